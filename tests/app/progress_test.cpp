#include <algorithm>

#include "program.hpp"
#include "tiny_scene.hpp"
#include <gtest/gtest.h>
#include <pty.h>

namespace polynya::tests {
namespace {

/// What a program writes to stderr where that is a terminal of that many columns.
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
  for (ssize_t count = 0; (count = read(terminal, block, sizeof block)) > 0;)
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

TEST(ProgressBar, FitsAnyTerminal) {
  const TemporaryFolder folder;
  write_file(folder / "tiny.json", kTinyScene);
  for (const int columns : {1, 6, 20, 59, 80}) {
    const std::string text = on_terminal({"run", "tiny.json", "--out", "run", "--overwrite"}, folder, columns);
    std::filesystem::remove_all(folder / "run");
    EXPECT_HAS(text, "\r");
    EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;  // at the end
    for (const int used : columns_of_lines(text)) EXPECT_LT(used, columns) << text;
    EXPECT_EQ(text.find("100 %") != std::string::npos, columns > 5) << text;
  }
}

/// A scene that comes late, as a field that takes long to make.
TEST(ProgressBar, IsThereWhileASceneIsReadAndGoesAway) {
  const TemporaryFolder folder;
  write_file(folder / "tiny.json", kTinyScene);
  Start start{folder.path()};
  start.under = {"/bin/sh", "-c", "{ /bin/sleep 4; /bin/cat tiny.json; } | \"$@\"", "sh"};
  const Outcome outcome = polynya("validate - --progress json", start);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(outcome.err, R"({"work":"reading the scene","part":null,"wall_time_s":)");
  EXPECT_EQ(polynya("validate tiny.json --progress json", folder).err, "");
}

TEST(ProgressBar, IsLinesWhereThereIsNoTerminal) {
  const TemporaryFolder folder;
  write_file(folder / "tiny.json", kTinyScene);
  const Outcome outcome = polynya("run tiny.json --out run --progress bar", folder);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_LACKS(outcome.err, "\r");
}

}  // namespace
}  // namespace polynya::tests
