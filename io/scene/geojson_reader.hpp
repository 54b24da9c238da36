#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/scene/scene_draft.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

struct GeojsonPolygon {
  geometry::Polygon polygon;  ///< in house notation (floe_group.hpp), not checked for validity
  std::uint32_t offset = 0;   ///< of its coordinates in the text
  GivenIce ice;               ///< of its feature's properties
};

struct GeojsonFloes {
  std::vector<GeojsonPolygon> polygons;
  std::optional<double> run_time;  ///< where the floes are those of a run at that time [s]
};

/// The polygons of a GeoJSON text (Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection), in
/// order, with what its features' properties give of their ice. Coordinates are metres in the scene's plane;
/// a third one is passed over. Anything else is added as a problem of that source of the collector; so is,
/// once for the whole text, that its coordinates are longitude and latitude (by its crs, or by how little ice
/// they would be) or too large.
GeojsonFloes read_geojson(std::size_t source, ProblemCollector& problems);

}  // namespace polynya::io
