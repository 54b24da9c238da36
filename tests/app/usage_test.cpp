// Wrong words on the command line: each ends with 2, prints nothing to stdout and names what is wrong.
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
      "performance, calibrate, figures, loads, management, movie, study\n";
  const std::string tools = "one of --disc, --crack, --line, --polygon, --ops is needed, ";
  const std::vector<Refusal> rows{
      {"", 2, "polynya: a command is missing\n" + commands},
      {"veiw x", 2, "polynya: no such command: veiw; did you mean view?\n" + commands},
      {"run", 2, "polynya run: scene is required"},
      {"run a --until", 2, "polynya run: --until: 1 required S"},
      {"run a --until -1", 2, "--until: "},
      {"run a --until soon", 2, "--until: "},
      {"run a --threads 0", 2, "--threads: "},
      {"run a --seed -3", 2, "--seed: "},
      {"run scenes/two-floes.json --set seed", 2, "seed"},
      {"run a --unitl 3 b", 2,
       "polynya run: not expected: --unitl 3 b; did you mean --until?\npolynya run --help explains its "
       "options\n"},
      {"run x --progress loud", 2, "--progress: \"loud\" is not one of: auto, bar, json, none\n"},
      {"validate", 2, "scene is required"},
      {"validate tiny.json --json --resolved", 2},
      {"cut floes.wkt", 2, tools + "none is given\n"},
      {"cut x --disc 0,0,1 --crack 0,0,1", 2, tools + "2 are given\n"},
      {"cut x --disc 0,0,1 --keep all", 2, "polynya cut: --keep: \"all\" is not one of: outside, inside, both\n"},
      {"cut x --disc 0,0,1 --keep 1", 2, "polynya cut: --keep: \"1\" is not one of: outside, inside, both\n"},
      {"cut floes.wkt --disc 0,0", 2, "--disc"},
      {"cut floes.wkt --disc 0,0,-1", 2, "--disc"},
      {"cut floes.wkt --disc 0,0,x", 2, "--disc"},
      {"cut floes.wkt --crack 0,0,nan", 2, "--crack"},
      {"cut floes.wkt --line 1,1,1,1", 2, "--line"},
      {"cut floes.wkt --ops ops.json", 2, "ops.json"},
      {"cut floes.wkt --disc 0,0,1 --sagitta -1", 2, "--sagitta: "},
      {"cut floes.wkt --disc 0,0,1 --repair please", 2, "--repair: "},
      {"cut floes.wkt --disc 0,0,1 --out - --ledger -", 2, "--ledger"},
      {"cut floes.wkt --disc 0,0,1 more", 2, "more"},
      {"cut - --polygon -", 2},
      {"channel x --format jsn", 2, "--format: \"jsn\" is not one of: table, csv, json; did you mean json?\n"},
      {"channel shipless", 2},
      {"export shipless", 2},
      {"export shipless --geojson g --at 7", 2},
      {"figures x --load most", 2, "--load: \"most\" is not one of: true, mean, max, ships, j-over-tau-c\n"},
      {"inspect", 2, "run is required"},
      {"inspect x --floe 1 --format dxf", 2, "--format: \"dxf\" is not one of: wkt, geojson\n"},
      {"inspect run --floe 99999", 2, "99999"},
      {"inspect run --floe -1", 2, "there is no floe -1; they go from 0 to "},
      {"inspect run --lineage 99999", 2, "99999"},
      {"inspect run --at 1e9", 2, "--at"},
      {"inspect run --at -1", 2, "--at"},
      {"inspect run --at soon", 2, "--at: "},
      {"inspect run --format wkt", 2, "--format"},
      {"inspect run --floe 1 --check", 2},
      {"inspect run --check --fsd", 2},
      {"inspect run --events --check", 2},
      {"inspect run --floe 1 --lineage 1", 2},
      {"inspect run --floe 3 --json", 2},
      {"inspect run --floe 0 --at 1", 2, "floe 0"},
      {"view", 2, "run is required"},
      {"view run --every 0", 2, "--every: "},
      {"view run --every x", 2, "--every: "},
      {"view run --from 1000", 2, "no frame of run is in that part; they go from 0 to 1 s"},
      {"view run --from 0.9 --until 0.5", 2, "no frame of run is in that part"},
      {"view run --area 9,9,5,5", 2, "--area"},
      {"view run --area -900,-900,-800,-800", 2, "--area"},
      {"view run run", 2, "--out"},
      {"view run run run --out x.html", 2},
      {"view run --label a,b", 2, "--label"},
      {"view run run --label a --out x.html", 2, "--label"},
      {"database", 2, "polynya database: a command is missing\n"},
      {"database biuld", 2,
       "polynya database: no such command: biuld; did you mean build?\ncommands: build, show, "
       "query\n"},
      {"database build --fluid 0", 2, "--fluid: \"0\" is not one of: winkler, local-mass, potential, free-surface\n"},
      {"database build --wedge-angles 30", 2, "--wedge-angles"},
      {"database build --wedge-angles 60,30", 2, "--wedge-angles"},
      {"database build --wedge-angles 30,190", 2, "--wedge-angles"},
      {"database build --wedge-angles 30,nan", 2, "--wedge-angles"},
      {"database build --threads 0", 2, "--threads: "},
      {"database build --threads 1.5", 2, "--threads: 1.5 is not a whole number from 1 to 1024"},
      {{"database", "build", "--out", ""}, 2, "--out: the name is empty"},
      {"database show --hull-angle 5", 2, "a hull 5 deg from the vertical only crushes ice of friction 0.2"},
      {{"database", "show", "--svg", ""}, 2, "--svg: the name is empty"},
      {"database query --speed 1 --hull-angle 60 --wedge-angle 90", 2, "--thickness"},
      {query, 2},
      {query + "--wedge-angle 0", 2, "--wedge-angle"},
      {query + "--wedge-angle nan", 2, "--wedge-angle"},
      {query + "--front-angle 30", 2, "--back-angle"},
      {query + "--front-angle 0 --back-angle 0", 2},
      {query + "--wedge-angle 90 --front-angle 30 --back-angle 60", 2},
      {query + "--wedge-angle 90 --density 1100", 2, "ice of 1100 kg/m3 does not float in water of 1000 kg/m3"}};
  expect_refusals(rows, {folder->path()});
  for (const char* name : {"x.html", "runs"}) EXPECT_FALSE(std::filesystem::exists(*folder / name)) << name;
}

/// CLI11's range accepts nan, and a checkpoint every nan seconds is none.
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
  /// What bash completes a line to.
  std::string completed(const std::string& line) const {
    const std::string script = "source " POLYNYA_BINARY ".bash; COMP_WORDS=(" + line +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _polynya; echo \" ${COMPREPLY[*]} \"";
    FILE* pipe = popen(("cd '" + folder.path().string() + "' && bash -c '" + script + "'").c_str(), "r");
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
    EXPECT_EQ(pclose(pipe), 0);
    return text;
  }
  /// What the build writes beside the program.
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
  static const std::regex kOption(R"(\n  (?:-\w,)?(--[a-z-]+))");
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
