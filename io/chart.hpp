#pragma once

#include <string>
#include <vector>

namespace polynya::io {

/// Curves over common axes, several panels side by side.
struct Chart {
  struct Point {
    double x = 0;
    double y = 0;
    bool is_faint = false;  ///< drawn faintly: outside of what the curve is good for
  };
  enum class Dash { kSolid, kDashed, kDotted };
  struct Curve {
    std::string name;
    int colour = 0;  ///< of kCurveColours, counted round
    Dash dash = Dash::kSolid;
    std::vector<Point> points;
  };
  struct Axis {
    std::string label;  ///< with its unit
    bool is_log = false;
  };
  struct Panel {
    std::string title;
    Axis x, y;
    std::vector<Curve> curves;
  };
  std::string title;
  std::string caption;
  std::vector<Panel> panels;
};

/// Dark to light, apart for colour-blind eyes [Okabe2008]: blue, vermilion, green, purple, black, grey.
inline constexpr const char* kCurveColours[] = {"#0072b2", "#d55e00", "#009e73",
                                                "#aa4499", "#000000", "#777777"};

/// The chart as SVG, 1600 px wide, the legend below taken from the first panel. A linear axis of positive
/// values starts at 0. On a log axis points that are not positive are left out, on any axis those that are
/// not finite. The same chart gives the same bytes.
std::string to_svg(const Chart& chart);

}  // namespace polynya::io
