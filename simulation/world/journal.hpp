#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "dynamics/planar.hpp"
#include "simulation/world/event.hpp"

namespace polynya::simulation {

/// Data of a floe at its creation, without its shape.
struct BirthRecord {
  FloeId floe = 0;
  FloeId parent = kNoFloe;
  double time = 0;                   ///< time of creation [s]
  int generation = 0;                ///< number of ancestors; 0 for a floe of the scene
  double area = 0;                   ///< area in plan [m²]
  double mass = 0;                   ///< mass [kg]
  geometry::Point centroid_in_body;  ///< centre of mass in the body frame [m]
  std::int32_t own_ice = -1;         ///< index of the floe's ice in Scene::own_ice; −1 for the scene's ice
};

/// Data of a floe at its creation, with its shape. Each birth is written as one line of floes.ndjson.
struct Birth : BirthRecord {
  geometry::Polygon polygon_in_body;  ///< outline in the body frame: scene coordinates of the oldest ancestor [m]
};

/// Last shape of a floe that broke, surfaced or stays under the ice for good. Most of the children's boundaries are
/// parts of this shape, and the lines of the children in floes.ndjson refer to it.
struct Death {
  FloeId floe = kNoFloe;
  geometry::Polygon polygon_in_body;  ///< outline in the body frame [m]
  friend bool operator==(const Death&, const Death&) = default;
};

/// Loads and motion of one hull (ship, structure or wall) over one recording interval, in the hull's frame. Loads are
/// means over the interval unless stated otherwise. io/run/records.cpp defines the corresponding columns of
/// forces.csv.
struct HullSample {
  double time = 0;            ///< end of the interval [s]
  int ship = 0;               ///< number of the hull in the scene
  dynamics::Planar from_ice;  ///< force of the ice around the hull: impulse / interval [N, N m]
  /// Impulse of that ice that contacts missed before they were found and that is not booked yet at the end of the
  /// interval (CarriedLoad). `from_ice` of later intervals contains it [N s, N m s].
  dynamics::Planar carried;
  /// Largest force of the ice around the hull in a single step, by magnitude and for each component [N, N m].
  dynamics::Planar from_ice_largest;
  /// Largest collision force j/τ_c of the paper, of the contacts with ice, in a single step, by magnitude and for each
  /// component [N, N m].
  dynamics::Planar collision;
  dynamics::Planar from_ships;  ///< force of contacts with other hulls [N, N m]
  /// Largest force of contacts with other hulls in a single step, by magnitude and for each component [N, N m].
  dynamics::Planar from_ships_largest;
  /// Force of the ice that lies under the hull and of cusps that the hull presses down [N, N m].
  dynamics::Planar from_submerged;
  double submerged_area = 0;           ///< area of the ice under the hull in the last step [m²]
  geometry::Point position_in_world;   ///< origin of the hull's frame; of a ship its centre of gravity [m]
  double heading = 0;                  ///< heading, counter-clockwise from the x axis [rad]
  geometry::Vector velocity_in_world;  ///< velocity over ground [m/s]
  double yaw_rate = 0;                 ///< yaw rate, counter-clockwise [rad/s]
  /// Thrust along the heading [N]: the constant thrust, the mean thrust of the engine, or the load with which a wall
  /// presses. For a hull of prescribed motion it is the force that holds the hull at its speed.
  double thrust = 0;
  dynamics::Planar friction_of_ice;  ///< part of `from_ice` that friction causes [N, N m]
  // The following loads are 0 unless the ship has water around its hull, an engine or a mooring.
  dynamics::Planar from_water;    ///< force of the water on the hull, with the inertia of the water [N, N m]
  dynamics::Planar from_engine;   ///< force of the propellers or thrusters [N, N m]
  dynamics::Planar from_rudder;   ///< force of the rudder [N, N m]
  dynamics::Planar from_mooring;  ///< force of the mooring [N, N m]
  double lever = 0;               ///< thrust lever at the end, −1 (full astern) to 1 (full ahead) [-]
  double steering_angle = 0;      ///< angle of the rudder or thrusters at the end, positive to port [rad]
  std::int32_t rams = 0;          ///< number of charges after the first, of a pilot that rams
  double distance_gained = 0;     ///< distance along the heading that ramming has gained [m]
  double delivered_power = 0;     ///< |lever| × installed power of the engine; 0 if that power is unknown [W]
  int contacts = 0;               ///< number of contacts with ice in the last step
  int contacts_with_ships = 0;    ///< number of contacts with other hulls in the last step
  friend bool operator==(const HullSample&, const HullSample&) = default;
};

/// Cause that ended a peak of a contact's force.
enum class PeakEnd : std::uint8_t {
  kNone,   ///< no cause, because the contact is not a peak
  kBend,   ///< the floe broke by bending, at this contact or at another one
  kSplit,  ///< the floe split
  kSlip,   ///< no event of the ice: the two bodies slid or moved apart
  kTilt    ///< the floe's edge tilted down under the hull
};

/// State of one contact of two bodies in one step.
struct ContactState {
  /// Value of a place on the waterline for a contact that has none.
  static constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  /// A hull or a floe; the other member has its default value.
  struct Body {
    int ship = -1;          ///< number of the hull in the scene
    FloeId floe = kNoFloe;  ///< identity of the floe
    friend bool operator==(Body, Body) = default;
  };
  Body on;  ///< body on which the force acts
  Body by;  ///< body that exerts the force
  /// Point of the contact line at which the force acts, in the world frame at the start of the step [m].
  geometry::Point point_in_world;
  geometry::Vector force;    ///< force of `by` on `on` in the world's axes: impulse / time step [N]
  double depth = 0;          ///< depth of the overlap along the contact's normal [m]
  bool is_crushing = false;  ///< true if the contact presses with the full force of crushing ice
  double arc = kNowhere;  ///< arc length along the waterline of `on` from its stem to the point, positive to port [m]
  double station = kNowhere;          ///< distance of the point aft of the stem, along the length of `on` [m]
  double width = 0;                   ///< length of the contact line [m]
  double height = 0;                  ///< height of the ice that presses on the hull; 0 if two hulls touch [m]
  double pressure = 0;                ///< nominal pressure: normal force / (width × height); 0 if two hulls touch [Pa]
  double thickness = 0;               ///< thickness of the ice, of two floes the smaller one; 0 if two hulls touch [m]
  PeakEnd ended_by = PeakEnd::kNone;  ///< cause that ended the peak; kNone for a contact that is not a peak

