// A run that does not fit into memory: it is refused before it starts, or ends as one that was killed.
#include "interrupted_run.hpp"
#include "program.hpp"
#include <sys/resource.h>

#include "app/run/load_scene.hpp"
#include "io/run/run_folder.hpp"
#include "simulation/world/memory_estimate.hpp"

namespace polynya::tests {
namespace {

/// Floes in a square, at rest until the first step, in which all of them come to move: that takes more memory
/// than they had before. Two steps.
std::string drifting_floes(int rows) {
  return R"({"name": "drifting", "time": {"step_s": 0.02, "until_s": 0.04}, "record": {"frames_interval_s": 0.02},
    "floes": [{"lattice": {"rows": )" +
         std::to_string(rows) + R"(, "columns": )" + std::to_string(rows) +
         R"(, "pitch_m": 10, "size_m": 9.5}, "velocity_m_per_s": [0.1, 0]}]})";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these take all addresses

constexpr rlim_t kMegabyte = 1'000'000;

Outcome run_within(rlim_t addresses, const Start& start, const Words& words) {
  Start limited = start;
  limited.arrange_streams = [addresses] {
    const rlimit limit{addresses, addresses};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
  };
  return polynya(words, limited);
}

/// What a run that memory ended leaves is what kill -9 leaves: nothing yet, or a folder that goes on.
TEST(Memory, RunsOutAndLeavesNothingOrARunThatGoesOn) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  write_file(folder / "scene.json", drifting_floes(100));
  ASSERT_EQ(polynya("run scene.json --out whole --progress none", start).code, 0);
  int before = 0, during = 0;
  for (rlim_t limit = 40; limit < 400; limit += 20) {
    const std::string out = "run" + std::to_string(limit);
    const Outcome outcome =
        run_within(limit * kMegabyte, start, {"run", "scene.json", "--out", out, "--progress", "none"});
    if (outcome.code == 0) break;
    SCOPED_TRACE(std::to_string(limit) + " MB: " + outcome.err);
    if (!std::filesystem::exists(folder / out)) {
      ++before;
      continue;
    }
    if (outcome.code == 4) {
      EXPECT_HAS(outcome.err, "polynya resume " + out);
    }
    if (++during % 3 != 1) continue;
    EXPECT_EQ(polynya({"resume", out, "--progress", "none"}, start).code, 0);
    EXPECT_EQ(first_difference(folder / "whole", folder / out), "");
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(during, 0);
}

/// The most memory that a run had [bytes]. Without rsvg-convert, whose memory would count too.
double peak_of_run(const std::string& scene, Start start) {
  start.arrange_streams = [] { setenv("PATH", "", 1); };
  const pid_t child = start_polynya({"run", scene, "--out", scene + "-run", "--progress", "none"}, start);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TEST(Memory, IsEstimatedWithinAFactorOfWhatRunsTake) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  write_file(folder / "few.json", drifting_floes(2));
  const double program = peak_of_run("few.json", start);
  for (const int rows : {50, 100}) {
    const std::string name = std::to_string(rows) + ".json";
    write_file(folder / name, drifting_floes(rows));
    const double taken = peak_of_run(name, start) - program;
    const auto scene = checked(io::read_scene_file(folder / name));
    const simulation::MemoryEstimate estimate = simulation::estimate_memory(scene->scene);
    EXPECT_LT(estimate.at_start, taken) << "a run that fits would be refused";
    EXPECT_LT(taken, 7 * estimate.at_start);
    EXPECT_LT(estimate.all_moving, 1.5 * taken);
    EXPECT_LT(taken, 1.5 * estimate.all_moving);
  }
}

#endif

using app::may_fit;

TEST(MemoryCheck, RefusesWhatSurelyDoesNotFitAndNotesWhatMayNot) {
  simulation::Scene scene;
  const geometry::Ring square{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  scene.floes.assign(1000, {{square, {}}, {}, 0});
  const auto said_of = [&](double bytes, bool expected) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(may_fit(scene, "scene.json", {bytes, "a limit"}), expected);
    return testing::internal::GetCapturedStderr();
  };
  const std::string refusal = said_of(200e3, false);
  EXPECT_HAS(refusal,
             "scene.json: 1000 floes take at least 1 MB of memory, and there are 0 MB (a limit); "
             "nothing was written");
  EXPECT_HAS(said_of(3e6, true), "note: scene.json: the run takes about");
  EXPECT_EQ(said_of(1e9, true), "");
}

}  // namespace
}  // namespace polynya::tests
