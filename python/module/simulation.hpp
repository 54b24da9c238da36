#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/module/pilot.hpp"
#include "python/module/recording.hpp"
#include "python/module/scene.hpp"

#include "simulation/simulation.hpp"

namespace polynya::python {

/// A simulation owned by Python. Every method is called with the GIL held; steps release it.
class Simulation {
 public:
  Simulation(const std::shared_ptr<Scene>& scene, int threads);
  /// Continues from the bytes of save(). Raises ValueError where they do not fit.
  static std::unique_ptr<Simulation> resume(std::shared_ptr<Scene> scene, const py::bytes& bytes, int threads);

  void step(std::int64_t count);
  /// To a time [s], the scene's own end if none is given. `progress` is None or a callable.
  void run(std::optional<double> until, const py::object& progress);
  py::list events();
  py::bytes save() const;
  /// Writes a run folder from the start on (Recording), until end_recording(), which gives a reason if it is not the
  /// run's end.
  void record(const std::string& folder, bool overwrite);
  void end_recording(const std::string& stopped_by);
  /// Puts a callable in the place of a ship's own pilot; None gives the ship back to its own. The ship is an
  /// index or a name.
  void set_pilot(const py::object& ship, const py::object& pilot);
  /// Gives a ship a command that it follows from now on, in place of its pilot's: the lever, and the steering angle as
  /// a share of the largest. It is asked without Python, so that stepping does not take the GIL.
  void set_command(const py::object& ship, double lever, double steering_share);
  /// What Python's garbage collector follows and clears.
  std::vector<py::object>& pilots() { return pilots_; }

  /// The simulation between two steps or before one, to be read. Raises RuntimeError while it is stepped,
  /// but for its pilots, which are asked before anything moves.
  const simulation::Simulation& between_steps() const;
  /// The same, refused to pilots too: to be read as long as views() is not 0.
  const simulation::Simulation& at_rest() const;
  /// How many arrays on this simulation's own memory live (FloeMemory); it is not stepped meanwhile.
  const std::shared_ptr<std::int64_t>& views() const { return views_; }
  /// Marks the simulation as being read without the GIL as long as it lives; it is not stepped meanwhile. Made and
  /// ended with the GIL held.
  class Reading {
   public:
    explicit Reading(const Simulation& simulation) : readers_(simulation.readers_) { ++readers_; }
    ~Reading() { --readers_; }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    int& readers_;
  };
  /// Of a ship given by an index or a name; `caller` is named in what it raises.
  std::size_t index_of(const py::object& ship, const char* caller) const;
  /// The last recorded row of a ship; none before the first.
  const std::optional<simulation::HullSample>& last_sample(std::size_t ship) const { return samples_[ship]; }
  const io::LoadedScene& scene() const { return scene_->loaded(); }
  const std::shared_ptr<Scene>& given_scene() const { return scene_; }

 private:
  class Stepping;
  Simulation(std::shared_ptr<Scene> scene, simulation::Simulation simulation, int threads);
  void advance_to(std::int64_t last_step, const py::object& progress);
  void step_once();
  void refuse_while_stepping() const;
  void refuse_while_viewed() const;
  simulation::Command command_of(std::size_t ship, const simulation::PilotView& view);
  void take_journal();
  void raise_failure();
  std::size_t commanded_ship(const py::object& ship, const char* caller) const;

  std::shared_ptr<Scene> scene_;
  simulation::Simulation simulation_;
  std::unique_ptr<Recording> recording_;
  double until_ = 0;    ///< that run() was last asked for [s]
  std::string events_;  ///< since the last call of events(): JSON objects, a comma behind each
  std::vector<std::optional<simulation::HullSample>> samples_;  ///< per ship
  std::vector<py::object> pilots_;                              ///< per ship; None: its own
  std::vector<simulation::Command> commands_;                   ///< per ship: of set_command(), the angle as a share
  std::exception_ptr pilot_error_;                              ///< raised by one in a step, to be raised after it
  std::shared_ptr<std::int64_t> views_ = std::make_shared<std::int64_t>(0);
  mutable int readers_ = 0;  ///< number of calls that read the simulation without the GIL
  bool is_stepping_ = false;
  bool is_pilot_asked_ = false;
  bool is_broken_ = false;  ///< an exception left a step unfinished
};

void bind_simulation(py::module_& module);
/// Ship, Floes and how they are read from a simulation.
void bind_arrays(py::module_& module, py::class_<Simulation>& simulation);
/// FloeMemory: the floes without a copy.
void bind_floe_memory(py::module_& module, py::class_<Simulation>& simulation);
void bind_occupancy(py::class_<Simulation>& simulation);
/// The floes that are nearest to a ship, as an array.
void bind_nearest_floes(py::class_<Simulation>& simulation);
void bind_cut(py::module_& module);

}  // namespace polynya::python
