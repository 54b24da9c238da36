#pragma once

#include <span>
#include <vector>

#include "dynamics/contact/broad_phase.hpp"
#include "dynamics/water/water_drag.hpp"
#include "fracture/tilting.hpp"
#include "fracture/turning_cusp.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/ship/pilot.hpp"
#include "simulation/world/journal.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

using dynamics::BodyIndex;

/// A floe's cold data. Its body is at index hulls + floe id; both are never reused.
struct Floe {
  FloeId parent = kNoFloe;
  double born = 0;                   ///< [s]
  int generation = 0;                ///< fractures since the scene's floe
  std::int32_t own_ice = kSceneIce;  ///< index in Scene::own_ice, as its parent's
  double area = 0;                   ///< [m²]
  geometry::Shape shape;  ///< body frame: the scene's coordinates of its oldest ancestor; empty once it broke
  bool is_under = false;  ///< a submerged piece under a hull: it meets no body, and rests in the water
};

/// A floe that a ship's hull presses down.
struct TiltedFloe {
  FloeId floe = 0;
  int ship = 0;
  fracture::EdgeMotion edge;
};

/// A floe under a ship's hull, or under the ice behind it.
struct SubmergedPiece {
  FloeId floe = 0;
  int ship = 0;         ///< whose hull it is under
  double path = 0;      ///< s: how far the ship has come over it [m]
  double weight = 0;    ///< w_t: buoyancy of its part within the beam, when it went under [N]
  double next_try = 0;  ///< of coming up [s]
  double waited = 0;    ///< clear of the hull, for room [s]
  double area = 0;      ///< of the floe, beside what each step reads; in no state [m²]
};

/// A cusp that broke off under a ship's hull and turns until it lies along it. In the ship's frame where named so.
struct PressedDeck {
  int ship = 0;
  geometry::Vector arm_in_ship;         ///< of the contact that broke it, from the ship's centre [m]
  geometry::Vector normal_in_ship;      ///< of that contact, out of the hull
  geometry::Vector horizontal_in_ship;  ///< force on the ice per force down on it [-]
  fracture::Deck deck;
  fracture::DeckState state;
};

/// How a ship is steered, and what it may lose.
struct Helm {
  double lever = 0;            ///< of the thrust, −1 to 1
  double steering_angle = 0;   ///< of the rudder or the thrusters; to port [rad]
  bool is_adrift = false;      ///< its mooring broke
  double adrift_since = 0;     ///< [s]
  dynamics::Planar ice_force;  ///< of the step before [N, N m]
  PilotMemory memory;
};

/// The hulls and floes of a run, where they are and how they move.
struct Population {
  Population(const Setup& setup, std::span<const FloeSpec> floes);

  int hull_count = 0;
  dynamics::DragArea drag_area;           ///< the scene's
  bool has_skin_drag = false;             ///< likewise
  geometry::Vector water_velocity;        ///< of the water frame over ground, its mean over the last step [m/s]
  dynamics::Bodies bodies;                ///< the hulls as the scene numbers them, then floes by id
  std::vector<Helm> helms;                ///< per ship
  std::vector<Floe> floes;                ///< by id
  std::vector<BodyIndex> awake;           ///< ascending
  dynamics::BroadPhase pairs;             ///< of bodies that may touch, with the memory of their contacts
  std::vector<TiltedFloe> tilted;         ///< by (ship, floe)
  std::vector<SubmergedPiece> submerged;  ///< in the order in which they went under
  std::vector<PressedDeck> decks;         ///< in the order in which they broke off

