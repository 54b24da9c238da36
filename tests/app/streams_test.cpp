#include <algorithm>

#include "interrupted_run.hpp"
#include "program.hpp"
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/stat.h>

namespace polynya::tests {
namespace {

class Streams : public InSharedFolder {
 protected:
  static void SetUpTestSuite() {
    folder.emplace();
    write_file(folder->path() / "tiny.json", kTinyScene);
    write_file(folder->path() / "floes.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10))\n");
    ASSERT_EQ(in_folder("run tiny.json --out good").code, 0);
    ASSERT_GT(read_file(folder->path() / "good/events.ndjson").size(), 0U);
  }
  static Outcome in_folder(
      const Words& words, std::function<void()> arrange = [] {}) {
    const auto arrange_all = [&] {
      setenv("PATH", "/", 1);  // without rsvg-convert, which takes seconds
      arrange();
    };
    return polynya(words, {.folder = folder->path(), .arrange_streams = arrange_all});
  }
};

/// Every command that prints to stdout, called as a user calls it.
const std::vector<Words> kPrinting{"--help",
                                   "--version",
                                   "run --help",
                                   "run tiny.json --out replaced --overwrite --progress none",
                                   "validate tiny.json",
                                   "validate tiny.json --resolved",
                                   "schema",
                                   "schema --markdown",
                                   "init",
                                   "inspect good",
                                   "inspect good --check",
                                   "inspect good --fsd",
                                   "inspect good --floe 0",
                                   "inspect good --lineage 1",
                                   "view good",
                                   "channel good",
                                   "export good --vtk vtk",
                                   "export good --geojson layers",
                                   "cut floes.wkt --crack 5,5,30",
                                   "cut floes.wkt --crack 5,5,30 --out - --ledger ledger.json",
                                   "database show",
                                   "database query --thickness 1 --speed 1 --wedge-angle 90 --hull-angle 60"};

TEST_F(Streams, TextThatAFullDiskRefusesNeverEndsInZero) {
  for (const auto& words : kPrinting) {
    const Outcome outcome = in_folder(words, [] { fill_disk_of(1); });
    EXPECT_EQ(outcome.code, 5) << words.front();
    EXPECT_HAS(outcome.err, "polynya: stdout: No space left on device") << words.front() << ": ";
  }
}

/// `polynya inspect RUN | head -1` closes the pipe in the same way.
TEST_F(Streams, AClosedPipeIsQuietAndEndsAsShellsReportIt) {
  for (const auto& words : kPrinting) {
    const Outcome read = expect_code(0, in_folder(words));
    EXPECT_NE(read.out, "") << words.front();
    const Outcome outcome = in_folder(words, [] { close_pipe_behind(1); });
    EXPECT_EQ(outcome.code, 141) << words.front();
    EXPECT_EQ(outcome.err, read.err) << words.front();
  }
}

TEST_F(Streams, ThatCannotBeWrittenOrReadNeverEndInZero) {
  const Words noisy = "cut floes.wkt --crack 5,5,30";
  ASSERT_NE(in_folder(noisy).err, "");
  EXPECT_EQ(in_folder(noisy, [] { fill_disk_of(2); }).code, 5);
  EXPECT_EQ(in_folder(noisy, [] { close(2); }).code, 5);
  EXPECT_EQ(in_folder(noisy, [] { close_pipe_behind(2); }).code, 141);
  EXPECT_EQ(in_folder("validate tiny.json", [] { fill_disk_of(2); }).code, 0);  // it has no message
  EXPECT_HAS(expect_code(5, in_folder("cut - --crack 5,5,30", [] { close(0); })).err, "stdin: ");
}

/// The files of the run would take the descriptors of closed streams, and reports and progress would go there.
TEST_F(Streams, WhateverStreamIsClosedARunsFilesHoldTheRun) {
  for (int closed = 1; closed < 8; ++closed) {
    const auto close_some = [closed] {
      for (int descriptor = 0; descriptor < 3; ++descriptor) {
        if ((closed >> descriptor & 1) != 0) close(descriptor);
      }
    };
    const std::string name = "closed-" + std::to_string(closed);
    const Outcome outcome = in_folder({"run", "tiny.json", "--out", name, "--progress", "json"}, close_some);
    EXPECT_EQ(outcome.code, (closed & 2) != 0 ? 5 : 0) << closed;
    EXPECT_EQ(first_difference(folder->path() / "good", folder->path() / name), "") << closed;
  }
}

/// A named pipe without a writer would be waited for.
TEST_F(Streams, ANamedPipeIsNoFileToRead) {
  ASSERT_EQ(mkfifo((folder->path() / "in").c_str(), 0600), 0);
  write_file(folder->path() / "of-pipe.json", R"({"floes": [{"file": "in"}]})");
  for (const Words& words : std::vector<Words>{"validate in", "validate of-pipe.json", "import in --out o.geojson",
                                               "cut in --crack 5,5,30", "database show in", "inspect in"}) {
    const Outcome outcome = in_folder(words);
    EXPECT_GT(outcome.code, 0) << words.front();
    EXPECT_HAS(outcome.err, "in");
  }
}

/// The page is the only output on stdout. The line about it goes to stderr.
TEST_F(Streams, APageGoesIntoAPipeAndToStdout) {
  ASSERT_EQ(in_folder("view good --out page.html").code, 0);
  const std::string page = read_file(folder->path() / "page.html");
  ASSERT_EQ(mkfifo((folder->path() / "fifo").c_str(), 0600), 0);
  const pid_t reader = fork();
  if (reader == 0) {
    write_file(folder->path() / "read.html", read_file(folder->path() / "fifo"));
    _exit(0);
  }
  EXPECT_EQ(in_folder("view good --out fifo").code, 0);
  EXPECT_TRUE(std::filesystem::is_fifo(folder->path() / "fifo"));
  std::filesystem::remove(folder->path() / "fifo");
  waitpid(reader, nullptr, 0);
  EXPECT_TRUE(read_file(folder->path() / "read.html") == page);
  const Outcome outcome = expect_code(0, in_folder("view good --out /dev/stdout"));
  EXPECT_TRUE(outcome.out == page);
  EXPECT_HAS(outcome.err, "open it in a browser");
}

/// A run folder may come from elsewhere, so polynya does not write to the target of a link in it.
TEST_F(Streams, ProductsInARunFolderReplaceALink) {
  const auto mine = folder->path() / "mine.txt";
  std::filesystem::copy(folder->path() / "good", folder->path() / "foreign");
  for (const auto& [command, product] : {std::pair{"view", "view.html"}, {"channel", "channel.csv"}}) {
    write_file(mine, "mine");
    const auto file = folder->path() / "foreign" / product;
    std::filesystem::remove(file);
    std::filesystem::create_symlink(mine, file);
    EXPECT_EQ(in_folder({command, "foreign"}).code, 0);
    EXPECT_EQ(read_file(mine), "mine") << command;
  }
}

// ---- how far a run is

/// Returns what a program writes to stderr if stderr is a terminal with `columns` columns.
std::string on_terminal(const Words& words, const TemporaryFolder& folder, int columns) {
  int terminal = -1, stream = -1;
  const winsize size{.ws_row = 24, .ws_col = static_cast<unsigned short>(columns), .ws_xpixel = 0, .ws_ypixel = 0};
  EXPECT_EQ(openpty(&terminal, &stream, nullptr, nullptr, &size), 0);
  const auto use_terminal = [&] { dup2(stream, 2); };
  const Start start{.folder = folder.path(), .arrange_streams = use_terminal};
  const pid_t child = start_polynya(words, start);
  close(stream);
  std::string text;
  char block[4096];
  for (ssize_t count = 0; (count = ::read(terminal, block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(count));
  close(terminal);
  EXPECT_EQ(wait_for(child, start).code, 0);
  return text;
}

/// Columns of each line that a carriage return leads back on: characters of UTF-8, without "erase to the end
/// of the line".
std::vector<int> columns_of_lines(const std::string& text) {
  std::vector<int> columns{0};
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 3, "\x1b[K") == 0)
      i += 2;
    else if (text[i] == '\r' || text[i] == '\n')
      columns.push_back(0);
    else if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80)
      ++columns.back();
  }
  return columns;
}

