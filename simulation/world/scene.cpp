#include "simulation/world/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace polynya::simulation {
namespace {

/// A moment of inertia that no impulse turns by more than rounding, and whose inverse solvers can take
/// [kg m²].
constexpr double kNeverTurns = 1e30;

}  // namespace

geometry::Ring wedge_bow_waterline(double length, double beam, double entrance_angle) {
  const double bow = 0.5 * beam / std::tan(entrance_angle);
  return {{0.5 * length, 0},
          {0.5 * length - bow, 0.5 * beam},
          {-0.5 * length, 0.5 * beam},
          {-0.5 * length, -0.5 * beam},
          {0.5 * length - bow, -0.5 * beam}};
}

double recording_interval(const Scene& scene) {
  const double steps = std::max(1.0, std::round(scene.record.forces_interval / scene.time.step));
  return steps * scene.time.step;
}

bool splits_by_j_over_tau_c(const Scene& scene) {
  return scene.fracture.splitting == fracture::SplittingModel::kMichel;
}

bool has_draught(const Scene& scene) {
  return std::ranges::any_of(scene.ships, [](const ShipSpec& ship) { return ship.hull.draught > 0; });
}

bool sails(const ShipSpec& ship) {
  return ship.water.acts || std::holds_alternative<Engine>(ship.propulsion) || ship.mooring.has_value();
}

bool is_grounded(const ShipSpec& ship) {
  return std::holds_alternative<FixedInPlace>(ship.propulsion) ||
         std::holds_alternative<Wall>(ship.propulsion);
}

bool has_wind_or_walls(const Scene& scene) {
  return scene.wind.blows() || std::ranges::any_of(scene.ships, [](const ShipSpec& ship) {
           const auto* wall = std::get_if<Wall>(&ship.propulsion);
           return wall && wall->presses();
         });
}

ShipSpec wall_between(geometry::Point from, geometry::Point to, double depth, Wall wall) {
  wall.length = distance(from, to);
  const geometry::Vector normal = perpendicular(to - from);
  ShipSpec spec;
  spec.position_in_world = midpoint(from, to);
  spec.heading = std::atan2(normal.y, normal.x);
  const double half = 0.5 * wall.length;
  spec.hull.waterline = {{0, -half}, {0, half}, {-depth, half}, {-depth, -half}};
  spec.hull.angles_from_vertical.assign(4, 0.0);
  spec.mass = wall.presses() ? wall.mass_per_length * wall.length : std::numeric_limits<double>::infinity();
  spec.moment_of_inertia = wall.presses() ? kNeverTurns : spec.mass;
  spec.propulsion = wall;
  return spec;
}

geometry::Ring cylinder_waterline(double radius) {
  constexpr double kSagitta = 0.01;  // [m]
  const double half_turn = std::acos(std::max(-1.0, 1 - kSagitta / radius));
  const int corners = std::max(24, static_cast<int>(std::ceil(std::numbers::pi / half_turn)));
  geometry::Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

}  // namespace polynya::simulation
