#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

namespace fs = std::filesystem;

/// Runs in a folder, without rsvg-convert, which takes seconds.
class Resume : public testing::Test {
 protected:
  /// A run that was killed when it had two checkpoints, beside the same run uninterrupted; a copy of it is
  /// kept.
  void interrupt() {
    write_file(folder_ / "scene.json", crash_scene("100"));
    ASSERT_EQ(polynya("run scene.json --out whole", start_).code, 0);
    ASSERT_TRUE(kill_at_checkpoints("run scene.json --out run --checkpoint-every 1", start_, folder_ / "run", 2))
        << "it ended before it was killed";
    checkpoints_ = io::checkpoints_in(folder_ / "run");
    ASSERT_EQ(checkpoints_.size(), 2U);
    fs::copy(folder_ / "run", folder_ / "killed");
  }
  void restore() {
    fs::remove_all(folder_ / "run");
    fs::copy(folder_ / "killed", folder_ / "run");
  }
  Outcome resume(const Words& more = {}) { return polynya(Words("resume run") + more, start_); }
  void expect_refused(const Words& more, const std::string& message) {
    const std::string forces = read_file(folder_ / "run/forces.csv"), events = read_file(folder_ / "run/events.ndjson");
    const Outcome refused = resume(more);
    EXPECT_EQ(refused.code, 5);
    EXPECT_HAS(refused.err, message);
    EXPECT_EQ(read_file(folder_ / "run/forces.csv"), forces) << "nothing is cut back before all is there";
    EXPECT_EQ(read_file(folder_ / "run/events.ndjson"), events);
  }
  std::string difference() const { return first_difference(folder_ / "whole", folder_ / "run"); }

  const TemporaryFolder folder_;
  const Start start_{.folder = folder_.path(), .arrange_streams = [] { setenv("PATH", "/", 1); }};
  std::vector<fs::path> checkpoints_;  // the newest first
};

TEST_F(Resume, GivesTheBytesOfTheRunNobodyInterrupted) {
  interrupt();
  const Outcome resumed = resume();
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_HAS(resumed.err, checkpoints_[0].filename().string());
  EXPECT_EQ(difference(), "");
  EXPECT_EQ(io::checkpoints_in(folder_ / "run").size(), 1U) << "a finished run keeps that of its end";
  const Outcome again = resume();
  EXPECT_EQ(again.code, 0);
  EXPECT_HAS(again.err, "finished");
  // The map is drawn from the finished folder: a kill may come between.
  const std::string map = read_file(folder_ / "run/final.svg");
  fs::remove(folder_ / "run/final.svg");
  EXPECT_EQ(resume().code, 0);
  EXPECT_EQ(read_file(folder_ / "run/final.svg"), map);

  restore();  // and rows behind the checkpoint's
  for (const auto name : {io::run_file::kForces, io::run_file::kEvents, io::run_file::kFloes, io::run_file::kFrames,
                          io::run_file::kContacts})
    write_file(folder_ / "run" / name, read_file(folder_ / "run" / name) + "half a li");
  EXPECT_EQ(resume({"--checkpoint", checkpoints_[1]}).code, 0);
  EXPECT_EQ(difference(), "");

  restore();
  for (const fs::path& checkpoint : checkpoints_) fs::remove(checkpoint);
  EXPECT_HAS(resume().err, "from the start");
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, WhatIsDamagedMissingOrOfAnotherRunIsRefused) {
  interrupt();
  const std::string newest = checkpoints_[0].filename(), older = checkpoints_[1].filename();
  const std::string good = read_file(checkpoints_[0]);
  for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{20}, good.size() / 2, good.size() - 1}) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_file(checkpoints_[0], damaged);
    expect_refused({}, newest + ": ");
    expect_refused({}, "--checkpoint run/" + older);
  }
  write_file(checkpoints_[0], good.substr(0, good.size() / 3));
  expect_refused({}, "damaged");

  restore();
  write_file(folder_ / "other.json", replaced(crash_scene("100"), "2e6", "3e6"));
  ASSERT_TRUE(kill_at_checkpoints("run other.json --out other --checkpoint-every 1", start_, folder_ / "other", 2));
  expect_refused({"--checkpoint", io::checkpoints_in(folder_ / "other").front()}, "of another run");
  expect_refused("--checkpoint scene.json", "not a checkpoint");
  expect_refused("--checkpoint nowhere.bin", "no such file");

  const std::string forces = read_file(folder_ / "run/forces.csv");
  write_file(folder_ / "run/forces.csv", replaced(forces, "surge_N", "other_N"));
  expect_refused({}, "its columns are those of another version");
  write_file(folder_ / "run/forces.csv", forces.substr(0, 200));
  expect_refused({}, "forces.csv: 200 bytes; at the checkpoint there were");
}

