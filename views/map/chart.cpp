#include "views/map/chart.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "views/map/axis_scale.hpp"
#include "views/map/svg_text.hpp"

namespace polynya::views {
namespace {

constexpr double kLeft = 92;         ///< of a frame, for the y axis' numbers and label [px]
constexpr double kRight = 24;        ///< [px]
constexpr double kBelow = 62;        ///< of a frame, for the x axis' numbers and label [px]
constexpr double kTitleLine = 20;    ///< of a panel [px]
constexpr double kLeastPitch = 300;  ///< from panel to panel [px]
constexpr std::size_t kMostColumns = 3;
constexpr auto kMajorMark = "#000000";
constexpr auto kMinorMark = "#555555";

AxisScale scale_of(const Chart::Panel& panel, const Chart::Axis& axis, double Chart::Point::*coordinate,
                   AxisFit fit) {
  if (axis.range)
    return axis_scale(axis.range->first, axis.range->second, axis.is_log,
                      axis.is_exact ? AxisFit::kTight : fit);
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
        columns_(chart.columns > 0 ? chart.columns : columns_for(chart.panels.size(), chart.page)),
        pitch_((chart.page.pixels() - kRight) / static_cast<double>(columns_)),
        heading_(chart.page, kRight, chart.title, chart.caption),
        titles_(panel_titles()),
        names_(legend_names()),
        legend_(legend_entries(), kLeft, chart.page.pixels() - kRight),
        svg_(chart.page.pixels(), legend_top() + legend_.height()) {}

  std::string draw() {
    heading_.draw(svg_);
    for (std::size_t i = 0; i < chart_.panels.size(); ++i) {
      left_ = pitch_ * static_cast<double>(i % columns_) + kLeft;
      width_ = pitch_ - kLeft - 12;
      top_ = top_of_row(static_cast<double>(row_of(i, columns_)));
      if (!chart_.panels[i].title.empty()) draw_panel(chart_.panels[i], i);
    }
    draw_legend();
    return svg_.finish();
  }

 private:
  /// Of the frames in it.
  double top_of_row(double row) const {
    std::size_t lines = 1;
    for (const auto& title : titles_) lines = std::max(lines, title.size());
    const double head = 16 + kTitleLine * static_cast<double>(lines);
    return heading_.height() + head + row * (head + chart_.panel_height + kBelow);
  }
  double legend_top() const {
    const auto rows = static_cast<double>(rows_of(std::max<std::size_t>(1, chart_.panels.size()), columns_));
    return top_of_row(rows - 1) + chart_.panel_height + kBelow;
  }
  /// With their letters, in lines.
  std::vector<std::vector<std::string>> panel_titles() const {
    const auto shown = static_cast<std::size_t>(
        std::ranges::count_if(chart_.panels, [](const Chart::Panel& p) { return !p.title.empty(); }));
    std::vector<std::vector<std::string>> titles;
    std::size_t number = 0;
    for (const Chart::Panel& panel : chart_.panels) {
      if (panel.title.empty())
        titles.emplace_back();
      else
        titles.push_back(wrapped(letter_of(number++, shown) + panel.title, 17.6, pitch_ - 24));
    }
    return titles;
  }
  double px(double x) const { return left_ + width_ * x_scale_.share(x); }
  double py(double y) const { return top_ + chart_.panel_height * (1 - y_scale_.share(y)); }

  void draw_panel(const Chart::Panel& panel, std::size_t number) {
    x_scale_ = scale_of(panel, panel.x, &Chart::Point::x, AxisFit::kTight);
    y_scale_ = scale_of(panel, panel.y, &Chart::Point::y, AxisFit::kRoomy);
    draw_axes(panel, titles_[number]);
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

  void draw_axes(const Chart::Panel& panel, const std::vector<std::string>& title) {
    const double bottom = top_ + chart_.panel_height;
    double y = top_ - 14 - kTitleLine * static_cast<double>(title.size() - 1);
    for (const std::string& line : title) {
      svg_.add("<text x='{:.2f}' y='{:.2f}' font-size='16' font-weight='bold'>{}</text>\n",
               left_ - kLeft + 24, y, io::escaped(line));
      y += kTitleLine;
    }
    double free_from = -kLeft;  // where there is room for the next number
    for (const double tick : x_scale_.ticks) {
      const std::string number = fmt::format("{:.6g}", tick);
      const double x = px(tick), half = 0.5 * width_of(number, 16);
      svg_.add("<path d='M{:.2f} {:.2f}V{:.2f}' stroke='#dddddd'/>\n", x, top_, bottom);
      if (x - half < free_from) continue;
      svg_.words(x, bottom + 22, 16, number, "middle");
      free_from = x + half + 8;
    }
    double free_below = bottom + 40;
    for (const double tick : y_scale_.ticks) {
      svg_.add("<path d='M{:.2f} {:.2f}h{:.2f}' stroke='#dddddd'/>\n", left_, py(tick), width_);
      if (py(tick) > free_below) continue;
      svg_.words(left_ - 8, py(tick) + 5.5, 16, fmt::format("{:.6g}", tick), "end");
      free_below = py(tick) - 18;
    }
    svg_.words(left_ + 0.5 * width_, bottom + 46, 16, panel.x.label, "middle");
    svg_.add(
        "<text transform='translate({:.2f} {:.2f}) rotate(-90)' font-size='16' "
        "text-anchor='middle'>{}</text>\n",
        left_ - 66, top_ + 0.5 * chart_.panel_height, io::escaped(panel.y.label));
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
  std::vector<const Chart::Curve*> legend_names() const {
    std::vector<const Chart::Curve*> names;
    for (const Chart::Panel& panel : chart_.panels) {
      for (const Chart::Curve& curve : panel.curves) {
        const auto is_it = [&](const Chart::Curve* other) { return other->name == curve.name; };
        if (!curve.name.empty() && std::ranges::none_of(names, is_it)) names.push_back(&curve);
      }
    }
    return names;
  }
  std::vector<Legend::Entry> legend_entries() const {
    std::vector<Legend::Entry> entries;
    for (const Chart::Curve* curve : names_) entries.push_back({curve->name});
    for (const std::string& mark : {chart_.minor_mark, chart_.major_mark}) {
      if (!mark.empty()) entries.push_back({mark, 24});
    }
    return entries;
  }

  void draw_legend() {
    const double top = legend_top();
    std::size_t entry = 0;
    for (const Chart::Curve* curve : names_) {
      const geometry::Point at = legend_.draw(svg_, entry++, top);
      svg_.add("<path d='M{:.2f} {:.2f}h48' stroke='{}' stroke-width='3' stroke-dasharray='{}'/>\n", at.x,
               at.y - 5.5, colour_of(*curve), dash_array(curve->dash));
    }
    if (!chart_.minor_mark.empty()) {
      const geometry::Point at = legend_.draw(svg_, entry++, top);
      svg_.add("<path d='M{:.2f} {:.2f}v10m8 -10v10m5 -10v10' stroke='{}'/>\n", at.x + 4, at.y - 11,
               kMinorMark);
    }
    if (!chart_.major_mark.empty()) {
      const geometry::Point at = legend_.draw(svg_, entry++, top);
      svg_.add("<path d='M{:.2f} {:.2f}l-7 -14h14Z' fill='{}'/>\n", at.x + 12, at.y, kMajorMark);
    }
  }

  const Chart& chart_;
  std::size_t columns_;
  double pitch_;  ///< from panel to panel [px]
  Heading heading_;
  std::vector<std::vector<std::string>> titles_;  ///< of the panels, in lines
  std::vector<const Chart::Curve*> names_;        ///< in the legend
  Legend legend_;
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

std::size_t columns_for(std::size_t panels, const PageStyle& page) {
  const double room = std::clamp(page.pixels() / kLeastPitch, 1.0, static_cast<double>(kMostColumns));
  return panels == 0 ? 1 : rows_of(panels, rows_of(panels, static_cast<std::size_t>(room)));
}

std::string to_svg(const Chart& chart) {
  return SvgChart(chart).draw();
}

}  // namespace polynya::views
