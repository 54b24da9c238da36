#include "crash_trials.hpp"
#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

namespace fs = std::filesystem;

/// A run that was killed when it had two checkpoints, beside the same run uninterrupted.
class Resume : public testing::Test {
 protected:
  void interrupt() {
    write_file(folder_ / "scene.json", crash_scene("100"));
    ASSERT_EQ(polynya({"run", "scene.json", "--out", "whole"}, start_).code, 0);
    ASSERT_TRUE(kill_at_checkpoints({"run", "scene.json", "--out", "run", "--checkpoint-every", "1"}, start_,
                                    folder_ / "run", 2))
        << "it ended before it was killed";
    checkpoints_ = io::checkpoints_in(folder_ / "run");
    ASSERT_EQ(checkpoints_.size(), 2U);
  }
  Outcome resume(std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"resume", "run"});
    return polynya(more, start_);
  }
  std::string difference() const { return first_difference(folder_ / "whole", folder_ / "run"); }

  const TemporaryFolder folder_;
  const Start start_{folder_.path()};
  std::vector<fs::path> checkpoints_;  // the newest first
};

TEST_F(Resume, GivesTheBytesOfTheRunNobodyInterrupted) {
  interrupt();
  const Outcome resumed = resume();
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find(checkpoints_[0].filename().string()), std::string::npos) << resumed.err;
  EXPECT_EQ(difference(), "");
  EXPECT_TRUE(io::checkpoints_in(folder_ / "run").empty()) << "a finished run keeps none";
  const Outcome again = resume();
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("finished"), std::string::npos);
}

/// The map is drawn from the finished folder: a kill may come between.
TEST_F(Resume, AFinishedRunWithoutItsMapGetsIt) {
  interrupt();
  ASSERT_EQ(resume().code, 0);
  for (const auto name : {io::run_file::kFinalSvg, io::run_file::kFinalPng}) {
    const auto map = folder_ / "run" / name;
    if (!fs::exists(map)) continue;  // a PNG needs rsvg-convert
    const std::string drawn = read_file(map);
    fs::remove(map);
    EXPECT_EQ(resume().code, 0);
    EXPECT_EQ(read_file(map), drawn) << name;
  }
}

TEST_F(Resume, WhatRunsPastTheCheckpointIsCutBack) {
  interrupt();
  for (const auto name : {io::run_file::kForces, io::run_file::kEvents, io::run_file::kFloes,
                          io::run_file::kFrames, io::run_file::kContacts})
    write_file(folder_ / "run" / name, read_file(folder_ / "run" / name) + "half a li");
  EXPECT_EQ(resume({"--checkpoint", checkpoints_[1].string()}).code, 0);
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, ADamagedCheckpointIsNamedAndRefusedAndTheOlderOneOffered) {
  interrupt();
  const std::string good = read_file(checkpoints_[0]);
  for (const std::size_t at :
       {std::size_t{0}, std::size_t{9}, std::size_t{20}, good.size() / 2, good.size() - 1}) {
    std::string damaged = good;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_file(checkpoints_[0], damaged);
    const std::string forces = read_file(folder_ / "run/forces.csv");
    const Outcome refused = resume();
    EXPECT_EQ(refused.code, 5);
    EXPECT_NE(refused.err.find(checkpoints_[0].filename().string() + ": "), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("--checkpoint run/" + checkpoints_[1].filename().string()), std::string::npos)
        << refused.err;
    EXPECT_EQ(read_file(folder_ / "run/forces.csv"), forces) << "nothing is touched";
  }
  write_file(checkpoints_[0], good.substr(0, good.size() / 3));
  EXPECT_NE(resume().err.find("damaged"), std::string::npos);
  EXPECT_EQ(resume({"--checkpoint", checkpoints_[1].string()}).code, 0);
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, ACheckpointOfAnotherRunIsRefused) {
  interrupt();
  write_file(folder_ / "other.json", crash_scene("99"));
  ASSERT_TRUE(kill_at_checkpoints({"run", "other.json", "--out", "other", "--checkpoint-every", "1"}, start_,
                                  folder_ / "other", 2));
  const Outcome refused = resume({"--checkpoint", io::checkpoints_in(folder_ / "other").front().string()});
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("of another run"), std::string::npos) << refused.err;
  EXPECT_NE(resume({"--checkpoint", "scene.json"}).err.find("not a checkpoint"), std::string::npos);
  EXPECT_NE(resume({"--checkpoint", "nowhere.bin"}).err.find("no such file"), std::string::npos);
}

/// A run of another version, whose forces.csv has other columns.
TEST_F(Resume, RowsAreNotWrittenUnderAnotherHeader) {
  interrupt();
  const auto forces = folder_ / "run" / io::run_file::kForces;
  std::string text = read_file(forces);
  text.replace(text.find("surge_N"), 7, "other_N");
  write_file(forces, text);
  const Outcome refused = resume();
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("its columns are those of another version"), std::string::npos) << refused.err;
  EXPECT_EQ(read_file(forces), text) << "nothing is cut back";
}

TEST_F(Resume, OutputThatIsMissingIsRefused) {
  interrupt();
  const std::string events = read_file(folder_ / "run/events.ndjson");
  const std::string forces = read_file(folder_ / "run/forces.csv");
  write_file(folder_ / "run/forces.csv", forces.substr(0, 200));
  const Outcome refused = resume();
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("forces.csv: 200 bytes; at the checkpoint there were"), std::string::npos)
      << refused.err;
  EXPECT_EQ(read_file(folder_ / "run/events.ndjson"), events)
      << "nothing is cut back before all is known to be there";
}