  /// Returns the force along the contact's normal [N]; 0 if two hulls touch.
  double normal_force() const { return pressure * width * height; }
};

/// A peak of the force of a contact between a hull and ice: the largest force between two times at which the force was
/// below half of it. The force is the one that the gauge of RecordSettings::peak_response shows, which smooths the
/// force of each step.
struct LoadPeak {
  double time = 0;     ///< end of the step with the largest force [s]
  ContactState state;  ///< contact in that step, with force and pressure scaled to what the gauge shows
};

/// Loads of the ice on one panel of a hull over one recording interval, in the hull's frame. Only panels on which ice
/// pressed have a sample.
struct PanelSample {
  double time = 0;  ///< end of the interval [s]
  int hull = 0;     ///< number of the hull in the scene
  int column = 0;   ///< column of the panel, counted from the stem: to port 0, 1, …; to starboard −1, −2, …
  int row = 0;      ///< row of the panel, counted from the bottom; −1: all ice above and below the rows
  dynamics::Planar load;  ///< mean force and moment of the ice [N, N m]
  double force = 0;       ///< mean force along the normals of the contacts [N]
  double largest = 0;     ///< largest such force in a single step [N]
  double pressure = 0;    ///< mean force along the normals / area of the panel; 0 for row −1 [Pa]
  double loaded = 0;      ///< time during which ice pressed on the panel [s]
  friend bool operator==(const PanelSample&, const PanelSample&) = default;
};

/// Records of a run since the journal was last cleared. The caller writes them and clears the journal.
struct Journal {
  /// Number of births above which clear() frees the memory of the births. A scene may add a million floes at once,
  /// while one step breaks off far fewer. Smaller values free and allocate memory in every step; larger ones keep
  /// memory that is not needed again.
  static constexpr std::size_t kManyBirths = 1000;
  std::vector<Event> events;
  std::vector<Birth> births;
  std::vector<Death> deaths;
  std::vector<HullSample> samples;
  std::vector<LoadPeak> peaks;
  std::vector<PanelSample> panels;
  /// Removes all records. The vectors keep their capacity, except for more than kManyBirths births.
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

/// Largest number of peaks that a run records. Further peaks are only counted. Larger values let contacts.csv grow.
inline constexpr std::int64_t kMostPeaks = 200'000;

/// Numbers of peaks of contact forces in a run.
struct PeakCounts {
  std::int64_t recorded = 0;  ///< number of recorded peaks
  std::int64_t below = 0;     ///< number of peaks below RecordSettings::least_peak, which are not recorded
  std::int64_t beyond = 0;    ///< number of peaks after the first kMostPeaks, which are not recorded
  double largest_beyond = 0;  ///< largest force of the peaks in `beyond` [N]
};

/// Amounts of ice by the place where the ice is, either areas [m²] or masses [kg]. A mass is computed with each floe's
/// own density and thickness.
struct IceLedger {
  double initial = 0;      ///< ice of the scene at the start
  double floes = 0;        ///< floating floes
  double under_hulls = 0;  ///< pieces under hulls, and pieces behind a hull that wait for space to surface
  double under_ice = 0;    ///< pieces that stay under the ice for good
  double submerged = 0;    ///< cusps that went under for good: by CuspFate::kSubmerge, or at a hull without a draught
  double brash = 0;        ///< ice that became brash
  double rounding = 0;     ///< ice added (+) or removed (−) by rounding the coordinates of cuts

