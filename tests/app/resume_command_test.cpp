#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <random>

#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

namespace fs = std::filesystem;

/// Runs in a folder, without rsvg-convert, which takes seconds.
class Resume : public testing::Test {
 protected:
  /// Makes a run that was killed when it had two checkpoints, and the same run uninterrupted. A copy of the killed run
  /// is kept.
  void interrupt() {
    write_file(folder_ / "scene.json", crash_scene("100"));
    ASSERT_EQ(polynya("run scene.json --out whole", start_).code, 0);
    ASSERT_TRUE(kill_at_checkpoints("run scene.json --out run --checkpoint-every 1", start_, folder_ / "run", 2))
        << "it ended before it was killed";
    checkpoints_ = io::checkpoints_in(folder_ / "run");
    ASSERT_GE(checkpoints_.size(), 2U);
    for (; checkpoints_.size() > 2; checkpoints_.pop_back())  // killed before the oldest one went
      fs::remove(checkpoints_.back());
    fs::copy(folder_ / "run", folder_ / "killed");
  }
  void restore() {
    fs::remove_all(folder_ / "run");
    fs::copy(folder_ / "killed", folder_ / "run");
  }
  Outcome resume(const Words& more = {}) { return polynya(Words("resume run") + more, start_); }
  void expect_refused(const Words& more, const std::string& message) {
    const std::string forces = read_file(folder_ / "run/forces.csv"), events = read_file(folder_ / "run/events.ndjson");
    EXPECT_HAS(expect_code(5, resume(more)).err, message);
    EXPECT_EQ(read_file(folder_ / "run/forces.csv"), forces) << "nothing is cut back before all is there";
    EXPECT_EQ(read_file(folder_ / "run/events.ndjson"), events);
  }
  std::string difference() const { return first_difference(folder_ / "whole", folder_ / "run"); }

  const TemporaryFolder folder_;
  const Start start_ = without_converter(folder_);
  std::vector<fs::path> checkpoints_;  // the newest first
};

TEST_F(Resume, GivesTheBytesOfTheRunNobodyInterrupted) {
  interrupt();
  EXPECT_FALSE(checked(io::read_run(folder_ / "run"))->summary.find("finished")->boolean()) << "readable all the same";
  EXPECT_HAS(expect_code(0, resume()).err, checkpoints_[0].filename().string());
  EXPECT_EQ(difference(), "");
  EXPECT_EQ(io::checkpoints_in(folder_ / "run").size(), 1U) << "a finished run keeps that of its end";
  EXPECT_HAS(expect_code(0, resume()).err, "finished");
  // The map is drawn from the finished folder, so the run may be killed before it is drawn.
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
  EXPECT_HAS(resume().err, "starting from the beginning");
  EXPECT_EQ(difference(), "");
}

/// A kill after summary.json and before checksums.txt leaves the latter's beginning under another name. The end of the
/// run is then done again. Beside checksums that were there before (a picture was added) the remains are removed.
TEST_F(Resume, ARunThatWasKilledBeforeItsChecksumsWereWrittenGetsThem) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  ASSERT_EQ(polynya("run scene.json --out whole", start_).code, 0);
  const fs::path run = folder_ / "run", sums = run / io::run_file::kChecksums, remains = io::temporary_name(sums);
  for (const auto& [has_checksums, written] : {std::pair{false, 0}, {false, 40}, {true, 40}}) {
    SCOPED_TRACE(testing::Message() << has_checksums << ", " << written << " bytes");
    fs::remove_all(run);
    fs::copy(folder_ / "whole", run, fs::copy_options::recursive);
    write_file(remains, read_file(sums).substr(0, written));
    if (!has_checksums) fs::remove(sums);
    EXPECT_EQ(expect_code(0, resume()).err.find("has finished") != std::string::npos, has_checksums);
    EXPECT_FALSE(fs::exists(remains));
    EXPECT_TRUE(fs::exists(sums));
    EXPECT_EQ(difference(), "");
    EXPECT_HAS(expect_code(0, polynya("inspect run --check", start_)).out, "sound");
  }
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
    EXPECT_LACKS(expect_code(0, resume({"--until", until})).err, "starting from the beginning");
    EXPECT_EQ(difference(), "");
    EXPECT_EQ(read_file(folder_ / "run/final.svg"), read_file(folder_ / "whole/final.svg"));
    EXPECT_FALSE(fs::exists(folder_ / "run/view.html"));
  }
  EXPECT_HAS(resume("--until 40").err, "the run has finished at 60.5 s");
  EXPECT_EQ(difference(), "");
  // The folder is made like that of a version that kept no checkpoint.
  fs::remove(io::checkpoints_in(folder_ / "run").front());
  ASSERT_EQ(polynya("run scene.json --out whole --until 61 --overwrite", start_).code, 0);
  EXPECT_HAS(resume("--until 61").err, "starting from the beginning");
  EXPECT_EQ(difference(), "");
}