TEST_F(Resume, BeforeTheFirstCheckpointItBeginsAnew) {
  interrupt();
  for (const fs::path& checkpoint : checkpoints_) fs::remove(checkpoint);
  const Outcome resumed = resume();
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("from the start"), std::string::npos);
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, AFolderThatIsNoRunIsFive) {
  EXPECT_EQ(polynya({"resume", "nowhere"}, start_).code, 5);
  fs::create_directory(folder_ / "empty");
  const Outcome refused = polynya({"resume", "empty"}, start_);
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("no run to resume"), std::string::npos);
}

TEST_F(Resume, ASignalStopsWithACheckpointAndNobodyElseMayWriteMeanwhile) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  write_file(folder_ / "long.json", crash_scene("1e5"));
  const pid_t child = start_polynya({"run", "long.json", "--out", "run", "--checkpoint-every", "1"}, start_);
  while (!has_ended(child) && io::checkpoints_in(folder_ / "run").empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const TemporaryFolder elsewhere;
  const Start beside{elsewhere.path()};
  for (const auto& words :
       {std::vector<std::string>{"resume", folder_ / "run"},
        std::vector<std::string>{"run", folder_ / "scene.json", "--out", folder_ / "run", "--overwrite"}}) {
    const Outcome locked = polynya(words, beside);
    EXPECT_EQ(locked.code, 5);
    EXPECT_NE(locked.err.find("another polynya is writing this run"), std::string::npos) << locked.err;
  }
  kill(child, SIGTERM);
  const Outcome stopped = wait_for(child, start_);
  EXPECT_EQ(stopped.code, 75) << stopped.err;
  EXPECT_NE(stopped.err.find("polynya resume run"), std::string::npos) << stopped.err;
  EXPECT_FALSE(io::checkpoints_in(folder_ / "run").empty());
  EXPECT_LE(io::checkpoints_in(folder_ / "run").size(), 2U);
}

/// A size limit stands for a full disk, of 64 kB: forces.csv or floes.ndjson meets it. After it is lifted,
/// all is well.
TEST_F(Resume, AfterAFullDiskTheRunGoesOn) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  ASSERT_EQ(polynya({"run", "scene.json", "--out", "whole"}, start_).code, 0);
  for (const rlim_t limit : {20'000, 100'000, 150'000}) {
    const Start full{folder_.path(), limit};
    const Outcome stopped =
        polynya({"run", "scene.json", "--out", "run", "--overwrite", "--checkpoint-every", "1"}, full);
    EXPECT_EQ(stopped.code, 5);
    EXPECT_NE(stopped.err.find("File too large"), std::string::npos) << stopped.err;
    EXPECT_NE(stopped.err.find("polynya resume run"), std::string::npos) << stopped.err;
    const auto summary = io::parse_json(read_file(folder_ / "run/summary.json"));
    EXPECT_TRUE(summary.faults.empty());
    const Outcome resumed = resume();
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(difference(), "") << limit;
  }
}

/// A ship that is pushed out of all proportion: it breaks ice, and then runs away.
TEST_F(Resume, AFailureIsDumpedAndRepeated) {
  write_file(folder_ / "scene.json", R"({"time": {"step_s": 0.01, "until_s": 60},
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30},
      "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0], "propulsion": {"thrust_N": 9e8}}],
    "floes": [{"rectangle": {"corner_m": [0, -30], "size_m": [40, 60]}}]})");
  const Outcome failed = polynya({"run", "scene.json", "--out", "run", "--checkpoint-every", "4"}, start_);
  ASSERT_EQ(failed.code, 4) << failed.err;
  EXPECT_NE(failed.err.find("--from-failure"), std::string::npos) << failed.err;
  const std::string states = read_file(folder_ / "run/states.csv");
  const Outcome repeated = resume({"--from-failure"});
  EXPECT_EQ(repeated.code, 4) << repeated.err;
  EXPECT_NE(repeated.out.find("\nreproduced\n"), std::string::npos) << repeated.out;
  EXPECT_EQ(resume({"--from-failure"}).out, repeated.out);
  EXPECT_EQ(read_file(folder_ / "run/states.csv"), states) << "nothing is written";
  // The same dump comes of a run without any checkpoint.
  ASSERT_EQ(polynya({"run", "scene.json", "--out", "other"}, start_).code, 4);
  EXPECT_EQ(polynya({"resume", "other", "--from-failure"}, start_).out, repeated.out);
}

TEST_F(Resume, TheBytesAreTheSameOnAnyNumberOfThreads) {
  // 3000 awake floes jam against a cylinder: enough to be shared out among threads.
  write_file(folder_ / "scene.json", R"({"time": {"step_s": 0.05, "until_s": 20},
    "water": {"drift_m_per_s": [0.5, 0], "shear": {"rate_per_s": 0.0005, "origin_m": [0, 430]}},
    "record": {"frames_interval_s": 2}, "structures": [{"radius_m": 30, "position_m": [430, 430]}],
    "floes": [{"field": {"corner_m": [0, 0], "extent_m": 860, "floe_size_m": 14, "concentration": 0.8}}]})");
  for (const char* threads : {"1", "2", "8"}) {
    const Outcome outcome = polynya({"run", "scene.json", "--out", std::string("on") + threads, "--threads",
                                     threads, "--progress", "none"},
                                    start_);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("TBB"), std::string::npos) << outcome.err;
    EXPECT_EQ(first_difference(folder_ / "on1", folder_ / (std::string("on") + threads)), "") << threads;
  }
}

TEST_F(Resume, AFewKillsLoseAndDoubleNothing) {
  const CrashTally tally = crash_trials(4, 1);
  EXPECT_GE(tally.kills, 4);
}

}  // namespace
}  // namespace polynya::tests
