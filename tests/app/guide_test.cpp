// Help, manual page and completion tell of every command and option there is.
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
std::string output_of(const std::vector<std::string>& words) {
  const Outcome outcome = polynya(words, {folder().path()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
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
  for (std::sregex_iterator at(help.begin(), help.end(), kOption), end; at != end; ++at)
    found.insert((*at)[1]);
  return found;
}

std::string completed(const std::string& line) {
  const std::string script = "source <(" POLYNYA_BINARY " completion); COMP_WORDS=(" + line +
                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _polynya; echo \" ${COMPREPLY[*]} \"";
  FILE* pipe = popen(("cd '" + folder().path().string() + "' && bash -c '" + script + "'").c_str(), "r");
  std::string text;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
  EXPECT_EQ(pclose(pipe), 0);
  return text;
}

TEST(Guide, HelpLeadsWithExamples) {
  const std::string help = output_of({"--help"});
  EXPECT_EQ(help.find("Examples:"), 0U);
  const auto commands = subcommands(help);
  ASSERT_GE(commands.size(), 11U);
  for (const std::string& command : commands) {
    const std::string text = output_of({command, "--help"});
    const std::size_t examples = text.find("Examples:\n");
    ASSERT_NE(examples, std::string::npos) << command;
    EXPECT_LT(examples, text.find("Usage:")) << command;
    EXPECT_NE(text.find("  polynya " + command), std::string::npos) << command;
  }
}

TEST(Guide, TheManualPageHasEveryCommandAndOption) {
  std::string page = output_of({"man"});
  page = std::regex_replace(page, std::regex(R"(\\-)"), "-");
  for (const std::string& command : subcommands(output_of({"--help"}))) {
    EXPECT_NE(page.find(".SS " + command + "\n"), std::string::npos) << command;
    for (const std::string& option : long_options(output_of({command, "--help"})))
      EXPECT_NE(page.find(option), std::string::npos) << command << ' ' << option;
  }
}

TEST(Guide, BashCompletesCommandsOptionsChoicesAndFiles) {
  write_file(folder() / "scene-of-mine.json", "{}");
  const std::string help = output_of({"--help"});
  const std::string all = completed("polynya \"\"");
  for (const std::string& command : subcommands(help)) {
    EXPECT_NE(all.find(" " + command + " "), std::string::npos) << command;
    const std::string options = completed("polynya " + command + " --");
    for (const std::string& option : long_options(output_of({command, "--help"})))
      EXPECT_NE(options.find(" " + option + " "), std::string::npos) << command << ' ' << option << options;
  }
  EXPECT_EQ(completed("polynya cha"), " channel \n");
  EXPECT_EQ(completed("polynya run --progress js"), " json \n");
  EXPECT_EQ(completed("polynya validate scene-of"), " scene-of-mine.json \n");
}

}  // namespace
}  // namespace polynya::tests
