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
  dynamics::Planar impulse;         ///< on the ship [N s, N m s]
  dynamics::Planar steady_impulse;  ///< in the present step, without missed impulses; gives `largest` [N s, N m s]
  dynamics::Planar largest;         ///< largest mean force of a step, component by component [N, N m]
  dynamics::Planar friction;        ///< part of the impulse that the slip of contacts gave [N s, N m s]
  CarriedLoad carried[3];           ///< of impulse: surge, sway, yaw; kept from one recording interval to the next
  int contacts = 0;                 ///< number of contacts in the last step
};

/// Loads of the ice that goes under a ship's hull and lies there.
struct SubmergedLoads {
  dynamics::Planar impulse;  ///< by cusps that are pushed down and ice under the hull [N s, N m s]
  double area = 0;           ///< area of the ice under the hull in the last step [m²]
};

/// All loads on a hull over a step or a recording interval, in the hull's frame.
struct HullLoads {
  ContactLoads ice;
  ContactLoads hulls;  ///< by other ships, structures and walls
  SubmergedLoads submerged;
  dynamics::Planar collision;  ///< the paper's j/τ_c of contacts with ice, component by component [N, N m]
};

/// Impulses on a ship that sails, other than by ice and other hulls, over a recording interval, in the ship's frame.
struct SailingLoads {
  dynamics::Planar water;    ///< on the hull, with the inertia of the water around it [N s, N m s]
  dynamics::Planar engine;   ///< [N s, N m s]
  dynamics::Planar rudder;   ///< [N s, N m s]
  dynamics::Planar mooring;  ///< [N s, N m s]
};

/// How a hull pushes the edge of a cusp that it breaks off.
struct EdgePush {
  double speed = 0;               ///< downward speed that the hull gives the edge; 0: it is not pushed [m/s]
  double speed_per_approach = 0;  ///< that speed over the hull's along the contact's normal [-]
  geometry::Vector horizontal;    ///< force on the ice per force down on it [-]
  double hull_angle = 0;          ///< θ_s, angle of the hull from the vertical [rad]
};

/// A fracture decided in this step, to be applied at its end.
struct PendingFracture {
  fracture::Failure failure = fracture::Failure::kNone;
  int ship = 0;                         ///< the hull that breaks the floe; -1: a floe does
  FloeId by_floe = kNoFloe;             ///< the floe that breaks it
  FloeId floe = 0;                      ///< the floe that breaks
  geometry::Point point_in_water;       ///< contact point [m]
  geometry::Point first_touch_in_body;  ///< centre of the cusp in the floe's frame [m]
  geometry::Vector normal;              ///< from the hull into the ice, water frame
  double penetration = 0;               ///< [m]
  double cusp_radius = 0;               ///< [m]
  /// Unit vector; the cusp's polygon is the same to both sides of it.
  geometry::Vector cusp_axis_in_body{1, 0};
  EdgePush push;                      ///< for bends by the law of crushing ice
  bool is_in_range = true;            ///< the bending model holds for this load
  bool passes_to_pieces = false;      ///< if its floe bends elsewhere in the same step, it breaks a piece of it
  geometry::CrackPath crack_in_body;  ///< path of a split
  fracture::FailureCriteria criteria;
  dynamics::PersistentContact* record = nullptr;  ///< the contact that breaks it; valid during the step
};

/// The hull at one of its contacts.
struct HullSlope {
  double vertical_share = 0;  ///< V/H, down on the ice; ≤ 0 where it is too steep to press ice down
  double tangent = 0;         ///< tan θ_s
  /// Fraction of the overlap's growth in the step that is crushed [-]. In the rest the ice edge bent or tilted down.
  double crushed_share = 1;
  /// Crushed depth as a fraction of the depth of the overlap [-]. By the rest, the ice edge has bent away so far.
  double penetration_share = 1;
  double height = 0;  ///< height of the ice that the hull presses on [m]
};

/// A floe whose edge was pressed down so far that it goes under.
struct PendingSubmersion {
  FloeId floe = 0;
  int ship = 0;
  geometry::Point point_in_water;  ///< contact point [m]
  geometry::Vector normal;         ///< from the hull into the ice, water frame
  double penetration = 0;          ///< [m]
  TiltCriterion criterion;
};