class ProgressBar : public InFolder {
 protected:
  void SetUp() override { write("tiny.json", kTinyScene); }
};

TEST_F(ProgressBar, FitsAnyTerminal) {
  for (const int columns : {1, 6, 20, 59, 80}) {
    const std::string text = on_terminal({"run", "tiny.json", "--out", "run", "--overwrite"}, folder, columns);
    std::filesystem::remove_all(folder / "run");
    EXPECT_HAS(text, "\r");
    EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;  // at the end
    for (const int used : columns_of_lines(text)) EXPECT_LT(used, columns) << text;
    EXPECT_EQ(text.find("100 %") != std::string::npos, columns > 5) << text;
  }
}

/// The scene arrives late, like a field that takes long to generate.
TEST_F(ProgressBar, IsThereWhileASceneIsReadAndGoesAway) {
  Start start{folder.path()};
  start.under = {"/bin/sh", "-c", "{ /bin/sleep 4; /bin/cat tiny.json; } | \"$@\"", "sh"};
  EXPECT_HAS(expect_code(0, polynya("validate - --progress json", start)).err,
             R"({"work":"reading the scene","part":null,"wall_time_s":)");
  EXPECT_EQ(done("validate tiny.json --progress json").err, "");
}

TEST_F(ProgressBar, IsLinesWhereThereIsNoTerminal) {
  EXPECT_LACKS(done("run tiny.json --out run --progress bar").err, "\r");
}

}  // namespace
}  // namespace polynya::tests
