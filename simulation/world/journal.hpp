#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "dynamics/planar.hpp"
#include "simulation/world/event.hpp"

namespace polynya::simulation {

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

/// One recorded row of one ship, in the ship's frame. Loads are means over the interval where nothing else is
/// stated; the columns of forces.csv that follow are in io/run/force_columns.cpp.
struct HullSample {
  double time = 0;  ///< end of the interval [s]
  int ship = 0;
  dynamics::Planar from_ice;            ///< around the hull: momentum given / time [N, N m]
  dynamics::Planar from_ice_largest;    ///< of a single step, component by component by magnitude [N, N m]
  dynamics::Planar collision;           ///< the paper's j/τ_c with ice, likewise the largest [N, N m]
  dynamics::Planar from_ships;          ///< from contact with other ships and structures [N, N m]
  dynamics::Planar from_ships_largest;  ///< of a single step [N, N m]
  dynamics::Planar from_submerged;      ///< of the ice under the hull [N, N m]
  double submerged_area = 0;            ///< ice under the hull, at the sampled step [m²]
  geometry::Point position_in_world;    ///< [m]
  double heading = 0;                   ///< [rad]
  geometry::Vector velocity_in_world;   ///< over ground [m/s]
  double yaw_rate = 0;                  ///< [rad/s]
  double thrust = 0;  ///< along the heading; for a constant-speed ship the force that kept its speed [N]
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
  friend bool operator==(const HullSample&, const HullSample&) = default;
};

/// What ended a peak of a contact's force: its ice bent or split, it tilted under the hull, or none of these: the two
/// slid or moved apart.
enum class PeakEnd : std::uint8_t { kNone, kBend, kSplit, kSlip, kTilt };

/// Two bodies that touch, in one step.
struct ContactState {
  static constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  struct Body {  ///< a ship or a floe
    int ship = -1;
    FloeId floe = kNoFloe;
    friend bool operator==(Body, Body) = default;
  };
  Body on;
  Body by;
  geometry::Point point_in_world;     ///< that the force acts at, where it was when the step began [m]
  geometry::Vector force;             ///< by `by` on `on`, over ground, mean of the step: impulse / time [N]
  double depth = 0;                   ///< of the overlap along the normal [m]
  bool is_crushing = false;           ///< it presses with all that crushing ice carries
  double arc = kNowhere;              ///< of that point on the waterline of `on`, from its stem, to port [m]
  double station = kNowhere;          ///< the same along its length, from the stem aft [m]
  double width = 0;                   ///< of the contact line [m]
  double height = 0;                  ///< of ice against the hull [m]; 0 of steel
  double pressure = 0;                ///< nominal: normal force by width and height [Pa]; 0 of steel
  double thickness = 0;               ///< of the ice, of two floes the thinner [m]; 0 of steel
  PeakEnd ended_by = PeakEnd::kNone;  ///< of a peak; in the contacts of a frame none
};

/// The largest force of a contact between two times at which it was below half of it.
struct LoadPeak {
  double time = 0;  ///< [s]
  ContactState state;
};

/// One recorded row of a panel of a hull that ice pressed in the interval, in the hull's frame.
struct PanelSample {
  double time = 0;  ///< end of the interval [s]
  int hull = 0;
  int column = 0;         ///< from the stem, to starboard −1, −2, …
  int row = 0;            ///< from the bottom; −1: above and below all of them
  dynamics::Planar load;  ///< mean of the ice's [N, N m]
  double force = 0;       ///< mean of what acts along the contacts' normals [N]
  double largest = 0;     ///< of a single step [N]
  double pressure = 0;    ///< mean over the panel's area [Pa]
  double loaded = 0;      ///< how long ice pressed [s]
  friend bool operator==(const PanelSample&, const PanelSample&) = default;
};

/// What happened since the caller last cleared it; the vectors keep their capacity, but for the births of the
/// scene's many floes.
struct Journal {
  static constexpr std::size_t kManyBirths = 1000;  ///< of a scene; what breaks in a step stays below
  std::vector<Event> events;
  std::vector<Birth> births;
  std::vector<Death> deaths;
  std::vector<HullSample> samples;
  std::vector<LoadPeak> peaks;
  std::vector<PanelSample> panels;
  void clear() {
    events.clear();
    births.clear();
    if (births.capacity() > kManyBirths) births.shrink_to_fit();
    deaths.clear();
    samples.clear();
    peaks.clear();
    panels.clear();
  }
};

/// Peaks of a run that are recorded.
inline constexpr std::int64_t kMostPeaks = 200'000;

/// Of the peaks of contacts' forces, how many are recorded, and what fell under the limits.
struct PeakCounts {
  std::int64_t recorded = 0;
  std::int64_t below = 0;     ///< the scene's least peak
  std::int64_t beyond = 0;    ///< kMostPeaks
  double largest_beyond = 0;  ///< of those [N]
};

/// Where all the ice went, by area [m²] or by mass [kg], each floe with its own density and thickness.
struct IceLedger {
  double initial = 0;
  double floes = 0;
  double under_hulls = 0;  ///< submerged pieces, also those that wait for room
  double under_ice = 0;    ///< those that found none
  double submerged = 0;    ///< gone by cusp_fate submerge
  double brash = 0;
  double rounding = 0;  ///< what rounding added (+) or took (−)

  /// The sum of all places − rounding − initial.
  double imbalance() const { return floes + under_hulls + under_ice + submerged + brash - rounding - initial; }
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
  std::int64_t crowded_ticks = 0;       ///< in the most parts, and yet with more bends in each than kCrowded
  std::int64_t unresolved_splits = 0;   ///< whose force could not be stopped where they run: they did not
  std::int64_t unconverged_steps = 0;   ///< steps in which the contact solver used all its sweeps
  double largest_residual = 0;          ///< by how much a contact missed its law after a step's last sweep [m/s]
  double energy_created = 0;            ///< by steps whose contacts gave more than they took [J]
  std::int64_t unpaired_stretches = 0;  ///< overlaps without a contact for a step: crossings not in pairs
  std::int64_t steps = 0;               ///< whole ticks
  std::int64_t steps_taken = 0;         ///< time steps: the parts of all ticks
  std::int64_t most_parts = 0;          ///< of a tick
  std::int64_t body_steps = 0;          ///< awake bodies, summed over the time steps
  std::int64_t peak_contacts = 0;
  std::int64_t peak_awake = 0;
};

}  // namespace polynya::simulation
