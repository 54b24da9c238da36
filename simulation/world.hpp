#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/impulse_solver.hpp"
#include "dynamics/pairs.hpp"
#include "dynamics/separation.hpp"
#include "dynamics/water_drag.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/decision.hpp"
#include "geometry/contact/crack_path.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/energy.hpp"
#include "simulation/journal.hpp"
#include "simulation/scene.hpp"

namespace polynya::simulation {

using dynamics::BodyIndex;

/// A floe's cold data. Its body is at index ships + floe id; both are never reused.
struct Floe {
  FloeId parent = kNoFloe;
  double born = 0;        ///< [s]
  int generation = 0;     ///< fractures since the scene's floe
  double area = 0;        ///< [m²]
  geometry::Shape shape;  ///< body frame: the scene's coordinates of its oldest ancestor; empty once it broke
};

/// What one kind of contact does to a ship over a recording interval, in the ship's frame.
struct ContactLoads {
  geometry::Vector impulse;    ///< on the ship [N s]
  double angular_impulse = 0;  ///< [N m s]
  geometry::Vector largest;    ///< single-step true force, component by component [N]
  double largest_moment = 0;   ///< [N m]
  int contacts = 0;            ///< at the last step
};

/// Sums over a recording interval, in the ship's frame.
struct ShipLoads {
  ContactLoads ice;
  ContactLoads ships;      ///< other ships and structures
  geometry::Vector peak;   ///< the paper's j/τ_c of contacts with ice, component by component [N]
  double peak_moment = 0;  ///< [N m]
};

/// A fracture decided in this step, to be applied at its end.
struct PendingFracture {
  fracture::Failure failure = fracture::Failure::kNone;
  int ship = 0;
  FloeId floe = 0;
  geometry::Point point_in_water;       ///< contact point [m]
  geometry::Point first_touch_in_body;  ///< of the floe: the cusp's centre [m]
  geometry::Vector normal;              ///< from the hull into the ice, water frame
  double penetration = 0;               ///< [m]
  double cusp_radius = 0;               ///< [m]
  geometry::CrackPath crack_in_body;    ///< of a split
  fracture::FailureCriteria criteria;
  dynamics::PersistentContact* record = nullptr;  ///< of the contact that broke it, valid during the step
};

/// What a new world has in it.
enum class Population {
  kScene,  ///< the scene's ships and floes
  kNone,   ///< nothing: a saved state is to be loaded (state.hpp)
};

/// Everything a run is made of. The stages of step.hpp work on it.
struct World {
  explicit World(Scene scene_of_run, Shortcuts shortcuts_of_run = {},
                 Population population = Population::kScene);

  Scene scene;
  int threads = 1;  ///< to step with; results do not depend on it
  Shortcuts shortcuts;
  std::unique_ptr<fracture::BendingModel> bending;
  double breakable_size = 0;       ///< κ l [m]
  dynamics::ShearCurrent current;  ///< in the water frame

  dynamics::Bodies bodies;  ///< the ships first, then floes by id
  std::vector<Floe> floes;  ///< by id
  std::vector<BodyIndex> awake;
  dynamics::BroadPhase pairs;
  dynamics::ImpulseSolver solver;
  dynamics::SolverSettings solver_settings;
  dynamics::SeparationSettings separation_settings;

  std::vector<dynamics::Contact> contacts;    ///< of the present step
  std::vector<PendingFracture> fractures;     ///< of the present step
  std::vector<ShipLoads> loads;               ///< per ship, since the last sample
  std::vector<ShipLoads> step_loads;          ///< per ship, of the present step
  std::vector<ShipContact> ship_contacts;     ///< the first one of each pair of ships so far
  std::vector<std::int64_t> touched_at_step;  ///< per body: the last step at which it touched something
  std::int64_t steps_per_sample = 1;

  std::int64_t steps = 0;
  Journal journal;
  AreaLedger ledger;  ///< initial, submerged, brash, rounding; the rest is derived
  AuditSums audit;
  Counts counts;
  std::optional<std::string> failure;

  int ship_count() const { return static_cast<int>(scene.ships.size()); }
  double time() const { return static_cast<double>(steps) * scene.time.step; }
  bool is_ship(BodyIndex body) const { return body < ship_count(); }
  BodyIndex body_of(FloeId floe) const { return static_cast<BodyIndex>(floe) + ship_count(); }
  FloeId floe_of(BodyIndex body) const { return body - ship_count(); }
  bool is_alive(FloeId floe) const { return bodies.is_alive[body_of(floe)] != 0; }
  /// Would a body at rest in the water frame stay there, as far as the water goes? A sheared current carries
  /// it off.
  bool is_current_still_at(BodyIndex body) const;
  geometry::Vector drift() const {
    return time() * scene.water.drift;
  }  ///< of the water frame over ground [m]
};

/// What a floe is when it comes to be; the world gives it an id and a body.
struct NewFloe {
  geometry::Shape shape;
  FloeId parent = kNoFloe;
  int generation = 0;
  geometry::Pose water_from_body;
  double angle = 0;             ///< of water_from_body [rad]
  geometry::Vector velocity;    ///< of the body frame's origin relative to the water [m/s]
  double angular_velocity = 0;  ///< [rad/s]
};

/// Takes a floe of these measures into the world, at rest or moving as a part of a rigid body whose frame is
/// the floe's; writes its birth.
FloeId add_floe(World& world, const NewFloe& floe, const geometry::Measures& measures);

/// What a scene's sheared current is to the water drag.
dynamics::ShearCurrent current_of(const ShearSettings& shear);

/// The body of a ship where the scene has it, and that of a floe of such a shape and its measures, wherever
/// it is.
dynamics::NewBody new_body_of(const World& world, const ShipSpec& ship);
dynamics::NewBody new_body_of(const World& world, const geometry::Polygon& polygon_in_body,
                              const geometry::Measures& measures);

/// The water is to hold a floe back from now on.
void give_drag(World& world, BodyIndex body);

/// Takes a floe out of the world.
void retire_floe(World& world, FloeId floe);

void wake(World& world, BodyIndex body);

/// Floes slower than this, all their points included, that touch nothing are at rest with the water [m/s].
/// Quadratic drag alone never brings anything to rest.
inline constexpr double kRestSpeed = 1e-4;

}  // namespace polynya::simulation
