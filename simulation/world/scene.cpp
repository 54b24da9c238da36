#include "simulation/world/scene.hpp"

#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"

namespace polynya::simulation {
geometry::Ring wedge_bow_waterline(double length, double beam, double entrance_angle) {
  const double bow = 0.5 * beam / elementary::tan(entrance_angle);
  return {{0.5 * length, 0},
          {0.5 * length - bow, 0.5 * beam},
          {-0.5 * length, 0.5 * beam},
          {-0.5 * length, -0.5 * beam},
          {0.5 * length - bow, -0.5 * beam}};
}

std::size_t hull_count(const Scene& scene) {
  return scene.ships.size() + scene.structures.size() + scene.walls.size();
}

const PlacedHull& hull_of(const Scene& scene, std::size_t hull) {
  return visit_hull(scene, hull, [](const PlacedHull& placed) -> const PlacedHull& { return placed; });
}

BodyKind kind_of_hull(const Scene& scene, std::size_t hull) {
  return visit_hull(scene, hull, [](const auto& of_a_kind) { return of_a_kind.kKind; });
}

int hull_named(const Scene& scene, std::string_view name) {
  const int count = static_cast<int>(hull_count(scene));
  for (int hull = 0; hull < count; ++hull) {
    if (hull_of(scene, static_cast<std::size_t>(hull)).name == name) return hull;
  }
  return -1;
}

double recording_interval(const Scene& scene) {
  return std::max(scene.record.forces_interval, scene.time.step);
}

geometry::Vector WaterSettings::drift_at(double time) const {
  const geometry::Vector mean = drift_rows.empty() ? drift : dynamics::velocity_of(drift_rows, time);
  return tide ? mean + tide->velocity(time) : mean;
}

geometry::Vector WaterSettings::drift_path(double time) const {
  const geometry::Vector mean = drift_rows.empty() ? time * drift : dynamics::path_of(drift_rows, time);
  return tide ? mean + tide->path(time) : mean;
}

double WaterSettings::fastest_drift() const {
  double fastest = length(drift);
  for (const dynamics::FlowRow& row : drift_rows) fastest = std::max(fastest, row.speed);
  return tide ? fastest + elementary::hypot(tide->major, tide->minor) : fastest;
}

geometry::Vector free_drift(const Scene& scene, double time) {
  const geometry::Vector drift = scene.water.drift_at(time);
  if (!scene.wind.blows() || scene.water.skin_drag_coefficient == 0) return drift;
  const double share = std::sqrt(scene.wind.density * scene.wind.drag_coefficient /
                                 (scene.water.water.density * scene.water.skin_drag_coefficient));
  return drift + share * scene.wind.velocity_at(time);
}

bool splits_by_j_over_tau_c(const Scene& scene) {
  return scene.fracture.splitting == fracture::SplittingModel::kMichel;
}

bool has_draught(const Scene& scene) {
  return std::ranges::any_of(scene.ships, [](const Ship& ship) { return ship.hull.draught > 0; });
}

bool sails(const Ship& ship) {
  return ship.water.acts || std::holds_alternative<Engine>(ship.propulsion) || ship.mooring.has_value();
}

bool has_wind_or_walls(const Scene& scene) {
  return scene.wind.blows() ||
         std::ranges::any_of(scene.walls, [](const Wall& wall) { return wall.pressure.has_value(); });
}

bool has_moorings(const Scene& scene) {
  return std::ranges::any_of(scene.ships, [](const Ship& ship) { return ship.mooring.has_value(); });
}

Wall wall_between(geometry::Point from, geometry::Point to, double depth) {
  const geometry::Vector normal = perpendicular(to - from);
  Wall wall;
  wall.length = distance(from, to);
  wall.position_in_world = midpoint(from, to);
  wall.heading = elementary::atan2(normal.y, normal.x);
  const double half = 0.5 * wall.length;
  wall.hull.waterline = {{0, -half}, {0, half}, {-depth, half}, {-depth, -half}};
  wall.hull.angles_from_vertical.assign(4, 0.0);
  return wall;
}

geometry::Ring cylinder_waterline(double radius) {
  // Largest distance of the polygon from the circle [m]. Smaller values give more corners, which cost time.
  constexpr double kSagitta = 0.01;
  const double half_turn = elementary::acos(std::max(-1.0, 1 - kSagitta / radius));
  const int corners = std::max(24, static_cast<int>(std::ceil(std::numbers::pi / half_turn)));
  geometry::Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back({radius * elementary::cos(angle), radius * elementary::sin(angle)});
  }
  return ring;
}

}  // namespace polynya::simulation
