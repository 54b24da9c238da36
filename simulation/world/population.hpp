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

/// Data of a floe that few stages read. The data that each step reads are in the floe's body, which has the index
/// `number of hulls + floe id` in dynamics::Bodies. Neither the id nor the index is ever reused.
struct Floe {
  FloeId parent = kNoFloe;           ///< floe from which this one was made; kNoFloe for a floe of the scene
  double born = 0;                   ///< time of creation [s]
  int generation = 0;                ///< number of ancestors; 0 for a floe of the scene
  std::int32_t own_ice = kSceneIce;  ///< index of the ice in Scene::own_ice, the same as the parent's
  double area = 0;                   ///< area in plan [m²]
  /// Shape in the body frame, which has the scene coordinates of the oldest ancestor. Empty once the floe is retired.
  geometry::Shape shape;
  /// True for a piece under a hull. Such a piece has no contacts and is at rest relative to the water.
  bool is_under = false;
};

/// A floe whose edge a ship's hull presses down.
struct TiltedFloe {
  FloeId floe = 0;
  int ship = 0;               ///< number of the hull that presses
  fracture::EdgeMotion edge;  ///< deflection of the edge and its rate
};

/// A piece of ice under a ship's hull, or behind the hull under other ice.
struct SubmergedPiece {
  FloeId floe = 0;
  int ship = 0;         ///< ship under whose hull the piece went
  double path = 0;      ///< distance s that the ship has moved over the piece; negative if the ship backed off it [m]
  double weight = 0;    ///< net buoyancy w_t of the part within the ship's beam when the piece went under [N]
  double next_try = 0;  ///< time from which the piece may try to surface again [s]
  /// Time that the piece, clear of the hull, has waited for space to surface [s]. After ResurfaceSettings::give_up the
  /// piece stays under the ice for good.
  double waited = 0;
  /// True for a cusp that had a PressedDeck. The force on its deck contains the bow's part of the growth with speed
  /// (Lindqvist's factor), which is therefore not added to the force of the piece again.
  bool had_deck = false;
  double area = 0;  ///< copy of Floe::area, kept here for fast access and not stored in saved states [m²]
};

/// A cusp that broke off under a ship's hull and whose edge has not reached the speed yet that the slope of the hull
/// gives it. It is removed when impulse_left or distance_left is used up. Members named `_in_ship` are in the ship's
/// frame.
struct AcceleratingCusp {
  int ship = 0;                         ///< number of the ship
  geometry::Vector arm_in_ship;         ///< vector from the ship's centre to the contact that broke the cusp [m]
  geometry::Vector normal_in_ship;      ///< unit normal of that contact, out of the hull
  geometry::Vector horizontal_in_ship;  ///< horizontal force on the ice per downward force on it [-]
  double impulse_left = 0;              ///< downward impulse that is still needed to give the edge its speed [N s]
  double largest_force = 0;  ///< largest downward force of the hull on the edge: the one with which the ice broke [N]
  double distance_left = 0;  ///< distance that the hull moves along the normal until it has passed the cusp [m]
};

/// A cusp that broke off under a ship's hull and turns until it lies along the hull. Members named `_in_ship` are in
/// the ship's frame.
struct PressedDeck {
  int ship = 0;                         ///< number of the ship
  geometry::Vector arm_in_ship;         ///< vector from the ship's centre to the contact that broke the cusp [m]
  geometry::Vector normal_in_ship;      ///< unit normal of that contact, out of the hull
  geometry::Vector horizontal_in_ship;  ///< horizontal force on the ice per downward force on it [-]
  fracture::Deck deck;                  ///< geometry of the cusp
  fracture::DeckState state;            ///< progress of the turning, and water on the deck
};

