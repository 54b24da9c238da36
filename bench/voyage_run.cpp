#include "bench/voyage_run.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <malloc.h>

#include "io/scene/scene_reader.hpp"
#include "simulation/world/world.hpp"

namespace polynya::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Linux keeps the process's peak memory, and forgets it when told so. What an earlier run left is given
/// back.
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

/// Takes the steps until a limit is met, and adds up what they report.
template <class Step>
void run_steps(RunCost& cost, const Limits& limits, Step step) {
  double spent = 0;
  double block = 0;
  double contacts = 0;
  long counted = 0;
  double awake = 0;
  while (cost.steps < limits.steps && spent < limits.wall) {
    const bool counts_contacts = cost.steps % 20 == 0;
    const StepReport report = step(counts_contacts);
    ++cost.steps;
    spent += report.seconds;
    block += report.seconds;
    awake += report.awake;
    cost.most_awake = std::max(cost.most_awake, report.awake);
    if (report.contacts >= 0) {
      contacts += report.contacts;
      ++counted;
    }
    if (cost.steps % RunCost::kBlock == 0) {
      cost.blocks.push_back(block);
      block = 0;
    }
  }
  if (cost.steps % RunCost::kBlock != 0) cost.blocks.push_back(block);
  cost.mean_awake = awake / static_cast<double>(cost.steps);
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
  return cost;
}

RunCost step_through(simulation::Simulation& simulation, const Limits& limits) {
  RunCost cost;
  cost.engine = limits.threads == 1 ? "Polynya" : "Polynya, " + std::to_string(limits.threads) + " threads";
  simulation.set_threads(limits.threads);
  cost.step = simulation.scene().time.step;
  simulation.journal().clear();
  run_steps(cost, limits, [&](bool counts_contacts) {
    StepReport report;
    const auto before = Clock::now();
    simulation.step();
    simulation.journal().clear();
    report.seconds = seconds_since(before);
    report.awake =
        static_cast<int>(simulation.world().population.awake.size()) - simulation.world().population.hull_count;
    report.contacts = counts_contacts ? touching_pairs(simulation.world().step.contacts) : -1;
    return report;
  });
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

double RunCost::total_of_first(long first) const {
  double sum = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const long begin = static_cast<long>(i) * kBlock;
    const long length = std::min(kBlock, steps - begin);
    const double share = std::clamp(static_cast<double>(first - begin) / static_cast<double>(length), 0.0, 1.0);
    sum += share * blocks[i];
  }
  return sum;
}

double RunCost::median_step() const {
  const std::size_t whole = std::max<std::size_t>(1, static_cast<std::size_t>(steps / kBlock));
  std::vector<double> sorted(blocks.begin(),
                             blocks.begin() + static_cast<std::ptrdiff_t>(std::min(whole, blocks.size())));
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() / 2] / static_cast<double>(std::min(kBlock, steps));
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

RunCost run_polynya(const std::string& file, const Edit& edit, const Limits& limits) {
  forget_peak_memory();
  const auto start = Clock::now();
  simulation::Simulation simulation(load(file, edit));
  const double load_time = seconds_since(start);
  RunCost cost = step_through(simulation, limits);
  cost.load = load_time;
  cost.memory = peak_memory();
  return cost;
}
RunCost run_polynya(const simulation::Scene& scene, const Limits& limits) {
  simulation::Simulation simulation{simulation::Scene(scene)};
  return step_through(simulation, limits);
}

const std::vector<Peer>& peers() {
  static const std::vector<Peer> all{{"Box2D 2.4.1", run_peer<Box2dWorld>},
#ifdef POLYNYA_BENCH_BOX2D_3
                                     {"Box2D 3.2", run_peer<Box2d3World>},
#endif
                                     {"Chipmunk 7.0.3", run_peer<ChipmunkWorld>}};
  return all;
}

}  // namespace polynya::bench
