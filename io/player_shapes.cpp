#include "io/player_shapes.hpp"

#include <map>
#include <tuple>

#include "geometry/boundary.hpp"

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
    const simulation::Birth& birth = floe.birth;
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
    add_ring(birth.polygon_in_body.outer);
    for (const geometry::Ring& hole : birth.polygon_in_body.holes) add_ring(hole);
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

namespace {

/// Circles told once each, and runs of them.
class CircleTable {
 public:
  /// The circles of one polygon. `family` keeps circles of floes in different frames apart.
  void add(FloeId family, const geometry::Polygon& polygon, Point origin, double radius) {
    const geometry::EdgeList edges = edge_list(polygon);
    for (const geometry::ContactCircle& circle :
         sample_contact_circles(edges, boundary_pieces(edges, radius), radius)) {
      const auto next = static_cast<std::int32_t>(circles.size() / 3);
      const auto [found, is_new] =
          numbers_.try_emplace({family, circle.centre.x, circle.centre.y, circle.radius}, next);
      if (is_new) {
        circles.push_back(static_cast<float>(circle.centre.x - origin.x));
        circles.push_back(static_cast<float>(circle.centre.y - origin.y));
        circles.push_back(static_cast<float>(circle.radius));
      }
      append(found->second);
    }
    runs_of.push_back(static_cast<std::int32_t>(runs.size() / 2));
  }
  std::vector<float> circles;      ///< x, y, radius [m]
  std::vector<std::int32_t> runs;  ///< first, count
  std::vector<std::int32_t> runs_of{0};

 private:
  void append(std::int32_t number) {
    const bool starts = static_cast<std::size_t>(runs_of.back()) * 2 == runs.size();
    if (!starts && runs[runs.size() - 2] + runs.back() == number)
      ++runs.back();
    else
      runs.insert(runs.end(), {number, 1});
  }
  std::map<std::tuple<FloeId, double, double, double>, std::int32_t> numbers_;
};

}  // namespace

bool add_contact_circles(ColumnWriter& columns, const Run& run, std::size_t most) {
  const double radius = run.scene.scene.contact.circle_radius;
  CircleTable table;
  std::vector<FloeId> oldest;  // by floe
  for (const RunFloe& floe : run.floes) {
    const FloeId parent = floe.birth.parent;
    const FloeId id = floe.birth.floe;
    oldest.push_back(parent >= 0 && parent < id ? oldest[static_cast<std::size_t>(parent)] : id);
    table.add(oldest.back(), floe.birth.polygon_in_body, run.floe(oldest.back())->birth.centroid_in_body,
              radius);
    if (table.circles.size() / 3 > most) return false;
  }
  FloeId family = simulation::kNoFloe;
  for (const simulation::ShipSpec& ship : run.scene.scene.ships)
    table.add(family--, {ship.hull.waterline, {}}, {}, radius);
  columns.add("circles_m", table.circles);
  columns.add("circle_runs", table.runs);
  columns.add("circle_runs_of", table.runs_of);
  return true;
}

}  // namespace polynya::io
