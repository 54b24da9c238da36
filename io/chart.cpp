#include "io/chart.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "io/xml_text.hpp"

namespace polynya::io {
namespace {

constexpr double kWidth = 1600;       ///< [px]
constexpr double kHeader = 112;       ///< [px]
constexpr double kPanelHeight = 560;  ///< of the axes' frame [px]
constexpr double kLeft = 92;          ///< of a frame, for the y axis' numbers and label [px]
constexpr double kRight = 24;         ///< [px]
constexpr double kBelow = 80;         ///< of a frame, for the x axis' numbers and label [px]
constexpr double kLegendLine = 30;    ///< [px]

/// An axis with its range, its ticks, and where on the paper a value lies.
struct Scale {
  bool is_log = false;
  double low = 0;
  double high = 1;
  std::vector<double> ticks;

  bool takes(double value) const { return std::isfinite(value) && (!is_log || value > 0); }
  /// 0 at the low end, 1 at the high end.
  double share(double value) const {
    return is_log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  }
};

std::vector<double> log_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  const std::vector<double> mantissas = decades > 3     ? std::vector{1.0}
                                        : decades > 0.9 ? std::vector{1.0, 2.0, 5.0}
                                                        : std::vector{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0};
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::log10(high); ++power) {
    for (const double mantissa : mantissas) {
      const double tick = mantissa * std::pow(10.0, power);
      if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) ticks.push_back(tick);
    }
  }
  return ticks;
}

/// The least of 1, 2, 5 × 10ⁿ that makes at most eight steps of the range.
double linear_step(double range) {
  const double decade = std::pow(10, std::floor(std::log10(range / 8)));
  for (const double mantissa : {1.0, 2.0, 5.0}) {
    if (range / (mantissa * decade) <= 8) return mantissa * decade;
  }
  return 10 * decade;
}

Scale scale_of(const Chart::Panel& panel, const Chart::Axis& axis, double Chart::Point::*coordinate,
               bool is_tight) {
  Scale scale;
  scale.is_log = axis.is_log;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Chart::Curve& curve : panel.curves) {
    for (const Chart::Point& point : curve.points) {
      if (!scale.takes(point.*coordinate)) continue;
      low = std::min(low, point.*coordinate);
      high = std::max(high, point.*coordinate);
    }
  }
  if (!(low <= high)) low = high = 1;
  if (axis.is_log) {
    const double room = is_tight ? 1 : std::pow(high / low, 0.06) * 1.02;
    scale.low = low / room;
    scale.high = std::max(high * room, scale.low * 1.1);
    scale.ticks = log_ticks(scale.low, scale.high);
    return scale;
  }
  if (!is_tight && low > 0) low = 0;
  if (high <= low) high = low + std::max(1.0, std::abs(low));
  const double step = linear_step(high - low);
  scale.low = is_tight ? low : std::floor(low / step) * step;
  scale.high = is_tight ? high : std::ceil(high / step + 0.2) * step;
  for (auto i = std::llround(std::ceil(scale.low / step - 1e-9));
       static_cast<double>(i) * step <= scale.high * (1 + 1e-9); ++i)
    scale.ticks.push_back(static_cast<double>(i) * step);
  return scale;
}

const char* dash_array(Chart::Dash dash) {
  return dash == Chart::Dash::kSolid ? "none" : dash == Chart::Dash::kDashed ? "12 6" : "2.5 5";
}

const char* colour_of(const Chart::Curve& curve) {
  return kCurveColours[static_cast<std::size_t>(curve.colour) % std::size(kCurveColours)];
}

class SvgChart {
 public:
  explicit SvgChart(const Chart& chart) : chart_(chart) {}

