// Kills runs at random times, resumes them (and kills those too, every other time), and compares what they
// leave with an uninterrupted run. Four kills; POLYNYA_KILLS sets how many, and the ctest label `crash` has a
// hundred.
#include <cstdlib>
#include <iostream>
#include <random>

#include "interrupted_run.hpp"

namespace polynya::tests {
namespace {

struct CrashTally {
  int runs = 0;
  int kills = 0;            ///< by SIGKILL, of runs and of resumed runs, at random times
  int before_anything = 0;  ///< of them, before the run folder had its scene
  int resumed = 0;          ///< runs that ended after a resume from a checkpoint
  int restarted = 0;        ///< and from the start, no checkpoint being there yet
};

CrashTally crash_trials(int kills, unsigned seed) {
  std::cout << "seed " << seed << std::endl;  // before any fork
  std::mt19937 random(seed);
  const TemporaryFolder folder;
  const Start start{.folder = folder.path(), .arrange_streams = [] { setenv("PATH", "/", 1); }};  // no rsvg-convert
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
