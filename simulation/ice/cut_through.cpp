#include "simulation/ice/cut_overlap.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// How often floes that hulls pierce are examined [s]. Rarer, a floe stays one in which a hull has come through;
/// more often, large plates that are pierced and hold together elsewhere cost a cut at each time.
constexpr double kInterval = 0.25;

bool is_due(const Setup& setup, const Clock& clock) {
  const auto period = static_cast<std::int64_t>(std::max(1.0, std::floor(kInterval / setup.scene.time.step)));
  return clock.is_at_tick() && clock.steps % period == 0;
}

/// Whether a hull may have come through a floe: a hull that has not carves an overlap of one stretch of each
/// boundary. Where nothing moves the two, carve_channels() cuts.
bool may_part(const Population& population, const Contact& c) {
  const bool is_held = population.bodies.inverse_mass[c.a] == 0 && population.bodies.inverse_mass[c.b] == 0;
  return !population.is_hull(c.b) && !is_held && c.record->is_pierced;
}

}  // namespace

void cut_through_floes(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                       Accounts& accounts, Journal& journal) {
  if (!is_crush_law(setup) || !is_due(setup, clock)) return;
  for (std::size_t i = 0; i < step.slopes.size(); ++i) {
    const Contact& c = step.contacts[i];
    if (!can_cut(population, accounts, c.a, c.b) || !may_part(population, c)) continue;
    const dynamics::Bodies& bodies = population.bodies;
    const geometry::Pose a_from_b =
        relative_pose(dynamics::water_from_body(bodies, c.a), dynamics::water_from_body(bodies, c.b));
    cut_overlap(setup, clock, {c.a, c.b, {a_from_b}, c.middle(), {c.area, 0}, CutWhen::kParts}, population, accounts,
                journal);
  }
}

}  // namespace polynya::simulation
