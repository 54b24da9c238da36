#pragma once

#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/run_reader.hpp"

namespace polynya::tests {

/// One real run for all tests of a command: an icebreaker 30 s into a plate.
class PlateRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    const Outcome outcome = polynya("run scenes/level-plate.json --until 30 --out run", *folder);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    auto read = io::read_run(folder->path() / "run");
    ASSERT_TRUE(read.has_value()) << read.error();
    run = new io::Run(std::move(*read));
    ASSERT_GT(run->events.size(), 5U);
  }
  static void TearDownTestSuite() {
    delete run;
    delete folder;
  }
  /// The command with the run's folder, or another of that folder's, and more words.
  static Outcome on_run(const std::string& command, const Words& words, const std::string& of = "run") {
    return polynya(Words{command, of} + words, *folder);
  }

  static inline TemporaryFolder* folder = nullptr;
  static inline io::Run* run = nullptr;
};

}  // namespace polynya::tests
