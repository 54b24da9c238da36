#pragma once

#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::views {

enum class FractureMark { kBend, kSplit, kGrind };

/// A run at an instant, drawn from above.
struct Picture {
  struct Floe {
    geometry::Polygon polygon_in_world;  ///< [m]
    int generation = 0;
    bool came_up = false;  ///< from under a hull
  };
  struct Ship {
    geometry::Ring waterline_in_world;   ///< [m]
    std::vector<geometry::Point> track;  ///< of its centre of gravity [m]
    bool is_wall = false;
  };
  struct Fracture {
    geometry::Point point_in_world;  ///< [m]
    FractureMark mark = FractureMark::kBend;
  };
  std::string title;
  std::string caption;
  std::vector<geometry::Polygon> ice_at_start;  ///< drawn faintly, so that the channel shows
  std::vector<Floe> floes;
  std::vector<geometry::Polygon> ice_under_hulls;  ///< drawn through the ships [m]
  std::vector<Ship> ships;
  std::vector<Fracture> fractures;
};

/// The picture as SVG on a page as wide as a journal's, with scale bar and legend. Its colours stay apart in
/// greyscale and for colour-blind eyes.
std::string to_svg(const Picture& picture);

}  // namespace polynya::views
