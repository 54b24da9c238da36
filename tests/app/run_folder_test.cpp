// State of a run folder after polynya is killed, after a power failure, and when the folder has other files in it.

#include <cstdlib>
#include <set>
#include <sstream>

#include "interrupted_run.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

namespace fs = std::filesystem;

/// Returns a command line for strace with options. LeakSanitizer cannot work under strace, so it is switched off.
Words strace(const Words& options) {
  return Words("env ASAN_OPTIONS=detect_leaks=0 strace -f") + options;
}

/// Returns a command line that kills the program at the n-th system call of the given name.
Words killed_at(const std::string& call, int n) {
  return strace("-o /dev/null -e trace=" + call + " -e inject=" + call +
                ":error=EIO:signal=KILL:when=" + std::to_string(n));
}

class RunFolderTrial : public testing::Test {
 protected:
  void SetUp() override {
    write_file(folder_ / "tiny.json", replaced(kTinyScene, "\"until_s\": 1", "\"until_s\": 3"));
    ASSERT_EQ(run_to("whole").code, 0);
    ASSERT_GT(read_file(folder_ / "whole/events.ndjson").size(), 0U);
  }
  static bool has_strace() { return std::system("strace -o /dev/null true >/dev/null 2>&1") == 0; }
  Outcome call(const Words& words, const Words& under = {}) const {
    return polynya(words, {.folder = folder_.path(), .under = under});
  }
  Outcome run_to(const std::string& name, const Words& more = {}, const Words& under = {}) const {
    return call(Words{"run", "tiny.json", "--out", name, "--progress", "none"} + more, under);
  }
  std::string difference(const std::string& name) const { return first_difference(folder_ / "whole", folder_ / name); }
  void leave_run(const std::string& name, std::int64_t end, const std::vector<std::int64_t>& checkpoints) const {
    tests::leave_run(folder_ / "tiny.json", folder_ / name, end, checkpoints, 50);
  }

  const TemporaryFolder folder_;
};

/// A kill at any call that changes the folder leaves a folder that the next run accepts. If resume accepts it, resume
/// brings the run to its end.
TEST_F(RunFolderTrial, AKillWhileARunIsReplacedLeavesAFolderThatIsTaken) {
  if (!has_strace()) GTEST_SKIP() << "no strace that works here";
  for (const auto& [call, stride] : {std::pair<std::string, int>("unlink", 12), {"rename", 2}}) {
    int kills = 0;
    for (int at = 2;; at += stride) {
      fs::remove_all(folder_ / "run");
      fs::copy(folder_ / "whole", folder_ / "run", fs::copy_options::recursive);
      const Outcome killed = run_to("run", {"--overwrite"}, killed_at(call, at));
      if (killed.code != -SIGKILL) break;
      SCOPED_TRACE(call + " " + std::to_string(at));
      ++kills;
      fs::remove_all(folder_ / "copy");
      fs::copy(folder_ / "run", folder_ / "copy", fs::copy_options::recursive);
      const Outcome resumed = this->call({"resume", "copy", "--progress", "none"});
      if (resumed.code == 0) {
        EXPECT_EQ(difference("copy"), "");
      } else {
        EXPECT_HAS(resumed.err, "polynya run SCENE --out copy --overwrite");
      }
      EXPECT_EQ(run_to("run", {"--overwrite"}).code, 0);
      ASSERT_EQ(difference("run"), "");
    }
    EXPECT_GE(kills, 3) << call;
  }
}

