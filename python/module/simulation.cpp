#include "python/module/simulation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "io/run/checkpoint.hpp"
#include "io/run/event_records.hpp"
#include "io/run/run_loop.hpp"
#include "simulation/world/world.hpp"

namespace polynya::python {
namespace {

using Clock = std::chrono::steady_clock;

/// Longest delay of Ctrl-C, and time between two reports of progress.
constexpr auto kBetweenReports = std::chrono::milliseconds(50);
constexpr double kMostSteps = 1e15;  ///< largest number of ticks of one call; larger numbers are refused

int checked_threads(int threads) {
  if (threads < 1 || threads > 1024)
    throw py::value_error(fmt::format("threads: found {}, allowed: 1 to 1024", threads));
  return threads;
}

simulation::Simulation start(const io::LoadedScene& loaded) {
  const py::gil_scoped_release release;
  return simulation::Simulation(loaded.scene);
}

simulation::Simulation resumed(const io::LoadedScene& loaded, const std::string& bytes) {
  const auto checkpoint = io::read_checkpoint(bytes);
  if (!checkpoint) throw py::value_error("cannot resume: " + checkpoint.error());
  if (checkpoint->course_hash != loaded.course_hash) throw py::value_error("cannot resume: saved of another scene");
  auto simulation = io::simulation_at(loaded, *checkpoint);
  if (!simulation) throw py::value_error("cannot resume: " + simulation.error());
  return *std::move(simulation);
}

/// Raises KeyboardInterrupt after Ctrl-C, and reports progress.
void report(const py::object& progress, double time) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!progress.is_none()) progress(time);
}

}  // namespace

/// Marks a simulation as being stepped. It must be created and destroyed with the GIL held.
class Simulation::Stepping {
 public:
  explicit Stepping(Simulation& simulation) : simulation_(simulation) { simulation.is_stepping_ = true; }
  ~Stepping() { simulation_.is_stepping_ = false; }
  Stepping(const Stepping&) = delete;
  Stepping& operator=(const Stepping&) = delete;

 private:
  Simulation& simulation_;
};

Simulation::Simulation(const std::shared_ptr<Scene>& scene, int threads)
    : Simulation(scene, start(scene->loaded()), threads) {}

Simulation::Simulation(std::shared_ptr<Scene> scene, simulation::Simulation simulation, int threads)
    : scene_(std::move(scene)),
      simulation_(std::move(simulation)),
      samples_(hull_count(scene_->loaded().scene)),
      pilots_(samples_.size(), py::none()) {
  simulation_.set_threads(checked_threads(threads));
  simulation_.journal().clear();
}

std::unique_ptr<Simulation> Simulation::resume(std::shared_ptr<Scene> scene, const py::bytes& bytes, int threads) {
  simulation::Simulation simulation = resumed(scene->loaded(), bytes);
  return std::unique_ptr<Simulation>(new Simulation(std::move(scene), std::move(simulation), threads));
}

const simulation::Simulation& Simulation::between_steps() const {
  if (is_broken_)
    throw std::runtime_error("an earlier error left a step of this simulation unfinished; resume a saved one");
  if (!is_pilot_asked_) refuse_while_stepping();
  return simulation_;
}

const simulation::Simulation& Simulation::at_rest() const {
  refuse_while_stepping();
  return between_steps();
}

void Simulation::refuse_while_viewed() const {
  if (readers_ > 0) throw std::runtime_error("another thread reads this simulation; wait for it");
  if (*views_ > 0)
    throw py::buffer_error(
        fmt::format("{} arrays of floe_memory live: a step would move what they show; delete them, or copy "
                    "what is to last",
                    *views_));
}

void Simulation::refuse_while_stepping() const {
  if (is_stepping_) throw std::runtime_error("this simulation is being stepped; wait for its step() or run()");
}

void Simulation::take_journal() {
  simulation::Journal& journal = simulation_.journal();
  const simulation::Scene& scene = simulation_.scene();
  const auto& floes = simulation_.world().population.floes;
  for (const simulation::Event& event : journal.events) {
    const simulation::IceEvent* ice = event.ice();
    io::append_event(events_, event, scene, ice ? floes[ice->floe].parent : simulation::kNoFloe);
    events_.back() = ',';  // replaces the line break
  }
  for (const simulation::HullSample& sample : journal.samples) samples_[sample.ship] = sample;
  if (recording_)
    recording_->take_step();
  else
    journal.clear();
}

void Simulation::step_once() {
  try {
    simulation_.step();
    take_journal();
  } catch (...) {  // memory ran out
    is_broken_ = true;
    throw;
  }
}

void Simulation::raise_failure() {
  if (const auto failure = simulation_.numerical_failure())
    raise("SimulationError", py::str(fmt::format("numerical failure at {:.6g} s: {}", simulation_.time(), *failure)));
}

void Simulation::advance_to(std::int64_t last_step, const py::object& progress) {
  at_rest();
  refuse_while_viewed();
  raise_failure();
  const Stepping stepping(*this);
  {
    const py::gil_scoped_release release;
    auto last_report = Clock::now();
    while (simulation_.steps() < last_step && !simulation_.numerical_failure()) {
      step_once();
      if (pilot_error_ || (recording_ && recording_->failure())) break;
      if (const auto now = Clock::now(); now - last_report >= kBetweenReports) {
        last_report = now;
        const py::gil_scoped_acquire acquire;
        report(progress, simulation_.time());
      }
    }
  }
  if (pilot_error_) std::rethrow_exception(std::exchange(pilot_error_, nullptr));
  if (recording_ && recording_->failure()) raise("FolderError", py::str(*recording_->failure()));
  raise_failure();
}

