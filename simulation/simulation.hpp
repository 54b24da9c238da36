#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/shape/pose.hpp"
#include "simulation/ship/pilot.hpp"
#include "simulation/world/energy.hpp"
#include "simulation/world/journal.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::dynamics {
class ThreadLimit;
}

namespace polynya::simulation {

struct World;

/// Where one floe is that has not broken. Frames and pictures are made of these.
struct FloeState {
  FloeId floe = 0;
  FloeId parent = kNoFloe;
  double born = 0;  ///< [s]
  int generation = 0;
  geometry::Pose world_from_body;
  double angle = 0;                                    ///< of world_from_body [rad]
  geometry::Vector velocity;                           ///< of the centre of mass over ground [m/s]
  double angular_velocity = 0;                         ///< [rad/s]
  double area = 0;                                     ///< [m²]
  double mass = 0;                                     ///< [kg]
  bool is_fast = false;                                ///< held at its velocity
  std::string_view under_hull_of;                      ///< of scenes that go on from a run: the ship's name, or none
  double under_path = 0;                               ///< then how far that ship has come over it [m]
  const fracture::Ice* ice = nullptr;                  ///< valid as long as the simulation
  const geometry::Polygon* polygon_in_body = nullptr;  ///< valid as long as the floe
};

/// Which of the floes that have not broken.
enum class Living {
  kFloating,
  kAll,  ///< also those under hulls
};

struct HullState {
  geometry::Pose world_from_ship;
  double heading = 0;           ///< [rad]
  geometry::Vector velocity;    ///< over ground [m/s]
  double angular_velocity = 0;  ///< [rad/s]
};

/// Two bodies with an overlap: ice that was crushed there or gave way, and ice that is not paid yet.
struct CrushedOverlap {
  ContactState::Body on;
  ContactState::Body by;
  double area = 0;    ///< crushed [m²]
  double share = 0;   ///< the whole overlap as a fraction of the smaller of the two bodies
  double tilted = 0;  ///< where the ice edge tilted or bent down under a hull [m²]
  double unpaid = 0;  ///< in contact and not paid: it presses the two bodies apart [m²]
  double volume = 0;  ///< of the ice that the work crushed; under an inclined hull a wedge of the area's [m³]
  double work = 0;    ///< that crushed it, friction aside [J]
};

/// A run in progress: the scene's world, stepped.
class Simulation {
 public:
  explicit Simulation(Scene scene, Shortcuts shortcuts = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Continues from the state() of a run of the same scene. The error states what is wrong with the bytes.
  static tl::expected<Simulation, std::string> resumed(Scene scene, std::string_view state);

  /// All that decides how the run continues, beside the scene. Taken between steps, after the journal.
  std::string state() const;
  /// A hash of it, the same wherever the same bits were computed (docs/reliability.md).
  std::uint64_t state_hash() const;

  /// The number of threads to step on from now on. Results do not depend on it.
  void set_threads(int threads);

  /// Puts a pilot from outside in the place of a ship's own; none gives the ship back to its own. What an
  /// outside pilot remembers is not in state().
  void set_pilot(int ship, ExternalPilot pilot);

  /// Sets the force and moment from outside on a ship, in its frame, until they are set again [N, N m]. They add to the
  /// ship's own propulsion. They are not in state(). A ship of prescribed motion ignores them.
  void set_external_force(int ship, dynamics::Planar force);

  /// Sets the motion of a ship of prescribed motion (ConstantSpeed) from now on: velocity over ground [m/s] and yaw
  /// rate [rad/s]. The motion is in state(). Throws std::invalid_argument for a ship whose motion is not prescribed.
  void set_prescribed_motion(int ship, geometry::Vector velocity, double yaw_rate);

  /// Appends the loads since the last sample to journal(), as is also done at each RecordSettings::forces_interval.
  /// There must have been a tick since.
  void sample_loads();

  /// Advances the run by one tick. Appends what happened in it to journal().
  void step();

  /// Why the run cannot continue (NaN, runaway speed); checked every step.
  std::optional<std::string> numerical_failure() const;

  double time() const;         ///< [s]
  std::int64_t steps() const;  ///< ticks so far
  const Scene& scene() const;  ///< without its floes: the simulation has taken them
  Journal& journal();
  IceLedger area_ledger() const;
  IceLedger mass_ledger() const;
  Audit audit() const;  ///< of energy and momentum
  Counts counts() const;
  std::vector<FloeState> floe_states(Living which = Living::kFloating) const;  ///< in id order
  /// Calls use(state) for each of floe_states(), one at a time: all of a million floes' take 140 MB.
  void for_each_floe(Living which, const std::function<void(const FloeState&)>& use) const;
  std::vector<HullState> ship_states() const;
  /// Those contacts of the last step that the scene has recorded, ships' first, in the order of their
  /// bodies. None before the first step and right after a resume.
  std::vector<ContactState> contact_states() const;
  /// Those of a ship or structure with a floe first, in the order of their bodies.
  std::vector<CrushedOverlap> crushed_overlaps() const;
  const World& world() const;

 private:
  explicit Simulation(std::unique_ptr<World> world);
  std::unique_ptr<World> world_;
  std::unique_ptr<dynamics::ThreadLimit> thread_limit_;
};

}  // namespace polynya::simulation
