#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dynamics/planar.hpp"
#include "fracture/decision.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::simulation {

using FloeId = std::int64_t;
inline constexpr FloeId kNoFloe = -1;

enum class EventKind {
  kBend,
  kSplit,
  kGrind,
  kRejectedCut,
  kSubmerge,   ///< a floe or a broken cusp went under a hull
  kResurface,  ///< it came up behind it
  kStayUnder,  ///< it found no room and stays under the ice
};
std::string_view name_of(EventKind kind);

/// Whether ice broke in it.
constexpr bool is_fracture(EventKind kind) {
  return kind == EventKind::kBend || kind == EventKind::kSplit || kind == EventKind::kGrind;
}

/// What decides that an overlap is ground to brash: it is large, and no motion of the bodies reduces it (the
/// gradient of its area is small, docs/theory.md, "Contact").
struct GrindCriterion {
  double overlap_area = 0;  ///< [m²]
  double least_area = 0;    ///< a smaller overlap is left [m²]
  double width = 0;         ///< |R|, by which the area falls per metre of motion [m]
  double least_width = 0;   ///< a wider overlap is left to its contact [m]
};

/// What decides that a floe goes under.
struct TiltCriterion {
  double deflection = 0;        ///< w of its edge [m]
  double least_deflection = 0;  ///< c_g h; 0 of a cusp, which goes under as it breaks off [m]
  double vertical_force = 0;    ///< V on it in the step [N]
  double capacity = 0;          ///< V_rot [N]
};

/// What decides that ice comes up, or stays under.
struct ResurfaceCriterion {
  double path = 0;          ///< s, how far the ship has come over it [m]
  double least_path = 0;    ///< s̄, of the hull [m]
  double waited = 0;        ///< for room [s]
  double longest_wait = 0;  ///< [s]
};

/// A fracture, ground ice, ice that goes under or comes up, or a cut that geometry refused. Written as one
/// line of events.ndjson.
struct Event {
  double time = 0;  ///< [s]
  EventKind kind = EventKind::kBend;
  int ship = 0;              ///< index in the scene; -1 where a floe did it
  FloeId by_floe = kNoFloe;  ///< the floe that ground or split it
  FloeId floe = kNoFloe;     ///< the floe that broke (its children's parent)
  std::vector<FloeId> children;
  geometry::Point point_in_world;      ///< contact point [m]
  geometry::Vector normal_in_world;    ///< unit, from the hull into the ice
  fracture::FailureCriteria criteria;  ///< both sides of what was decided
  GrindCriterion grinding;             ///< of ground ice
  TiltCriterion tilting;               ///< of ice that goes under
  ResurfaceCriterion resurfacing;      ///< of ice that comes up or stays under
  double cusp_radius = 0;              ///< R, bends only [m]
  double penetration = 0;              ///< ξ when it broke [m]
  double submerged_area = 0;           ///< gone under the ship for good [m²]
  double under_hull_area = 0;          ///< gone under it, to come up [m²]
  double under_ice_area = 0;           ///< staying under the ice behind it [m²]
  double brash_area = 0;               ///< pieces below the size limit and slivers [m²]
  double rounding_defect = 0;          ///< [m²]
  std::string reason;                  ///< of a rejected cut
};

/// What decided that ice bent or split, as every view shows it.
struct DecidingLoad {
  std::string_view name;           ///< of the load
  std::string_view comparison;     ///< ">" or ">="
  std::string_view capacity_name;  ///< of what it reached
  double load = 0;                 ///< [N]
  double capacity = 0;             ///< [N]
};
DecidingLoad deciding_load(const Event& event);

/// The first contact of two ships, or of a ship and a structure. Written as one line of events.ndjson.
struct ShipContact {
  double time = 0;                 ///< [s]
  int ship = 0;                    ///< index in the scene
  int other = 0;                   ///< index in the scene, greater than `ship`
  geometry::Point point_in_world;  ///< [m]
  double closing_speed = 0;        ///< along the contact's normal, before the contact acts [m/s]
  double relative_speed = 0;       ///< of the two at that point [m/s]
  bool is_prescribed = false;      ///< the motion of both is: they pass through each other without a force
};

