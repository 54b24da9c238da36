#include "views/player/player_shapes.hpp"

#include <algorithm>

namespace polynya::views {

using geometry::Point;

void ColumnWriter::add_raw(const std::string& name, const char* type, const void* data, std::size_t count,
                           std::size_t size) {
  bytes_.resize((bytes_.size() + 7) / 8 * 8);
  table_.push_back({name, type, bytes_.size(), count});
  bytes_.append(static_cast<const char*>(data), count * size);
}
void ColumnWriter::add(const std::string& name, const std::vector<double>& values) {
  add_raw(name, "f64", values.data(), values.size(), sizeof(double));
}
void ColumnWriter::add(const std::string& name, const std::vector<std::int32_t>& values) {
  add_raw(name, "i32", values.data(), values.size(), sizeof(std::int32_t));
}
void ColumnWriter::add(const std::string& name, std::string_view bytes) {
  add_raw(name, "u8", bytes.data(), bytes.size(), 1);
}

namespace {

/// The shapes of floes while they are gathered (views/player/run_data.js reads them).
class ShapeColumns {
 public:
  explicit ShapeColumns(const io::Run& run) : run_(run) {}

  void add(const simulation::BirthRecord& birth) {
    const io::ShapeParts* parts = run_.shapes.parts_of(birth.floe);
    const auto polygon = run_.shape(birth.floe);
    double reach = 0;  // no hole reaches farther than the outer ring
    for (const Point p : polygon->outer) reach = std::max(reach, distance(p, birth.centroid_in_body));
    reach_.push_back(reach);
    std::size_t end = 0;
    for (const std::size_t size : io::ring_sizes(*polygon)) {
      end += size;
      ring_ends_.push_back(static_cast<std::int32_t>(end));
    }
    rings_of_.push_back(static_cast<std::int32_t>(ring_ends_.size()));
    if (!parts) {
      add_points(polygon->outer);
      for (const geometry::Ring& hole : polygon->holes) add_points(hole);
      return;
    }
    add_points(parts->vertices);
    for (const io::ShapePart& part : parts->parts) {
      part_floe_.push_back(static_cast<std::int32_t>(birth.floe));
      part_ring_.push_back(part.ring);
      part_first_.push_back(static_cast<std::int32_t>(part.first));
      part_count_.push_back(static_cast<std::int32_t>(part.count));
    }
  }

  void add_to(ColumnWriter& columns) const {
    columns.add("rings_of", rings_of_);
    columns.add("ring_ends", ring_ends_);
    columns.add("part_floe", part_floe_);
    columns.add("part_ring", part_ring_);
    columns.add("part_first", part_first_);
    columns.add("part_count", part_count_);
    columns.add("reach_m", reach_);
    columns.add("points_m", points_);
  }

 private:
  void add_points(const geometry::Ring& ring) {
    for (const Point p : ring) points_.insert(points_.end(), {p.x, p.y});
  }

  const io::Run& run_;
  std::vector<std::int32_t> rings_of_{0}, ring_ends_, part_floe_, part_ring_, part_first_, part_count_;
  std::vector<double> points_, reach_;
};

}  // namespace

void add_floes(ColumnWriter& columns, const io::Run& run, const HeldFloes& held) {
  const auto add_of_floe = [&](const char* name, auto read) {
    columns.add(name, held.ids(), [&run, read](simulation::FloeId id) { return std::invoke(read, *run.floe(id)); });
  };
  const auto add = [&](const char* name, auto read) {
    add_of_floe(name, [read](const io::RunFloe& floe) { return std::invoke(read, floe.birth); });
  };
  using simulation::BirthRecord;
  if (!held.are_all()) add("floe_id", &BirthRecord::floe);
  add("parent", &BirthRecord::parent);
  add("generation", &BirthRecord::generation);
  add("born_s", &BirthRecord::time);
  add_of_floe("died_s", &io::RunFloe::died);
  add_of_floe("went_under_s", &io::RunFloe::went_under);
  add_of_floe("came_up", &io::RunFloe::came_up);
  add("area_m2", &BirthRecord::area);
  add("mass_kg", &BirthRecord::mass);
  const simulation::Scene& scene = run.scene.scene;
  add("thickness_m", [&](const BirthRecord& birth) { return ice_of(scene, birth.own_ice).thickness; });
  add("flexural_strength_Pa", [&](const BirthRecord& birth) { return ice_of(scene, birth.own_ice).flexural_strength; });
  add("centroid_x_m", [](const BirthRecord& birth) { return birth.centroid_in_body.x; });
  add("centroid_y_m", [](const BirthRecord& birth) { return birth.centroid_in_body.y; });
  ShapeColumns shapes(run);
  for (const simulation::FloeId id : held.ids()) shapes.add(run.floe(id)->birth);
  shapes.add_to(columns);
}

}  // namespace polynya::views