TEST_F(Resume, AKilledRunMayEndElsewhere) {
  interrupt();
  expect_refused("--until 0.5", "after the end of the run at 0.5 s");
  ASSERT_EQ(polynya("run scene.json --out whole --until 110 --overwrite", start_).code, 0);
  EXPECT_EQ(resume("--until 110").code, 0);
  EXPECT_EQ(difference(), "");
}

/// The test also checks that the folder is complete and states that the run is not finished.
TEST_F(Resume, ASignalStopsWithACheckpointAndNobodyElseMayWriteMeanwhile) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  write_file(folder_ / "long.json", crash_scene("4500"));
  for (const auto& [signal, name] : {std::pair{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}}) {
    fs::remove_all(folder_ / "run");
    const pid_t child = start_polynya("run long.json --out run --checkpoint-every 1", start_);
    const auto has_rows = [&] { return std::ranges::count(read_file(folder_ / "run/forces.csv"), '\n') > 1; };
    while (!has_ended(child) && (io::checkpoints_in(folder_ / "run").empty() || !has_rows()))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const TemporaryFolder elsewhere;
    const std::string run_folder = folder_ / "run";
    for (const Words& words :
         {Words{"resume", run_folder}, {"run", folder_ / "scene.json", "--out", run_folder, "--overwrite"}})
      EXPECT_HAS(expect_code(5, polynya(words, elsewhere)).err, "another polynya is writing this run");
    kill(child, signal);
    EXPECT_HAS(expect_code(75, wait_for(child, start_)).err, name, "polynya resume run");
    const std::size_t kept = io::checkpoints_in(run_folder).size();
    EXPECT_TRUE(kept == 1 || kept == 2) << kept;
    const auto run = checked(io::read_run(folder_ / "run"));
    EXPECT_FALSE(run->summary.find("finished")->boolean());
    EXPECT_GT(run->samples.size(), 0U);
    EXPECT_TRUE(fs::exists(folder_ / "run/final.svg"));
    for (const auto file : {io::run_file::kForces, io::run_file::kEvents})
      EXPECT_EQ(read_file(folder_ / "run" / file).back(), '\n') << file;
  }
}

/// A limit on the size of files simulates a full disk: forces.csv or floes.ndjson reaches it. After the limit is
/// removed, the run continues.
TEST_F(Resume, AfterAFullDiskTheRunGoesOn) {
  write_file(folder_ / "scene.json", crash_scene("100"));
  ASSERT_EQ(polynya("run scene.json --out whole", start_).code, 0);
  for (const rlim_t limit : {20'000, 100'000, 150'000}) {
    const Start full{folder_.path(), limit};
    const Outcome stopped = expect_code(5, polynya("run scene.json --out run --overwrite --checkpoint-every 1", full));
    EXPECT_HAS(stopped.err, "File too large", "polynya resume run");
    EXPECT_TRUE(io::parse_json(read_file(folder_ / "run/summary.json")).faults.empty());
    expect_code(0, resume());
    EXPECT_EQ(difference(), "") << limit;
  }
}

TEST_F(Resume, AFailureIsDumpedAndRepeated) {
  write_file(folder_ / "scene.json", R"({"time": {"step_s": 0.01, "until_s": 60},
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30},
      "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0], "propulsion": {"thrust_N": 0},
      "mooring": {"position_m": [2000, 0], "surge_stiffness_N_per_m": 5e6}}],
    "floes": [{"rectangle": {"corner_m": [0, -30], "size_m": [40, 60]}}]})");
  EXPECT_HAS(expect_code(4, polynya("run scene.json --out run --checkpoint-every 4", start_)).err, "--from-failure");
  const std::string states = read_file(folder_ / "run/states.csv");
  const Outcome repeated = expect_code(4, resume("--from-failure"));
  EXPECT_HAS(repeated.out, "\nreproduced\n");
  EXPECT_EQ(resume("--from-failure").out, repeated.out);
  EXPECT_EQ(read_file(folder_ / "run/states.csv"), states) << "nothing is written";
  // A run without any checkpoint leads to the same dump.
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
    const std::string out = std::string("on") + threads;
    const Words words{"run", "scene.json", "--out", out, "--threads", threads, "--progress", "none"};
    EXPECT_LACKS(expect_code(0, polynya(words, start_)).err, "TBB");
    EXPECT_EQ(first_difference(folder_ / "on1", folder_ / out), "") << threads;
  }
}

