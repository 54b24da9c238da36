#include "io/chart.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "io/axis_scale.hpp"
#include "io/rows_of.hpp"
#include "io/svg_text.hpp"

namespace polynya::io {
namespace {

constexpr double kWidth = 1600;     ///< [px]
constexpr double kHeader = 112;     ///< [px]
constexpr double kHeadOfRow = 32;   ///< for the titles of further rows of panels [px]
constexpr double kLeft = 92;        ///< of a frame, for the y axis' numbers and label [px]
constexpr double kRight = 24;       ///< [px]
constexpr double kBelow = 80;       ///< of a frame, for the x axis' numbers and label [px]
constexpr double kLegendLine = 30;  ///< [px]
constexpr std::size_t kLegendColumns = 3;
constexpr auto kMajorMark = "#000000";
constexpr auto kMinorMark = "#555555";

AxisScale scale_of(const Chart::Panel& panel, const Chart::Axis& axis, double Chart::Point::*coordinate,
                   AxisFit fit) {
  if (axis.range) return axis_scale(axis.range->first, axis.range->second, axis.is_log, fit);
  const AxisScale any{.is_log = axis.is_log, .ticks = {}};
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Chart::Curve& curve : panel.curves) {
    for (const Chart::Point& point : curve.points) {
      if (!any.takes(point.*coordinate)) continue;
      low = std::min(low, point.*coordinate);
      high = std::max(high, point.*coordinate);
    }
  }
  if (!(low <= high)) low = high = 1;
  return axis_scale(low, high, axis.is_log, fit);
}

const char* dash_array(Chart::Dash dash) {
  return dash == Chart::Dash::kSolid ? "none" : dash == Chart::Dash::kDashed ? "12 6" : "2.5 5";
}

const char* colour_of(const Chart::Curve& curve) {
  return kCurveColours[static_cast<std::size_t>(curve.colour) % std::size(kCurveColours)];
}

class SvgChart {
 public:
  explicit SvgChart(const Chart& chart)
      : chart_(chart),
        columns_(chart.columns > 0 ? chart.columns : std::max<std::size_t>(1, chart.panels.size())),
        row_height_(chart.panel_height + kBelow),
        legend_(legend_entries()),
        svg_(kWidth, page_height()) {}

  std::string draw() {
    svg_.title(kRight, chart_.title, chart_.caption);
    const double pitch = (kWidth - kRight) / static_cast<double>(columns_);
    for (std::size_t i = 0; i < chart_.panels.size(); ++i) {
      left_ = pitch * static_cast<double>(i % columns_) + kLeft;
      width_ = pitch - kLeft - 12;
      top_ = kHeader + (row_height_ + kHeadOfRow) * static_cast<double>(row_of(i, columns_));
      if (!chart_.panels[i].title.empty()) draw_panel(chart_.panels[i], i);
    }
    draw_legend();
    return svg_.finish();
  }

 private:
  double page_height() const {
    return kHeader + rows() * row_height_ + (rows() - 1) * kHeadOfRow + legend_height() + 16;
  }
  double rows() const {
    return static_cast<double>(rows_of(std::max<std::size_t>(1, chart_.panels.size()), columns_));
  }
  double px(double x) const { return left_ + width_ * x_scale_.share(x); }
  double py(double y) const { return top_ + chart_.panel_height * (1 - y_scale_.share(y)); }

  void draw_panel(const Chart::Panel& panel, std::size_t number) {
    x_scale_ = scale_of(panel, panel.x, &Chart::Point::x, AxisFit::kTight);
    y_scale_ = scale_of(panel, panel.y, &Chart::Point::y, AxisFit::kRoomy);
    draw_axes(panel);
    svg_.add(
        "<clipPath id='panel{}'><rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}'/></clipPath>\n"
        "<g clip-path='url(#panel{})' fill='none' stroke-linejoin='round'>\n",
        number, left_, top_, width_, chart_.panel_height, number);
    for (const Chart::Mark& mark : panel.marks) draw_mark(mark);
    for (const Chart::Curve& curve : panel.curves) draw_curve(curve);
    svg_.add(
        "</g>\n<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='none' stroke='#000000'/>\n",
        left_, top_, width_, chart_.panel_height);
  }

  void draw_axes(const Chart::Panel& panel) {
    const double bottom = top_ + chart_.panel_height;
    svg_.add("<text x='{:.2f}' y='{:.2f}' font-size='18' font-weight='bold'>{}</text>\n<g font-size='16'>\n",
             left_, top_ - 10, escaped(panel.title));
    for (const double tick : x_scale_.ticks)
      svg_.add(
          "<path d='M{0:.2f} {1:.2f}V{2:.2f}' stroke='#dddddd'/><text x='{0:.2f}' y='{3:.2f}' "
          "text-anchor='middle'>{4:.6g}</text>\n",
          px(tick), top_, bottom, bottom + 24, tick);
    for (const double tick : y_scale_.ticks)
      svg_.add(
          "<path d='M{0:.2f} {1:.2f}h{2:.2f}' stroke='#dddddd'/><text x='{3:.2f}' y='{4:.2f}' "
          "text-anchor='end'>{5:.6g}</text>\n",
          left_, py(tick), width_, left_ - 8, py(tick) + 5.5, tick);
    svg_.add("<text x='{:.2f}' y='{:.2f}' text-anchor='middle'>{}</text>\n", left_ + 0.5 * width_,
             bottom + 54, escaped(panel.x.label));
    svg_.add("<text transform='translate({:.2f} {:.2f}) rotate(-90)' text-anchor='middle'>{}</text>\n</g>\n",
             left_ - 62, top_ + 0.5 * chart_.panel_height, escaped(panel.y.label));
  }

