// Help, manual page and completion list every command and option.
#include <regex>
#include <set>

#include "program.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

const TemporaryFolder& folder() {
  static const TemporaryFolder kFolder;
  return kFolder;
}
std::string output_of(const Words& words) {
  const Outcome outcome = expect_code(0, polynya(words, {folder().path()}));
  return outcome.out;
}

/// The commands that the help lists after its line "Subcommands:".
std::vector<std::string> subcommands(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(std::min(help.size(), help.find("Subcommands:"))));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  ")) {
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

std::set<std::string> long_options(const std::string& help) {
  std::set<std::string> found;
  static const std::regex kOption(R"(\n  (?:-\w,)?(--[a-z-]+))");
  for (std::sregex_iterator at(help.begin(), help.end(), kOption), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

std::string completed(const std::string& line) {
  const std::string script = "source " POLYNYA_BINARY ".bash; COMP_WORDS=(" + line +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _polynya; echo \" ${COMPREPLY[*]} \"";
  FILE* pipe = popen(("cd '" + folder().path().string() + "' && bash -c '" + script + "'").c_str(), "r");
  std::string text;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0);
  return text;
}

TEST(Guide, HelpLeadsWithExamples) {
  const std::string help = output_of("--help");
  EXPECT_BEGINS(help, "Examples:");
  const auto commands = subcommands(help);
  ASSERT_GE(commands.size(), 11U);
  for (const std::string& command : commands) {
    const std::string text = output_of({command, "--help"});
    const std::size_t examples = text.find("Examples:\n");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_LT(examples, text.find("Usage:")) << command;
    EXPECT_HAS(text, "  polynya " + command) << command;
  }
}

/// What the build writes beside the program.
std::string page_named(const char* name) {
  return read_file(std::filesystem::path(POLYNYA_BINARY).parent_path() / name);
}

TEST(Guide, TheManualPageHasEveryCommandAndOption) {
  std::string page = page_named("polynya.1");
  page = std::regex_replace(page, std::regex(R"(\\-)"), "-");
  for (const std::string& command : subcommands(output_of("--help"))) {
    EXPECT_HAS(page, ".SS " + command + "\n") << command;
    for (const std::string& option : long_options(output_of({command, "--help"})))
      EXPECT_HAS(page, option) << command << ' ';
  }
}

TEST(Guide, BashCompletesCommandsOptionsChoicesAndFiles) {
  write_file(folder() / "scene-of-mine.json", "{}");
  const std::string help = output_of("--help");
  const std::string all = completed("polynya \"\"");
  for (const std::string& command : subcommands(help)) {
    EXPECT_HAS(all, " " + command + " ") << command;
    const std::string options = completed("polynya " + command + " --");
    for (const std::string& option : long_options(output_of({command, "--help"})))
      EXPECT_HAS(options, " " + option + " ") << command << ' ' << option;
  }
  EXPECT_EQ(completed("polynya cha"), " channel \n");
  EXPECT_EQ(completed("polynya run --progress js"), " json \n");
  EXPECT_EQ(completed("polynya validate scene-of"), " scene-of-mine.json \n");
}

TEST(Guide, BashCompletesFilesOnlyWhereTheyAreExpected) {
  std::filesystem::create_directories(folder() / "scene-folder");
  write_file(folder() / "scene-of-mine.json", "{}");
  write_file(folder() / "scene of two words.json", "{}");
  EXPECT_EQ(completed("polynya database \"\""), " build show query \n");
  EXPECT_EQ(completed("polynya inspect scene"), " scene-folder \n");
  for (const char* line : {"polynya run --until scene", "polynya cut --disc scene", "polynya schema scene",
                           "polynya database scene", "polynya database query scene", "polynya scene"})
    EXPECT_EQ(completed(line), "  \n") << line;
  for (const char* line : {"polynya cut scene-of", "polynya cut --ops scene-of", "polynya cut x.wkt --out scene-of"})
    EXPECT_EQ(completed(line), " scene-of-mine.json \n") << line;
  EXPECT_EQ(completed("polynya run \"scene of\""), " scene of two words.json \n");
  const std::string options = completed("polynya cut floes.wkt --");
  for (const char* tool : {"--disc", "--crack", "--line", "--polygon", "--ops", "--keep", "--repair"})
    EXPECT_HAS(options, std::string(" ") + tool + " ");
}

TEST(Guide, OptionsComeInTheOrderOfTheirUse) {
  const std::string help = output_of("cut --help");
  const std::string page = std::regex_replace(page_named("polynya.1"), std::regex(R"(\\-)"), "-");
  for (const auto& [text, begin] : {std::pair{help, "\n  "}, {page.substr(page.find(".SS cut\n")), "\n.B "}}) {
    std::size_t last = 0;
    for (const char* option :
         {"--disc ", "--crack ", "--line ", "--polygon ", "--ops ", "--keep ", "--sagitta ", "--out "}) {
      const std::size_t at = text.find(begin + std::string(option));
      ASSERT_NE(at, std::string::npos) << option;
      EXPECT_GT(at, last) << option;
      last = at;
    }
  }
}

}  // namespace
}  // namespace polynya::tests
