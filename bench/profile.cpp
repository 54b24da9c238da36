// The time of each stage of a step (simulation/world/step.hpp) and of the end of a tick, over whole runs. Each tick is
// one fine step without parts.
//   polynya_bench_profile [--quick]      prints a Markdown table of shares, on one thread
//   polynya_bench_profile [--quick] --only voyage|field-10000|cylinder-shear [--until SECONDS]
//                                        prints one case in microseconds a step, on one and on two threads
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

#include "bench/voyage_run.hpp"
#include "dynamics/thread_limit.hpp"
#include "simulation/world/step.hpp"

namespace polynya::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// Returns the stages that are timed: the stages of the crushing law.
std::span<const simulation::Stage> stages() {
  return simulation::stages_of(simulation::ContactLaw::kCrush);
}

/// Mean time of each of stages() and, last, of the end of a tick [s].
using Times = std::vector<double>;

/// The name of a row of Times.
std::string_view name_of(std::size_t row) {
  return row < stages().size() ? stages()[row].name : "end of a tick";
}

struct Profile {
  Times times;
  double contacts = 0;  ///< mean of a step
};

struct Case {
  const char* name;
  const char* file;
  double until;  ///< [s]
};
constexpr Case kCases[] = {{"voyage", "sawamura2017-fig4b.json", 550},
                           {"field-10000", "field-10000.json", 500},
                           {"cylinder-shear", "cylinder-shear.json", 100}};

/// Takes one tick as one step, and adds the time of each stage and of the tick's end [s].
void timed_tick(simulation::World& world, Times& seconds) {
  auto before = Clock::now();
  const auto add_time_to = [&](double& sum) {
    const auto now = Clock::now();
    sum += std::chrono::duration<double>(now - before).count();
    before = now;
  };
  world.last_step = step_of(world.setup, world.clock, 0, 1);
  for (std::size_t i = 0; i < stages().size(); ++i) {
    stages()[i].run(world, world.last_step);
    add_time_to(seconds[i]);
  }
  ++world.clock.ticks;
  simulation::end_tick(world);
  add_time_to(seconds.back());
}

Profile profile(const Case& at, double part, int threads) {
  simulation::World world(load(at.file,
                               [](simulation::Scene& scene) {
                                 scene.contact.law = simulation::ContactLaw::kCrush;
                                 take_fine_step(scene);
                               }),
                          kWithoutParts);
  world.threads = threads;
  dynamics::ThreadLimit limit(threads);
  const auto steps = std::lround(at.until * part / world.clock.tick);
  Profile result;
  result.times.resize(stages().size() + 1);
  limit.execute([&] {
    for (long step = 0; step < steps; ++step) {
      timed_tick(world, result.times);
      result.contacts += static_cast<double>(world.data.contacts.size()) / static_cast<double>(steps);
      world.journal.clear();
    }
  });
  for (double& s : result.times) s /= static_cast<double>(steps);
  return result;
}

double sum_of(const Times& times) {
  double sum = 0;
  for (const double t : times) sum += t;
  return sum;
}

void print_shares(double part) {
  std::array<Times, std::size(kCases)> times;
  for (std::size_t c = 0; c < times.size(); ++c) times[c] = profile(kCases[c], part, 1).times;
  std::puts("| stage | voyage | field-10000 | cylinder-shear |\n|---|---|---|---|");
  for (std::size_t i = 0; i < times.front().size(); ++i) {
    std::printf("| %s |", name_of(i).data());
    for (const Times& t : times) std::printf(" %.0f %% |", 100 * t[i] / sum_of(t));
    std::puts("");
  }
}

void print_threads(const Case& at, double part) {
  const Profile profiled = profile(at, part, 1);
  const Times& one = profiled.times;
  const Times two = profile(at, part, 2).times;
  std::printf("| stage of %s | 1 thread, us | 2 threads, us |\n|---|---|---|\n", at.name);
  for (std::size_t i = 0; i < one.size(); ++i)
    std::printf("| %s | %.2f | %.2f |\n", name_of(i).data(), 1e6 * one[i], 1e6 * two[i]);
  std::printf("| all | %.2f | %.2f |\n", 1e6 * sum_of(one), 1e6 * sum_of(two));
  std::printf("%.1f contacts a step\n", profiled.contacts);
}

}  // namespace
}  // namespace polynya::bench

int main(int count, char** words) {
  using namespace polynya::bench;
  double part = 1;
  std::string_view only;
  double until = 0;  // [s]; 0: the case's own
  for (int i = 1; i < count; ++i) {
    if (std::string_view(words[i]) == "--quick")
      part = 0.1;
    else if (std::string_view(words[i]) == "--only" && i + 1 < count)
      only = words[++i];
    else if (std::string_view(words[i]) == "--until" && i + 1 < count)
      until = std::atof(words[++i]);
  }
  if (only.empty()) return print_shares(part), 0;
  for (Case at : kCases) {
    if (only != at.name) continue;
    if (until > 0) at.until = until;
    return print_threads(at, part), 0;
  }
  std::fprintf(stderr, "usage: %s [--quick] [--only voyage|field-10000|cylinder-shear [--until SECONDS]]\n", words[0]);
  return 2;
}
