#include <algorithm>
#include <utility>

#include "simulation/ice/cut_overlap.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// What a contact crushed is cut off from this share of the smaller body on; when it has parted also from h²
/// on. Smaller, floes become new ones at every touch; greater, bodies share more than 1 % of the smaller when
/// they part: half a per cent may not have pressed (contact_tracker.cpp).
constexpr double kLeastCrushedShare = 0.005;

double smaller_area(const Population& population, BodyIndex a, BodyIndex b) {
  return std::min(population.bodies.area[a], population.bodies.area[b]);
}

/// From which area on what a contact crushed that has parted is cut off [m²].
double least_parted(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b) {
  const double h = ice_of_body(setup, population, ground_of(setup, population, a, b)).thickness;
  return std::min(kLeastCrushedShare * smaller_area(population, a, b), h * h);
}

/// All contacts of a pair.
struct Touching {
  std::span<const Contact> contacts;
  std::span<const HullSlope> slopes;  ///< none of two floes

  bool is_pressing() const {
    return std::ranges::any_of(contacts, [](const Contact& c) { return c.total_normal_impulse() > 0; });
  }
  /// Against vertical walls the force depends on the contact's width alone. A hull that leans crushes a
  /// wedge: a new edge would take it from the start.
  bool is_vertical() const {
    return std::ranges::all_of(slopes, [](const HullSlope& slope) { return slope.tangent == 0; });
  }
  double crushed_area() const {  ///< of the overlap now [m²]
    double area = 0;
    for (const Contact& c : contacts) area += c.record->crushed.area > 0 ? std::min(c.area, c.record->loaded_area) : 0;
    return area;
  }
  const Contact& largest() const {
    return *std::ranges::max_element(contacts, {}, [](const Contact& c) { return c.record->crushed.area; });
  }
};

/// Whether carve_channels() takes what two bodies crush: their motion is prescribed.
bool is_carved(const dynamics::Bodies& bodies, BodyIndex a, BodyIndex b) {
  return bodies.inverse_mass[a] == 0 && bodies.inverse_mass[b] == 0;
}

/// Calls use(touching) for each pair that touched in the step.
template <class Use>
void for_touching(const StepData& step, Use use) {
  const std::span<const Contact> all(step.contacts);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    while (end < all.size() && all[end].a == all[first].a && all[end].b == all[first].b) ++end;
    const bool has_slopes = first < step.slopes.size();
    use(Touching{all.subspan(first, end - first),
                 has_slopes ? std::span(step.slopes).subspan(first, end - first) : std::span<const HullSlope>()});
    first = end;
  }
}

/// Where what a pair crushed is cut off: where the most of it pressed, and where they are, unless they press:
/// then what they come to share in the step goes on being their contact.
std::vector<geometry::Pose> poses_of(const dynamics::Bodies& bodies, const Touching& touching) {
  const Contact& c = touching.largest();
  std::vector<geometry::Pose> poses{c.record->crushed.a_from_b};
  if (!touching.is_pressing())
    poses.push_back(relative_pose(dynamics::water_from_body(bodies, c.a), dynamics::water_from_body(bodies, c.b)));
  return poses;
}

/// Whether that is most of a floe: a hull that takes no ice, as a cone, has come over it and crushed it.
bool is_most(const Population& population, const Contact& c, double area) {
  return area > 0.5 * population.bodies.area[c.b];
}

bool is_tilted(const Population& population, BodyIndex ship, BodyIndex floe) {
  return std::ranges::any_of(population.tilted, [&](const TiltedFloe& tilted) {
    return tilted.ship == ship && population.body_of(tilted.floe) == floe;
  });
}

/// A body, or what it broke into in this step: its pieces have its frame.
std::vector<BodyIndex> left_of(const Population& population, const Clock& clock, BodyIndex body) {
  if (population.bodies.is_alive[body]) return {body};
  const FloeId first = population.floe_of(body);
  std::vector<BodyIndex> left;
  for (FloeId id = population.floe_count() - 1; id > first && population.floes[id].born == clock.time(); --id) {
    FloeId ancestor = population.floes[id].parent;
    while (ancestor > first) ancestor = population.floes[ancestor].parent;
    if (ancestor == first && population.is_alive(id)) left.push_back(population.body_of(id));
  }
  std::ranges::sort(left);
  return left;
}

/// Cuts off what a contact crushed that has parted.
void shed_parted(const Setup& setup, const Clock& clock, const dynamics::PartedContact& parted, Population& population,
                 Accounts& accounts, Journal& journal) {
  for (const BodyIndex a : left_of(population, clock, parted.a)) {
    for (const BodyIndex b : left_of(population, clock, parted.b)) {
      const bool is_in_order = a < b;  // pieces have numbers of their own
      const BodyIndex low = is_in_order ? a : b;
      const BodyIndex high = is_in_order ? b : a;
      if (is_carved(population.bodies, low, high) || !can_cut(population, accounts, low, high)) continue;
      const double least = least_parted(setup, population, low, high);
      if (parted.crushed.area < least) continue;
      const geometry::Pose pose = parted.crushed.a_from_b;
      cut_overlap(
          setup, clock,
          {low, high, {is_in_order ? pose : geometry::inverse(pose)}, parted.middle, {parted.crushed.area, least}},
          population, accounts, journal);
    }
  }
}

/// Cuts off what contacts crushed that last, where it is much.
void shed_touching(const Setup& setup, const Clock& clock, const Touching& touching, Population& population,
                   Accounts& accounts, Journal& journal) {
  const Contact& c = touching.contacts.front();
  if (is_carved(population.bodies, c.a, c.b) || !can_cut(population, accounts, c.a, c.b)) return;
  const double crushed = touching.crushed_area();  // records of bodies that broke may be gone
  if (crushed == 0) return;
  const double least = kLeastCrushedShare * smaller_area(population, c.a, c.b);
  if (crushed < least || (touching.is_pressing() && !touching.is_vertical() && !is_most(population, c, crushed)))
    return;
  if (population.is_hull(c.a) && is_tilted(population, c.a, c.b)) return;
  const OverlapCut cut{c.a, c.b, poses_of(population.bodies, touching), touching.largest().middle(), {crushed, least}};
  std::vector<dynamics::CrushedIce> kept;  // the pieces inherit none of it
  for (const Contact& contact : touching.contacts) kept.push_back(std::exchange(contact.record->crushed, {}));
  if (cut_overlap(setup, clock, cut, population, accounts, journal)) return;
  for (std::size_t i = 0; i < kept.size(); ++i) touching.contacts[i].record->crushed = kept[i];
}

}  // namespace

void shed_crushed_ice(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                      Accounts& accounts, Journal& journal) {
  if (!is_crush_law(setup)) return;
  for (const dynamics::PartedContact& parted : step.parted)
    shed_parted(setup, clock, parted, population, accounts, journal);
  for_touching(step,
               [&](const Touching& touching) { shed_touching(setup, clock, touching, population, accounts, journal); });
}

}  // namespace polynya::simulation
