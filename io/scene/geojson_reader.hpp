#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/import/floe_properties.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

struct GeojsonPolygon {
  geometry::Polygon polygon;  ///< rings as drawn, not checked for validity
  FloeProperties properties;  ///< of its feature
  std::uint32_t offset = 0;   ///< of its coordinates in the text
};

struct GeojsonFloes {
  std::vector<GeojsonPolygon> polygons;
  std::optional<double> run_time;  ///< where the floes are those of a run at that time [s]
  std::string crs;                 ///< the system that the text names; empty: none
  std::uint32_t crs_offset = 0;    ///< of it in the text
  std::vector<NearMiss> near_misses;
  bool are_metres = false;  ///< the features' area_m2 are those of their coordinates
};

/// The polygons of a GeoJSON text (Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection), in
/// order, with their properties by these names. A third coordinate is passed over. Anything else is added as
/// a problem of that source of the collector.
GeojsonFloes read_geojson(std::size_t source, const PropertyNames& names, ProblemCollector& problems);

}  // namespace polynya::io
