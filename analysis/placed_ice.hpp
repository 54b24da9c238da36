#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/shape/polygon.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::analysis {

/// A valid polygon of ice at some instant, with its box.
struct PlacedIce {
  const simulation::BirthRecord* birth = nullptr;  ///< of the floe; null: of the scene
  geometry::Polygon polygon;                       ///< in the world [m]
  geometry::Box box;
};

/// Adds a floe's polygon in the world. A placed shape is rounded and may not be valid any more: it is then
/// what its rings wind around, in as many polygons as that takes; none where they enclose nothing. Fails with
/// words where a coordinate is not finite.
tl::expected<void, std::string> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth,
                                        geometry::Polygon polygon_in_world);

/// The polygons whose boxes meet a box.
std::vector<geometry::Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box);

/// What of a polygon others cover and what not.
struct Parted {
  std::vector<geometry::Polygon> inside;
  std::vector<geometry::Polygon> outside;
  double inside_area = 0;  ///< [m²]
};

/// Exact but for one rounding of vertices. Fails with words where geometry refuses the cut.
tl::expected<Parted, std::string> part(const geometry::Polygon& polygon, const std::vector<geometry::Polygon>& by);

}  // namespace polynya::analysis