  std::string draw() {
    const double height = kHeader + kPanelHeight + kBelow + legend_height() + 16;
    add("<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
        "{1:.0f}' font-family='DejaVu Sans, Helvetica, Arial, sans-serif'>\n"
        "<rect width='100%' height='100%' fill='#ffffff'/>\n",
        kWidth, height);
    add("<text x='{:.0f}' y='34' font-size='24' font-weight='bold'>{}</text>\n", kRight,
        escaped(chart_.title));
    add("<text x='{:.0f}' y='60' font-size='16' fill='#333333'>{}</text>\n", kRight, escaped(chart_.caption));
    const double pitch =
        (kWidth - kRight) / static_cast<double>(std::max<std::size_t>(1, chart_.panels.size()));
    for (std::size_t i = 0; i < chart_.panels.size(); ++i) {
      left_ = pitch * static_cast<double>(i) + kLeft;
      width_ = pitch - kLeft - 12;
      draw_panel(chart_.panels[i], i);
    }
    draw_legend();
    add("</svg>\n");
    return std::move(svg_);
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(svg_), format, std::forward<Values>(values)...);
  }

  double px(double x) const { return left_ + width_ * x_scale_.share(x); }
  double py(double y) const { return kHeader + kPanelHeight * (1 - y_scale_.share(y)); }

  void draw_panel(const Chart::Panel& panel, std::size_t number) {
    x_scale_ = scale_of(panel, panel.x, &Chart::Point::x, true);
    y_scale_ = scale_of(panel, panel.y, &Chart::Point::y, false);
    draw_axes(panel);
    add("<clipPath id='panel{}'><rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}'/></clipPath>\n"
        "<g clip-path='url(#panel{})' fill='none' stroke-linejoin='round'>\n",
        number, left_, kHeader, width_, kPanelHeight, number);
    for (const Chart::Curve& curve : panel.curves) draw_curve(curve);
    add("</g>\n<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='none' stroke='#000000'/>\n",
        left_, kHeader, width_, kPanelHeight);
  }

  void draw_axes(const Chart::Panel& panel) {
    const double bottom = kHeader + kPanelHeight;
    add("<text x='{:.2f}' y='{:.2f}' font-size='18' font-weight='bold'>{}</text>\n<g font-size='16'>\n",
        left_, kHeader - 10, escaped(panel.title));
    for (const double tick : x_scale_.ticks)
      add("<path d='M{0:.2f} {1:.2f}V{2:.2f}' stroke='#dddddd'/><text x='{0:.2f}' y='{3:.2f}' "
          "text-anchor='middle'>{4:.6g}</text>\n",
          px(tick), kHeader, bottom, bottom + 24, tick);
    for (const double tick : y_scale_.ticks)
      add("<path d='M{0:.2f} {1:.2f}h{2:.2f}' stroke='#dddddd'/><text x='{3:.2f}' y='{4:.2f}' "
          "text-anchor='end'>{5:.6g}</text>\n",
          left_, py(tick), width_, left_ - 8, py(tick) + 5.5, tick);
    add("<text x='{:.2f}' y='{:.2f}' text-anchor='middle'>{}</text>\n", left_ + 0.5 * width_, bottom + 54,
        escaped(panel.x.label));
    add("<text transform='translate({:.2f} {:.2f}) rotate(-90)' text-anchor='middle'>{}</text>\n</g>\n",
        left_ - 62, kHeader + 0.5 * kPanelHeight, escaped(panel.y.label));
  }

  /// Runs of points that are alike faint or not; a run begins at the last point of the one before it.
  void draw_curve(const Chart::Curve& curve) {
    std::vector<Chart::Point> points;
    std::ranges::copy_if(curve.points, std::back_inserter(points),
                         [&](const Chart::Point& p) { return x_scale_.takes(p.x) && y_scale_.takes(p.y); });
    for (std::size_t i = 0; i + 1 < points.size();) {
      const bool is_faint = points[i].is_faint || points[i + 1].is_faint;
      add("<path d='M{:.2f} {:.2f}", px(points[i].x), py(points[i].y));
      for (; i + 1 < points.size() && (points[i].is_faint || points[i + 1].is_faint) == is_faint; ++i)
        add("L{:.2f} {:.2f}", px(points[i + 1].x), py(points[i + 1].y));
      add("' stroke='{}' stroke-width='3' stroke-dasharray='{}' stroke-opacity='{}'/>\n", colour_of(curve),
          dash_array(curve.dash), is_faint ? "0.3" : "1");
    }
  }

  std::size_t legend_columns() const { return 3; }
  double legend_height() const {
    if (chart_.panels.empty()) return 0;
    const std::size_t lines = (chart_.panels.front().curves.size() + legend_columns() - 1) / legend_columns();
    return kLegendLine * static_cast<double>(lines);
  }

  void draw_legend() {
    if (chart_.panels.empty()) return;
    const double top = kHeader + kPanelHeight + kBelow + 16;
    const double pitch = (kWidth - kLeft) / static_cast<double>(legend_columns());
    const auto& curves = chart_.panels.front().curves;
    add("<g font-size='16'>\n");
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const double x = kLeft + pitch * static_cast<double>(i % legend_columns());
      const std::size_t line = i / legend_columns();
      const double y = top + kLegendLine * static_cast<double>(line);
      add("<path d='M{:.2f} {:.2f}h48' stroke='{}' stroke-width='3' stroke-dasharray='{}'/>", x, y - 5.5,
          colour_of(curves[i]), dash_array(curves[i].dash));
      add("<text x='{:.2f}' y='{:.2f}'>{}</text>\n", x + 58, y, escaped(curves[i].name));
    }
    add("</g>\n");
  }

  const Chart& chart_;
  Scale x_scale_, y_scale_;
  double left_ = 0;   ///< of the panel's frame [px]
  double width_ = 0;  ///< of the panel's frame [px]
  std::string svg_;
};

}  // namespace

std::string to_svg(const Chart& chart) {
  return SvgChart(chart).draw();
}

}  // namespace polynya::io