  FloeId floe_count() const { return static_cast<FloeId>(floes.size()); }
  BodyKind kind(BodyIndex body) const { return bodies.kind[body]; }
  bool is_hull(BodyIndex body) const { return body < hull_count; }
  BodyIndex body_of(FloeId floe) const { return static_cast<BodyIndex>(floe) + hull_count; }
  FloeId floe_of(BodyIndex body) const { return body - hull_count; }
  /// The same of any body, as events name who did it: one of the two is none.
  std::int32_t hull_or_none(BodyIndex body) const { return is_hull(body) ? body : -1; }
  FloeId floe_or_none(BodyIndex body) const { return is_hull(body) ? kNoFloe : floe_of(body); }
  bool is_alive(FloeId floe) const { return bodies.is_alive[body_of(floe)] != 0; }
  bool is_floating(FloeId floe) const { return is_alive(floe) && !floes[floe].is_under; }
  bool is_fast(FloeId floe) const { return bodies.inverse_mass[body_of(floe)] == 0; }
};

/// A floe to be added; the population gives it an id and a body.
struct NewFloe {
  geometry::Shape shape;
  std::int32_t own_ice = kSceneIce;  ///< index in Scene::own_ice
  FloeId parent = kNoFloe;
  int generation = 0;
  geometry::Pose water_from_body;
  double angle = 0;             ///< of water_from_body [rad]
  geometry::Vector velocity;    ///< of the body frame's origin relative to the water [m/s]
  double angular_velocity = 0;  ///< [rad/s]
  bool is_fast = false;         ///< its motion is prescribed
};

/// Adds the scene's hulls, and its floes, asleep and awake; takes their polygons.
void add_scene(const Setup& setup, std::vector<FloeSpec>& floes, Population& population, Journal& journal);

/// Adds a floe of these measures, at rest or moving as a part of a rigid body whose frame is the floe's;
/// records its birth.
FloeId add_floe(const Setup& setup, const Instant& now, NewFloe floe, const geometry::Measures& measures,
                Population& population, Journal& journal);

/// Takes a floe out of the contact world, and puts it to sleep.
void leave_contacts(FloeId floe, Population& population);

/// Removes a floe that broke; records its death.
void retire_floe(FloeId floe, Population& population, Journal& journal);

void wake(BodyIndex body, Population& population);

void insert_into(std::vector<BodyIndex>& ascending, BodyIndex body);
void erase_from(std::vector<BodyIndex>& ascending, BodyIndex body);

/// Makes the drag shape of a floe that is about to move.
void add_drag(BodyIndex body, Population& population);

/// Whether a body at rest in the water frame stays at rest as far as water and wind go: a sheared current or
/// a wind carries it off.
bool stays_at_rest(BodyIndex body, const Setup& setup, const dynamics::Bodies& bodies);

/// The body of a hull where the scene has it.
dynamics::NewBody new_body_of(const Scene& scene, std::size_t hull);

/// The body of a floe, without its place and motion. Its thickness is kept there too, in Bodies::thickness,
/// where drag reads it.
dynamics::NewBody new_body_of(const geometry::Polygon& polygon_in_body, const geometry::Measures& measures,
                              const fracture::Ice& ice, bool is_fast);

/// The ice of a floe: its own where it has that, else the scene's.
inline const fracture::Ice& ice_of_floe(const Setup& setup, const Population& population, FloeId floe) {
  return ice_of(setup.scene, population.floes[floe].own_ice);
}
inline const fracture::Ice& ice_of_body(const Setup& setup, const Population& population, BodyIndex body) {
  if (setup.scene.own_ice.empty()) return setup.scene.ice;
  return ice_of_floe(setup, population, population.floe_of(body));
}

inline const IceLimits& limits_of_body(const Setup& setup, const Population& population, BodyIndex body) {
  if (setup.ice_limits.size() == 1) return setup.ice_limits.front();  // without a look at a floe that is in no cache
  const std::int32_t own_ice = population.floes[population.floe_of(body)].own_ice;
  return setup.ice_limits[own_ice == kSceneIce ? 0 : static_cast<std::size_t>(own_ice) + 1];
}

/// ρ h of a floe [kg/m²].
inline double mass_per_area(const fracture::Ice& ice) {
  return ice.density * ice.thickness;
}

/// Floes slower than this, all their points included, that touch nothing are at rest with the water [m/s].
/// Quadratic drag alone never brings anything to rest.
inline constexpr double kRestSpeed = 1e-4;

}  // namespace polynya::simulation
