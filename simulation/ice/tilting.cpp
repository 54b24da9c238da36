#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// Fraction of a floe's area that a hull may cover before the floe goes under [-]. With more than half, the centre of a
/// compact floe is inside the waterline. Larger values leave floes afloat that lie inside a hull.
constexpr double kMostCovered = 0.5;

/// All contacts of one ship with one floe. They are consecutive in the list of contacts.
struct Pressed {
  int ship = 0;
  FloeId floe = 0;
  std::span<Contact> contacts;
  std::span<HullSlope> slopes;
  std::pair<int, FloeId> key() const { return {ship, floe}; }
};

/// Returns true if floes can go under the hull of a ship.
bool can_go_under(const Setup& setup, int ship) {
  return setup.scene.fracture.going_under.is_enabled && setup.underwater[ship].can_take_ice;
}

/// Calls use(pressed) for each floe in contact with a hull under which it can go, ordered by (ship, floe). Fast ice
/// cannot go under a hull.
template <class Use>
void for_pressed(const Setup& setup, const Population& population, std::vector<Contact>& contacts,
                 std::vector<HullSlope>& slopes, Use use) {
  std::size_t first = 0;
  while (first < slopes.size()) {
    const Contact& c = contacts[first];
    std::size_t end = first + 1;
    while (end < slopes.size() && contacts[end].a == c.a && contacts[end].b == c.b) ++end;
    const bool is_free = !population.is_hull(c.b) && !population.is_fast(population.floe_of(c.b));
    if (is_free && can_go_under(setup, c.a)) {
      use(Pressed{c.a, population.floe_of(c.b), std::span(contacts).subspan(first, end - first),
                  std::span(slopes).subspan(first, end - first)});
    }
    first = end;
  }
}

/// Returns the resistance of a floe to tilting.
fracture::TiltResistance resistance_of(const Setup& setup, const Population& population, FloeId floe) {
  return fracture::tilt_resistance(ice_of_floe(setup, population, floe), setup.scene.water.water,
                                   population.floes[floe].area,
                                   setup.scene.fracture.going_under.tilting.added_mass_factor);
}

/// Returns the motion of the edge of a floe that a ship presses down; zero if the floe is not in the list. `tilted` is
/// ordered by (ship, floe).
fracture::EdgeMotion edge_of(const std::vector<TiltedFloe>& tilted, std::pair<int, FloeId> key) {
  const auto key_of = [](const TiltedFloe& floe) { return std::pair(floe.ship, floe.floe); };
  const auto at = std::ranges::lower_bound(tilted, key, {}, key_of);
  return at != tilted.end() && key_of(*at) == key ? at->edge : fracture::EdgeMotion{};
}

/// Returns the largest speed at which the slope of the hull can slide the edge down, v_n / tan θ_s, over all contacts
/// [m/s].
double slide_speed(const Pressed& pressed) {
  double fastest = 0;
  for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
    if (pressed.slopes[i].vertical_share > 0)
      fastest = std::max(fastest, pressed.contacts[i].approach_speed / pressed.slopes[i].tangent);
  }
  return fastest;
}

/// Returns the vertical force of a contact at the end of a step of length dt [s], if the bodies keep their speeds and
/// the ice crushes [N].
double expected_vertical_force(const Contact& c, const HullSlope& slope, double dt) {
  const double grown = c.crushing_stiffness * std::max(0.0, c.approach_speed) * dt;
  return slope.vertical_share * (c.crushing_force + grown);
}

/// Reduces the forces of a contact to a fraction, because the floe tilts instead of resisting more.
void scale(Contact& c, double share) {
  c.crushing_force *= share;
  c.crushing_stiffness *= share;
  if (std::isfinite(c.most_force)) c.most_force *= share;
  c.missed_impulse *= share;
  c.crushing_share *= share;
  c.gives_way = true;
}

/// Reduces the fraction of the overlaps' growth that is crushed, by the distance by which the edge moved down in the
/// step, `lowered` [m]. dt is the length of the step [s].
void share_growth(const Pressed& pressed, double lowered, double dt) {
  for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
    HullSlope& slope = pressed.slopes[i];
    const double way = dt * pressed.contacts[i].approach_speed;
    if (slope.vertical_share > 0 && way > 0)
      slope.crushed_share *= std::clamp(1 - lowered * slope.tangent / way, 0.0, 1.0);
  }
}

