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
  /// Continues from the bytes of save(). Raises ValueError if they do not belong to the scene.
  static std::unique_ptr<Simulation> resume(std::shared_ptr<Scene> scene, const py::bytes& bytes, int threads);

  void step(std::int64_t count);
  /// Steps to a time [s], or to the scene's end if none is given. `progress` is None or a callable.
  void run(std::optional<double> until, const py::object& progress);
  py::list events();
  py::bytes save() const;
  /// Writes a run folder (Recording) from the start of the run until end_recording(). That takes a reason if the run is
  /// stopped before its end.
  void record(const std::string& folder, bool overwrite);
  void end_recording(const std::string& stopped_by);
  /// Replaces the pilot of a ship by a callable; None restores the ship's own pilot. `ship` is an index or a name.
  void set_pilot(const py::object& ship, const py::object& pilot);
  /// Gives a ship a command that it follows from now on instead of its pilot's: the lever, and the steering angle as a
  /// fraction of the largest. The command is read without Python, so that stepping does not need the GIL.
  void set_command(const py::object& ship, double lever, double steering_share);
  /// Objects that Python's garbage collector visits and clears.
  std::vector<py::object>& pilots() { return pilots_; }

  /// Returns the simulation for reading between two steps or before the first one. Raises RuntimeError while it is
  /// being stepped. Its pilots may read it, because they are asked before anything moves.
  const simulation::Simulation& between_steps() const;
  /// The same, but refuses pilots too: for reading as long as views() is not 0.
  const simulation::Simulation& at_rest() const;
  /// Number of existing arrays that share the simulation's memory (FloeMemory). The simulation cannot be stepped while
  /// there are any.
  const std::shared_ptr<std::int64_t>& views() const { return views_; }
  /// Marks the simulation as being read without the GIL as long as this object exists; it cannot be stepped meanwhile.
  /// It must be created and destroyed with the GIL held.
  class Reading {
   public:
    explicit Reading(const Simulation& simulation) : readers_(simulation.readers_) { ++readers_; }
    ~Reading() { --readers_; }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

   private:
    int& readers_;
  };
  /// Returns the index of a ship given by index or name. `caller` is named in the exception.
  std::size_t index_of(const py::object& ship, const char* caller) const;
  /// The last recorded row of a ship; nothing before the first one.
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
  double until_ = 0;    ///< end that run() was asked for last [s]
  std::string events_;  ///< events since the last call of events(): JSON objects, each followed by a comma
  std::vector<std::optional<simulation::HullSample>> samples_;  ///< per ship
  std::vector<py::object> pilots_;                              ///< per ship; None: the ship's own pilot
  std::vector<simulation::Command> commands_;  ///< per ship: the command of set_command(), with the angle as a fraction
  std::exception_ptr pilot_error_;             ///< raised by a pilot in a step; it is raised again after the step
  std::shared_ptr<std::int64_t> views_ = std::make_shared<std::int64_t>(0);
  mutable int readers_ = 0;  ///< number of calls that read the simulation without the GIL
  bool is_stepping_ = false;
  bool is_pilot_asked_ = false;
  bool is_broken_ = false;  ///< an exception interrupted a step
};

void bind_simulation(py::module_& module);
/// Binds Ship and Floes, and the properties of a simulation that return them.
void bind_arrays(py::module_& module, py::class_<Simulation>& simulation);
/// Binds FloeMemory, which gives access to the floes without a copy.
void bind_floe_memory(py::module_& module, py::class_<Simulation>& simulation);
void bind_occupancy(py::class_<Simulation>& simulation);
/// Binds the method that returns the floes nearest to a ship as an array.
void bind_nearest_floes(py::class_<Simulation>& simulation);
void bind_cut(py::module_& module);

}  // namespace polynya::python
