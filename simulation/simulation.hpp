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

/// State of one floe that has not broken. Frames and pictures are made from these states.
struct FloeState {
  FloeId floe = 0;
  FloeId parent = kNoFloe;
  double born = 0;  ///< time of creation [s]
  int generation = 0;
  geometry::Pose world_from_body;
  double angle = 0;             ///< angle of world_from_body [rad]
  geometry::Vector velocity;    ///< velocity of the centre of mass over ground [m/s]
  double angular_velocity = 0;  ///< [rad/s]
  double area = 0;              ///< area in plan [m²]
  double mass = 0;              ///< [kg]
  bool is_fast = false;         ///< true for fast ice, whose motion is prescribed
  /// Name of the ship under whose hull the floe is; only set when a run is exported as a scene.
  std::string_view under_hull_of;
  double under_path = 0;               ///< distance that this ship has moved over the floe; likewise [m]
  const fracture::Ice* ice = nullptr;  ///< ice of the floe; valid as long as the simulation exists
  const geometry::Polygon* polygon_in_body = nullptr;  ///< outline; valid as long as the floe exists [m]
};

/// Selection among the floes that have not broken.
enum class Living {
  kFloating,
  kAll,  ///< floating floes and pieces under hulls
};

/// Position and motion of a hull.
struct HullState {
  geometry::Pose world_from_ship;
  double heading = 0;           ///< heading, counter-clockwise from the x axis [rad]
  geometry::Vector velocity;    ///< velocity over ground [m/s]
  double angular_velocity = 0;  ///< [rad/s]
};

/// The overlap of two bodies: ice that was crushed there or gave way, and overlap that is not paid yet.
struct CrushedOverlap {
  ContactState::Body on;
  ContactState::Body by;
  double area = 0;    ///< area of ice that was crushed [m²]
  double share = 0;   ///< whole overlap / area of the smaller of the two bodies [-]
  double tilted = 0;  ///< area where the ice edge tilted or bent down under a hull [m²]
  double unpaid = 0;  ///< area that is not paid and presses the two bodies apart [m²]
  double volume = 0;  ///< volume of the crushed ice; under an inclined hull it is a wedge [m³]
  double work = 0;    ///< work that crushed it, without friction [J]
};

/// A run in progress.
class Simulation {
 public:
  /// Starts a run of a scene, which must be valid (io/scene checks scenes).
  explicit Simulation(Scene scene, Shortcuts shortcuts = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Continues from the state() of a run of the same scene. On failure the error states what is wrong with the bytes.
  static tl::expected<Simulation, std::string> resumed(Scene scene, std::string_view state);

  /// Returns all data that decide how the run continues, except for the scene. Must be called between steps, after the
  /// journal was written.
  std::string state() const;
  /// Returns a hash of the state. It is the same on every machine on which the run computed the same bits
  /// (docs/reliability.md).
  std::uint64_t state_hash() const;

  /// Sets the number of threads for the next steps. Results do not depend on it.
  void set_threads(int threads);

  /// Replaces a ship's own pilot by one from outside. An empty pilot gives the ship back to its own. The memory of an
  /// outside pilot is not in state(). Throws std::out_of_range if there is no such ship.
  void set_pilot(int ship, ExternalPilot pilot);

  /// Sets the force and moment from outside on a ship, in its frame, until they are set again [N, N m]. They add to the
  /// ship's own propulsion. They are not in state(). A ship of prescribed motion ignores them.
  void set_external_force(int ship, dynamics::Planar force);

  /// Sets the motion of a ship of prescribed motion (ConstantSpeed) from now on: velocity over ground [m/s] and yaw
  /// rate [rad/s]. The motion is in state(). Throws std::invalid_argument for a ship whose motion is not prescribed.
  void set_prescribed_motion(int ship, geometry::Vector velocity, double yaw_rate);

  /// Appends the mean loads since the last sample to journal(), as is also done at each
  /// RecordSettings::forces_interval. At least one tick must have passed since then.
  void sample_loads();

  /// Advances the run by one tick and appends the events, births, deaths and samples of the tick to journal().
  void step();

  /// Returns why the run cannot continue: a speed that is not finite or above kRunawaySpeed, or an overload. Returns
  /// nullopt if the run can continue. It is checked in every step.
  std::optional<std::string> numerical_failure() const;

  double time() const;         ///< time that the run has reached [s]
  std::int64_t steps() const;  ///< number of ticks so far
  const Scene& scene() const;  ///< scene without its floes, which the simulation has taken over
  Journal& journal();
  IceLedger area_ledger() const;
  IceLedger mass_ledger() const;
  Audit audit() const;  ///< balance of energy and momentum
  Counts counts() const;
  std::vector<FloeState> floe_states(Living which = Living::kFloating) const;  ///< states in the order of floe ids
  /// Calls use(state) for each of floe_states(), one at a time. The states of a million floes together would take 140
  /// MB.
  void for_each_floe(Living which, const std::function<void(const FloeState&)>& use) const;
  std::vector<HullState> ship_states() const;
  /// Returns the contacts of the last step that the scene records (RecordSettings::contacts), those of hulls first, in
  /// the order of their bodies. Returns none before the first step and directly after a resume.
  std::vector<ContactState> contact_states() const;
  /// Returns the overlaps of all pairs, those of hulls first, in the order of their bodies.
  std::vector<CrushedOverlap> crushed_overlaps() const;
  const World& world() const;

 private:
  explicit Simulation(std::unique_ptr<World> world);
  std::unique_ptr<World> world_;
  std::unique_ptr<dynamics::ThreadLimit> thread_limit_;
};

}  // namespace polynya::simulation
