#include "cosim/coupled_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "io/run/checkpoint.hpp"
#include "io/run/event_records.hpp"
#include "io/run/run_loop.hpp"
#include "simulation/ship/cover_image.hpp"
#include "simulation/world/world.hpp"

namespace polynya::cosim {
namespace {

using simulation::Engine;
using simulation::Ship;

/// Largest speed [m/s] and yaw rate [rad/s] that the other simulator may prescribe. A larger one means that its pose
/// jumped, or that the body is no ship, and is refused.
constexpr double kFastestMotion = 30;
constexpr double kFastestTurn = 1;

/// Prepares a ship for its control. A ship whose motion is given loses its engine, steering, pilot and mooring.
io::Result<> prepare(Control control, Ship& ship) {
  const bool has_engine = std::holds_alternative<Engine>(ship.propulsion);
  if (control == Control::kCommand && !has_engine)
    return io::fail(
        fmt::format("{}.control: the ship has no engine to command; give it propulsion.engine, or choose "
                    "scene or motion",
                    ship.name));
  if (control != Control::kMotion) return {};
  ship.propulsion = simulation::ConstantSpeed{ship.speed};
  ship.steering = {};
  ship.pilot = {};
  ship.mooring.reset();
  return {};
}

}  // namespace

CoupledRun::CoupledRun(io::LoadedScene scene, std::vector<Control> controls)
    : scene_(std::make_unique<io::LoadedScene>(std::move(scene))),
      controls_(std::move(controls)),
      inputs_(std::make_unique<std::vector<ShipInput>>(controls_.size())),
      hulls_(scene_->scene.ships.size() + scene_->scene.structures.size()) {}

io::Result<CoupledRun> CoupledRun::start(io::LoadedScene scene, std::vector<Control> controls) {
  for (std::size_t i = 0; i < controls.size(); ++i)
    if (auto prepared = prepare(controls[i], scene.scene.ships[i]); !prepared) return io::fail(prepared.error());
  // Rows are written at the ends of communication steps alone, and contacts with hulls are always followed.
  scene.scene.record.forces_interval = std::numeric_limits<double>::max();
  scene.scene.record.contacts = simulation::RecordedContacts::kShips;
  CoupledRun run(std::move(scene), std::move(controls));
  run.simulation_ = std::make_unique<simulation::Simulation>(run.scene_->scene);
  run.simulation_->journal().clear();
  run.attach_pilots();
  run.take_motion();
  return run;
}

void CoupledRun::attach_pilots() {
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    if (controls_[i] != Control::kCommand) continue;
    const ShipInput* input = &(*inputs_)[i];
    simulation_->set_pilot(static_cast<int>(i), [input](const simulation::PilotView&) {
      return simulation::Command{input->lever, input->steering_angle};
    });
  }
}

/// The motion that brings the ship from where it is to where the other side has it after the step. If that side gives
/// the start of the step, an earlier difference so disappears within the step, without a jump.
io::Result<> CoupledRun::give_motion(int ship, const ShipInput& input, double seconds) {
  const simulation::HullSample& now = hulls_[static_cast<std::size_t>(ship)].sample;
  const geometry::Vector velocity = input.velocity + (1 / seconds) * (input.position - now.position_in_world);
  const double turn = std::remainder(input.heading - now.heading, 2 * std::numbers::pi);
  const double yaw_rate = input.yaw_rate + turn / seconds;
  if (!(length(velocity) <= kFastestMotion && std::abs(yaw_rate) <= kFastestTurn))
    return io::fail(fmt::format(
        "{}: the given motion needs {:.4g} m/s and {:.4g} rad/s, at most {} m/s and {} rad/s are allowed; the ship "
        "is at ({:.4f}, {:.4f}) m with heading {:.6f} rad",
        scene_->scene.ships[static_cast<std::size_t>(ship)].name, length(velocity), yaw_rate, kFastestMotion,
        kFastestTurn, now.position_in_world.x, now.position_in_world.y, now.heading));
  simulation_->set_prescribed_motion(ship, velocity, yaw_rate);
  return {};
}

io::Result<> CoupledRun::give(const std::vector<ShipInput>& inputs, double seconds) {
  *inputs_ = inputs;
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    const int ship = static_cast<int>(i);
    simulation_->set_external_force(ship, inputs[i].force);
    if (controls_[i] != Control::kMotion) continue;
    if (auto given = give_motion(ship, inputs[i], seconds); !given) return given;
  }
  return {};
}

