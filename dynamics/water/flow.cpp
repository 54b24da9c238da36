#include "dynamics/water/flow.hpp"

#include <numbers>

#include "elementary/elementary.hpp"

namespace polynya::dynamics {

using geometry::Vector;

namespace {

Vector along(double direction, double ahead, double to_port) {
  const Vector unit{elementary::cos(direction), elementary::sin(direction)};
  return ahead * unit + to_port * perpendicular(unit);
}

double angular_frequency(const Tide& tide) {
  return 2 * std::numbers::pi / tide.period;
}

}  // namespace

Vector FlowRow::velocity() const {
  return along(direction, speed, 0);
}

Vector velocity_of(std::span<const FlowRow> rows, double time) {
  const auto after = std::ranges::upper_bound(rows, time, {}, &FlowRow::time);
  if (after == rows.begin()) return rows.front().velocity();
  const FlowRow& from = *(after - 1);
  if (after == rows.end()) return from.velocity();
  const double share = (time - from.time) / (after->time - from.time);
  return (1 - share) * from.velocity() + share * after->velocity();
}

Vector path_of(std::span<const FlowRow> rows, double time) {
  Vector path;
  double from = 0;
  Vector before = velocity_of(rows, 0);
  const auto go_on = [&](double to) {
    const Vector then = velocity_of(rows, to);
    path += 0.5 * (to - from) * (before + then);
    from = to;
    before = then;
  };
  for (const FlowRow& row : rows)
    if (row.time > 0 && row.time < time) go_on(row.time);
  go_on(time);
  return path;
}

Vector Tide::velocity(double time) const {
  const double angle = angular_frequency(*this) * time + phase;
  return along(direction, major * elementary::cos(angle), minor * elementary::sin(angle));
}

Vector Tide::path(double time) const {
  const double omega = angular_frequency(*this);
  const double angle = omega * time + phase;
  return along(direction, major / omega * (elementary::sin(angle) - elementary::sin(phase)),
               minor / omega * (elementary::cos(phase) - elementary::cos(angle)));
}

WindWork apply_wind(Bodies& bodies, std::span<const BodyIndex> floes, Vector stress, double dt) {
  WindWork work;
  for (const BodyIndex i : floes) {
    if (bodies.inverse_mass[i] == 0) continue;  // wind does not move fast ice
    const Vector impulse = dt * bodies.area[i] * stress;
    const Vector change = bodies.inverse_mass[i] * impulse;
    work.energy += dot(impulse, bodies.velocity[i] + 0.5 * change);
    work.impulse += impulse;
    work.impulses += length(impulse);
    bodies.velocity[i] += change;
  }
  return work;
}

}  // namespace polynya::dynamics
