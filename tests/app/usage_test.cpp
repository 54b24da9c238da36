// Wrong arguments on the command line: each ends with exit status 2, prints nothing to stdout and is named in the
// message.
#include <regex>
#include <set>

#include "program.hpp"
#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

class Usage : public InSharedFolder {
 protected:
  static void SetUpTestSuite() {
    folder.emplace();
    write_file(*folder / "tiny.json", kTinyScene);
    ASSERT_EQ(polynya("run tiny.json --out run --no-map", *folder).code, 0);
    ASSERT_EQ(polynya("run scenes/two-floes.json --until 1 --out shipless --no-map", *folder).code, 0);
    write_file(*folder / "ops.json", R"([{"disk": [1,2,3]}])");
    write_file(*folder / "floes.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10))\n");
  }
};

TEST_F(Usage, ErrorsNameTheCommandTheFaultAndWhatWasMeant) {
  const Words query = "database query --thickness 1 --speed 1 --hull-angle 60";
  const std::string commands =
      "commands: run, resume, validate, schema, ships, init, view, channel, export, inspect, cut, import, database, "
      "fmu, "
      "performance, figures, loads, management, movie, study\n";
  const std::string tools = "one of --disc, --crack, --line, --polygon, --ops is needed, ";
  std::vector<Refusal> rows{
      {"", 2, "polynya: a command is missing\n" + commands},
      {"veiw x", 2, "polynya: no such command: veiw; did you mean view?\n" + commands},
      {"run a --unitl 3 b", 2,
       "polynya run: not expected: --unitl 3 b; did you mean --until?\npolynya run --help explains its "
       "options\n"},
      {"cut floes.wkt", 2, tools + "none is given\n"},
      {"cut x --disc 0,0,1 --crack 0,0,1", 2, tools + "2 are given\n"},
      {"database biuld", 2,
       "polynya database: no such command: biuld; did you mean build?\ncommands: build, show, "
       "query\n"},
      {{"database", "build", "--out", ""}, 2, "--out: the name is empty"},
      {{"database", "show", "--svg", ""}, 2, "--svg: the name is empty"}};
  for (const std::vector<std::string>& row : table_of("app/usage.txt"))
    rows.push_back({row[0], 2, std::regex_replace(row[1], std::regex(R"(\\n)"), "\n")});
  expect_refusals(rows, {folder->path()});
  for (const char* name : {"x.html", "runs"}) EXPECT_FALSE(std::filesystem::exists(*folder / name)) << name;
}

/// The range check of CLI11 accepts nan, but an interval of nan seconds gives no checkpoints.
TEST_F(Usage, EveryNumberMustBeFinite) {
  for (const Words& row : std::initializer_list<Words>{
           "run --until --checkpoint-every --checkpoint-every-wall",
           "resume --checkpoint-every --checkpoint-every-wall", "view --from --until --limit",
           "channel --at --spacing --reach", "figures --at", "export --at", "inspect --at", "cut --sagitta"}) {
    for (std::size_t i = 1; i < row.size(); ++i)
      for (const char* word : {"nan", "-inf"})
        expect_refusals({{{row[0], "nowhere", row[i], word}, 2, row[i] + ": "}}, {folder->path()});
  }
}

