#include "simulation/ice/going_under.hpp"

#include <algorithm>

#include "geometry/exact/measures.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

/// δρ g h times the area that the hull's beam passes over [N].
double weight_under(const Setup& setup, const Population& population, FloeId floe, int ship) {
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex body = population.body_of(floe);
  const geometry::Pose ship_from_floe =
      relative_pose(dynamics::water_from_body(bodies, ship), dynamics::water_from_body(bodies, body));
  const double under_beam = geometry::area_in_band(transform(ship_from_floe, population.floes[floe].shape.polygon),
                                                   0.5 * setup.underwater[ship].form.beam);
  const fracture::Ice& ice = ice_of_floe(setup, population, floe);
  const double lighter = setup.scene.water.water.density - ice.density;
  return lighter * fracture::kGravity * ice.thickness * std::max(0.0, under_beam);
}

}  // namespace

Event submersion_event(const Clock& clock, const Population& population, FloeId floe, int ship) {
  Submerge submerge;
  submerge.under_hull_area = population.floes[floe].area;
  submerge.floe = floe;
  const geometry::Point place = population.bodies.position[population.body_of(floe)] + clock.drift();
  return {clock.time(), ship, place, submerge};
}

void go_under(const Setup& setup, const Clock& clock, FloeId floe, int ship, Population& population,
              Accounts& accounts) {
  const BodyIndex body = population.body_of(floe);
  leave_contacts(floe, population);
  stop(population.bodies, body, accounts.audit.energy.submersion, accounts.audit);
  population.bodies.rim_speed[body] = 0;
  population.bodies.drag[body].reset();
  population.floes[floe].is_under = true;
  population.submerged.push_back({.floe = floe,
                                  .ship = ship,
                                  .path = 0,
                                  .weight = weight_under(setup, population, floe, ship),
                                  .next_try = clock.time(),
                                  .waited = 0,
                                  .area = population.floes[floe].area});
  ++accounts.counts.went_under;
}

void apply_submersions(const Setup& setup, const Clock& clock, const std::vector<PendingSubmersion>& pending,
                       Population& population, Accounts& accounts, Journal& journal) {
  for (const PendingSubmersion& floe : pending) {
    if (!population.is_floating(floe.floe)) continue;  // it broke in this step, or another ship has it
    Event event = submersion_event(clock, population, floe.floe, floe.ship);
    event.point_in_world = floe.point_in_water + clock.drift();
    auto& submerge = std::get<Submerge>(event.what);
    submerge.normal_in_world = floe.normal;
    submerge.penetration = floe.penetration;
    submerge.criterion = floe.criterion;
    go_under(setup, clock, floe.floe, floe.ship, population, accounts);
    ++accounts.counts.tilted_under;
    journal.events.push_back(std::move(event));
  }
}

}  // namespace polynya::simulation
