// The run loop as an embedder calls it: progress and stop are callbacks, the result is a value.
#include "io/run/run_loop.hpp"

#include <algorithm>

#include "expect_text.hpp"
#include "temporary_folder.hpp"

#include "io/run/checkpoint.hpp"
#include "io/run/run_folder.hpp"

namespace polynya::io {
namespace {

using tests::read_file;
using tests::TemporaryFolder;

LoadedScene load() {
  auto loaded = read_scene(R"({
    "name": "small", "time": {"step_s": 0.01, "until_s": 2},
    "record": {"forces_interval_s": 0.1, "frames_interval_s": 0.5},
    "ships": [{"hull": {"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30}, "mass_kg": 3e6,
               "moment_of_inertia_kg_m2": 5e8, "position_m": [-30.5, 2], "propulsion": {"constant_speed_m_per_s": 2}}],
    "floes": [{"rectangle": {"corner_m": [0, -20], "size_m": [60, 40]}}]})",
                           "small.json", ".");
  EXPECT_TRUE(loaded.has_value());
  return std::move(*loaded);
}

TEST(RunLoop, ReportsProgressAndFinishesTheFolder) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  auto run = start_run(folder / "run", scene);
  ASSERT_TRUE(run.has_value()) << run.error();
  std::vector<double> times;
  const RunResult result =
      run_to_end(*run, {.progress = [&](const RunStatus& at) { times.push_back(at.time); }});
  EXPECT_EQ(result.end, RunEnd::kFinished);
  EXPECT_EQ(result.reason, "");
  EXPECT_EQ(result.summary.steps, 200);
  EXPECT_GT(fractures_of(result.summary.counts), 0);
  EXPECT_TRUE(is_finished_run(folder / "run"));
  EXPECT_EQ(times.size(), 200 / 16);
  EXPECT_TRUE(std::ranges::is_sorted(times));
}

TEST(RunLoop, AStoppedRunIsResumedToTheSameBytes) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  auto whole = start_run(folder / "whole", scene);
  ASSERT_TRUE(whole.has_value()) << whole.error();
  EXPECT_EQ(run_to_end(*whole).end, RunEnd::kFinished);
  {
    auto run = start_run(folder / "run", scene);
    ASSERT_TRUE(run.has_value()) << run.error();
    int steps = 0;
    const RunResult result = run_to_end(*run, {.stop = [&]() -> std::optional<std::string> {
      return ++steps == 70 ? std::optional<std::string>("enough") : std::nullopt;
    }});
    EXPECT_EQ(result.end, RunEnd::kStopped);
    EXPECT_EQ(result.reason, "enough");
    EXPECT_EQ(result.summary.steps, 70);
    EXPECT_FALSE(result.summary.finished);
  }
  const auto checkpoints = checkpoints_in(folder / "run");
  ASSERT_EQ(checkpoints.size(), 1U);
  auto lock = RunLock::take(folder / "run");
  ASSERT_TRUE(lock.has_value()) << lock.error();
  auto resumed = resume_run(std::move(*lock), scene, checkpoints.front());
  ASSERT_TRUE(resumed.has_value()) << resumed.error();
  EXPECT_EQ(run_to_end(*resumed).end, RunEnd::kFinished);
  for (const auto name :
       {run_file::kForces, run_file::kEvents, run_file::kFloes, run_file::kFrames, run_file::kStates,
        run_file::kContacts, run_file::kCrushed, run_file::kFinalGeojson})
    EXPECT_EQ(read_file(folder / "run" / name), read_file(folder / "whole" / name)) << name;
}

TEST(RunLoop, ANumericalFailureAndALostFolderAreResults) {
  const TemporaryFolder folder;
  const LoadedScene scene = load();
  const auto runaway = read_scene(R"({"time": {"step_s": 0.01, "until_s": 60},
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7,
               "moment_of_inertia_kg_m2": 5e9, "propulsion": {"thrust_N": 9e8}}]})",
                                  "runaway.json", ".");
  ASSERT_TRUE(runaway.has_value());
  auto broken = start_run(folder / "broken", *runaway);
  ASSERT_TRUE(broken.has_value()) << broken.error();
  const RunResult failed = run_to_end(*broken);
  EXPECT_EQ(failed.end, RunEnd::kNumericalFailure);
  EXPECT_TRUE(failed.reason.starts_with("numerical failure: ")) << failed.reason;
  ASSERT_TRUE(failed.dump.has_value());
  EXPECT_TRUE(failed.dump->has_value()) << failed.dump->error();
  EXPECT_TRUE(std::filesystem::exists(folder / "broken" / run_file::kFailure));
  auto lost = start_run(folder / "lost", scene);
  ASSERT_TRUE(lost.has_value()) << lost.error();
  std::filesystem::remove_all(folder / "lost");
  const RunResult displaced = run_to_end(*lost);
  EXPECT_EQ(displaced.end, RunEnd::kFolderFailure);
  EXPECT_HAS(displaced.reason, "removed, moved or replaced");
}

/// Of many floes final.geojson is written on request; how long the files become is known before.
TEST(RunLoop, ALargeFinalGeojsonIsWrittenOnRequestAlone) {
  const TemporaryFolder folder;
  const auto scene = read_scene(R"({
    "name": "many", "time": {"step_s": 0.01, "until_s": 0.01},
    "floes": [{"lattice": {"origin_m": [0.1, 0.2], "columns": 320, "rows": 320, "pitch_m": [3.3, 3.3],
                           "size_m": [3.1, 3.1]}}]})",
                                "many.json", ".");
  ASSERT_TRUE(scene.has_value()) << to_string(scene.error().front());
  const FolderSize estimated = estimate_folder_size(scene->scene);
  for (const bool is_asked : {false, true}) {
    auto run = start_run(folder / "run", *scene, true);
    ASSERT_TRUE(run.has_value()) << run.error();
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

}  // namespace
}  // namespace polynya::io