  /// Returns the ice of all places − rounding − initial, which is ideally 0.
  double imbalance() const { return floes + under_hulls + under_ice + submerged + brash - rounding - initial; }

  /// Largest imbalance, as a fraction of the ice at the start, at which the ledger counts as closed [-]. Sums of
  /// doubles leave far less.
  static constexpr double kTolerance = 1e-9;
  /// Returns true if the imbalance is within kTolerance; false for an imbalance that is not a number.
  bool is_closed() const { return std::abs(imbalance()) <= kTolerance * initial; }
};

/// Counts of a run so far. `floes_final` and `steps` are set only in the copy that Simulation::counts() returns.
struct Counts {
  std::int64_t floes_initial = 0;  ///< number of floes of the scene
  std::int64_t floes_final = 0;    ///< number of floating floes now
  std::int64_t bends = 0;          ///< number of bends, each of which breaks off a cusp
  std::int64_t splits = 0;         ///< number of splits
  std::int64_t ground = 0;         ///< number of overlaps that were cut off and became brash
  std::int64_t tilted_under = 0;   ///< number of floes that tilted and went under a hull
  /// Number of pieces that went under a hull: tilted floes, cusps, and floes that the scene puts there at the start.
  std::int64_t went_under = 0;
  std::int64_t came_up = 0;         ///< number of pieces from under a hull that surfaced, as floes or as brash
  std::int64_t stayed_under = 0;    ///< number of pieces from under a hull that stay under the ice for good
  std::int64_t crush_contacts = 0;  ///< number of contacts at which ice crushed, each counted once
  std::int64_t rejected_cuts = 0;   ///< number of cuts that geometry refused
  std::int64_t floated_cusps = 0;   ///< number of pieces of cusps that float as floes (CuspFate::kFloat)
  std::int64_t brash_pieces = 0;    ///< number of pieces that became brash
  /// Number of pieces whose vertices, rounded to the nearest doubles, did not form a valid polygon. They are rounded
  /// to a lattice (docs/geometry.md, "Rounding that stays valid").
  std::int64_t snap_rounded = 0;
  /// Number of cusps that broke under a load outside the range of the bending model's data. Loads that did not reach
  /// V_b are not counted.
  std::int64_t database_out_of_range = 0;
  /// Number of ticks with kMostParts parts in which the running mean of bends in a part exceeded kCrowdedBends, so that
  /// loads depend on the step (parts.hpp).
  std::int64_t crowded_ticks = 0;
  /// Number of splits that were given up because their contacts could not be stopped at the force that splits the floe
  /// (ice/split_instant.hpp).
  std::int64_t unresolved_splits = 0;
  /// Number of time steps of the law of impulses in which an overlap was larger than half of the smaller of its two
  /// bodies: rigid impulses crush ice and do not remove it, so that one body passes through the other.
  std::int64_t passing_steps = 0;
  std::int64_t unconverged_steps = 0;  ///< number of time steps in which the contact solver used all its sweeps
  /// Largest residual of the contact solver after the last sweep of a step: speed by which a contact violates its law
  /// [m/s].
  double largest_residual = 0;
  /// Energy that contacts created by error [J]: the sum of their net work over all steps in which it was positive.
  double energy_created = 0;
  /// Number of overlaps, summed over all steps, that had no contact because rounding left a crossing of the two
  /// boundaries without its partner.
  std::int64_t unpaired_stretches = 0;
  std::int64_t steps = 0;          ///< number of whole ticks
  std::int64_t steps_taken = 0;    ///< number of time steps: the parts of all ticks
  std::int64_t most_parts = 0;     ///< largest number of parts of a tick
  std::int64_t body_steps = 0;     ///< number of awake bodies, summed over all time steps
  std::int64_t peak_contacts = 0;  ///< largest number of contacts in a time step
  std::int64_t peak_awake = 0;     ///< largest number of awake bodies at the end of a tick
};

}  // namespace polynya::simulation
