#include "io/text/geojson_layer.hpp"

#include <utility>

namespace polynya::io {
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

GeojsonLayer::GeojsonLayer(double time, Project project) : project_(std::move(project)), json_(text_) {
  json_.open('{').key("type").value("FeatureCollection").key("t_s").value(time).key("features").open('[');
}

JsonWriter& GeojsonLayer::start() {
  json_.start_line();
  return json_.open('{').key("type").value("Feature").key("properties").open('{');
}

JsonWriter& GeojsonLayer::open_geometry(const char* type) {
  return json_.close('}').key("geometry").open('{').key("type").value(type).key("coordinates");
}

Ring GeojsonLayer::projected(Ring points) const {
  if (!project_) return points;
  for (Point& p : points) p = project_(p);
  return points;
}

Polygon GeojsonLayer::projected(Polygon polygon) const {
  polygon.outer = projected(std::move(polygon.outer));
  for (Ring& hole : polygon.holes) hole = projected(std::move(hole));
  return polygon;
}

void GeojsonLayer::end_with(const Polygon& polygon) {
  open_geometry("Polygon").value(projected(polygon)).close('}').close('}');
}

void GeojsonLayer::end_with(const std::vector<Polygon>& polygons) {
  open_geometry("MultiPolygon").open('[');
  for (const Polygon& polygon : polygons) json_.value(projected(polygon));
  json_.close(']').close('}').close('}');
}

void GeojsonLayer::end_with(const Ring& line) {
  open_geometry("LineString").value(projected(line)).close('}').close('}');
}

void GeojsonLayer::end_with(Point point) {
  open_geometry("Point").value(project_ ? project_(point) : point).close('}').close('}');
}

std::string GeojsonLayer::finish() {
  json_.close(']').close('}');
  return std::move(text_) + "\n";
}

}  // namespace polynya::io
