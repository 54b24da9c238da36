// A run that does not fit into memory: nothing is written, or a whole folder, and exit code 4.
#include "interrupted_run.hpp"
#include "program.hpp"
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "analysis/run_check.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/run/summary.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/memory_estimate.hpp"

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

Outcome run_within(rlim_t addresses, const Start& start, const std::vector<std::string>& words) {
  Start limited = start;
  limited.arrange_streams = [addresses] {
    const rlimit limit{addresses, addresses};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
  };
  return polynya(words, limited);
}

/// That a folder is that of a run that memory stopped, whole and sound.
void expect_stopped_run(const std::filesystem::path& folder) {
  const auto run = io::read_run(folder);
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_FALSE(run->summary.find("finished")->boolean());
  EXPECT_EQ(run->summary.find("stopped_by")->text(), "memory");
  EXPECT_TRUE(analysis::check_run(*run).is_sound());
}

TEST(Memory, RunsOutAtAnyPointAndLeavesNothingOrAWholeFolder) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  write_file(folder / "scene.json", drifting_floes(100));
  ASSERT_EQ(polynya({"run", "scene.json", "--out", "whole", "--progress", "none"}, start).code, 0);
  int before = 0, during = 0;
  for (rlim_t limit = 40; limit < 400; limit += 5) {
    const std::string out = "run" + std::to_string(limit);
    const Outcome outcome =
        run_within(limit * kMegabyte, start, {"run", "scene.json", "--out", out, "--progress", "none"});
    if (outcome.code == 0) break;
    SCOPED_TRACE(std::to_string(limit) + " MB: " + outcome.err);
    ASSERT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("out of memory"), std::string::npos);
    EXPECT_NE(outcome.err.find("ulimit -v"), std::string::npos);
    if (!std::filesystem::exists(folder / out)) {
      EXPECT_NE(outcome.err.find("nothing was written"), std::string::npos);
      ++before;
      continue;
    }
    EXPECT_NE(outcome.err.find("polynya resume " + out), std::string::npos);
    if (!io::is_finished_run(folder / out)) expect_stopped_run(folder / out);  // else only its map is missing
    if (++during % 3 != 1) continue;
    EXPECT_EQ(polynya({"resume", out, "--progress", "none"}, start).code, 0);
    EXPECT_EQ(first_difference(folder / "whole", folder / out), "");
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(during, 0);
}

/// Threads are made before the first step, where that there is no room for one is an exception: TBB aborts.
TEST(Memory, RunsOutOnSeveralThreadsToo) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  write_file(folder / "scene.json", drifting_floes(70));
  int stopped = 0;
  for (rlim_t limit = 60; limit < 400; limit += 7) {
    const std::string out = "run" + std::to_string(limit);
    const Outcome outcome =
        run_within(limit * kMegabyte, start,
                   {"run", "scene.json", "--out", out, "--progress", "none", "--threads", "4"});
    if (outcome.code == 0) break;
    SCOPED_TRACE(std::to_string(limit) + " MB: " + outcome.err);
    ASSERT_EQ(outcome.code, 4);
    if (!std::filesystem::exists(folder / out) || io::is_finished_run(folder / out)) continue;
    expect_stopped_run(folder / out);
    ++stopped;
  }
  EXPECT_GT(stopped, 0);
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
    const auto scene = io::read_scene_file(folder / name);
    ASSERT_TRUE(scene.has_value());
    const simulation::MemoryEstimate estimate = simulation::estimate_memory(scene->scene);
    EXPECT_LT(estimate.at_start, taken) << "a run that fits would be refused";
    EXPECT_LT(taken, 7 * estimate.at_start);
    EXPECT_LT(estimate.all_moving, 1.5 * taken);
    EXPECT_LT(taken, 1.5 * estimate.all_moving);
  }
}

#endif

}  // namespace
}  // namespace polynya::tests
