#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "dynamics/contact/contact_solver.hpp"
#include "fracture/decision.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/ice/beams.hpp"
#include "simulation/ship/carried_load.hpp"
#include "simulation/ship/load_peaks.hpp"
#include "simulation/ship/panels.hpp"
#include "simulation/world/clock.hpp"
#include "simulation/world/energy.hpp"
#include "simulation/world/journal.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// Loads of one kind of contact on a hull over a recording interval, in the hull's frame.
struct ContactLoads {
  dynamics::Planar impulse;  ///< impulse on the hull [N s, N m s]
  /// Impulse in the present step, without the impulses that were missed before contacts were found [N s, N m s].
  dynamics::Planar step_impulse;
  dynamics::Planar largest;   ///< largest booked force of a single step, component by component [N, N m]
  dynamics::Planar friction;  ///< part of the impulse that is due to friction [N s, N m s]
  /// Missed impulses in surge, sway and yaw that are booked in later steps, also in later recording intervals.
  CarriedLoad carried[3];
  int contacts = 0;  ///< number of contacts in the last step
};

/// Loads of the ice that goes under a ship's hull and lies there.
struct SubmergedLoads {
  dynamics::Planar impulse;  ///< impulse of cusps that the hull presses down and of ice under the hull [N s, N m s]
  double area = 0;           ///< area of the ice under the hull in the last step [m²]
};

/// All loads on a hull in a step, or their sums over a recording interval, in the hull's frame.
struct HullLoads {
  ContactLoads ice;
  ContactLoads hulls;  ///< loads of other ships, structures and walls
  SubmergedLoads submerged;
  /// Collision force j/τ_c of contacts with ice: their sum in a step; over an interval the largest of these sums,
  /// component by component [N, N m].
  dynamics::Planar collision;
};

/// Impulses on a ship that sails, over a recording interval, in the ship's frame. Those of ice and other hulls are in
/// HullLoads.
struct SailingLoads {
  dynamics::Planar water;    ///< impulse of the water, with the inertia of the added mass [N s, N m s]
  dynamics::Planar engine;   ///< impulse of the propellers [N s, N m s]
  dynamics::Planar rudder;   ///< impulse of the rudders [N s, N m s]
  dynamics::Planar mooring;  ///< impulse of the mooring [N s, N m s]
};

/// The motion that a hull gives to the edge of a cusp that it breaks off.
struct DrivenEdge {
  double speed = 0;               ///< downward speed of the edge; 0 if the hull does not move it [m/s]
  double speed_per_approach = 0;  ///< downward speed of the edge / speed of the hull along the contact's normal [-]
  geometry::Vector horizontal;    ///< horizontal force on the ice / downward force on it, in the water frame [-]
  double hull_angle = 0;          ///< angle θ_s of the hull from the vertical [rad]
};

/// A fracture that was decided in this step. It is applied at the end of the step.
struct PendingFracture {
  fracture::Failure failure = fracture::Failure::kNone;
  int ship = 0;                         ///< hull that breaks the floe; −1 if another floe does
  FloeId by_floe = kNoFloe;             ///< floe that breaks it; kNoFloe if a hull does
  FloeId floe = 0;                      ///< floe that breaks
  geometry::Point point_in_water;       ///< contact point [m]
  geometry::Point first_touch_in_body;  ///< centre of the cusp in the body frame of the floe [m]
  geometry::Vector normal;              ///< unit normal from the hull into the ice, in the water frame
  double penetration = 0;               ///< penetration depth of the contact (IceEvent::penetration) [m]
  double cusp_radius = 0;               ///< radius of the cusp [m]
  /// Axis of symmetry of the cusp's polygon: unit vector in the body frame of the floe.
  geometry::Vector cusp_axis_in_body{1, 0};
  DrivenEdge driven_edge;   ///< motion of the cusp's edge; set for bends by the law of crushing ice
  bool is_in_range = true;  ///< true if the load is in the range of the bending model's data
  /// True if the fracture is assigned to a piece of its floe if another bend breaks the floe in the same step before
  /// it.
  bool passes_to_pieces = false;
  geometry::CrackPath crack_in_body;  ///< crack of a split, in the body frame of the floe
  fracture::FailureCriteria criteria;
  dynamics::PersistentContact* record = nullptr;  ///< record of the contact that breaks the floe; valid during the step
};

/// The slope of a hull at one of its contacts, and the part of the overlap that is crushed there.
struct HullSlope {
  /// V/H: downward force on the ice / horizontal force; ≤ 0 if the hull is too steep to press ice down [-].
  double vertical_share = 0;
  double tangent = 0;  ///< tan θ_s, with the angle θ_s from the vertical [-]
  /// Fraction of the growth of the depth in the step that is crushed [-]. The rest is the ice edge that bent or tilted
  /// away in the step.
  double crushed_share = 1;
  /// Crushed depth as a fraction of the whole depth of the overlap [-]. The rest is the distance by which the ice edge
  /// has bent away since first contact.
  double penetration_share = 1;
  double height = 0;  ///< height of the ice that presses on the hull [m]
};