/// A mooring that broke; its ship is adrift. Written as one line of events.ndjson.
struct MooringBreak {
  double time = 0;                          ///< end of the step in which it broke [s]
  int ship = 0;                             ///< index in the scene
  geometry::Point point_in_world;           ///< centre of gravity of the ship [m]
  geometry::Vector offset_in_moored_place;  ///< of it from the moored place, along and across its heading [m]
  double force = 0;                         ///< with which the mooring held the ship, horizontal [N]
  double break_load = 0;                    ///< which that force exceeds [N]
};

/// A floe at its birth, without its shape.
struct BirthRecord {
  FloeId floe = 0;
  FloeId parent = kNoFloe;
  double time = 0;                   ///< [s]
  int generation = 0;                ///< fractures since the scene's floe
  double area = 0;                   ///< [m²]
  double mass = 0;                   ///< [kg]
  geometry::Point centroid_in_body;  ///< [m]
  std::int32_t own_ice = -1;         ///< index in Scene::own_ice; −1: it is the scene's
};

/// The same with its shape. Written as one line of floes.ndjson.
struct Birth : BirthRecord {
  geometry::Polygon polygon_in_body;  ///< body frame: the scene's coordinates of the floe's oldest ancestor
};

/// A floe that broke, and what it was: its children's boundaries are for the most part its own.
struct Death {
  FloeId floe = kNoFloe;
  geometry::Polygon polygon_in_body;
  friend bool operator==(const Death&, const Death&) = default;
};

/// What a cut that geometry refused was asked to do. Written as an input of `polynya cut`.
struct RejectedCut {
  std::int64_t number = 0;  ///< of the run's rejected cuts, from 1
  double time = 0;          ///< [s]
  FloeId floe = kNoFloe;
  std::string reason;
  geometry::Polygon polygon_in_body;  ///< of the floe
  geometry::Ring cusp_in_body;        ///< of a bend; empty of a split [m]
  geometry::Point crack_in_body[2];   ///< of a split: its ends [m]
};

/// One recorded row of one ship, in the ship's frame. Loads are those of ice where their names state no other
/// source.
struct ShipSample {
  double time = 0;  ///< end of the interval [s]
  int ship = 0;
  double surge_force = 0;  ///< mean true force over the interval: momentum given / time [N]
  double sway_force = 0;   ///< [N]
  double yaw_moment = 0;   ///< [N m]
  double surge_peak = 0;   ///< the paper's j/τ_c, the interval's largest by magnitude [N]
  double sway_peak = 0;    ///< [N]
  double yaw_peak = 0;     ///< [N m]
  double surge_max = 0;    ///< largest true force of a single step in the interval, by magnitude [N]
  double sway_max = 0;     ///< [N]
  double yaw_max = 0;      ///< [N m]
  // From contact with other ships and structures:
  double surge_from_ships = 0;         ///< mean force over the interval [N]
  double sway_from_ships = 0;          ///< [N]
  double yaw_from_ships = 0;           ///< [N m]
  double surge_from_ships_max = 0;     ///< largest force of a single step in the interval, by magnitude [N]
  double sway_from_ships_max = 0;      ///< [N]
  double yaw_from_ships_max = 0;       ///< [N m]
  geometry::Point position_in_world;   ///< [m]
  double heading = 0;                  ///< [rad]
  geometry::Vector velocity_in_world;  ///< over ground [m/s]
  double yaw_rate = 0;                 ///< [rad/s]
  double thrust = 0;  ///< along the heading; for a constant-speed ship the force that kept its speed [N]
  double surge_from_submerged = 0;  ///< of the ice under the hull, mean over the interval [N]
  double yaw_from_submerged = 0;    ///< likewise [N m]
  double submerged_area = 0;        ///< ice under the hull, at the sampled step [m²]
  // Of ships with water around the hull, an engine or a mooring:
  dynamics::Planar friction_of_ice;  ///< its share of the force of the ice [N, N m]
  dynamics::Planar from_water;       ///< on the hull, the inertia of the water with it [N, N m]
  dynamics::Planar from_engine;      ///< [N, N m]
  dynamics::Planar from_rudder;      ///< [N, N m]
  dynamics::Planar from_mooring;     ///< [N, N m]
  double lever = 0;                  ///< of the thrust, at the sampled step, −1 to 1
  double steering_angle = 0;         ///< of rudder or thrusters, to port [rad]
  std::int32_t rams = 0;             ///< charges after the first, of a ramming pilot
  double gained = 0;                 ///< by them, along the heading [m]
  double delivered_power = 0;        ///< by the lever, of the installed power; 0 where that is not known [W]
  int contacts = 0;                  ///< with ice, at the sampled step
  int contacts_with_ships = 0;       ///< with other ships and structures, at the sampled step
};

