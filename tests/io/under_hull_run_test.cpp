// A run whose ice goes under a hull, read back: what is under, what came up, and thinned frames.
#include "scene_text.hpp"
#include "temporary_folder.hpp"

#include "io/run/run_loop.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::io {
namespace {

/// 35 s into a small plate, in drifting water: what is under the hull moves.
class UnderHullRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new tests::TemporaryFolder;
    const LoadedScene loaded = tests::load(tests::scene(
        {R"("time": {"step_s": 0.01, "until_s": 35}, "water": {"drift_m_per_s": [0, 0.1]})",
         R"("floes": [{"rectangle": {"corner_m": [0, -25], "size_m": [100, 50]}}])",
         tests::list("ships", {tests::ship(R"("hull": {"length_m": 40, "beam_m": 8, "draught_m": 2}, "mass_kg": 1e6,
           "moment_of_inertia_kg_m2": 1e8, "position_m": [-21, 0], "propulsion": {"constant_speed_m_per_s": 2})")})}));
    auto active = tests::checked(start_run(folder->path() / "run", loaded, true));
    ASSERT_EQ(run_to_end(*active).end, RunEnd::kFinished);
    auto read = tests::checked(read_run(folder->path() / "run"));
    run = new io::Run(std::move(*read));
  }
  static void TearDownTestSuite() {
    delete run;
    delete folder;
  }
  static inline tests::TemporaryFolder* folder = nullptr;
  static inline io::Run* run = nullptr;
};

TEST_F(UnderHullRun, BrashIsWhatCameUpAndWhatItBrokeInto) {
  std::size_t came_up = 0;
  for (const RunFloe& floe : run->floes) {
    const RunFloe* parent = run->floe(floe.birth.parent);
    const bool rose = parent && run->events.at(*parent->death_event).is<simulation::Resurface>();
    EXPECT_EQ(floe.came_up, rose || (parent && parent->came_up)) << floe.birth.floe;
    came_up += floe.came_up;
  }
  EXPECT_GT(came_up, 5U);
}

TEST_F(UnderHullRun, EveryFloeEitherFloatsOrIsUnder) {
  const MotionIndex motions(*run);
  for (const Frame& frame : run->frames) {
    const auto floating = floes_at(*run, motions, frame.time), under = floes_under_hulls_at(*run, motions, frame.time);
    std::size_t there = 0;
    for (const RunFloe& floe : run->floes) there += floe.birth.time <= frame.time && frame.time < floe.died ? 1 : 0;
    EXPECT_EQ(floating.size() + under.size(), there) << frame.time;
  }
  EXPECT_GE(floes_under_hulls_at(*run, motions, run->end_time()).size(), 5U);
}

TEST_F(UnderHullRun, ThinnedFramesHaveWhatIsUnderWhereItIs) {
  io::Run thin = *run;
  thin.frames = thinned_frames(*run, {.every = 4});
  ASSERT_LT(thin.frames.size(), run->frames.size() / 2);
  const MotionIndex all(*run), some(thin);
  std::size_t compared = 0;
  for (const Frame& frame : thin.frames) {
    for (const PlacedFloe& floe : floes_under_hulls_at(*run, all, frame.time)) {
      const auto motion = tests::checked(some.floe_at(floe.birth->floe, frame.time));
      EXPECT_LT(distance(motion->position, floe.motion->position), 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20U);
}

}  // namespace
}  // namespace polynya::io
