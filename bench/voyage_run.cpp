#include "bench/voyage_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <utility>

#include <malloc.h>

#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/world/default_tick.hpp"
#include "simulation/world/world.hpp"

namespace polynya::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Linux keeps the peak memory of a process until it is told to reset it. Memory that an earlier run left allocated is
/// returned to the system first.
void forget_peak_memory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::strtod(line.c_str() + 6, nullptr) / 1024;
  }
  return 0;
}

/// Takes ticks until a limit is met, and adds up their reports.
template <class Step>
void run_steps(RunCost& cost, const Limits& limits, Step step) {
  const long most = std::lround(limits.time / cost.step);
  double spent = 0;
  double block = 0;
  double contacts = 0;
  long counted = 0;
  double awake = 0;
  long next_count = 0;
  while (cost.ticks < most && spent < limits.wall) {
    const bool counts_contacts = cost.ticks >= next_count;
    if (counts_contacts) next_count = cost.ticks + 20;
    const StepReport report = step(counts_contacts);
    ++cost.ticks;
    spent += report.seconds;
    block += report.seconds;
    awake += report.awake;
    cost.most_awake = std::max(cost.most_awake, report.awake);
    if (report.contacts >= 0) {
      contacts += report.contacts;
      ++counted;
    }
    if (cost.ticks % RunCost::kBlock != 0) continue;
    cost.blocks.push_back(block);
    block = 0;
  }
  if (block > 0) cost.blocks.push_back(block);
  cost.mean_awake = awake / static_cast<double>(cost.ticks);
  cost.mean_contacts = counted > 0 ? contacts / static_cast<double>(counted) : 0;
}

int touching_pairs(const std::vector<dynamics::Contact>& contacts) {
  int pairs = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    pairs += i == 0 || contacts[i].a != contacts[i - 1].a || contacts[i].b != contacts[i - 1].b ? 1 : 0;
  return pairs;
}

template <class Engine>
RunCost run_peer(const Peer& peer, const PeerScene& scene, const Limits& limits) {
  RunCost cost;
  cost.engine = peer.name;
  cost.step = scene.step;
  Engine engine(scene);
  run_steps(cost, limits, [&](bool counts_contacts) { return engine.step(counts_contacts); });
  if constexpr (requires { engine.places(); }) cost.places = engine.places();
  return cost;
}

RunCost step_through(simulation::Simulation& simulation, const Limits& limits) {
  RunCost cost;
  cost.engine = limits.threads == 1 ? "Polynya" : "Polynya, " + std::to_string(limits.threads) + " threads";
  simulation.set_threads(limits.threads);
  cost.step = simulation.scene().time.step;
  simulation.journal().clear();
  long samples = 0;
  run_steps(cost, limits, [&](bool counts_contacts) {
    StepReport report;
    const auto before = Clock::now();
    simulation.step();
    report.seconds = seconds_since(before);
    for (const simulation::HullSample& sample : simulation.journal().samples) {
      if (sample.ship != 0) continue;
      cost.surge += sample.from_ice.surge;
      ++samples;
    }
    simulation.journal().clear();
    report.awake =
        static_cast<int>(simulation.world().population.awake.size()) - simulation.world().population.hull_count;
    report.contacts = counts_contacts ? touching_pairs(simulation.world().data.contacts) : -1;
    return report;
  });
  if (samples > 0) cost.surge /= static_cast<double>(samples);
  cost.bends = static_cast<int>(simulation.counts().bends);
  cost.splits = static_cast<int>(simulation.counts().splits);
  return cost;
}

}  // namespace

double RunCost::total() const {
  double sum = 0;
  for (const double block : blocks) sum += block;
  return sum;
}

double RunCost::total_of_first(double time) const {
  const double share = std::min(1.0, time / covered()) * static_cast<double>(blocks.size());
  double sum = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    sum += std::clamp(share - static_cast<double>(i), 0.0, 1.0) * blocks[i];
  return sum;
}

double RunCost::median_tick() const {
  std::vector<double> sorted = blocks;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2] * static_cast<double>(blocks.size()) / static_cast<double>(ticks);
}

void keep_quieter(RunCost& cost, const RunCost& again) {
  for (std::size_t i = 0; i < std::min(cost.blocks.size(), again.blocks.size()); ++i)
    cost.blocks[i] = std::min(cost.blocks[i], again.blocks[i]);
  cost.load = std::min(cost.load, again.load);
}

simulation::Scene load(const std::string& file, const Edit& edit) {
  auto loaded = io::read_scene_file(std::string(POLYNYA_SOURCE_DIR) + "/scenes/" + file);
  if (!loaded) {
    for (const io::Problem& problem : loaded.error()) std::fprintf(stderr, "%s\n", to_string(problem).c_str());
    std::exit(1);
  }
  if (edit) edit(loaded->scene);
  return std::move(loaded->scene);
}

void take_fine_step(simulation::Scene& scene) {
  // Ticks are not divided with the impulse law, so the tick chosen for this law is the fine step.
  const simulation::ContactLaw law = std::exchange(scene.contact.law, simulation::ContactLaw::kImpulse);
  scene.time.step = std::min(scene.time.step, simulation::default_tick(scene));
  scene.contact.law = law;
}

RunCost run_polynya(const std::string& file, const Edit& edit, const Limits& limits, simulation::Shortcuts shortcuts) {
  forget_peak_memory();
  const auto start = Clock::now();
  simulation::Simulation simulation(load(file, edit), shortcuts);
  const double load_time = seconds_since(start);
  RunCost cost = step_through(simulation, limits);
  cost.load = load_time;
  cost.memory = peak_memory();
  return cost;
}
RunCost run_polynya(const simulation::Scene& scene, const Limits& limits, simulation::Shortcuts shortcuts) {
  simulation::Simulation simulation{simulation::Scene(scene), shortcuts};
  return step_through(simulation, limits);
}

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all{{"Box2D 2.4.1", run_peer<Box2dWorld>, false},
#ifdef POLYNYA_BENCH_BOX2D_3
                                     {"Box2D 3.2", run_peer<Box2d3World>, true},
#endif
                                     {"Chipmunk 7.0.3", run_peer<ChipmunkWorld>, false}};
  return all;
}

}  // namespace polynya::bench