TEST_F(RunFolderTrial, AKillInAFreshFolderLeavesOneThatIsTaken) {
  if (!has_strace()) GTEST_SKIP() << "no strace that works here";
  for (const auto& [call, last] : {std::pair("mkdir", 1), {"flock", 1}, {"fsync", 4}, {"rename", 2}}) {
    for (int at = 1; at <= last; ++at) {
      SCOPED_TRACE(std::string(call) + " " + std::to_string(at));
      fs::remove_all(folder_ / "run");
      expect_code(-SIGKILL, run_to("run", {}, killed_at(call, at)));
      const bool has_scene = fs::exists(folder_ / "run/scene.json");
      const Outcome again = run_to("run");
      EXPECT_EQ(again.code, has_scene ? 5 : 0) << again.err;
      if (has_scene) {
        EXPECT_HAS(again.err, "polynya resume run");
        EXPECT_EQ(this->call({"resume", "run"}).code, 0);
      }
      EXPECT_EQ(difference("run"), "");
    }
  }
}

/// The paths in a line of `strace -y`: of the descriptor "3</tmp/run/forces.csv>", and in quotes.
std::string path_in(const std::string& line, char open, char close) {
  const auto start = line.find(open);
  if (start == std::string::npos) return "";
  const auto end = line.find(close, start + 1);
  return line.substr(start + 1, end - start - 1);
}

/// Follows a trace of system calls to find the files of a run folder that a power failure could lose.
class Unsynced {
 public:
  explicit Unsynced(fs::path folder) : folder_(std::move(folder)) {}
  void take(const std::string& line) {
    const std::string call = line.substr(0, line.find('('));
    const std::string opened = path_in(line, '<', '>');
    const std::string named = fs::path(path_in(line, '"', '"')).lexically_normal();
    if (call == "fsync") paths_.erase(opened);
    if (call == "write" && is_in_folder(opened)) paths_.insert(opened);
    if (call == "openat" && line.find("O_CREAT") != std::string::npos) change_names_of(named);
    if (call == "mkdir") change_names_of(named);
    if (call != "rename") return;
    change_names_of(named);
    const std::string from = folder_.parent_path() / named;
    const auto second = line.find("\", \"") + 4;
    const std::string to = folder_.parent_path() / line.substr(second, line.find('"', second) - second);
    paths_.erase(to);
    if (paths_.erase(from) > 0) paths_.insert(to);
  }
  std::string list() const {
    std::string text;
    for (const std::string& path : paths_) text += path + " ";
    return text;
  }

 private:
  bool is_in_folder(const std::string& path) const { return path.starts_with(folder_.string() + "/"); }
  void change_names_of(const std::string& named) {
    const fs::path path = folder_.parent_path() / named;
    if (path == folder_ || is_in_folder(path)) paths_.insert(path.parent_path());
  }
  fs::path folder_;
  std::set<std::string> paths_;  ///< files with bytes, and folders with names, that are not on the disk
};

/// A checkpoint is removed only when all data written before it are on the disk, because a run is resumed from it.
TEST_F(RunFolderTrial, EveryByteIsOnTheDiskBeforeACheckpointGoes) {
  if (!has_strace()) GTEST_SKIP() << "no strace that works here";
  expect_code(
      0, run_to("run", {"--checkpoint-every", "0.4"},
                strace({"-y", "-s", "4096", "-o", "trace.txt", "-e", "trace=write,openat,mkdir,fsync,rename,unlink"})));
  Unsynced unsynced(fs::canonical(folder_.path()) / "run");
  std::istringstream lines(read_file(folder_ / "trace.txt"));
  int gone = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::string call = line.substr(line.find_first_not_of(" ", line.find(' ')));
    if (call.starts_with("unlink(") && call.find("checkpoint-") != std::string::npos &&
        call.find("= 0") != std::string::npos) {
      ++gone;
      EXPECT_EQ(unsynced.list(), "") << call;
    }
    unsynced.take(call);
  }
  EXPECT_EQ(gone, 7);
  EXPECT_EQ(difference("run"), "");
}

