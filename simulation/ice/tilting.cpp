#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// The share of a floe that a hull may cover: of a compact floe with more its middle is below the waterline.
constexpr double kMostCovered = 0.5;

/// All contacts of one ship with one floe: they follow each other.
struct Pressed {
  int ship = 0;
  FloeId floe = 0;
  std::span<Contact> contacts;
  std::span<HullSlope> slopes;
  std::pair<int, FloeId> key() const { return {ship, floe}; }
};

bool can_go_under(const Setup& setup, int ship) {
  return setup.scene.fracture.going_under.is_enabled && setup.underwater[ship].can_take_ice;
}

/// Calls use(pressed) for each floe in contact with a hull that it can go under, by (ship, floe). Fast ice
/// cannot.
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

fracture::TiltResistance resistance_of(const Setup& setup, const Population& population, FloeId floe) {
  return fracture::tilt_resistance(ice_of_floe(setup, population, floe), setup.scene.water.water,
                                   population.floes[floe].area,
                                   setup.scene.fracture.going_under.tilting.added_mass_factor);
}

fracture::EdgeMotion edge_of(const std::vector<TiltedFloe>& tilted, std::pair<int, FloeId> key) {
  const auto key_of = [](const TiltedFloe& floe) { return std::pair(floe.ship, floe.floe); };
  const auto at = std::ranges::lower_bound(tilted, key, {}, key_of);
  return at != tilted.end() && key_of(*at) == key ? at->edge : fracture::EdgeMotion{};
}

/// The fastest that a contact slides the edge down the hull, v_n / tan θ_s [m/s].
double slide_speed(const Pressed& pressed) {
  double fastest = 0;
  for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
    if (pressed.slopes[i].vertical_share > 0)
      fastest = std::max(fastest, pressed.contacts[i].approach_speed / pressed.slopes[i].tangent);
  }
  return fastest;
}

/// The vertical force with which a contact may press at the end of the step [N].
double expected_vertical_force(const Contact& c, const HullSlope& slope, double dt) {
  const double grown = c.crushing_stiffness * std::max(0.0, c.approach_speed) * dt;
  return slope.vertical_share * (c.crushing_force + grown);
}

void scale(Contact& c, double share) {
  c.crushing_force *= share;
  c.crushing_stiffness *= share;
  if (std::isfinite(c.most_force)) c.most_force *= share;
  c.missed_impulse *= share;
  c.crushing_share *= share;
  c.gives_way = true;
}

/// Of what the overlaps grow in the step, what the edge's own way down leaves to be crushed.
void share_growth(const Pressed& pressed, double lowered, double dt) {
  for (std::size_t i = 0; i < pressed.contacts.size(); ++i) {
    HullSlope& slope = pressed.slopes[i];
    const double way = dt * pressed.contacts[i].approach_speed;
    if (slope.vertical_share > 0 && way > 0)
      slope.crushed_share *= std::clamp(1 - lowered * slope.tangent / way, 0.0, 1.0);
  }
}

/// The share of a floe that a hull covers which presses it down; 0 where it does not.
double covered_share(const Population& population, const Pressed& pressed) {
  const bool presses_down =
      std::ranges::any_of(pressed.slopes, [](const HullSlope& slope) { return slope.vertical_share > 0; });
  double area = 0;
  for (const Contact& c : pressed.contacts) area += c.area;
  return presses_down ? area / population.floes[pressed.floe].area : 0;
}

/// What becomes of a floe whose edge is pressed down in a step.
struct TiltOutcome {
  std::optional<TiltedFloe> tilted;
  std::optional<PendingSubmersion> submersion;
};

/// Turns the floe's edge. The floe goes under where its edge is deep enough, or the hull covers most of it: then its
/// middle is below the hull's waterline.
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