// ---- kills at random times

struct CrashTally {
  int runs = 0;
  int kills = 0;            ///< number of SIGKILLs of runs and of resumed runs, at random times
  int before_anything = 0;  ///< number of kills before the run folder had its scene
  int resumed = 0;          ///< runs that ended after a resume from a checkpoint
  int restarted = 0;        ///< number of restarts from the start, because no checkpoint existed
};

CrashTally crash_trials(int kills, unsigned seed) {
  std::cout << "seed " << seed << std::endl;  // before any fork
  std::mt19937 random(seed);
  const TemporaryFolder folder;
  const Start start = without_converter(folder);
  write_file(folder / "scene.json", crash_scene("100"));
  const Words often = "--checkpoint-every 4 --progress none";
  const auto begin = std::chrono::steady_clock::now();
  const Outcome whole = polynya(Words("run scene.json --out whole") + often, start);
  const auto duration = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
  CrashTally tally;
  EXPECT_EQ(whole.code, 0) << whole.err;
  if (whole.code != 0) return tally;
  std::uniform_int_distribution<long> delay(0, duration.count());
  const auto run = folder / "run";
  while (tally.kills < kills && !testing::Test::HasFailure()) {
    std::filesystem::remove_all(run);
    bool is_killed = kill_after(start_polynya(Words("run scene.json --out run") + often, start), start,
                                std::chrono::microseconds(delay(random)));
    ++tally.runs;
    while (is_killed) {
      ++tally.kills;
      if (!std::filesystem::exists(run / io::run_file::kScene)) {
        ++tally.before_anything;  // nothing was there yet that could be lost
        break;
      }
      const bool has_checkpoint = !io::checkpoints_in(run).empty();
      const pid_t child = start_polynya(Words("resume run") + often, start);
      if (tally.kills < kills && random() % 2 == 0) {
        is_killed = kill_after(child, start, std::chrono::microseconds(delay(random)));
        if (is_killed) continue;
      }
      is_killed = false;
      const Outcome resumed = wait_for(child, start);
      EXPECT_TRUE(resumed.code == 0 || resumed.code == -1) << resumed.err;  // −1: it was waited for above
      ++(has_checkpoint ? tally.resumed : tally.restarted);
    }
    if (!std::filesystem::exists(run / io::run_file::kScene)) continue;
    EXPECT_EQ(first_difference(folder / "whole", run), "") << "after " << tally.kills << " kills";
    EXPECT_EQ(io::checkpoints_in(run).size(), 1U);
  }
  return tally;
}

TEST(Crash, KillsLoseAndDoubleNothing) {
  const char* wanted = std::getenv("POLYNYA_KILLS");
  const int kills = wanted ? std::atoi(wanted) : 4;
  const CrashTally tally = crash_trials(kills, wanted ? 7 : 1);
  std::cout << tally.kills << " kills of " << tally.runs << " runs: " << tally.resumed << " resumed from a checkpoint, "
            << tally.restarted << " begun again before the first, " << tally.before_anything
            << " killed before the scene was written; every file as in the uninterrupted run\n";
  EXPECT_GE(tally.kills, kills);
  EXPECT_GE(tally.resumed, wanted ? 3 * kills / 10 : 0);
}

}  // namespace
}  // namespace polynya::tests