  void draw_mark(const Chart::Mark& mark) {
    const double x = px(mark.x);
    if (mark.is_major) {
      svg_.add("<path d='M{:.2f} {:.2f}V{:.2f}' stroke='#999999' stroke-width='1' stroke-dasharray='8 4'/>\n",
               x, top_ + 16, top_ + chart_.panel_height);
      svg_.add("<path d='M{:.2f} {:.2f}l-7 -14h14Z' fill='{}'/>\n", x, top_ + 16, kMajorMark);
    } else {
      svg_.add("<path d='M{:.2f} {:.2f}v10' stroke='{}' stroke-opacity='0.6'/>\n", x, top_ + 18, kMinorMark);
    }
  }

  std::vector<Chart::Point> shown(const Chart::Curve& curve) const {
    std::vector<Chart::Point> points;
    std::ranges::copy_if(curve.points, std::back_inserter(points),
                         [&](const Chart::Point& p) { return x_scale_.takes(p.x) && y_scale_.takes(p.y); });
    return points;
  }

  void draw_curve(const Chart::Curve& curve) {
    const std::vector<Chart::Point> points = shown(curve);
    if (curve.form == Chart::Form::kLine) return draw_line(curve, points);
    if (points.empty()) return;
    const double width = curve.form == Chart::Form::kStems ? 1.2 : 3;
    svg_.add("<path d='");
    if (curve.form == Chart::Form::kStems) {
      for (const Chart::Point& p : points) svg_.add("M{:.2f} {:.2f}V{:.2f}", px(p.x), py(0), py(p.y));
    } else {
      svg_.add("M{:.2f} {:.2f}", px(points.front().x), py(points.front().y));
      for (const Chart::Point& p : points) svg_.add("V{:.2f}H{:.2f}", py(p.y), px(p.x));
    }
    svg_.add("' stroke='{}' stroke-width='{}' stroke-dasharray='{}'/>\n", colour_of(curve), width,
             dash_array(curve.dash));
  }

  /// Runs of points that are alike faint or not; a run begins at the last point of the one before it.
  void draw_line(const Chart::Curve& curve, const std::vector<Chart::Point>& points) {
    for (std::size_t i = 0; i + 1 < points.size();) {
      const bool is_faint = points[i].is_faint || points[i + 1].is_faint;
      svg_.add("<path d='M{:.2f} {:.2f}", px(points[i].x), py(points[i].y));
      for (; i + 1 < points.size() && (points[i].is_faint || points[i + 1].is_faint) == is_faint; ++i)
        svg_.add("L{:.2f} {:.2f}", px(points[i + 1].x), py(points[i + 1].y));
      svg_.add("' stroke='{}' stroke-width='3' stroke-dasharray='{}' stroke-opacity='{}'/>\n",
               colour_of(curve), dash_array(curve.dash), is_faint ? "0.3" : "1");
    }
  }

  /// The curves of all panels, each name once.
  std::vector<const Chart::Curve*> legend_entries() const {
    std::vector<const Chart::Curve*> entries;
    for (const Chart::Panel& panel : chart_.panels) {
      for (const Chart::Curve& curve : panel.curves) {
        const auto is_it = [&](const Chart::Curve* other) { return other->name == curve.name; };
        if (!curve.name.empty() && std::ranges::none_of(entries, is_it)) entries.push_back(&curve);
      }
    }
    return entries;
  }
  std::size_t mark_entries() const {
    return (chart_.minor_mark.empty() ? 0U : 1U) + (chart_.major_mark.empty() ? 0U : 1U);
  }
  double legend_height() const {
    return kLegendLine * static_cast<double>(rows_of(legend_.size() + mark_entries(), kLegendColumns));
  }

  void draw_legend() {
    const double top = page_height() - legend_height();
    std::size_t place = 0;
    const auto next = [&] {
      const double pitch = (kWidth - kLeft) / static_cast<double>(kLegendColumns);
      const double x = kLeft + pitch * static_cast<double>(place % kLegendColumns);
      const double y = top + kLegendLine * static_cast<double>(row_of(place, kLegendColumns));
      ++place;
      return std::pair{x, y};
    };
    for (const Chart::Curve* curve : legend_) {
      const auto [x, y] = next();
      svg_.add("<path d='M{:.2f} {:.2f}h48' stroke='{}' stroke-width='3' stroke-dasharray='{}'/>", x, y - 5.5,
               colour_of(*curve), dash_array(curve->dash));
      svg_.words(x + 58, y, 16, curve->name);
    }
    if (!chart_.minor_mark.empty()) {
      const auto [x, y] = next();
      svg_.add("<path d='M{:.2f} {:.2f}v10m8 -10v10m5 -10v10' stroke='{}'/>", x + 18, y - 11, kMinorMark);
      svg_.words(x + 58, y, 16, chart_.minor_mark);
    }
    if (!chart_.major_mark.empty()) {
      const auto [x, y] = next();
      svg_.add("<path d='M{:.2f} {:.2f}l-7 -14h14Z' fill='{}'/>", x + 24, y, kMajorMark);
      svg_.words(x + 58, y, 16, chart_.major_mark);
    }
  }

  const Chart& chart_;
  std::size_t columns_;
  double row_height_;  ///< [px]
  std::vector<const Chart::Curve*> legend_;
  SvgText svg_;
  AxisScale x_scale_, y_scale_;
  double left_ = 0;   ///< of the panel's frame [px]
  double width_ = 0;  ///< of the panel's frame [px]
  double top_ = 0;    ///< of the panel's frame [px]
};

}  // namespace

int colour_of_run(std::size_t run) {
  constexpr int kOrder[] = {4, 1, 6, 0, 3};
  return kOrder[run % std::size(kOrder)];
}

std::string to_svg(const Chart& chart) {
  return SvgChart(chart).draw();
}

}  // namespace polynya::io
