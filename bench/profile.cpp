// Where a step's time goes: the stages of simulation/world/step.hpp, each under the clock, over whole runs.
//   polynya_bench_profile [--quick]      prints a Markdown table of shares, on one thread
//   polynya_bench_profile [--quick] --only voyage|field-10000|cylinder-shear [--until SECONDS]
//                                        prints one case in microseconds a step, on one and on two threads
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "bench/voyage_run.hpp"
#include "dynamics/thread_limit.hpp"
#include "simulation/world/step.hpp"

namespace polynya::bench {
namespace {

using Clock = std::chrono::steady_clock;
using simulation::kStages;

/// Of each stage [s a step].
using Times = std::array<double, kStages.size()>;

struct Profile {
  Times times{};
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

Profile profile(const Case& at, double part, int threads) {
  simulation::World world(load(at.file, [](simulation::Scene& scene) {
    scene.contact.law = simulation::ContactLaw::kCrush;
    take_one_step_for_all(scene);
  }));
  world.threads = threads;
  dynamics::ThreadLimit limit(threads);
  const auto steps = std::lround(at.until * part / world.clock.tick);
  Profile result;
  Times& seconds = result.times;
  limit.execute([&] {
    for (long step = 0; step < steps; ++step) {
      auto before = Clock::now();
      for (std::size_t i = 0; i < kStages.size(); ++i) {
        kStages[i].run(world);
        const auto now = Clock::now();
        seconds[i] += std::chrono::duration<double>(now - before).count();
        before = now;
      }
      result.contacts += static_cast<double>(world.data.contacts.size()) / static_cast<double>(steps);
      world.journal.clear();
    }
  });
  for (double& s : seconds) s /= static_cast<double>(steps);
  return result;
}

double sum_of(const Times& times) {
  double sum = 0;
  for (const double t : times) sum += t;
  return sum;
}

void print_shares(double part) {
  std::array<Times, std::size(kCases)> times{};
  for (std::size_t c = 0; c < times.size(); ++c) times[c] = profile(kCases[c], part, 1).times;
  std::puts("| stage | voyage | field-10000 | cylinder-shear |\n|---|---|---|---|");
  for (std::size_t i = 0; i < kStages.size(); ++i) {
    std::printf("| %s |", kStages[i].name.data());
    for (const Times& t : times) std::printf(" %.0f %% |", 100 * t[i] / sum_of(t));
    std::puts("");
  }
}

void print_threads(const Case& at, double part) {
  const Profile profiled = profile(at, part, 1);
  const Times& one = profiled.times;
  const Times two = profile(at, part, 2).times;
  std::printf("| stage of %s | 1 thread, us | 2 threads, us |\n|---|---|---|\n", at.name);
  for (std::size_t i = 0; i < kStages.size(); ++i)
    std::printf("| %s | %.2f | %.2f |\n", kStages[i].name.data(), 1e6 * one[i], 1e6 * two[i]);
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