/// Positions of a ship's thrust lever and steering, and the state of its mooring and pilot.
struct Helm {
  double lever = 0;           ///< thrust lever, −1 (full astern) to 1 (full ahead) [-]
  double steering_angle = 0;  ///< angle of the rudder or the thrusters, positive to port [rad]
  bool is_adrift = false;     ///< true once the ship's mooring has broken
  double adrift_since = 0;    ///< time at which the mooring broke [s]
  /// Turn of a moored ship in the last step, needed for the momentum of its added mass (ship/sailing.cpp) [rad].
  double last_turn = 0;
  /// Force of the ice around the hull in the previous step, in the ship's frame [N, N m]. Pilots see this force. It is
  /// updated only for ships with water around the hull, an engine or a mooring.
  dynamics::Planar ice_force;
  PilotMemory memory;
};

/// The hulls and floes of a run with their positions, motions and contacts.
struct Population {
  Population(const Setup& setup, std::span<const FloeSpec> floes);

  int hull_count = 0;                     ///< number of ships, structures and walls
  dynamics::DragArea drag_area;           ///< reading of the area A of Eq. (6) of [Sawamura2017]
  bool has_skin_drag = false;             ///< true if the scene has skin drag on floes
  geometry::Vector water_velocity;        ///< mean velocity of the water frame over ground in the last step [m/s]
  dynamics::Bodies bodies;                ///< bodies of the hulls in the order of the scene, then of the floes by id
  std::vector<Helm> helms;                ///< helm of each ship
  std::vector<Floe> floes;                ///< floes by id
  std::vector<BodyIndex> awake;           ///< indices of the awake bodies, ascending
  dynamics::BroadPhase pairs;             ///< pairs of bodies that may touch, with the memory of their contacts
  std::vector<TiltedFloe> tilted;         ///< floes pressed down by hulls, ordered by (ship, floe)
  std::vector<SubmergedPiece> submerged;  ///< pieces under hulls, in the order in which they went under
  /// Cusps that hulls accelerate, in the order in which they broke off.
  std::vector<AcceleratingCusp> accelerating_cusps;
  std::vector<PressedDeck> decks;  ///< turning cusps, in the order in which they broke off

  /// Returns the number of all floes so far, retired ones included.
  FloeId floe_count() const { return static_cast<FloeId>(floes.size()); }
  BodyKind kind(BodyIndex body) const { return bodies.kind[body]; }
  bool is_hull(BodyIndex body) const { return body < hull_count; }
  BodyIndex body_of(FloeId floe) const { return static_cast<BodyIndex>(floe) + hull_count; }
  FloeId floe_of(BodyIndex body) const { return body - hull_count; }
  /// Returns the hull number of a body, or −1 for a floe. Events name the cause of an event by this number and by
  /// floe_or_none(), one of which is none.
  std::int32_t hull_or_none(BodyIndex body) const { return is_hull(body) ? body : -1; }
  /// Returns the floe id of a body, or kNoFloe for a hull.
  FloeId floe_or_none(BodyIndex body) const { return is_hull(body) ? kNoFloe : floe_of(body); }
  /// Returns true until the floe is retired.
  bool is_alive(FloeId floe) const { return bodies.is_alive[body_of(floe)] != 0; }
  /// Returns true if the floe exists and is not under a hull.
  bool is_floating(FloeId floe) const { return is_alive(floe) && !floes[floe].is_under; }
  /// Returns true if the floe is fast ice, whose motion is prescribed.
  bool is_fast(FloeId floe) const { return bodies.inverse_mass[body_of(floe)] == 0; }
};

/// Data of a floe to be added. The population gives it an id and a body.
struct NewFloe {
  geometry::Shape shape;             ///< shape in the body frame
  geometry::Measures measures;       ///< area, centroid and second moment of the shape, in the body frame
  std::int32_t own_ice = kSceneIce;  ///< index of the ice in Scene::own_ice
  FloeId parent = kNoFloe;           ///< floe from which this one is made
  int generation = 0;                ///< number of ancestors
  geometry::Pose water_from_body;    ///< pose of the body frame in the water frame
  double angle = 0;                  ///< angle of water_from_body, full turns included [rad]
  geometry::Vector velocity;         ///< velocity of the body frame's origin relative to the water [m/s]
  double angular_velocity = 0;       ///< angular velocity, counter-clockwise [rad/s]
  bool is_fast = false;              ///< true if the motion of the floe is prescribed
};