TEST_F(RunFolderTrial, AResumeFromASavedCheckpointIsNotLostToAKill) {
  leave_run("early", 60, {50});
  leave_run("run", 260, {200, 250});
  const std::string saved = "early/checkpoint-000000000050.bin";
  if (!has_strace()) GTEST_SKIP() << "no strace that works here";
  // The run is killed when it is about to write its third checkpoint.
  expect_code(-SIGKILL,
              call({"resume", "run", "--checkpoint", saved, "--checkpoint-every", "0.1"}, killed_at("rename", 4)));
  const auto left = io::checkpoints_in(folder_ / "run");
  ASSERT_EQ(left.size(), 2U);
  EXPECT_EQ(left.front().filename(), "checkpoint-000000000070.bin");
  EXPECT_EQ(call({"resume", "run"}).code, 0);
  EXPECT_EQ(difference("run"), "");
}

/// A run folder from elsewhere must not make polynya write outside of the folder.
TEST_F(RunFolderTrial, LinksInAForeignRunFolderAreNotFollowed) {
  write_file(folder_ / "precious", "years of work");
  fs::create_directory(folder_ / "elsewhere");
  fs::create_directory(folder_ / "run");
  fs::copy(folder_ / "whole/scene.json", folder_ / "run/scene.json");
  const auto link_all = [&] {
    for (const char* name : {"floes.ndjson", "final.png", "final.png.part", "final.svg", "final.geojson.part",
                             "summary.json.part", "forces.csv", "scene.json.part", "summary.json"}) {
      fs::remove(folder_ / "run" / name);
      fs::create_symlink("../precious", folder_ / "run" / name);
    }
  };
  link_all();
  EXPECT_EQ(call({"resume", "run"}).code, 0);
  EXPECT_EQ(difference("run"), "");
  link_all();
  EXPECT_EQ(run_to("run", {"--overwrite"}).code, 0);
  EXPECT_EQ(difference("run"), "");
  fs::remove(folder_ / "run/.polynya");
  fs::create_symlink("../precious", folder_ / "run/.polynya");
  EXPECT_EQ(run_to("run", {"--overwrite"}).code, 5);
  leave_run("other", 260, {250});
  fs::rename(folder_ / "other/states.csv", folder_ / "kept");
  fs::create_symlink("../kept", folder_ / "other/states.csv");
  const std::string kept = read_file(folder_ / "kept");
  EXPECT_HAS(expect_code(5, call({"resume", "other"})).err, "states.csv: not a regular file");
  EXPECT_EQ(read_file(folder_ / "kept"), kept);
  EXPECT_EQ(read_file(folder_ / "precious"), "years of work");
}

/// Files that `polynya loads` and `management` made from a run are removed before the next run. Other files in the
/// folder stay.
TEST_F(RunFolderTrial, WhatCommandsMadeOfARunGoesWithIt) {
  for (const char* name : {"loads/loads.html", "loads/loads-peaks.csv", "management.csv", "notes.txt"}) {
    fs::create_directories(folder_ / "whole/loads");
    write_file(folder_ / "whole" / name, "of the run before");
  }
  EXPECT_EQ(run_to("whole", {"--overwrite"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "whole/loads"));
  EXPECT_FALSE(fs::exists(folder_ / "whole/management.csv"));
  EXPECT_EQ(read_file(folder_ / "whole/notes.txt"), "of the run before");
  fs::create_directories(folder_ / "whole/loads");
  for (const char* name : {"loads/loads.html", "loads/mine.txt"}) write_file(folder_ / "whole" / name, "");
  EXPECT_EQ(call({"resume", "whole", "--until", "4"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "whole/loads/loads.html"));
  EXPECT_TRUE(fs::exists(folder_ / "whole/loads/mine.txt"));
}

TEST_F(RunFolderTrial, AFileTooLongToBeReadIsReported) {
  leave_run("run", 260, {250});
  fs::resize_file(folder_ / "run/contacts.csv", io::kLongestRunFile + 1);  // a hole, which takes no space
  EXPECT_HAS(expect_code(5, call({"inspect", "run"})).err, "contacts.csv");
}

}  // namespace
}  // namespace polynya::tests
