#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
/// From the scene's plane to the coordinates of a layer.
using Project = std::function<geometry::Point(geometry::Point)>;

/// A GeoJSON FeatureCollection of one instant while it is written, a feature a line: start() opens the
/// properties, end_with() closes them and writes the geometry.
class GeojsonLayer {
 public:
  explicit GeojsonLayer(double time, Project project = {});

  JsonWriter& start();
  void end_with(const geometry::Polygon& polygon);
  void end_with(const std::vector<geometry::Polygon>& polygons);
  void end_with(const geometry::Ring& line);
  void end_with(geometry::Point point);
  /// What was written since the last take(), so that a long layer need not fit into memory.
  std::string take() { return std::exchange(text_, {}); }
  std::size_t size() const { return text_.size(); }  ///< of it [bytes]
  std::string finish();

 private:
  JsonWriter& open_geometry(const char* type);
  geometry::Ring projected(geometry::Ring points) const;
  geometry::Polygon projected(geometry::Polygon polygon) const;

  Project project_;  ///< empty: none
  std::string text_;
  JsonWriter json_;
};

}  // namespace polynya::io