/// Ends that fall between frames and on one; products of the shorter run, which no longer run has.
TEST_F(Resume, AFinishedRunGoesOnToALaterEnd) {
  write_file(folder_ / "scene.json", crash_scene("60"));
  ASSERT_EQ(polynya("run scene.json --out run --until 30.3", start_).code, 0);
  ASSERT_EQ(polynya("view run", start_).code, 0);
  for (const char* until : {"41", "60.5"}) {
    ASSERT_EQ(polynya({"run", "scene.json", "--out", "whole", "--until", until, "--overwrite"}, start_).code, 0);
    const Outcome longer = resume({"--until", until});
    EXPECT_EQ(longer.code, 0) << longer.err;
    EXPECT_LACKS(longer.err, "from the start");
    EXPECT_EQ(difference(), "");
    EXPECT_EQ(read_file(folder_ / "run/final.svg"), read_file(folder_ / "whole/final.svg"));
    EXPECT_FALSE(fs::exists(folder_ / "run/view.html"));
  }
  EXPECT_HAS(resume("--until 40").err, "the run is finished, at 60.5 s");
  EXPECT_EQ(difference(), "");
  // One of a version that kept no checkpoint.
  fs::remove(io::checkpoints_in(folder_ / "run").front());
  ASSERT_EQ(polynya("run scene.json --out whole --until 61 --overwrite", start_).code, 0);
  EXPECT_HAS(resume("--until 61").err, "from the start");
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, AKilledRunMayEndElsewhere) {
  interrupt();
  expect_refused("--until 0.5", "behind the end of the run at 0.5 s");
  ASSERT_EQ(polynya("run scene.json --out whole --until 110 --overwrite", start_).code, 0);
  EXPECT_EQ(resume("--until 110").code, 0);
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, ASignalStopsWithACheckpointAndNobodyElseMayWriteMeanwhile) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  write_file(folder_ / "long.json", crash_scene("1e5"));
  const pid_t child = start_polynya("run long.json --out run --checkpoint-every 1", start_);
  while (!has_ended(child) && io::checkpoints_in(folder_ / "run").empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const TemporaryFolder elsewhere;
  const Start beside{elsewhere.path()};
  for (const auto& words : {Words{"resume", folder_ / "run"},
                            Words{"run", folder_ / "scene.json", "--out", folder_ / "run", "--overwrite"}}) {
    const Outcome locked = polynya(words, beside);
    EXPECT_EQ(locked.code, 5);
    EXPECT_HAS(locked.err, "another polynya is writing this run");
  }
  kill(child, SIGTERM);
  const Outcome stopped = wait_for(child, start_);
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_HAS(stopped.err, "polynya resume run");
  EXPECT_FALSE(io::checkpoints_in(folder_ / "run").empty());
  EXPECT_LE(io::checkpoints_in(folder_ / "run").size(), 2U);
}

/// A size limit stands for a full disk, of 64 kB: forces.csv or floes.ndjson meets it. After it is lifted,
/// all is well.
TEST_F(Resume, AfterAFullDiskTheRunGoesOn) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  ASSERT_EQ(polynya("run scene.json --out whole", start_).code, 0);
  for (const rlim_t limit : {20'000, 100'000, 150'000}) {
    const Start full{folder_.path(), limit};
    const Outcome stopped = polynya("run scene.json --out run --overwrite --checkpoint-every 1", full);
    EXPECT_EQ(stopped.code, 5);
    EXPECT_HAS(stopped.err, "File too large");
    EXPECT_HAS(stopped.err, "polynya resume run");
    const auto summary = io::parse_json(read_file(folder_ / "run/summary.json"));
    EXPECT_TRUE(summary.faults.empty());
    const Outcome resumed = resume();
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(difference(), "") << limit;
  }
}

TEST_F(Resume, AFailureIsDumpedAndRepeated) {
  write_file(folder_ / "scene.json", R"({"time": {"step_s": 0.01, "until_s": 60},
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30},
      "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0], "propulsion": {"thrust_N": 9e8}}],
    "floes": [{"rectangle": {"corner_m": [0, -30], "size_m": [40, 60]}}]})");
  const Outcome failed = polynya("run scene.json --out run --checkpoint-every 4", start_);
  ASSERT_EQ(failed.code, 4) << failed.err;
  EXPECT_HAS(failed.err, "--from-failure");
  const std::string states = read_file(folder_ / "run/states.csv");
  const Outcome repeated = resume("--from-failure");
  EXPECT_EQ(repeated.code, 4) << repeated.err;
  EXPECT_HAS(repeated.out, "\nreproduced\n");
  EXPECT_EQ(resume("--from-failure").out, repeated.out);
  EXPECT_EQ(read_file(folder_ / "run/states.csv"), states) << "nothing is written";
  // The same dump comes of a run without any checkpoint.
  ASSERT_EQ(polynya("run scene.json --out other", start_).code, 4);
  EXPECT_EQ(polynya("resume other --from-failure", start_).out, repeated.out);
}

TEST_F(Resume, TheBytesAreTheSameOnAnyNumberOfThreads) {
  // 3000 awake floes jam against a cylinder: enough to be shared out among threads.
  write_file(folder_ / "scene.json", R"({"time": {"step_s": 0.05, "until_s": 20},
    "water": {"drift_m_per_s": [0.5, 0], "shear": {"rate_per_s": 0.0005, "origin_m": [0, 430]}},
    "record": {"frames_interval_s": 2}, "structures": [{"radius_m": 30, "position_m": [430, 430]}],
    "floes": [{"field": {"corner_m": [0, 0], "extent_m": 860, "floe_size_m": 14, "concentration": 0.8}}]})");
  for (const char* threads : {"1", "2", "8"}) {
    const Outcome outcome =
        polynya({"run", "scene.json", "--out", std::string("on") + threads, "--threads", threads, "--progress", "none"},
                start_);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_LACKS(outcome.err, "TBB");
    EXPECT_EQ(first_difference(folder_ / "on1", folder_ / (std::string("on") + threads)), "") << threads;
  }
}

}  // namespace
}  // namespace polynya::tests
