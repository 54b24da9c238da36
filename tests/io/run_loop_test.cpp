// The run loop as an embedder calls it: progress and stop are callbacks, the result is a value.
#include "io/run/run_loop.hpp"

#include <algorithm>
#include <cmath>

#include "scene_text.hpp"
#include "temporary_folder.hpp"
#include <gtest/gtest.h>

#include "io/run/available_memory.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/run_folder.hpp"

namespace polynya::io {
namespace {

using namespace tests;
using io::memory_available;
using io::MemoryAvailable;

LoadedScene small_scene(double until = 2) {
  return load(
      scene({fmt::format(R"("time": {{"step_s": 0.01, "until_s": {}}}, "record": {{"frames_interval_s": 0.5}})", until),
             list("ships", {ship(R"("hull": {"length_m": 60}, "position_m": [-30.5, 2],
                       "propulsion": {"constant_speed_m_per_s": 2})")}),
             list("floes", {R"({"rectangle": {"corner_m": [0, -20], "size_m": [60, 40]}})"})}));
}

/// Stops when that holds, for "enough" reason.
template <class Holds>
RunControl until(Holds holds) {
  return {.stop = [holds]() mutable { return holds() ? std::optional<std::string>("enough") : std::nullopt; }};
}

/// Checks that the run in the folder, resumed from its newest checkpoint, ends like the run in `whole`.
void expect_resumes_to(const TemporaryFolder& folder, const LoadedScene& scene) {
  const auto checkpoints = checkpoints_in(folder / "run");
  ASSERT_FALSE(checkpoints.empty());
  auto lock = checked(RunLock::take(folder / "run"));
  auto resumed = checked(resume_run(std::move(*lock), scene, checkpoints.front()));
  EXPECT_EQ(run_to_end(*resumed).end, RunEnd::kFinished);
  for (const auto name : {run_file::kForces, run_file::kEvents, run_file::kFloes, run_file::kFrames, run_file::kStates,
                          run_file::kContacts, run_file::kCrushed, run_file::kFinalGeojson})
    EXPECT_EQ(read_file(folder / "run" / name), read_file(folder / "whole" / name)) << name;
}

TEST(RunLoop, ReportsProgressAndFinishesTheFolder) {
  const TemporaryFolder folder;
  const LoadedScene small = small_scene();
  auto run = checked(start_run(folder / "run", small));
  std::vector<double> times;
  const RunResult result = run_to_end(*run, {.progress = [&](const RunStatus& at) { times.push_back(at.time); }});
  EXPECT_EQ(result.end, RunEnd::kFinished);
  EXPECT_EQ(result.reason, "");
  EXPECT_EQ(result.summary.steps, 200);
  EXPECT_GT(fractures_of(result.summary.counts), 0);
  EXPECT_TRUE(finished_run(folder / "run"));
  EXPECT_GE(times.size(), 200U / 32);  // a step takes up to 32 ticks, and each 16 ticks are reported at most once
  EXPECT_LE(times.size(), 200U / 16);
  EXPECT_TRUE(std::ranges::is_sorted(times));
}

TEST(RunLoop, CountsBendsAndSplitsAsFractures) {
  simulation::Counts counts;
  counts.bends = 3;
  counts.splits = 2;
  counts.ground = 40;  // overlaps that became brash
  counts.rejected_cuts = 1;
  EXPECT_EQ(fractures_of(counts), 5);
}

TEST(RunLoop, AStoppedRunIsResumedToTheSameBytes) {
  const TemporaryFolder folder;
  const LoadedScene small = small_scene();
  auto whole = checked(start_run(folder / "whole", small));
  EXPECT_EQ(run_to_end(*whole).end, RunEnd::kFinished);
  {
    auto run = checked(start_run(folder / "run", small));
    const RunResult result = run_to_end(*run, until([steps = 0]() mutable { return ++steps == 50; }));
    EXPECT_EQ(result.end, RunEnd::kStopped);
    EXPECT_EQ(result.reason, "enough");
    EXPECT_GE(result.summary.steps, 50);
    EXPECT_LT(result.summary.steps, 200);
    EXPECT_FALSE(result.summary.finished);
  }
  EXPECT_EQ(checkpoints_in(folder / "run").size(), 1U);
  expect_resumes_to(folder, small);
}

/// A run that ends early, or is stopped, continues to a later end as if it had not ended.
TEST(RunLoop, AnEarlierEndLeavesNoTraceInALongerRun) {
  const TemporaryFolder folder;
  const LoadedScene longer = small_scene();
  auto whole = checked(start_run(folder / "whole", longer));
  EXPECT_EQ(run_to_end(*whole).end, RunEnd::kFinished);
  for (const auto& [until_s, stop_at] : {std::pair(0.2, 1000), std::pair(0.6, 45)}) {
    const LoadedScene shorter = small_scene(until_s);
    {
      auto run = checked(start_run(folder / "run", shorter, true));
      const RunResult result = run_to_end(*run, until([&, at = stop_at] { return run->simulation.steps() >= at; }));
      EXPECT_EQ(result.end, stop_at == 1000 ? RunEnd::kFinished : RunEnd::kStopped);
    }
    SCOPED_TRACE(until_s);
    expect_resumes_to(folder, longer);
  }
}

TEST(RunLoop, ANumericalFailureAndALostFolderAreResults) {
  const TemporaryFolder folder;
  const LoadedScene small = small_scene();
  const std::string mooring = R"("mooring": {"position_m": [2000, 0], "surge_stiffness_N_per_m": 5e6})";
  const LoadedScene runaway = load(scene({R"("time": {"step_s": 0.01, "until_s": 60})",
                                          list("ships", {ship(R"("propulsion": {"thrust_N": 0}, )" + mooring)})}));
  auto broken = checked(start_run(folder / "broken", runaway));
  const RunResult failed = run_to_end(*broken);
  EXPECT_EQ(failed.end, RunEnd::kNumericalFailure);
  EXPECT_TRUE(failed.reason.starts_with("numerical failure: ")) << failed.reason;
  ASSERT_TRUE(failed.dump.has_value());
  EXPECT_TRUE(failed.dump->has_value()) << failed.dump->error();
  EXPECT_TRUE(std::filesystem::exists(folder / "broken" / run_file::kFailure));
  auto lost = checked(start_run(folder / "lost", small));
  std::filesystem::remove_all(folder / "lost");
  const RunResult displaced = run_to_end(*lost);
  EXPECT_EQ(displaced.end, RunEnd::kFolderFailure);
  EXPECT_HAS(displaced.reason, "removed, moved or replaced");
}

/// For many floes final.geojson is written on request only. The size of the files is predicted.
TEST(RunLoop, ALargeFinalGeojsonIsWrittenOnRequestAlone) {
  const TemporaryFolder folder;
  const LoadedScene many = load(scene(
      {R"("time": {"step_s": 0.01, "until_s": 0.01})",
       list(
           "floes",
           {R"({"lattice": {"origin_m": [0.1, 0.2], "columns": 320, "rows": 320, "pitch_m": 3.3, "size_m": 3.1}})"})}));
  ASSERT_EQ(many.scene.floes.size(), 102'400U);
  const FolderSize estimated = estimate_folder_size(many.scene);
  for (const bool is_asked : {false, true}) {
    auto run = checked(start_run(folder / "run", many, true));
    const RunResult result = run_to_end(*run, {.final_geojson = is_asked});
    ASSERT_EQ(result.end, RunEnd::kFinished) << result.reason;
    EXPECT_EQ(std::filesystem::exists(folder / "run/final.geojson"), is_asked);
    EXPECT_EQ(result.summary.warnings.size(), is_asked ? 0U : 1U);
  }
  const auto size = [&](std::string_view name) {
    return static_cast<double>(std::filesystem::file_size(folder / "run" / name));
  };
  EXPECT_NEAR(size(run_file::kFloes) / estimated.floes, 1, 0.3);
  EXPECT_NEAR(size(run_file::kFinalGeojson) / estimated.final_geojson, 1, 0.3);
}

// ---- the memory that there is

TEST(MemoryAvailable, IsWhatTheMachineHasFreeWithSwapAndWhatThisProcessHas) {
  const TemporaryFolder root;
  EXPECT_TRUE(std::isinf(memory_available(root.path()).bytes)) << "nothing states a limit";
  EXPECT_GT(memory_available().bytes, 1e6);
  write_file(root / "proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    3000 kB\nSwapFree: 1000 kB\n");
  write_file(root / "proc/self/statm", "100 0 0 0 0 0 0\n");
  EXPECT_EQ(memory_available(root.path()).bytes, 4000 * 1024);
  write_file(root / "proc/self/statm", "100 10 0 0 0 0 0\n");
  EXPECT_GT(memory_available(root.path()).bytes, 4000 * 1024);
}

TEST(MemoryAvailable, IsTheLeastThatAControlGroupLeaves) {
  const TemporaryFolder root;
  write_file(root / "proc/meminfo", "MemAvailable:    30000 kB\n");
  write_file(root / "proc/self/cgroup", "0::/jobs/mine\n");
  write_file(root / "sys/fs/cgroup/jobs/mine/memory.max", "max\n");
  write_file(root / "sys/fs/cgroup/jobs/mine/memory.current", "50\n");
  write_file(root / "sys/fs/cgroup/jobs/memory.max", "5000000\n");
  write_file(root / "sys/fs/cgroup/jobs/memory.current", "4000000\n");
  write_file(root / "sys/fs/cgroup/jobs/memory.stat", "anon 1000000\nfile 2500000\n");
  const MemoryAvailable available = memory_available(root.path());
  EXPECT_EQ(available.bytes, 3500000);
  EXPECT_EQ(available.source, "the control group's limit");
  write_file(root / "proc/self/cgroup", "5:cpu,memory:/old\n");
  write_file(root / "sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
  write_file(root / "sys/fs/cgroup/memory/memory.usage_in_bytes", "7000\n");
  write_file(root / "sys/fs/cgroup/memory/old/memory.limit_in_bytes", "2000000\n");
  write_file(root / "sys/fs/cgroup/memory/old/memory.usage_in_bytes", "500000\n");
  EXPECT_EQ(memory_available(root.path()).bytes, 1500000);
}

}  // namespace
}  // namespace polynya::io