void Simulation::step(std::int64_t count) {
  if (count < 0) throw py::value_error(fmt::format("step: found {} steps, allowed: 0 or more", count));
  const std::int64_t done = between_steps().steps();
  if (static_cast<double>(done) + static_cast<double>(count) > kMostSteps)
    throw py::value_error(fmt::format("step: found {} steps, allowed: at most {}", count, kMostSteps));
  advance_to(done + count, py::none());
}

void Simulation::run(std::optional<double> until, const py::object& progress) {
  if (!progress.is_none() && !PyCallable_Check(progress.ptr()))
    throw py::type_error("run: progress is a callable that takes the time [s], or None");
  const simulation::StepSettings& time = between_steps().scene().time;
  const double steps = std::ceil(until.value_or(time.until) / time.step - 1e-9);
  if (!(std::abs(steps) <= kMostSteps))
    throw py::value_error(fmt::format("run: until is {} s, allowed: a finite time of at most {} steps",
                                      until.value_or(time.until), kMostSteps));
  until_ = until.value_or(time.until);
  advance_to(static_cast<std::int64_t>(steps), progress);
  report(progress, simulation_.time());
}

py::list Simulation::events() {
  between_steps();
  std::string text = "[" + std::exchange(events_, {});
  if (text.size() > 1) text.pop_back();
  return py::module_::import("json").attr("loads")(text + "]");
}

py::bytes Simulation::save() const {
  refuse_while_stepping();  // refuses pilots too, because ships before theirs have already moved their levers
  return py::bytes(io::checkpoint_bytes(io::checkpoint_of(between_steps(), scene(), {}, 0)));
}

void Simulation::record(const std::string& folder, bool overwrite) {
  at_rest();
  if (recording_) throw std::runtime_error("record: this simulation is recorded already");
  if (simulation_.steps() > 0)
    throw std::runtime_error("record: the simulation has been stepped; a run folder begins before the first step");
  recording_ = std::make_unique<Recording>(scene(), simulation_, folder, overwrite);
}

void Simulation::end_recording(const std::string& stopped_by) {
  const std::unique_ptr<Recording> recording = std::move(recording_);
  if (!recording) return;
  const simulation::Simulation& here = at_rest();
  // Keeps the end as it was given if the run has reached exactly that end.
  simulation::StepSettings time = scene().scene.time;
  for (const double until : {time.until, until_, here.time()}) {
    time.until = until;
    if (io::last_step_of(time) == here.steps()) break;
  }
  const bool is_at_start = here.steps() == 0 && stopped_by.empty();
  recording->end(time.until, is_at_start ? "closed before the first step" : stopped_by);
}

std::size_t Simulation::index_of(const py::object& ship, const char* caller) const {
  const auto count = static_cast<std::int64_t>(hull_count(simulation_.scene()));
  if (py::isinstance<py::int_>(ship)) {
    const auto index = ship.cast<std::int64_t>();
    if (index < 0 || index >= count)
      throw py::index_error(fmt::format("ship {}: the scene has {} ships and structures", index, count));
    return static_cast<std::size_t>(index);
  }
  if (!py::isinstance<py::str>(ship)) throw py::type_error(fmt::format("{}: a ship is an index or a name", caller));
  const auto name = ship.cast<std::string>();
  const int found = hull_named(simulation_.scene(), name);
  if (found < 0) throw py::value_error(fmt::format("the scene has no ship named \"{}\"", name));
  return static_cast<std::size_t>(found);
}

std::size_t Simulation::commanded_ship(const py::object& ship, const char* caller) const {
  refuse_while_stepping();
  const std::size_t index = index_of(ship, caller);
  const auto& ships = simulation_.scene().ships;
  if (index >= ships.size() || !std::holds_alternative<simulation::Engine>(ships[index].propulsion))
    throw py::value_error(fmt::format("ship \"{}\" has no engine to command: give it propulsion.engine (docs/scene.md)",
                                      hull_of(simulation_.scene(), index).name));
  return index;
}

void Simulation::set_command(const py::object& ship, double lever, double steering_share) {
  const std::size_t index = commanded_ship(ship, "set_command");
  if (!std::isfinite(lever) || !std::isfinite(steering_share))
    throw py::value_error(
        fmt::format("set_command: lever {} and steering {}, allowed: finite numbers", lever, steering_share));
  commands_.resize(pilots_.size());
  commands_[index] = {lever, steering_share};
  pilots_[index] = py::none();
  simulation_.set_pilot(static_cast<int>(index), [this, index](const simulation::PilotView& view) {
    return simulation::Command{commands_[index].lever, commands_[index].steering_angle * view.steering_most};
  });
}

void Simulation::set_pilot(const py::object& ship, const py::object& pilot) {
  const std::size_t index = commanded_ship(ship, "set_pilot");
  if (!pilot.is_none() && !PyCallable_Check(pilot.ptr()))
    throw py::type_error("set_pilot: a pilot is a callable that takes a PilotView, or None");
  pilots_[index] = pilot;
  simulation::ExternalPilot external;
  if (!pilot.is_none()) external = [this, index](const simulation::PilotView& view) { return command_of(index, view); };
  simulation_.set_pilot(static_cast<int>(index), std::move(external));
}

/// Asks the pilot of a ship. Its exception ends the stepping after this step. The step itself is completed, with lever
/// and steering unchanged.
simulation::Command Simulation::command_of(std::size_t ship, const simulation::PilotView& view) {
  simulation::Command command{view.lever, view.steering_angle};
  if (pilot_error_) return command;
  const py::gil_scoped_acquire acquire;
  is_pilot_asked_ = true;
  try {
    command = ask(pilots_[ship], view);
  } catch (...) {
    pilot_error_ = std::current_exception();
  }
  is_pilot_asked_ = false;
  return command;
}

}  // namespace polynya::python
