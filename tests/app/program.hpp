#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "../io/expect_text.hpp"
#include "../io/temporary_folder.hpp"
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/run/run_reader.hpp"

namespace polynya::tests {

/// The words of a command line. A text is parted at its blanks, and scenes/NAME.json is a scene that ships.
struct Words : std::vector<std::string> {
  using std::vector<std::string>::vector;
  Words(std::vector<std::string> words) : std::vector<std::string>(std::move(words)) {}
  Words(const std::string& line) {
    std::istringstream parts(line);
    for (std::string word; parts >> word;)
      push_back(word.starts_with("scenes/") ? POLYNYA_SOURCE_DIR "/" + word : word);
  }
  Words(const char* line) : Words(std::string(line)) {}
};

inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Outcome {
  int code = -1;  ///< exit code; −signal where a signal ended it
  std::string out;
  std::string err;
  std::string line = {};  ///< command line
};

/// How a program is started.
struct Start {
  std::filesystem::path folder;         ///< working folder, where the output is kept too
  rlim_t largest_file = RLIM_INFINITY;  ///< [bytes]
  std::filesystem::path input = {};     ///< file for stdin; no input if empty
  /// Replaces a descriptor just before the program starts. Other descriptors go to files, or come from /dev/null.
  std::function<void()> arrange_streams = [] {};
  std::vector<std::string> under = {};  ///< a program, and its options, that starts polynya
};

/// Starts the program without rsvg-convert, which takes seconds.
inline Start without_converter(const TemporaryFolder& folder) {
  return {.folder = folder.path(), .arrange_streams = [] { setenv("PATH", "/", 1); }};
}

/// Makes stdout or stderr a pipe without a reader.
inline void close_pipe_behind(int descriptor) {
  int ends[2];
  if (pipe(ends) != 0 || close(ends[0]) != 0 || dup2(ends[1], descriptor) < 0) _exit(126);
}

/// Makes stdout or stderr a file on a full disk.
inline void fill_disk_of(int descriptor) {
  const int full = open("/dev/full", O_WRONLY);
  if (full < 0 || dup2(full, descriptor) < 0) _exit(126);
}

/// A ship that breaks cusps from a plate within a second.
inline constexpr auto kTinyScene =
    R"({"name": "tiny", "time": {"step_s": 0.01, "until_s": 1}, "record": {"frames_interval_s": 0.5},
        "ships": [{"hull": {"length_m": 60, "beam_m": 16, "entrance_angle_deg": 30}, "mass_kg": 3e6,
          "moment_of_inertia_kg_m2": 8e8, "position_m": [-31, 0], "propulsion": {"constant_speed_m_per_s": 2}}],
        "floes": [{"rectangle": {"corner_m": [0.5, -40], "size_m": [120, 80]}}]})";

/// Starts the built polynya; its stdout and stderr go to files in the folder.
inline pid_t start_polynya(const Words& words, const Start& start) {
  const pid_t child = fork();
  if (child != 0) return child;
  // The background job of a shell, also with nohup, inherits that these signals are ignored. The tests send them.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  std::filesystem::current_path(start.folder);
  if (!freopen("stdout.txt", "w", stdout) || !freopen("stderr.txt", "w", stderr)) _exit(126);
  if (!freopen(start.input.empty() ? "/dev/null" : start.input.c_str(), "r", stdin)) _exit(126);
  if (start.largest_file != RLIM_INFINITY) {
    const rlimit limit{start.largest_file, start.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  start.arrange_streams();
  std::vector<std::string> copies = start.under;
  copies.emplace_back(POLYNYA_BINARY);
  copies.insert(copies.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(copies.size() + 1);
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

inline Outcome wait_for(pid_t child, const Start& start) {
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_file(start.folder / "stdout.txt"),
          read_file(start.folder / "stderr.txt")};
}

inline Outcome polynya(const Words& words, const Start& start) {
  Outcome outcome = wait_for(start_polynya(words, start), start);
  for (const std::string& word : words) outcome.line += word + ' ';
  return outcome;
}

inline Outcome polynya(const Words& words, const TemporaryFolder& folder) {
  return polynya(words, Start{folder.path()});
}

/// Checks that a command line ended with the given exit status, and returns its outcome.
inline Outcome expect_code(int code, Outcome outcome) {
  EXPECT_EQ(outcome.code, code) << outcome.line << outcome.err;
  return outcome;
}

/// A command line that must be refused, its exit status, and the expected parts of its message.
struct Refusal {
  Words words;
  int code = 0;
  std::string message = {};
};

/// Checks that each line ends with its exit status and message, and prints nothing to stdout.
inline void expect_refusals(const std::vector<Refusal>& all, const Start& start) {
  for (const Refusal& one : all) {
    const Outcome outcome = expect_code(one.code, polynya(one.words, start));
    EXPECT_EQ(outcome.out, "") << outcome.line;
    EXPECT_NE(outcome.err, "") << outcome.line;
    EXPECT_HAS(outcome.err, one.message) << outcome.line;
  }
}

/// Checks that all lines end with the same exit status and with some message.
inline void expect_refusals(int code, const std::vector<Words>& lines, const Start& start) {
  for (const Words& words : lines) expect_refusals({{words, code}}, start);
}

inline std::string scene_path(const std::string& name) {
  return std::string(POLYNYA_SOURCE_DIR) + "/scenes/" + name + ".json";
}

/// Gives a test an empty folder in which it calls the program.
class InFolder : public testing::Test {
 protected:
  Outcome call(const Words& words) const { return polynya(words, folder); }
  /// Returns the outcome of a command, which must succeed.
  Outcome done(const Words& words) const { return expect_code(0, call(words)); }
  void write(const std::string& name, const std::string& text) const { write_file(folder / name, text); }
  std::string read(const std::string& name) const { return read_file(folder / name); }
  TemporaryFolder folder;
};

/// A folder that the tests of a class share, filled by SetUpTestSuite.
class InSharedFolder : public testing::Test {
 protected:
  static void TearDownTestSuite() { folder.reset(); }
  static inline std::optional<TemporaryFolder> folder;
};

/// One real run for all tests of a command: an icebreaker 30 s into a plate.
class PlateRun : public InSharedFolder {
 protected:
  static void SetUpTestSuite() {
    folder.emplace();
    const Outcome outcome = polynya("run scenes/level-plate.json --until 30 --out run", *folder);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    auto read = io::read_run(folder->path() / "run");
    ASSERT_TRUE(read.has_value()) << read.error();
    run = std::move(*read);
    ASSERT_GT(run->events.size(), 5U);
  }
  /// The command with the run's folder, or another of that folder's, and more words.
  static Outcome on_run(const std::string& command, const Words& words, const std::string& of = "run") {
    return polynya(Words{command, of} + words, *folder);
  }

  static inline std::optional<io::Run> run;
};

}  // namespace polynya::tests
