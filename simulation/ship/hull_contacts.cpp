#include <algorithm>
#include <iterator>

#include "elementary/elementary.hpp"
#include "geometry/cut/overlap.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// Returns true if the contact of two hulls has been recorded before.
bool is_known(const std::vector<Event>& contacts, BodyIndex ship, BodyIndex other) {
  return std::ranges::any_of(
      contacts, [&](const Event& e) { return e.ship == ship && std::get<HullContact>(e.what).other == other; });
}

/// Returns the waterline of a hull in the water frame [m].
geometry::Ring waterline_in_water(const Setup& setup, const dynamics::Bodies& bodies, BodyIndex ship) {
  return transform(dynamics::water_from_body(bodies, ship),
                   hull_of(setup.scene, static_cast<std::size_t>(ship)).hull.waterline);
}

/// Returns the contact of two hulls of prescribed motion whose outlines began to touch in the step, or nullopt. The
/// contact search leaves such pairs out, because no impulse moves them.
std::optional<Event> prescribed_contact(const Setup& setup, const Step& step, const dynamics::Bodies& bodies,
                                        BodyIndex ship, BodyIndex other) {
  const Vector velocity = bodies.velocity[other] - bodies.velocity[ship];
  const double speed = length(velocity);
  // The outlines may have begun to touch in the step before, where rounding hid it.
  const double earliest = -2 * step.length;
  const double reach = bodies.bounding_radius[ship] + bodies.bounding_radius[other] - earliest * speed;
  if (speed == 0 || distance(bodies.position[ship], bodies.position[other]) > reach) return std::nullopt;
  const auto touch = geometry::first_contact(waterline_in_water(setup, bodies, ship),
                                             waterline_in_water(setup, bodies, other), velocity, earliest, 0);
  if (!touch) return std::nullopt;
  return Event{step.end.time, ship, touch->point + step.end.drift,
               HullContact{other, -dot(velocity, touch->normal), speed, true}};
}

}  // namespace

void record_hull_contacts(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                          Books books) {
  std::vector<Event>& known_contacts = books.accounts.hull_contacts;
  const dynamics::Bodies& bodies = population.bodies;
  const auto enter = [&](const Event& contact) {
    known_contacts.push_back(contact);
    books.journal.events.push_back(contact);
  };
  for (const dynamics::Contact& c : data.contacts) {
    if (!population.is_hull(c.b) || is_known(known_contacts, c.a, c.b)) continue;
    enter({step.end.time, c.a, c.middle() + step.end.drift,
           HullContact{c.b, c.approach_speed, elementary::hypot(c.approach_speed, c.slip_speed), false}});
  }
  for (BodyIndex ship = 0; ship < population.hull_count; ++ship) {
    for (BodyIndex other = ship + 1; other < population.hull_count; ++other) {
      if (!are_prescribed(bodies, ship, other)) continue;
      // Structures and walls do not meet each other.
      if (is_grounded(bodies.kind[ship]) && is_grounded(bodies.kind[other])) continue;
      if (is_known(known_contacts, ship, other)) continue;
      if (const auto contact = prescribed_contact(setup, step, bodies, ship, other)) enter(*contact);
    }
  }
  std::ranges::copy(data.mooring_breaks, std::back_inserter(books.journal.events));
}

}  // namespace polynya::simulation