/// A ship's velocity in the water frame [m/s, rad/s].
struct ShipMotion {
  geometry::Vector velocity;
  double angular_velocity = 0;
};

/// All that solving changes of one contact: the motion of its bodies and its memory before the step is solved.
struct SolverStart {
  geometry::Vector velocity[2];         ///< [m/s]
  double angular_velocity[2] = {0, 0};  ///< [rad/s]
  double last_impulse[2] = {0, 0};      ///< [N s]
  double last_slip_impulse = 0;         ///< [N s]
};

/// The results of the stages of one step. Between two steps they are those of the last one.
struct StepData {
  std::vector<dynamics::Contact> contacts;
  std::vector<dynamics::BlindOverlap> blind_overlaps;
  std::vector<dynamics::PartedContact> parted;
  std::vector<HullSlope> slopes;  ///< for the contacts of hulls, which are the first ones
  std::vector<PendingFracture> fractures;
  std::vector<PendingFracture> splits;  ///< splits by the true forces of the step
  std::vector<PendingSubmersion> submersions;
  std::vector<Event> mooring_breaks;                  ///< recorded after the events of ice
  std::vector<HullLoads> loads;                       ///< per hull
  std::vector<ShipMotion> start;                      ///< per ship: motion before the step's impulses
  std::vector<geometry::Pose> water_from_hull;        ///< per hull: place at the start of the step
  dynamics::ContactSolver solver;                     ///< kept for its memory
  std::unordered_map<FloeId, BeamShape> beam_shapes;  ///< of slender floes that forces may break
  std::vector<SolverStart> solver_start;              ///< per contact; for splits by true forces
};

/// Sums of all that has happened so far.
struct Accounts {
  IceLedger areas;   ///< of the ice that has gone; floes and ice under hulls are added when it is read
  IceLedger masses;  ///< the same in mass
  AuditSums audit;
  Counts counts;
  std::vector<HullLoads> loads;       ///< per hull, since the last sample
  std::vector<SailingLoads> sailing;  ///< per ship, since the last sample
  std::vector<Event> hull_contacts;   ///< first contact of each two hulls
  LoadPeaks load_peaks;
  std::vector<HullPanels> panels;                                     ///< per hull, since the last sample
  std::vector<std::pair<std::int64_t, std::int64_t>> refused_grinds;  ///< bodies that geometry refused to cut
  std::int64_t sampled_at = 0;                                        ///< the tick of the last sample
};

/// The accounts and the journal, in which a stage that changes floes enters what it did.
struct Books {
  Accounts& accounts;
  Journal& journal;
};

/// What the last ticks tell about the number of parts that the next one needs (parts.hpp).
struct Pace {
  int finer = 1;     ///< factor on the number of parts, a power of 2
  double bends = 0;  ///< bends in a step, a running mean over some eight ticks
};

/// The contents of a new world.
enum class Start {
  kScene,  ///< the scene's hulls and floes
  kEmpty,  ///< nothing: a saved state is to be loaded (state.hpp)
};

/// Everything a run is made of. A stage (step.hpp) is given the members that it reads and changes, not the world.
struct World {
  explicit World(Scene scene, Shortcuts shortcuts = {}, Start start = Start::kScene);

  std::vector<FloeSpec> floes_at_start;  ///< the scene's floes, until the population takes them
  const Setup setup;                     ///< with the scene, without its floes
  int threads = 1;                       ///< number of threads; results do not depend on it
  Clock clock;
  Population population;
  Pace pace;
  Step last_step;  ///< the step taken last, to which `data` belongs
  StepData data;
  Accounts accounts;
  Journal journal;
  std::vector<ExternalPilot> pilots;  ///< per ship: pilots from outside, if any
  /// Per ship: force and moment from outside, in the ship's frame [N, N m]. Empty if there are none. Not part of the
  /// saved state: whoever gives them also remembers them.
  std::vector<dynamics::Planar> external_forces;
  std::optional<std::string> failure;  ///< why the run cannot continue
};

/// Returns where all the ice of a world is now, and where the rest went.
IceLedger area_ledger(const World& world);
IceLedger mass_ledger(const World& world);

}  // namespace polynya::simulation
