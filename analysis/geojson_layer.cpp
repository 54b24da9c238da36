#include "analysis/geojson_layer.hpp"

#include <algorithm>
#include <utility>

namespace polynya::analysis {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

GeojsonLayer::GeojsonLayer(double time, Project project)
    : project_(project ? std::move(project) : [](Point p) { return p; }), json_(text_) {
  json_.open('{').key("type").value("FeatureCollection").key("t_s").value(time).key("features").open('[');
}

io::JsonWriter& GeojsonLayer::start() {
  json_.start_line();
  return json_.open('{').key("type").value("Feature").key("properties").open('{');
}

io::JsonWriter& GeojsonLayer::open_geometry(const char* type) {
  return json_.close('}').key("geometry").open('{').key("type").value(type).key("coordinates");
}

Ring GeojsonLayer::projected(Ring points) const {
  for (Point& p : points) p = project_(p);
  return points;
}

void GeojsonLayer::write(const Polygon& polygon) {
  const auto write_ring = [this](Ring ring) {
    ring.push_back(ring.front());
    json_.value(projected(std::move(ring)));
  };
  json_.open('[');
  write_ring(polygon.outer);
  std::ranges::for_each(polygon.holes, write_ring);
  json_.close(']');
}

void GeojsonLayer::end_with(const Polygon& polygon) {
  open_geometry("Polygon");
  write(polygon);
  json_.close('}').close('}');
}

void GeojsonLayer::end_with(const std::vector<Polygon>& polygons) {
  open_geometry("MultiPolygon").open('[');
  for (const Polygon& polygon : polygons) write(polygon);
  json_.close(']').close('}').close('}');
}

void GeojsonLayer::end_with(const Ring& line) {
  open_geometry("LineString").value(projected(line)).close('}').close('}');
}

void GeojsonLayer::end_with(Point point) {
  open_geometry("Point").value(project_(point)).close('}').close('}');
}

std::string GeojsonLayer::finish() {
  json_.close(']').close('}');
  return std::move(text_) + "\n";
}

}  // namespace polynya::analysis
