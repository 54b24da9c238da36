#pragma once

namespace polynya::tests {

struct CrashTally {
  int runs = 0;
  int kills = 0;            ///< by SIGKILL, of runs and of resumed runs, at random times
  int before_anything = 0;  ///< of them, before the run folder had its scene
  int resumed = 0;          ///< runs that ended after a resume from a checkpoint
  int restarted = 0;        ///< and from the start, no checkpoint being there yet
};

/// Kills runs at random times, resumes them (and kills those too, every other time), and compares what they
/// leave with an uninterrupted run. Fails the test at the first difference.
CrashTally crash_trials(int kills, unsigned seed);

}  // namespace polynya::tests