/// What happened since the caller last cleared it; the vectors keep their capacity, but for the births of the
/// scene's many floes.
struct Journal {
  static constexpr std::size_t kManyBirths = 1000;
  std::vector<Event> events;
  std::vector<ShipContact> ship_contacts;
  std::vector<MooringBreak> mooring_breaks;
  std::vector<Birth> births;
  std::vector<Death> deaths;
  std::vector<ShipSample> samples;
  std::vector<RejectedCut> rejected_cuts;
  void clear() {
    events.clear();
    ship_contacts.clear();
    mooring_breaks.clear();
    rejected_cuts.clear();
    births.clear();
    if (births.capacity() > kManyBirths) births.shrink_to_fit();
    deaths.clear();
    samples.clear();
  }
};

/// Where all the ice went [m²]. initial = floes + under hulls + under ice + submerged + brash − rounding, up
/// to `imbalance`.
struct AreaLedger {
  double initial_ice_area = 0;
  double floe_area = 0;
  double under_hull_area = 0;  ///< of submerged pieces, also of those that wait for room
  double under_ice_area = 0;   ///< of those that found none
  double submerged_area = 0;   ///< gone by cusp_fate submerge
  double brash_area = 0;
  double rounding_defect = 0;  ///< what rounding added (+) or took (−)
  double imbalance = 0;        ///< the sum of all places − rounding − initial
};

/// The same by mass [kg], each floe with its own density and thickness.
struct MassLedger {
  double initial_ice_mass = 0;
  double floe_mass = 0;
  double under_hull_mass = 0;
  double under_ice_mass = 0;
  double submerged_mass = 0;
  double brash_mass = 0;
  double rounding_mass = 0;
  double imbalance = 0;
};

struct Counts {
  std::int64_t floes_initial = 0;
  std::int64_t floes_final = 0;
  std::int64_t bends = 0;
  std::int64_t splits = 0;
  std::int64_t ground = 0;          ///< overlaps ground to brash
  std::int64_t tilted_under = 0;    ///< floes that tilted under a hull
  std::int64_t went_under = 0;      ///< the same and broken cusps
  std::int64_t came_up = 0;         ///< of them
  std::int64_t stayed_under = 0;    ///< of them
  std::int64_t crush_contacts = 0;  ///< contacts (not steps) at which ice crushed
  std::int64_t rejected_cuts = 0;
  std::int64_t floated_cusps = 0;
  std::int64_t brash_pieces = 0;
  std::int64_t snap_rounded = 0;  ///< pieces whose nearest doubles were not a valid polygon
  std::int64_t database_out_of_range = 0;
  std::int64_t unconverged_steps = 0;  ///< steps in which the contact solver used all its sweeps
  double largest_residual = 0;  ///< by how much a contact missed its law after a step's last sweep [m/s]
  double energy_created = 0;    ///< by steps whose contacts gave more than they took [J]
  std::int64_t unpaired_stretches = 0;  ///< overlaps without a contact for a step: crossings not in pairs
  std::int64_t steps = 0;
  std::int64_t peak_contacts = 0;
  std::int64_t peak_awake = 0;
};

}  // namespace polynya::simulation