TEST_F(Usage, WhatIsNotThereOrCannotBeWrittenIsFive) {
  write_file(*folder / "empty/notes.txt", "");
  std::vector<Refusal> rows{{"validate missing.json", 5, "missing.json: "},
                            {"run missing.json", 5, "missing.json: "},
                            {{"run", folder->path()}, 5, folder->path().string() + ": "},
                            {"validate /dev/zero", 5, "/dev/zero: "},
                            {"run scenes/two-floes.json --out tiny.json", 5, "tiny.json"},
                            {"run scenes/two-floes.json --out tiny.json/run", 5, "tiny.json"},
                            {"view run --out no/such/folder/page.html", 5, "no/such/folder/page.html"},
                            {"view run none --out x.html", 5, "none"},
                            {"export nothing --vtk v", 5, "nothing"},
                            {"resume nowhere", 5, "nowhere"},
                            {"resume empty", 5, "no run to resume"},
                            {"init tiny.json", 5, "tiny.json"}};
  for (const auto& [path, words] : {std::pair{"empty", "not a run folder: empty has no scene.json"},
                                    {"nowhere", "not a run folder: nowhere does not exist"},
                                    {"empty/notes.txt", "not a run folder: empty/notes.txt is a file"}}) {
    for (const char* command : {"view", "inspect", "channel"}) rows.push_back({{command, path}, 5, words});
  }
  expect_refusals(rows, {folder->path()});
  EXPECT_FALSE(std::filesystem::exists(*folder / "runs"));
}

TEST_F(Usage, AMissingPythonIsNamed) {
  Start start{folder->path()};
  start.arrange_streams = [] { setenv("POLYNYA_PYTHON", "/no/such/python3", 1); };
  const char* const message =
      "/no/such/python3: No such file or directory; this command needs Python: ./setup.sh python";
  expect_refusals({{"study gather x", 5, message}}, start);
}

// ---- help, manual page and completion list every command and option

class Guide : public InFolder {
 protected:
  std::string output_of(const Words& words) const { return done(words).out; }
  /// Returns the words to which bash completes a line.
  std::string completed(const std::string& line) const {
    const std::string script = "source " POLYNYA_BINARY ".bash; COMP_WORDS=(" + line +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _polynya; echo \" ${COMPREPLY[*]} \"";
    FILE* pipe = popen(("cd '" + folder.path().string() + "' && bash -c '" + script + "'").c_str(), "r");
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    EXPECT_EQ(pclose(pipe), 0);
    return text;
  }
  /// Returns the manual page, which the build writes beside the program.
  static std::string manual_page() {
    const auto file = std::filesystem::path(POLYNYA_BINARY).parent_path() / "polynya.1";
    return std::regex_replace(read_file(file), std::regex(R"(\\-)"), "-");
  }
};

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
  static const std::regex kOption(R"(\n  (?:-\w,)?(--[a-z0-9-]+))");
  for (std::sregex_iterator at(help.begin(), help.end(), kOption), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

TEST_F(Guide, HelpLeadsWithExamples) {
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

TEST_F(Guide, TheManualPageHasEveryCommandAndOption) {
  const std::string page = manual_page();
  for (const std::string& command : subcommands(output_of("--help"))) {
    EXPECT_HAS(page, ".SS " + command + "\n") << command;
    for (const std::string& option : long_options(output_of({command, "--help"})))
      EXPECT_HAS(page, option) << command << ' ';
  }
}

TEST_F(Guide, BashCompletesCommandsOptionsChoicesAndFiles) {
  write("scene-of-mine.json", "{}");
  const std::string all = completed("polynya \"\"");
  for (const std::string& command : subcommands(output_of("--help"))) {
    EXPECT_HAS(all, " " + command + " ") << command;
    const std::string options = completed("polynya " + command + " --");
    for (const std::string& option : long_options(output_of({command, "--help"})))
      EXPECT_HAS(options, " " + option + " ") << command << ' ' << option;
  }
  EXPECT_EQ(completed("polynya cha"), " channel \n");
  EXPECT_EQ(completed("polynya run --progress js"), " json \n");
  EXPECT_EQ(completed("polynya validate scene-of"), " scene-of-mine.json \n");
}

TEST_F(Guide, BashCompletesFilesOnlyWhereTheyAreExpected) {
  std::filesystem::create_directories(folder / "scene-folder");
  for (const char* name : {"scene-of-mine.json", "scene of two words.json"}) write(name, "{}");
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

TEST_F(Guide, OptionsComeInTheOrderOfTheirUse) {
  const std::string help = output_of("cut --help"), page = manual_page();
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
