#include "simulation/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polynya::simulation {

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
