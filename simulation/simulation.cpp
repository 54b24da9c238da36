#include "simulation/simulation.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <tuple>

#include "dynamics/thread_limit.hpp"
#include "simulation/ship/mooring.hpp"
#include "simulation/state/state.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {

using geometry::Vector;

Simulation::Simulation(Scene scene, Shortcuts shortcuts)
    : world_(std::make_unique<World>(std::move(scene), shortcuts)) {}
Simulation::Simulation(std::unique_ptr<World> world) : world_(std::move(world)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

tl::expected<Simulation, std::string> Simulation::resumed(Scene scene, std::string_view state) {
  auto world = std::make_unique<World>(std::move(scene), Shortcuts{}, Start::kEmpty);
  if (std::string reason = load_state(*world, state); !reason.empty()) return tl::unexpected(std::move(reason));
  return Simulation(std::move(world));
}
std::string Simulation::state() const {
  return save_state(*world_);
}
std::uint64_t Simulation::state_hash() const {
  return simulation::state_hash(*world_);
}

void Simulation::set_threads(int threads) {
  world_->threads = threads;
  thread_limit_ = threads > 1 ? std::make_unique<dynamics::ThreadLimit>(threads) : nullptr;
}

void Simulation::set_pilot(int ship, ExternalPilot pilot) {
  world_->pilots.resize(world_->setup.scene.ships.size());
  world_->pilots.at(static_cast<std::size_t>(ship)) = std::move(pilot);
}

void Simulation::set_external_force(int ship, dynamics::Planar force) {
  world_->external_forces.resize(world_->setup.scene.ships.size());
  world_->external_forces.at(static_cast<std::size_t>(ship)) = force;
}

void Simulation::set_prescribed_motion(int ship, Vector velocity, double yaw_rate) {
  dynamics::Bodies& bodies = world_->population.bodies;
  if (bodies.inverse_mass.at(static_cast<std::size_t>(ship)) != 0)
    throw std::invalid_argument("the motion of this ship is not prescribed");
  bodies.velocity[ship] = velocity - world_->population.water_velocity;
  bodies.angular_velocity[ship] = yaw_rate;
}

void Simulation::sample_loads() {
  simulation::sample_loads(world_->setup, world_->clock, world_->population, {world_->accounts, world_->journal});
}

namespace {

/// Checks the world in builds with assertions. Ends the program if it has a defect.
void validate([[maybe_unused]] const World& world) {
#ifndef NDEBUG
  if (world.failure) return;
  const auto defect = validate_world(world);
  if (!defect) return;
  std::fprintf(stderr, "step %lld: %s\n", static_cast<long long>(world.clock.ticks), defect->c_str());
  std::abort();
#endif
}

bool is_recorded(const World& world, const dynamics::Contact& contact) {
  switch (world.setup.scene.record.contacts) {
    case RecordedContacts::kNone:
      return false;
    case RecordedContacts::kShips:
      return world.population.is_hull(contact.a);  // hulls come first, so the first body is a hull if any is
    case RecordedContacts::kAll:
      return true;
  }
  return false;
}

}  // namespace

void Simulation::step() {
  if (thread_limit_ == nullptr) {
    simulation::step(*world_);
  } else {
    thread_limit_->execute([&] { simulation::step(*world_); });
  }
  validate(*world_);
}
std::optional<std::string> Simulation::numerical_failure() const {
  return world_->failure;
}
double Simulation::time() const {
  return world_->clock.time();
}
std::int64_t Simulation::steps() const {
  return world_->clock.ticks;
}
const Scene& Simulation::scene() const {
  return world_->setup.scene;
}
Journal& Simulation::journal() {
  return world_->journal;
}
const World& Simulation::world() const {
  return *world_;
}

Audit Simulation::audit() const {
  const dynamics::Bodies& bodies = world_->population.bodies;
  const double stored =
      stored_in_moorings(world_->setup, world_->population, drift_at(world_->setup, world_->clock.time()));
  return simulation::audit(world_->accounts.audit, holdings(bodies, stored));
}

IceLedger Simulation::area_ledger() const {
  return simulation::area_ledger(*world_);
}

IceLedger Simulation::mass_ledger() const {
  return simulation::mass_ledger(*world_);
}

Counts Simulation::counts() const {
  const Population& population = world_->population;
  Counts counts = world_->accounts.counts;
  counts.steps = world_->clock.ticks;
  for (FloeId id = 0; id < population.floe_count(); ++id) counts.floes_final += population.is_floating(id);
  return counts;
}

namespace {

/// Returns the state of a floe. `drift` is the present displacement of the water frame [m]; it is computed once for all
/// floes, because it may be interpolated in a long table.
FloeState state_of(const World& world, Vector drift, FloeId id) {
  const dynamics::Bodies& bodies = world.population.bodies;
  const BodyIndex body = world.population.body_of(id);
  const Floe& floe = world.population.floes[id];
  FloeState state;
  state.floe = id;
  state.parent = floe.parent;
  state.born = floe.born;
  state.generation = floe.generation;
  state.world_from_body = dynamics::water_from_body(bodies, body);
  state.world_from_body.position += drift;
  state.angle = bodies.angle[body];
  state.velocity = bodies.velocity[body] + world.population.water_velocity;
  state.angular_velocity = bodies.angular_velocity[body];
  if (floe.is_under && !world.setup.current.is_still()) {  // a piece under a hull moves with the water
    state.velocity += world.setup.current.velocity_at(bodies.position[body]);
    state.angular_velocity = world.setup.current.angular_velocity();
  }
  state.area = floe.area;
  state.mass = bodies.mass[body];
  state.is_fast = world.population.is_fast(id);
  state.ice = &ice_of_floe(world.setup, world.population, id);
  state.polygon_in_body = &floe.shape.polygon;
  return state;
}

}  // namespace

void Simulation::for_each_floe(Living which, const std::function<void(const FloeState&)>& use) const {
  const Population& population = world_->population;
  const Vector drift = drift_at(world_->setup, world_->clock.time());
  for (FloeId id = 0; id < population.floe_count(); ++id)
    if (which == Living::kFloating ? population.is_floating(id) : population.is_alive(id))
      use(state_of(*world_, drift, id));
}

std::vector<FloeState> Simulation::floe_states(Living which) const {
  std::vector<FloeState> states;
  for_each_floe(which, [&](const FloeState& state) { states.push_back(state); });
  return states;
}

std::vector<CrushedOverlap> Simulation::crushed_overlaps() const {
  const Population& population = world_->population;
  const dynamics::Bodies& bodies = population.bodies;
  std::vector<std::tuple<BodyIndex, BodyIndex, CrushedOverlap>> pairs;
  population.pairs.for_overlaps(
      [&](BodyIndex a, BodyIndex b, double paid, double unpaid, const dynamics::Booked& booked) {
        const double smaller = std::min(bodies.area[a], bodies.area[b]);
        paid = std::min(paid, smaller);  // the overlaps of a floe that surfaced are all paid, without their areas
        pairs.emplace_back(a, b,
                           CrushedOverlap{.on = contact_body(population, a),
                                          .by = contact_body(population, b),
                                          .area = std::max(0.0, paid - booked.tilted),
                                          .share = (paid + unpaid) / smaller,
                                          .tilted = booked.tilted,
                                          .unpaid = unpaid,
                                          .volume = booked.volume,
                                          .work = booked.work});
      });
  std::ranges::sort(pairs, {}, [](const auto& pair) { return std::pair(std::get<0>(pair), std::get<1>(pair)); });
  std::vector<CrushedOverlap> overlaps;
  overlaps.reserve(pairs.size());
  for (const auto& pair : pairs) overlaps.push_back(std::get<2>(pair));
  return overlaps;
}

std::vector<ContactState> Simulation::contact_states() const {
  const World& world = *world_;
  std::vector<ContactState> states;
  for (std::size_t i = 0; i < world.data.contacts.size(); ++i) {
    const dynamics::Contact& c = world.data.contacts[i];
    if (!is_recorded(world, c)) continue;
    const HullSlope* slope = i < world.data.slopes.size() ? &world.data.slopes[i] : nullptr;
    ContactState& state = states.emplace_back(state_of(world.setup, world.last_step, world.population, c, slope));
    if (!world.population.is_hull(c.a)) continue;
    const geometry::Pose& water_from_hull = world.data.water_from_hull[static_cast<std::size_t>(c.a)];
    place_on_waterline(world.setup, inverse_transform(water_from_hull, c.centre_of_pressure()), state);
  }
  return states;
}

std::vector<HullState> Simulation::ship_states() const {
  const dynamics::Bodies& bodies = world_->population.bodies;
  std::vector<HullState> states;
  for (BodyIndex hull = 0; hull < world_->population.hull_count; ++hull) {
    HullState state;
    state.world_from_ship = dynamics::water_from_body(bodies, hull);
    state.world_from_ship.position += drift_at(world_->setup, world_->clock.time());
    state.heading = bodies.angle[hull];
    state.velocity = bodies.velocity[hull] + world_->population.water_velocity;
    state.angular_velocity = bodies.angular_velocity[hull];
    states.push_back(state);
  }
  return states;
}

}  // namespace polynya::simulation
