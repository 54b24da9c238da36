#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"
#include <gtest/gtest.h>

#include "io/json_parser.hpp"
#include "io/run_folder.hpp"
#include "io/run_reader.hpp"

namespace polynya::tests {
namespace {

std::vector<std::string> run_for(const std::string& until, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"run", scene_path("level-plate"), "--until", until};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Lines of a text file; every one must be whole.
std::size_t whole_lines(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  EXPECT_TRUE(text.empty() || text.back() == '\n') << path;
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// Waits until a running run has put rows behind the header on disk. False where it ended before.
bool has_rows(pid_t child, const std::filesystem::path& forces) {
  while (true) {
    std::error_code not_there_yet;
    const auto size = std::filesystem::file_size(forces, not_there_yet);
    if (!not_there_yet && size > 2000) return true;
    siginfo_t ended{};
    if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        ended.si_pid == child)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST(RunCommand, WritesAFolderAndTellsTheResult) {
  const TemporaryFolder folder;
  const Outcome outcome = polynya(run_for("10"), {folder.path()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words :
       {"simulated   10 s", "real time", "cusps broken by bending", "splits", "imbalance", "peak force",
        "run folder  runs/level-plate", "picture     runs/level-plate/final."}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << "\n" << outcome.out;
  }
  const auto run = io::read_run(folder / "runs/level-plate");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_TRUE(run->summary.find("finished")->boolean());
  EXPECT_EQ(run->samples.size(), 100U);
  EXPECT_NEAR(run->end_time(), 10, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/level-plate/final.svg"));
  EXPECT_GT(run->summary.find("counts")->find("bends")->number(), 0);
}

TEST(RunCommand, TheSameSceneGivesTheSameBytesRunAfterRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya(run_for("20", {"--out", "a"}), {folder.path()}).code, 0);
  ASSERT_EQ(
      polynya(run_for("20", {"--out", "b", "--threads", "2", "--progress", "json"}), {folder.path()}).code,
      0);
  for (const auto name : {io::run_file::kForces, io::run_file::kEvents, io::run_file::kFloes,
                          io::run_file::kFrames, io::run_file::kContacts}) {
    const std::string a = read_file(folder.path() / "a" / name);
    EXPECT_FALSE(a.empty());
    EXPECT_TRUE(a == read_file(folder.path() / "b" / name)) << name;
  }
}

TEST(RunCommand, AnExistingRunIsKeptUnlessTold) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya(run_for("2"), {folder.path()}).code, 0);
  const std::string kept = read_file(folder / "runs/level-plate/forces.csv");
  const Outcome refused = polynya(run_for("3"), {folder.path()});
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(read_file(folder / "runs/level-plate/forces.csv"), kept);
  EXPECT_EQ(polynya(run_for("3", {"--overwrite"}), {folder.path()}).code, 0);
  EXPECT_NE(read_file(folder / "runs/level-plate/forces.csv"), kept);
}

/// The signal comes when the run has written something; then the folder must be whole and say that it is not
/// finished.
TEST(RunCommand, ASignalLeavesAWholeFolder) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    // Two floes that never stop: the run lasts as long as nobody ends it.
    const Start start{folder.path()};
    const pid_t child =
        start_polynya({"run", scene_path("sawamura2017-fig4c"), "--until", "1e6", "--out", "run"}, start);
    ASSERT_TRUE(has_rows(child, folder / "run/forces.csv")) << wait_for(child, start).err;
    kill(child, signal);
    const Outcome outcome = wait_for(child, start);
    EXPECT_EQ(outcome.code, 75) << outcome.err;
    EXPECT_NE(outcome.err.find(signal == SIGINT ? "SIGINT" : "SIGTERM"), std::string::npos);
    const auto run = io::read_run(folder / "run");
    ASSERT_TRUE(run.has_value()) << run.error();
    EXPECT_FALSE(run->summary.find("finished")->boolean());
    EXPECT_EQ(whole_lines(folder / "run/forces.csv"), run->samples.size() + 1);
    whole_lines(folder / "run/events.ndjson");
    EXPECT_TRUE(std::filesystem::exists(folder / "run/final.svg"));
  }
}

/// SIGKILL allows no last words: what is there must be readable all the same.
TEST(RunCommand, AKilledRunLeavesAUsableFolder) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  const pid_t child =
      start_polynya({"run", scene_path("sawamura2017-fig4c"), "--until", "1e6", "--out", "run"}, start);
  ASSERT_TRUE(has_rows(child, folder / "run/forces.csv")) << wait_for(child, start).err;
  kill(child, SIGKILL);
  EXPECT_EQ(wait_for(child, start).code, -SIGKILL);
  const auto run = io::read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_FALSE(run->summary.find("finished")->boolean());
  EXPECT_GT(run->samples.size(), 0U);
  EXPECT_EQ(whole_lines(folder / "run/forces.csv"), run->samples.size() + 1);
}

/// A size limit stands for a full disk.
TEST(RunCommand, AFullDiskIsFiveAndLeavesAUsableFolder) {
  const TemporaryFolder folder;
  const Start start{folder.path(), 20'000};
  const Outcome outcome = polynya(run_for("200", {"--out", "run"}), start);
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
  const auto run = io::read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_FALSE(run->summary.find("finished")->boolean());
  whole_lines(folder / "run/forces.csv");
  whole_lines(folder / "run/floes.ndjson");
}

TEST(RunCommand, AFolderThatCannotBeMadeIsFive) {
  const TemporaryFolder folder;
  write_file(folder / "file", "x");
  EXPECT_EQ(polynya(run_for("1", {"--out", "file/run"}), {folder.path()}).code, 5);
  EXPECT_EQ(polynya(run_for("1", {"--out", "file"}), {folder.path()}).code, 5);
}

TEST(RunCommand, JsonProgressIsOneObjectALine) {
  const TemporaryFolder folder;
  const Outcome outcome = polynya(run_for("5", {"--progress", "json"}), {folder.path()});
  ASSERT_EQ(outcome.code, 0);
  const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
  const auto document = io::parse_json(line);
  EXPECT_TRUE(document.faults.empty()) << line;
  for (const char* key :
       {"sim_time_s", "until_s", "wall_time_s", "real_time_factor", "time_left_s", "fractures"}) {
    EXPECT_NE(document.root.find(key), nullptr) << key;
  }
  const Outcome quiet = polynya(run_for("5", {"--progress", "none", "--out", "quiet"}), {folder.path()});
  EXPECT_EQ(quiet.err.find('%'), std::string::npos);
}

}  // namespace
}  // namespace polynya::tests
