#include "cosim/unit/component.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cosim/model_description.hpp"
#include <fmt/format.h>

#include "io/text/problem.hpp"

namespace polynya::cosim {
namespace {

namespace fs = std::filesystem;

/// Rounding that a communication point or step may have, as a fraction of a tick [-]. Masters add up steps.
constexpr double kRounding = 1e-6;
constexpr double kMostTicks = 1e9;  ///< of a communication step

io::Result<std::string> scene_file_in(const std::string& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") return entry.path().string();
  return io::fail(fmt::format("no scene in the folder of resources {}", folder));
}

/// Problems of a scene in one text, a line each.
std::string lines_of(const std::vector<io::Problem>& problems) {
  std::string text;
  for (const io::Problem& problem : problems) text += (text.empty() ? "" : "\n") + to_string(problem);
  return text;
}

}  // namespace

Component::Component(std::string text, std::string file, io::LoadedScene scene)
    : text_(std::move(text)), file_(std::move(file)), interface_(interface_of(scene)) {
  reset();
}

io::Result<std::unique_ptr<Component>> Component::make(const std::string& resources, std::string_view guid) {
  const auto file = scene_file_in(resources);
  if (!file) return io::fail(file.error());
  auto text = io::read_text_file(*file, io::kLongestScene);
  if (!text) return io::fail(fmt::format("{}: {}", *file, text.error()));
  auto scene = io::read_scene(*text, *file, {});
  if (!scene) return io::fail(lines_of(scene.error()));
  const std::string own = guid_of(*scene, interface_of(*scene));
  if (own != guid) return io::fail(fmt::format("guid is {}, allowed: {}", guid, own));
  return std::unique_ptr<Component>(new Component(*std::move(text), *file, *std::move(scene)));
}

void Component::set_experiment(double start, std::optional<double> stop) {
  has_experiment_ = true;
  start_ = start;
  stop_ = stop;
}

void Component::set(std::size_t reference, double value) {
  const Variable& v = interface_.variables[reference];
  values_[reference] = value;
  if (v.causality != Causality::kParameter) return;
  is_parameter_set_[reference] = 1;
  run_.reset();
}

io::Result<io::LoadedScene> Component::scene_with_parameters() const {
  io::SceneOverrides overrides;
  for (std::size_t i = 0; i < interface_.parameters.size(); ++i) {
    const std::size_t at = interface_.first_parameter + i;
    if (is_parameter_set_[at] == 0) continue;
    const bool is_boolean = interface_.variables[at].type == VariableType::kBoolean;
    const std::string words = is_boolean ? fmt::format("{}={}", interface_.parameters[i].path, values_[at] != 0)
                                         : fmt::format("{}={}", interface_.parameters[i].path, values_[at]);
    auto assignment = io::parse_assignment(words, "parameter");
    if (!assignment) return io::fail(assignment.error());
    overrides.assignments.push_back(*std::move(assignment));
  }
  auto scene = io::read_scene(text_, file_, {}, overrides);
  if (!scene) return io::fail(lines_of(scene.error()));
  if (interface_of(*scene).variables.size() != interface_.variables.size())
    return io::fail("these parameters give the scene other variables than modelDescription.xml has");
  return *std::move(scene);
}

std::vector<Control> Component::controls() const {
  std::vector<Control> result;
  for (const ShipInputs& ship : interface_.ships)
    result.push_back(static_cast<Control>(static_cast<int>(values_[ship.control])));
  return result;
}

io::Result<> Component::build() {
  auto scene = scene_with_parameters();
  if (!scene) return io::fail(scene.error());
  auto run = CoupledRun::start(*std::move(scene), controls());
  if (!run) return io::fail(run.error());
  run_ = std::make_unique<CoupledRun>(*std::move(run));
  return {};
}

io::Result<> Component::make_ready() {
  if (run_) return {};
  auto built = build();
  if (built) take_outputs();
  return built;
}

std::vector<ShipInput> Component::inputs() const {
  std::vector<ShipInput> result;
  for (const ShipInputs& at : interface_.ships) {
    const double* command = &values_[at.command];
    const double* force = &values_[at.force];
    const double* motion = &values_[at.motion];
    result.push_back({.lever = command[0],
                      .steering_angle = command[1],
                      .force = {force[0], force[1], force[2]},
                      .position = {motion[0], motion[1]},
                      .heading = motion[2],
                      .velocity = {motion[3], motion[4]},
                      .yaw_rate = motion[5]});
  }
  return result;
}

void Component::take_outputs() {
  values_[interface_.tick] = run_->tick();
  std::size_t at = interface_.first_output;
  for (std::size_t hull = 0; hull < run_->hulls().size(); ++hull) {
    for (const HullOutput& output : hull_outputs())
      if (!output.is_of_ships || hull < interface_.ships.size()) values_[at++] = output.value(run_->hulls()[hull]);
  }
  const simulation::Counts counts = run_->counts();
  values_[interface_.first_count] = static_cast<double>(counts.floes_final);
  values_[interface_.first_count + 1] = static_cast<double>(counts.bends);
  values_[interface_.first_count + 2] = static_cast<double>(counts.splits);
}

fmi2Status Component::do_step(double from, double length) {
  const double tick = run_->tick();
  if (!(std::abs(from - time()) <= kRounding * tick + 1e-12 * std::abs(from)))
    return error(
        fmt::format("fmi2DoStep: currentCommunicationPoint is {} s, and the instance is at {} s", from, time()));
  if (!(length > 0)) return error(fmt::format("fmi2DoStep: the step is {} s, allowed: > 0", length));
  if (stop_ && from + length > *stop_ + kRounding * tick)
    return error(fmt::format("fmi2DoStep: the step ends at {} s, behind the stop time {} s", from + length, *stop_));
  const double ticks = std::round(length / tick);
  if (ticks < 1 || ticks > kMostTicks || std::abs(length - ticks * tick) > kRounding * tick)
    return discard(
        fmt::format("fmi2DoStep: the step of {} s is no whole number of ticks of {} s (tick_s)", length, tick));
  const auto done = run_->advance(static_cast<std::int64_t>(ticks), inputs());
  if (!done) return discard("fmi2DoStep: " + done.error());
  take_outputs();
  log_events();
  return fmi2OK;
}

void Component::reset() {
  run_.reset();
  mode = Mode::kInstantiated;
  has_experiment_ = false;
  start_ = 0;
  stop_.reset();
  values_.clear();
  for (const Variable& v : interface_.variables) values_.push_back(v.start);
  is_parameter_set_.assign(values_.size(), 0);
}

}  // namespace polynya::cosim
