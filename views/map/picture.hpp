#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/journal.hpp"
#include "views/map/svg_layout.hpp"

namespace polynya::views {

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
    simulation::EventKind kind = simulation::EventKind::kBend;
  };
  std::string title;
  std::string caption;
  std::vector<geometry::Polygon> ice_at_start;  ///< drawn faintly, so that the channel shows
  std::vector<Floe> floes;
  std::vector<geometry::Polygon> ice_under_hulls;  ///< drawn through the ships [m]
  std::vector<Ship> ships;
  std::vector<Fracture> fractures;
  std::vector<geometry::Polygon> channel;  ///< open water along the track, drawn darker [m]
};

/// Several instants, or several runs, on one page and in one scale.
struct PictureSheet {
  std::string title;
  std::string caption;
  std::vector<Picture> pictures;  ///< their letters, titles and captions stand above each
  std::size_t columns = 1;        ///< at most, where the page has room for them
  PageStyle page = {};
  std::optional<geometry::Box> window = {};  ///< the part of the world to show; all of it if not given [m]
};

/// The picture as SVG, with scale bar and legend. Its colours stay apart in greyscale and for
/// colour-blind eyes.
std::string to_svg(const Picture& picture);
std::string to_svg(const PictureSheet& sheet);

}  // namespace polynya::views
