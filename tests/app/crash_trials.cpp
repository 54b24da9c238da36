#include "crash_trials.hpp"

#include <iostream>
#include <random>

#include "interrupted_run.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {

CrashTally crash_trials(int kills, unsigned seed) {
  std::cout << "seed " << seed << std::endl;  // before any fork
  std::mt19937 random(seed);
  const TemporaryFolder folder;
  const Start start{.folder = folder.path(),
                    .arrange_streams = [] { setenv("PATH", "/", 1); }};  // no rsvg-convert
  write_file(folder / "scene.json", crash_scene("100"));
  const Words often = "--checkpoint-every 4 --progress none";
  const auto begin = std::chrono::steady_clock::now();
  const Outcome whole = polynya(Words("run scene.json --out whole") + often, start);
  const auto duration =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
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
    EXPECT_TRUE(io::checkpoints_in(run).empty());
  }
  return tally;
}

}  // namespace polynya::tests
