#include "io/player_shapes.hpp"

namespace polynya::io {

using geometry::Point;
using simulation::FloeId;

void ColumnWriter::add_raw(const std::string& name, const char* type, const void* data, std::size_t count,
                           std::size_t size) {
  bytes_.resize((bytes_.size() + 7) / 8 * 8);
  table_.push_back({name, type, bytes_.size(), count});
  bytes_.append(static_cast<const char*>(data), count * size);
}
void ColumnWriter::add(const std::string& name, const std::vector<double>& values) {
  add_raw(name, "f64", values.data(), values.size(), sizeof(double));
}
void ColumnWriter::add(const std::string& name, const std::vector<float>& values) {
  add_raw(name, "f32", values.data(), values.size(), sizeof(float));
}
void ColumnWriter::add(const std::string& name, const std::vector<std::int32_t>& values) {
  add_raw(name, "i32", values.data(), values.size(), sizeof(std::int32_t));
}
void ColumnWriter::add(const std::string& name, std::string_view bytes) {
  add_raw(name, "u8", bytes.data(), bytes.size(), 1);
}

void add_floes(ColumnWriter& columns, const Run& run) {
  std::vector<std::int32_t> parent, generation, rings_of{0}, ring_ends;
  std::vector<double> born, died, area, mass, centroid_x, centroid_y;
  std::vector<float> points;
  for (const RunFloe& floe : run.floes) {
    const simulation::BirthRecord& birth = floe.birth;
    const auto polygon = run.shape(birth.floe);
    parent.push_back(static_cast<std::int32_t>(birth.parent));
    generation.push_back(birth.generation);
    born.push_back(birth.time);
    died.push_back(floe.died);
    area.push_back(birth.area);
    mass.push_back(birth.mass);
    centroid_x.push_back(birth.centroid_in_body.x);
    centroid_y.push_back(birth.centroid_in_body.y);
    const auto add_ring = [&](const geometry::Ring& ring) {
      for (const Point p : ring) {
        points.push_back(static_cast<float>(p.x - birth.centroid_in_body.x));
        points.push_back(static_cast<float>(p.y - birth.centroid_in_body.y));
      }
      ring_ends.push_back(static_cast<std::int32_t>(points.size() / 2));
    };
    add_ring(polygon->outer);
    for (const geometry::Ring& hole : polygon->holes) add_ring(hole);
    rings_of.push_back(static_cast<std::int32_t>(ring_ends.size()));
  }
  columns.add("parent", parent);
  columns.add("generation", generation);
  columns.add("born_s", born);
  columns.add("died_s", died);
  columns.add("area_m2", area);
  columns.add("mass_kg", mass);
  columns.add("centroid_x_m", centroid_x);
  columns.add("centroid_y_m", centroid_y);
  columns.add("rings_of", rings_of);
  columns.add("ring_ends", ring_ends);
  columns.add("points_m", points);
}

}  // namespace polynya::io