/// A floe that goes under a hull at the end of the step, because its edge was pressed down far enough.
struct PendingSubmersion {
  FloeId floe = 0;
  int ship = 0;
  geometry::Point point_in_water;  ///< contact point [m]
  geometry::Vector normal;         ///< unit normal from the hull into the ice, in the water frame
  double penetration = 0;          ///< depth of the overlap [m]
  TiltCriterion criterion;
};

/// A ship's velocity in the water frame [m/s, rad/s].
struct ShipMotion {
  geometry::Vector velocity;
  double angular_velocity = 0;
};

/// The data of one contact that the solver changes: the motion of its bodies and the memory of its record, before the
/// step is solved.
struct SolverStart {
  geometry::Vector velocity[2];         ///< velocities of the two bodies [m/s]
  double angular_velocity[2] = {0, 0};  ///< angular velocities of the two bodies [rad/s]
  double last_impulse[2] = {0, 0};      ///< PersistentContact::last_impulse [N s]
  double last_slip_impulse = 0;         ///< PersistentContact::last_slip_impulse [N s]
};

/// The results of the stages of one step. Between two steps they are those of the last step.
struct StepData {
  std::vector<dynamics::Contact> contacts;
  std::vector<dynamics::InseparableOverlap> inseparable_overlaps;
  std::vector<dynamics::PartedContact> parted;
  std::vector<HullSlope> slopes;  ///< slopes of the hulls at their contacts, which are the first contacts of the list
  /// Fractures to be applied: bends and splits by the paper's rule. enter_splits() inserts `splits` before them.
  std::vector<PendingFracture> fractures;
  std::vector<PendingFracture> splits;  ///< splits by the true forces of the step
  std::vector<PendingSubmersion> submersions;
  std::vector<Event> mooring_breaks;            ///< events of moorings that broke; recorded after the events of ice
  std::vector<HullLoads> loads;                 ///< loads of each hull in the step
  std::vector<ShipMotion> start;                ///< motion of each ship before the step's impulses
  std::vector<geometry::Pose> water_from_hull;  ///< pose of each hull at the start of the step
  dynamics::ContactSolver solver;               ///< solver, kept because it reuses its memory
  /// Shapes of slender floes that may break as beams. They are kept over steps, because they cost time to compute.
  std::unordered_map<FloeId, BeamShape> beam_shapes;
  /// State of each contact before it was solved; used for splits by true forces.
  std::vector<SolverStart> solver_start;
};

/// Sums over the run so far.
struct Accounts {
  IceLedger areas;   ///< areas of ice that is gone; floes and ice under hulls are added when the ledger is read
  IceLedger masses;  ///< masses of the same ice
  AuditSums audit;
  Counts counts;
  std::vector<HullLoads> loads;       ///< loads of each hull since the last sample
  std::vector<SailingLoads> sailing;  ///< loads of each ship since the last sample
  std::vector<Event> hull_contacts;   ///< first contact of each two hulls that have touched
  LoadPeaks load_peaks;
  std::vector<HullPanels> panels;  ///< loads on the panels of each hull since the last sample
  /// Pairs of bodies (a, b) that geometry refused to cut by each other. They are not cut again.
  std::vector<std::pair<std::int64_t, std::int64_t>> refused_grinds;
  std::int64_t sampled_at = 0;  ///< number of ticks at the last sample
};

/// The accounts and the journal, in which a stage that changes floes records its changes.
struct Books {
  Accounts& accounts;
  Journal& journal;
};

/// Adaptation of the number of parts of a tick to the number of bends in the last ticks (parts.hpp).
struct Pace {
  int finer = 1;     ///< factor on the number of parts, a power of 2
  double bends = 0;  ///< running mean of the number of bends in a step, over about eight ticks [-]
};

/// Contents of a new world.
enum class Start {
  kScene,  ///< the hulls and floes of the scene
  kEmpty,  ///< no bodies, because a saved state will be loaded (state.hpp)
};

/// All data of a run. A stage (step.hpp) receives only the members that it reads and changes.
struct World {
  explicit World(Scene scene, Shortcuts shortcuts = {}, Start start = Start::kScene);

  std::vector<FloeSpec> floes_at_start;  ///< floes of the scene, until the population takes them over
  const Setup setup;                     ///< settings with the scene, which no longer contains its floes
  int threads = 1;                       ///< number of threads; results do not depend on it
  Clock clock;
  Population population;
  Pace pace;
  Step last_step;  ///< last step, to which `data` belongs
  StepData data;
  Accounts accounts;
  Journal journal;
  std::vector<ExternalPilot> pilots;  ///< pilots from outside for each ship, not saved; empty if there are none
  /// Force and moment from outside on each ship, in the ship's frame [N, N m]; empty if there are none. They are not
  /// part of the saved state, so the caller sets them again after a resume.
  std::vector<dynamics::Planar> external_forces;
  std::optional<std::string> failure;  ///< reason why the run cannot continue, if any
};

/// Returns the area of all ice by the place where it is now [m²].
IceLedger area_ledger(const World& world);
/// Returns the mass of all ice by the place where it is now [kg].
IceLedger mass_ledger(const World& world);

}  // namespace polynya::simulation
