// ctest -L crash

#include <iostream>

#include "crash_trials.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

TEST(CrashTrials, AHundredKillsLoseAndDoubleNothing) {
  const CrashTally tally = crash_trials(100, 7);
  std::cout << tally.kills << " kills of " << tally.runs << " runs: " << tally.resumed
            << " resumed from a checkpoint, " << tally.restarted << " begun again before the first, "
            << tally.before_anything
            << " killed before the scene was written; every file as in the uninterrupted run\n";
  EXPECT_GE(tally.kills, 100);
  EXPECT_GE(tally.resumed, 30);
}

}  // namespace
}  // namespace polynya::tests
