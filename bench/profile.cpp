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
using simulation::kStages;

using Shares = std::array<double, kStages.size()>;

Shares profile(const char* file, double until) {
  simulation::World world(load(file));
  const auto steps = std::lround(until / world.clock.step);
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
    std::printf("| %s | %.0f %% | %.0f %% | %.0f %% |\n", kStages[i].name.data(), 100 * voyage[i],
                100 * field[i], 100 * cylinder[i]);
  }
}
