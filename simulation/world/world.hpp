#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "dynamics/contact/contact_solver.hpp"
#include "fracture/decision.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/ice/beams.hpp"
#include "simulation/ship/load_peaks.hpp"
#include "simulation/ship/panels.hpp"
#include "simulation/world/clock.hpp"
#include "simulation/world/energy.hpp"
#include "simulation/world/journal.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// What one kind of contact does to a ship over a recording interval, in the ship's frame.
struct ContactLoads {
  dynamics::Planar impulse;         ///< on the ship [N s, N m s]
  dynamics::Planar steady_impulse;  ///< of the present step: what the largest force is found from [N s, N m s]
  dynamics::Planar largest;         ///< single-step true force, component by component [N, N m]
  dynamics::Planar friction;        ///< of the present step: what slip gave of the impulse [N s, N m s]
  int contacts = 0;                 ///< at the last step
};

/// What the ice that goes under its hull and lies there does to a ship.
struct SubmergedLoads {
  dynamics::Planar impulse;  ///< of cusps that are pushed down, and of what lies under the hull [N s, N m s]
  double area = 0;           ///< of the ice under the hull, at the last step [m²]
};

/// Sums over a step or a recording interval, in the ship's frame.
struct HullLoads {
  ContactLoads ice;
  ContactLoads hulls;  ///< of other ships, structures and walls
  SubmergedLoads submerged;
  dynamics::Planar collision;  ///< the paper's j/τ_c of contacts with ice, component by component [N, N m]
};

/// What moves a ship that sails, beside ice and other ships. Over a recording interval, in the ship's frame.
struct SailingLoads {
  dynamics::Planar water;         ///< on the hull, the inertia of the water with it [N s, N m s]
  dynamics::Planar engine;        ///< [N s, N m s]
  dynamics::Planar rudder;        ///< [N s, N m s]
  dynamics::Planar mooring;       ///< [N s, N m s]
  dynamics::Planar ice_friction;  ///< of the contacts with ice, their slip [N s, N m s]
};

/// How a hull pushes the edge of a cusp that it breaks off.
struct EdgePush {
  double speed = 0;               ///< down, that the edge does not have when it breaks; 0 where nothing is pushed [m/s]
  double speed_per_approach = 0;  ///< of it by the hull's own along the contact's normal [-]
  geometry::Vector horizontal;    ///< force on the ice per force down on it [-]
  double hull_angle = 0;          ///< θ_s, of the hull there from the vertical [rad]
};

/// A fracture decided in this step, to be applied at its end.
struct PendingFracture {
  fracture::Failure failure = fracture::Failure::kNone;
  int ship = 0;              ///< that breaks it; -1 where a floe does
  FloeId by_floe = kNoFloe;  ///< that breaks it
  FloeId floe = 0;
  geometry::Point point_in_water;       ///< contact point [m]
  geometry::Point first_touch_in_body;  ///< of the floe: the cusp's centre [m]
  geometry::Vector normal;              ///< from the hull into the ice, water frame
  double penetration = 0;               ///< [m]
  double cusp_radius = 0;               ///< [m]
  EdgePush push;                        ///< of a bend by the law of crushing ice
  bool passes_to_pieces = false;        ///< where its floe bends at another place in the step, it breaks a piece
  geometry::CrackPath crack_in_body;    ///< of a split
  fracture::FailureCriteria criteria;
  dynamics::PersistentContact* record = nullptr;  ///< of the contact that broke it, valid during the step
};

/// The hull at one of its contacts.
struct HullSlope {
  double vertical_share = 0;  ///< V/H, down on the ice; ≤ 0 where it is too steep to press ice down
  double tangent = 0;         ///< tan θ_s
  /// Of what the overlap grows in the step [-]; with the rest the ice edge gave way: it bent or tilted down.
  double crushed_share = 1;
  double height = 0;  ///< of the ice that the hull presses on [m]
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

/// The motion of the bodies of one contact and its memory before the step is solved: what solving changes.
struct SolverStart {
  geometry::Vector velocity[2];         ///< [m/s]
  double angular_velocity[2] = {0, 0};  ///< [rad/s]
  double last_impulse[2] = {0, 0};      ///< [N s]
  double last_slip_impulse = 0;         ///< [N s]
  double loaded_depth = 0;              ///< [m]
};

/// The results of the stages of one step. Between two steps they are those of the last one.
struct StepData {
  std::vector<dynamics::Contact> contacts;
  std::vector<dynamics::BlindOverlap> blind_overlaps;
  std::vector<dynamics::PartedContact> parted;
  std::vector<HullSlope> slopes;  ///< of the contacts of hulls, which come first
  std::vector<PendingFracture> fractures;
  std::vector<PendingFracture> splits;  ///< by the true forces of the step
  std::vector<PendingSubmersion> submersions;
  std::vector<Event> mooring_breaks;                  ///< to be recorded after what happens to ice
  std::vector<HullLoads> loads;                       ///< per hull
  std::vector<ShipMotion> start;                      ///< per ship: its motion before the step's impulses
  std::vector<geometry::Pose> water_from_hull;        ///< per hull: where it was when the contacts were found
  dynamics::ContactSolver solver;                     ///< its reusable memory
  std::unordered_map<FloeId, BeamShape> beam_shapes;  ///< of slender floes that forces may break, once they may
  std::vector<SolverStart> solver_start;              ///< per contact, where splits by the true forces are found
};

/// What has happened so far, in sums.
struct Accounts {
  IceLedger areas;   ///< without what there is at the moment: floes and what is under hulls
  IceLedger masses;  ///< likewise
  AuditSums audit;
  Counts counts;
  std::vector<HullLoads> loads;       ///< per hull, since the last sample
  std::vector<SailingLoads> sailing;  ///< per ship, since the last sample
  std::vector<Event> hull_contacts;   ///< the first one of each pair of hulls
  LoadPeaks load_peaks;
  std::vector<HullPanels> panels;                                     ///< per hull, since the last sample
  std::vector<std::pair<std::int64_t, std::int64_t>> refused_grinds;  ///< bodies that geometry refused to cut
  std::int64_t sampled_at = 0;                                        ///< the tick of the last sample
};

/// What the ticks so far tell about the parts that the next one needs (parts.hpp).
struct Pace {
  int finer = 1;     ///< factor on the number of parts, a power of 2
  double bends = 0;  ///< bends in a step, a running mean over some eight ticks
};

/// What a new world has in it.
enum class Start {
  kScene,  ///< the scene's hulls and floes
  kEmpty,  ///< nothing: a saved state is to be loaded (state.hpp)
};

/// Everything a run is made of. Each stage of step.hpp takes of it what it reads and what it changes.
struct World {
  explicit World(Scene scene, Shortcuts shortcuts = {}, Start start = Start::kScene);

  std::vector<FloeSpec> floes_at_start;  ///< the scene's, until the population has them
  const Setup setup;                     ///< its scene has no floes
  int threads = 1;                       ///< to step with; results do not depend on it
  Clock clock;
  Population population;
  Pace pace;
  Step last_step;  ///< the one taken last; the data are of it
  StepData data;
  Accounts accounts;
  Journal journal;
  std::vector<ExternalPilot> pilots;   ///< per ship, those that take the place of the scene's; or fewer
  std::optional<std::string> failure;  ///< why the run cannot continue
};

/// Where all the ice of a world is at the moment and went.
IceLedger area_ledger(const World& world);
IceLedger mass_ledger(const World& world);

}  // namespace polynya::simulation