/// Returns the fraction of a floe's area inside a hull that presses it down; 0 if the hull is too steep to press it
/// down.
double covered_share(const Population& population, const Pressed& pressed) {
  const bool presses_down =
      std::ranges::any_of(pressed.slopes, [](const HullSlope& slope) { return slope.vertical_share > 0; });
  double area = 0;
  for (const Contact& c : pressed.contacts) area += c.area;
  return presses_down ? area / population.floes[pressed.floe].area : 0;
}

/// Result of pressing a floe's edge down in a step: the floe stays tilted, or goes under, or neither.
struct TiltOutcome {
  std::optional<TiltedFloe> tilted;
  std::optional<PendingSubmersion> submersion;
};

/// Moves the edge of a floe that a hull presses down. The floe goes under if its edge is deep enough, or if the hull
/// covers more than kMostCovered of it, because its centre is then below the hull's waterline.
TiltOutcome tilt(const Setup& setup, const Step& step, const Population& population, const Pressed& pressed) {
  TiltOutcome outcome;
  const fracture::TiltSettings& settings = setup.scene.fracture.going_under.tilting;
  const double dt = step.length;
  double vertical_force = 0;
  const Contact* strongest = &pressed.contacts.front();
  for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
    const Contact& c = pressed.contacts[i];
    vertical_force += std::max(0.0, pressed.slopes[i].vertical_share) * c.total_normal_impulse() / dt;
    if (c.total_normal_impulse() > strongest->total_normal_impulse()) strongest = &c;
  }
  const double covered = covered_share(population, pressed);
  const fracture::EdgeMotion before = edge_of(population.tilted, pressed.key());
  if (vertical_force == 0 && before.deflection == 0 && covered <= kMostCovered) return outcome;
  const fracture::TiltResistance resistance = resistance_of(setup, population, pressed.floe);
  const fracture::EdgeMotion edge = fracture::tilted(resistance, before, vertical_force, settings.damping, dt);
  share_growth(pressed, edge.deflection - before.deflection, dt);
  if (edge.deflection > 0) outcome.tilted = {pressed.floe, pressed.ship, edge};
  const double least = settings.edge_deflection * ice_of_floe(setup, population, pressed.floe).thickness;
  if (edge.deflection < least && covered <= kMostCovered) return outcome;
  outcome.submersion = {.floe = pressed.floe,
                        .ship = pressed.ship,
                        .point_in_water = strongest->middle(),
                        .normal = strongest->normal,
                        .penetration = strongest->depth,
                        .criterion = {edge.deflection, least, vertical_force, resistance.capacity, covered}};
  return outcome;
}

}  // namespace

void limit_by_tilt(const Setup& setup, const Step& step, const Population& population, StepData& data) {
  const double dt = step.length;
  for_pressed(setup, population, data.contacts, data.slopes, [&](const Pressed& pressed) {
    double expected = 0;
    for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
      if (pressed.slopes[i].vertical_share > 0)
        expected += expected_vertical_force(pressed.contacts[i], pressed.slopes[i], dt);
    }
    if (expected == 0) return;
    const double most =
        fracture::most_vertical_force(resistance_of(setup, population, pressed.floe),
                                      edge_of(population.tilted, pressed.key()), slide_speed(pressed), dt);
    if (expected <= most) return;
    for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
      if (pressed.slopes[i].vertical_share > 0) scale(pressed.contacts[i], most / expected);
    }
  });
}

void tilt_floes(const Setup& setup, const Step& step, Population& population, StepData& data) {
  data.submersions.clear();
  std::vector<TiltedFloe> tilted;
  const auto is_pressed = [&](const TiltedFloe& floe) {
    return std::ranges::any_of(std::span(data.contacts).first(data.slopes.size()), [&](const Contact& c) {
      return c.a == floe.ship && c.b == population.body_of(floe.floe);
    });
  };
  for (const TiltedFloe& floe : population.tilted) {
    if (!population.is_floating(floe.floe) || is_pressed(floe)) continue;
    const fracture::EdgeMotion edge = fracture::tilted(resistance_of(setup, population, floe.floe), floe.edge, 0,
                                                       setup.scene.fracture.going_under.tilting.damping, step.length);
    if (edge.deflection > 0) tilted.push_back({floe.floe, floe.ship, edge});
  }
  for_pressed(setup, population, data.contacts, data.slopes, [&](const Pressed& pressed) {
    const TiltOutcome outcome = tilt(setup, step, population, pressed);
    if (outcome.tilted) tilted.push_back(*outcome.tilted);
    if (outcome.submersion) data.submersions.push_back(*outcome.submersion);
  });
  std::ranges::sort(tilted, {}, [](const TiltedFloe& floe) { return std::pair(floe.ship, floe.floe); });
  population.tilted = std::move(tilted);
}

}  // namespace polynya::simulation