void CoupledRun::follow_contacts() {
  for (const simulation::ContactState& contact : simulation_->contact_states()) {
    const auto hull = static_cast<std::size_t>(contact.on.ship);
    if (contact.on.ship < 0 || hull >= hulls_.size() || contact.by.floe == simulation::kNoFloe) continue;
    double& largest = hulls_[hull].largest_contact;
    largest = std::max(largest, length(contact.force));
  }
}

io::Result<> CoupledRun::step(std::int64_t ticks) {
  for (HullOutputs& hull : hulls_) hull.largest_contact = 0;
  for (std::int64_t i = 0; i < ticks; ++i) {
    simulation_->step();
    if (const auto failure = simulation_->numerical_failure())
      return io::fail(fmt::format("numerical failure at {:.6g} s: {}", simulation_->time(), *failure));
    follow_contacts();
  }
  return {};
}

io::Result<> CoupledRun::advance(std::int64_t ticks, const std::vector<ShipInput>& inputs) {
  const std::vector<HullOutputs> outputs_before = hulls_;
  const std::string before = simulation_->state();
  io::Result<> done;
  try {
    done = give(inputs, static_cast<double>(ticks) * tick());
    if (done) done = step(ticks);
  } catch (const std::exception& error) {
    done = io::fail(error.what());
  }
  if (done) {
    take_outputs();
    return {};
  }
  hulls_ = outputs_before;
  auto again = simulation::Simulation::resumed(scene_->scene, before);
  if (!again) throw std::runtime_error("the state before a failed step cannot be restored: " + again.error());
  *simulation_ = *std::move(again);
  attach_pilots();
  return done;
}

void CoupledRun::take_outputs() {
  simulation_->sample_loads();
  simulation::Journal& journal = simulation_->journal();
  for (const simulation::HullSample& sample : journal.samples)
    if (static_cast<std::size_t>(sample.ship) < hulls_.size())
      hulls_[static_cast<std::size_t>(sample.ship)].sample = sample;
  events_.clear();
  const auto& floes = simulation_->world().population.floes;
  for (const simulation::Event& event : journal.events) {
    const simulation::IceEvent* ice = event.ice();
    io::append_event(events_, event, simulation_->scene(), ice ? floes[ice->floe].parent : simulation::kNoFloe);
  }
  journal.clear();
  for (std::size_t i = 0; i < scene_->scene.ships.size(); ++i)
    hulls_[i].cover_ahead = cover_ahead(simulation_->world(), static_cast<int>(i));
}

/// The outputs at the start of a run, or where it was restored: motion, without loads.
void CoupledRun::take_motion() {
  const std::vector<simulation::HullState> states = simulation_->ship_states();
  for (std::size_t i = 0; i < hulls_.size(); ++i) {
    hulls_[i] = {};
    simulation::HullSample& sample = hulls_[i].sample;
    sample.position_in_world = states[i].world_from_ship.position;
    sample.heading = states[i].heading;
    sample.velocity_in_world = states[i].velocity;
    sample.yaw_rate = states[i].angular_velocity;
    if (i >= scene_->scene.ships.size()) continue;
    const simulation::Helm& helm = simulation_->world().population.helms[i];
    sample.lever = helm.lever;
    sample.steering_angle = helm.steering_angle;
    hulls_[i].cover_ahead = cover_ahead(simulation_->world(), static_cast<int>(i));
  }
}

std::string CoupledRun::save() const {
  return io::checkpoint_bytes(io::checkpoint_of(*simulation_, *scene_, {}, 0));
}

io::Result<> CoupledRun::restore(std::string_view bytes) {
  const auto checkpoint = io::read_checkpoint(bytes);
  if (!checkpoint) return io::fail(checkpoint.error());
  if (checkpoint->course_hash != scene_->course_hash) return io::fail("the state is that of another scene");
  auto simulation = io::simulation_at(*scene_, *checkpoint);
  if (!simulation) return io::fail(simulation.error());
  *simulation_ = *std::move(simulation);
  attach_pilots();
  take_motion();
  return {};
}

}  // namespace polynya::cosim
