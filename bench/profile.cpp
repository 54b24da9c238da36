// Where a step's time goes: the stages of simulation/step.hpp, each under the clock, over whole runs.
//   polynya_bench_profile [--quick]      prints a Markdown table
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "bench/voyage_run.hpp"
#include "simulation/step.hpp"

namespace polynya::bench {
namespace {

using Clock = std::chrono::steady_clock;
using simulation::World;

struct Stage {
  const char* name;
  void (*run)(World&);
};

constexpr std::array kStages{Stage{"find pairs", simulation::find_pairs},
                             Stage{"find contacts", simulation::find_contacts},
                             Stage{"decide", simulation::decide},
                             Stage{"solve impulses", simulation::solve_impulses},
                             Stage{"tally loads", simulation::tally_loads},
                             Stage{"water and thrust", simulation::apply_forces},
                             Stage{"integrate",
                                   [](World& world) {
                                     simulation::integrate_motion(world);
                                     ++world.steps;
                                   }},
                             Stage{"apply fractures", simulation::apply_fractures},
                             Stage{"put to rest", simulation::put_to_rest},
                             Stage{"record", simulation::record}};

using Shares = std::array<double, kStages.size()>;

Shares profile(const char* file, double until) {
  World world(load(file));
  simulation::Simulation check(load(file));
  const auto steps = std::lround(until / world.scene.time.step);
  Shares seconds{};
  for (long step = 0; step < steps; ++step) {
    auto before = Clock::now();
    for (std::size_t i = 0; i < kStages.size(); ++i) {
      kStages[i].run(world);
      const auto now = Clock::now();
      seconds[i] += std::chrono::duration<double>(now - before).count();
      before = now;
    }
    world.journal.clear();
  }
  // The stages are listed here a second time: they must be those of step().
  for (long step = 0; step < steps; ++step) {
    check.step();
    check.journal().clear();
  }
  for (std::size_t i = 0; i < world.bodies.position.size(); ++i) {
    if (i < check.world().bodies.position.size() &&
        world.bodies.position[i] == check.world().bodies.position[i])
      continue;
    std::fprintf(stderr, "bench: the profiled stages are not those of a step any more\n");
    std::exit(1);
  }
  double sum = 0;
  for (const double s : seconds) sum += s;
  for (double& s : seconds) s /= sum;
  return seconds;
}

}  // namespace
}  // namespace polynya::bench

int main(int count, char** words) {
  using namespace polynya::bench;
  const double part = count > 1 && std::strcmp(words[1], "--quick") == 0 ? 0.1 : 1;
  const Shares voyage = profile("sawamura2017-fig4b.json", 550 * part);
  const Shares field = profile("field-10000.json", 500 * part);
  const Shares cylinder = profile("cylinder-shear.json", 100 * part);
  std::puts("| stage | voyage | field-10000 | cylinder-shear |\n|---|---|---|---|");
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    std::printf("| %s | %.0f %% | %.0f %% | %.0f %% |\n", kStages[i].name, 100 * voyage[i], 100 * field[i],
                100 * cylinder[i]);
  }
}