/// Adds the scene's hulls and floes, and wakes the hulls and all floes that move or may not stay at rest. The polygons
/// are moved out of `floes`.
void add_scene(const Setup& setup, std::vector<FloeSpec>& floes, Population& population, Journal& journal);

/// Adds a floe, asleep, records its birth and returns its id. The floe moves as a part of a rigid body that has the
/// floe's body frame, NewFloe::velocity and NewFloe::angular_velocity.
FloeId add_floe(const Setup& setup, const Instant& now, NewFloe floe, Population& population, Journal& journal);

/// Removes a floe from the contact search and from the tilted floes, and puts it to sleep. The floe stays alive.
void leave_contacts(FloeId floe, Population& population);

/// Ends the life of a floe that broke or was replaced, and records its death. Its shape is moved to the journal.
void retire_floe(FloeId floe, Population& population, Journal& journal);

/// Wakes a body: each step moves it from now on, and its neighbours are looked up. Does nothing if it is awake.
void wake(BodyIndex body, Population& population);

/// Inserts a body into a list in ascending order.
void insert_into(std::vector<BodyIndex>& ascending, BodyIndex body);
/// Removes a body from a list in ascending order, if it is there.
void erase_from(std::vector<BodyIndex>& ascending, BodyIndex body);

/// Computes the drag shape of a floe that is about to move, unless the floe has one. Hulls have none.
void add_drag(BodyIndex body, Population& population);

/// Returns true if a body at rest in the water frame stays there: no wind blows on it, and a sheared current moves none
/// of its points at kRestSpeed or faster. Wind does not move fast ice.
bool stays_at_rest(BodyIndex body, const Setup& setup, const dynamics::Bodies& bodies);

/// Returns the body of a hull, by its number in the scene, with its position and motion at the start.
dynamics::NewBody new_body_of(const Scene& scene, std::size_t hull);

/// Returns the body of a floe without its position and motion. The thickness of the ice is copied to the body, because
/// each step needs it for the drag of the water, the length of the step and the crushed volume.
dynamics::NewBody new_body_of(const geometry::Polygon& polygon_in_body, const geometry::Measures& measures,
                              const fracture::Ice& ice, bool is_fast);

/// Returns the ice of a floe: its own ice if it has one, otherwise the scene's.
inline const fracture::Ice& ice_of_floe(const Setup& setup, const Population& population, FloeId floe) {
  return ice_of(setup.scene, population.floes[floe].own_ice);
}
/// Returns the ice of a body, which must be a floe.
inline const fracture::Ice& ice_of_body(const Setup& setup, const Population& population, BodyIndex body) {
  if (setup.scene.own_ice.empty()) return setup.scene.ice;
  return ice_of_floe(setup, population, population.floe_of(body));
}

/// Returns the limits of breaking of the ice of a body, which must be a floe.
inline const IceLimits& limits_of_body(const Setup& setup, const Population& population, BodyIndex body) {
  if (setup.ice_limits.size() == 1) return setup.ice_limits.front();  // avoids reading the floe from slow memory
  const std::int32_t own_ice = population.floes[population.floe_of(body)].own_ice;
  return setup.ice_limits[own_ice == kSceneIce ? 0 : static_cast<std::size_t>(own_ice) + 1];
}

/// Returns the mass of ice per area in plan, ρ_i h [kg/m²].
inline double mass_per_area(const fracture::Ice& ice) {
  return ice.density * ice.thickness;
}

/// Speed relative to the water, of the fastest point of a floe, below which a floe without contacts is put to sleep
/// [m/s]. The limit is needed because quadratic drag alone never stops a floe. Larger values stop drifting floes too
/// early; smaller values keep floes awake, which costs time.
inline constexpr double kRestSpeed = 1e-4;

}  // namespace polynya::simulation
