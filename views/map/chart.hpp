#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "views/map/svg_layout.hpp"

namespace polynya::views {

/// Curves over common axes, in panels side by side and below each other.
struct Chart {
  struct Point {
    double x = 0;
    double y = 0;
    bool is_faint = false;  ///< drawn faintly: outside of what the curve is good for
  };
  enum class Dash { kSolid, kDashed, kDotted };
  enum class Form {
    kLine,   ///< from point to point
    kStems,  ///< from 0 to each point
    kSteps,  ///< a point's value holds from the point before it up to it
  };
  struct Curve {
    std::string name;
    int colour = 0;  ///< of kCurveColours, counted round
    Dash dash = Dash::kSolid;
    std::vector<Point> points;
    Form form = Form::kLine;
  };
  struct Axis {
    std::string label;  ///< with its unit
    bool is_log = false;
    std::optional<std::pair<double, double>> range = {};  ///< instead of that of the curves
    bool is_exact = false;                                ///< the axis ends where the range does
  };
  /// Something that happened at some x.
  struct Mark {
    double x = 0;
    bool is_major = false;  ///< a triangle and a line through the panel; else a dot at its top
  };
  struct Panel {
    std::string title;
    Axis x, y;
    std::vector<Curve> curves;
    std::vector<Mark> marks = {};
  };
  std::string title;
  std::string caption;
  std::vector<Panel> panels;    ///< one without a title leaves its place blank
  std::size_t columns = 0;      ///< panels beside each other; 0: as many as the page has room for
  double panel_height = 380;    ///< of a frame [px]
  std::string minor_mark = {};  ///< what marks mean, for the legend
  std::string major_mark = {};
  PageStyle page = {};
};

/// Panels beside each other on such a page, so that none is too narrow to read and the rows are nearly full.
std::size_t columns_for(std::size_t panels, const PageStyle& page);

/// Dark to light, apart for colour-blind eyes [Okabe2008]: blue, vermilion, green, purple, black, grey,
/// sky blue.
inline constexpr const char* kCurveColours[] = {"#0072b2", "#d55e00", "#009e73", "#aa4499",
                                                "#000000", "#777777", "#56b4e9"};

/// The colour of the n-th of several runs: black, vermilion, sky blue, blue, purple; the first three are
/// apart in greyscale too.
int colour_of_run(std::size_t run);

/// The chart as SVG; several panels have letters, and the legend below has each name once. A linear axis of
/// positive values starts at 0. On a log axis points that are not positive are left out, on any axis those
/// that are not finite. The same chart gives the same bytes.
std::string to_svg(const Chart& chart);

}  // namespace polynya::views
