// `polynya database` as people and scripts use it: the built program, its files and its exit codes.
#include <cmath>
#include <csignal>
#include <numbers>
#include <sstream>

#include "program.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "fracture/bending/database_text.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/crushing.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

using Words = std::vector<std::string>;

Outcome database(Words words, const TemporaryFolder& folder) {
  words.insert(words.begin(), "database");
  return polynya(words, {folder.path()});
}

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The fewest wedges that make a database, built once.
const std::string& small_database() {
  static const std::string text = [] {
    const TemporaryFolder folder;
    const Outcome built = database(
        {"build", "--fluid", "winkler", "--wedge-angles", "40,90", "--out", "small.txt", "--threads", "2"},
        folder);
    EXPECT_EQ(built.code, 0) << built.err;
    return read_file(folder / "small.txt");
  }();
  return text;
}

const Words kPaperWedge{"--thickness", "0.5", "--wedge-angle", "90", "--hull-angle", "60"};

/// The number at that key of the answer's JSON, NaN for null.
double number(const std::string& json, const std::string& key) {
  const std::size_t place = json.find('"' + key + "\": ");
  EXPECT_NE(place, std::string::npos) << key;
  const std::string value = json.substr(place + key.size() + 4, 40);
  return value.compare(0, 4, "null") == 0 ? std::nan("") : std::stod(value);
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// ---- build

TEST(DatabaseBuildCommand, MakesTheShippedBytes) {
  const TemporaryFolder folder;
  const Outcome built = database({"build", "--threads", "2", "--progress", "json"}, folder);
  EXPECT_EQ(built.code, 0) << built.err;
  EXPECT_TRUE(contains(built.out, "byte for byte the database that ships with Polynya")) << built.out;
  EXPECT_EQ(read_file(folder / "icebreaking-database.txt"), fracture::default_database_text());
  EXPECT_TRUE(contains(built.err, R"("wedges":45,"wedges_total":45)")) << built.err;
}

TEST(DatabaseBuildCommand, MakesWhatIsAsked) {
  const auto read = fracture::parse_database(small_database());
  ASSERT_TRUE(read.has_value()) << read.error().message;
  EXPECT_EQ(read->settings().fluid, fracture::FluidModel::kWinkler);
  EXPECT_EQ(read->grid().opening_angles_deg, (std::vector<double>{40, 90}));
  EXPECT_EQ(read->grid().softnesses, fracture::default_grid().softnesses);
}

TEST(DatabaseBuildCommand, OverwritesOnlyWhenTold) {
  const TemporaryFolder folder;
  write_file(folder / "kept.txt", "mine");
  const Words build{"build",     "--fluid", "winkler", "--wedge-angles", "40,90",
                    "--threads", "1",       "--out",   "kept.txt"};
  const Outcome refused = database(build, folder);
  EXPECT_EQ(refused.code, 5);
  EXPECT_TRUE(contains(refused.err, "kept.txt: it exists already")) << refused.err;
  EXPECT_TRUE(refused.out.empty());
  EXPECT_EQ(read_file(folder / "kept.txt"), "mine");
  EXPECT_EQ(database(build + Words{"--overwrite"}, folder).code, 0);
  EXPECT_EQ(read_file(folder / "kept.txt"), small_database());  // and one thread makes what two made
  EXPECT_FALSE(std::filesystem::exists(folder / "kept.txt.part"));
}

TEST(DatabaseBuildCommand, AFullDiskKeepsTheOldFile) {
  const TemporaryFolder folder;
  write_file(folder / "old.txt", "old");
  const Outcome cut = polynya({"database", "build", "--fluid", "winkler", "--wedge-angles", "40,90", "--out",
                               "old.txt", "--overwrite", "--threads", "2"},
                              {folder.path(), 10'000});
  EXPECT_EQ(cut.code, 5);
  EXPECT_TRUE(contains(cut.err, "old.txt: ")) << cut.err;
  EXPECT_EQ(read_file(folder / "old.txt"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "old.txt.part"));
}

// Before the work: no wedge is solved, which --progress json would show.
TEST(DatabaseBuildCommand, NowhereToWriteIsFoundBeforeTheWork) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder");
  std::filesystem::create_symlink("nowhere/file.txt", folder / "dangling");
  // Nobody, root included, makes files in /proc, or files of such names anywhere.
  const std::string long_name(255, 'n');
  for (const std::string& out :
       {std::string("missing/file.txt"), std::string("folder"), std::string("/dev/full"),
        std::string("/proc/file.txt"), std::string("dangling"), long_name}) {
    const Outcome outcome = database({"build", "--out", out, "--overwrite", "--progress", "json"}, folder);
    EXPECT_EQ(outcome.code, 5) << out;
    EXPECT_TRUE(contains(outcome.err, "polynya: ")) << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "wedges_total")) << outcome.err;
  }
}

TEST(DatabaseBuildCommand, LeavesNothingWhenStopped) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  const pid_t child = start_polynya({"database", "build", "--threads", "1"}, start);
  usleep(300'000);  // the whole takes seconds at the least
  kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child, start).code, -SIGTERM);
  EXPECT_FALSE(std::filesystem::exists(folder / "icebreaking-database.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "icebreaking-database.txt.part"));
}

// ---- query

// The paper's ice, ship at .1 … 4 m/s; expected from an independent prototype of the solution that is
// tabulated.
TEST(DatabaseQueryCommand, AnswersThePapersIce) {
  struct Row {
    double ship_speed, force_kN, time, radius;
  };
  const TemporaryFolder folder;
  for (const auto& [ship_speed, force, time, radius] : {Row{.1, 70.5, 1.893, 3.03},
                                                        {.5, 70.6, .379, 2.64},
                                                        {1, 71.6, .191, 2.17},
                                                        {2, 73.2, .0965, 1.74},
                                                        {4, 75.5, .049, 1.39}}) {
    const double speed = ship_speed * std::cos(27 * std::numbers::pi / 180);
    const Outcome outcome =
        database(Words{"query", "--json", "--speed", fmt::format("{}", speed)} + kPaperWedge, folder);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(io::parse_json(outcome.out).faults.empty());
    EXPECT_NEAR(number(outcome.out, "vertical_force_N") / 1e3 / force, 1, 0.007) << ship_speed;
    EXPECT_NEAR(number(outcome.out, "time_s") / time, 1, 0.01) << ship_speed;
    EXPECT_NEAR(number(outcome.out, "cusp_radius_m") / radius, 1, 0.02) << ship_speed;
    EXPECT_TRUE(contains(outcome.out, R"("radial_crack_first": false)"));
    EXPECT_TRUE(contains(outcome.out, R"("in_range": true)"));
    EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  }
}

TEST(DatabaseQueryCommand, IsTheModelOfTheSimulation) {
  const TemporaryFolder folder;
  const Outcome outcome = database({"query",
                                    "--json",
                                    "--thickness",
                                    "1.2",
                                    "--speed",
                                    "2.5",
                                    "--front-angle",
                                    "30",
                                    "--back-angle",
                                    "70",
                                    "--hull-angle",
                                    "50",
                                    "--slip-speed",
                                    "1.5",
                                    "--friction",
                                    "0.1",
                                    "--flexural-strength",
                                    "6e5",
                                    "--compressive-strength",
                                    "2e6",
                                    "--youngs-modulus",
                                    "4e9",
                                    "--density",
                                    "910",
                                    "--water-density",
                                    "1025"},
                                   folder);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  fracture::BendingLoad load;
  load.ice.thickness = 1.2;
  load.ice.friction = 0.1;
  load.ice.flexural_strength = 6e5;
  load.ice.compressive_strength = 2e6;
  load.ice.youngs_modulus = 4e9;
  load.ice.density = 910;
  load.water.density = 1025;
  load.front_half_angle = 30 * std::numbers::pi / 180;
  load.back_half_angle = 70 * std::numbers::pi / 180;
  load.hull_angle = 50 * std::numbers::pi / 180;
  load.mean_approach_speed = 2.5;
  load.vertical_to_crushing = fracture::crushing_shares(load.hull_angle, 0.1, 2.5, 1.5).vertical;
  const fracture::BendingForecast forecast = fracture::FsiDatabaseModel().forecast(load);
  EXPECT_NEAR(number(outcome.out, "vertical_force_N") / forecast.capacity.vertical_force, 1, 1e-12);
  EXPECT_NEAR(number(outcome.out, "normal_force_N") / forecast.normal_force, 1, 1e-12);
  EXPECT_NEAR(number(outcome.out, "time_s") / forecast.time, 1, 1e-12);
  EXPECT_NEAR(number(outcome.out, "cusp_radius_m") / forecast.capacity.cusp_radius, 1, 1e-12);
  EXPECT_NEAR(number(outcome.out, "penetration_m") / forecast.penetration, 1, 1e-12);
}

TEST(DatabaseQueryCommand, NamesWhatIsOutside) {
  struct Row {
    Words words;
    std::string json, note;
  };
  const TemporaryFolder folder;
  for (const auto& [words, json, note] :
       {Row{{"--wedge-angle", "10", "--hull-angle", "60"},
            R"([    "opening angle"  ])",
            "opening angle 10, the table's 20 to 180;"},
        Row{{"--wedge-angle", "90", "--hull-angle", "60", "--poisson-ratio", "0.25"},
            R"([    "Poisson ratio"  ])",
            "Poisson ratio 0.25, the table's 0.3;"},
        Row{{"--wedge-angle", "90", "--hull-angle", "60", "--youngs-modulus", "1e4"},
            R"([    "mass ratio",    "softness"  ])",
            "mass ratio 1.369, the table's 0.02 to 0.1; softness 0.7476, the table's 3e-05 to 0.1;"}}) {
    const Outcome outcome =
        database(Words{"query", "--json", "--thickness", "0.5", "--speed", "1"} + words, folder);
    EXPECT_EQ(outcome.code, 0);
    std::string one_line = outcome.out;
    std::erase_if(one_line, [](char c) { return c == '\n'; });
    EXPECT_TRUE(contains(one_line, R"("outside": )" + json)) << outcome.out;
    EXPECT_TRUE(contains(outcome.out, R"("in_range": false)"));
    EXPECT_TRUE(contains(outcome.err, "note: outside the database: " + note)) << outcome.err;
  }
}

// Just below the angle where the hull no longer presses the ice down, the contact crushes far through the
// thickness. What is outside is the softness of the equivalent push, not the load's own, which the table
// holds.
TEST(DatabaseQueryCommand, NamesTheSoftnessThatIsOutside) {
  const TemporaryFolder folder;
  const Words words{"query",         "--thickness", "0.5",          "--speed", "1",
                    "--wedge-angle", "90",          "--hull-angle", "12"};
  const Outcome outcome = database(words + Words{"--json"}, folder);
  ASSERT_EQ(outcome.code, 0);
  EXPECT_LT(number(outcome.out, "softness"), 0.1);
  const double equivalent = number(outcome.out, "equivalent_softness");
  EXPECT_GT(equivalent, 0.1);
  EXPECT_TRUE(contains(outcome.err, fmt::format("note: outside the database: equivalent softness {:.4g}, "
                                                "the table's 3e-05 to 0.1;",
                                                equivalent)))
      << outcome.err;
  EXPECT_TRUE(
      contains(database(words, folder).out,
               fmt::format("crushes through the thickness: equivalent softness {:.4g}\n", equivalent)));
}

// Nevel's form is of narrow wedges.
TEST(DatabaseQueryCommand, NevelsFormIsOutOfRangeForWideWedges) {
  const TemporaryFolder folder;
  const Words words{"query", "--json", "--thickness", "0.5", "--speed", "1", "--hull-angle", "60"};
  const auto nevel_in_range = [&](const char* angle) {
    const std::string json = database(words + Words{"--wedge-angle", angle}, folder).out;
    const std::size_t nevel = json.find("\"nevel\""), answer = json.find("\"in_range\": ", nevel);
    return json.compare(answer + 12, 4, "true") == 0;
  };
  EXPECT_TRUE(nevel_in_range("50"));
  EXPECT_FALSE(nevel_in_range("90"));
  EXPECT_FALSE(nevel_in_range("170"));
}

// Friction 0.2 outweighs the downward push of hulls steeper than atan 0.2 = 11.3 degrees.
TEST(DatabaseQueryCommand, ASteepHullOnlyCrushes) {
  const TemporaryFolder folder;
  const Words words{"query", "--json",        "--thickness", "0.5",         "--speed",
                    "1",     "--wedge-angle", "90",          "--hull-angle"};
  const Outcome steep = database(words + Words{"11"}, folder);
  EXPECT_EQ(steep.code, 0);
  EXPECT_TRUE(std::isnan(number(steep.out, "vertical_force_N")));
  EXPECT_TRUE(std::isnan(number(steep.out, "time_s")));
  EXPECT_TRUE(contains(steep.err, "only crushes")) << steep.err;
  EXPECT_GT(number(database(words + Words{"12"}, folder).out, "vertical_force_N"), 0);
}

TEST(DatabaseQueryCommand, AtRestNothingBreaksInTime) {
  const TemporaryFolder folder;
  const Outcome rest = database(Words{"query", "--json", "--speed", "0"} + kPaperWedge, folder);
  EXPECT_EQ(rest.code, 0);
  EXPECT_TRUE(std::isnan(number(rest.out, "time_s")));
  EXPECT_GT(number(rest.out, "vertical_force_N"), 0);
  EXPECT_TRUE(contains(database(Words{"query", "--speed", "0"} + kPaperWedge, folder).out, "never"));
}

TEST(DatabaseQueryCommand, AnswersFromTheFileItIsGiven) {
  const TemporaryFolder folder;
  write_file(folder / "small.txt", small_database());
  const Words words = Words{"query", "--json", "--speed", "1"} + kPaperWedge;
  const Outcome small = database(words + Words{"--database", "small.txt"}, folder);
  EXPECT_EQ(small.code, 0) << small.err;
  EXPECT_TRUE(contains(small.out, R"("fluid": "winkler")")) << small.out;
  EXPECT_NE(number(small.out, "vertical_force_N"), number(database(words, folder).out, "vertical_force_N"));
}

// ---- usage and hostile files

TEST(DatabaseCommand, HelpLeadsToExamples) {
  const TemporaryFolder folder;
  EXPECT_TRUE(contains(polynya({"--help"}, {folder.path()}).out, "database"));
  for (const char* command : {"build", "show", "query", "study"}) {
    const Outcome help = database({command, "--help"}, folder);
    EXPECT_EQ(help.code, 0);
    EXPECT_TRUE(contains(help.out, "Examples:")) << command;
  }
}

TEST(DatabaseCommand, UsageErrorsAreTwo) {
  const TemporaryFolder folder;
  const Words query{"query", "--thickness", "1", "--speed", "1", "--hull-angle", "60"};
  const std::vector<Words> wrong{
      {},
      {"melt"},
      {"build", "--fluid", "honey"},
      {"build", "--wedge-angles", "30"},
      {"build", "--wedge-angles", "60,30"},
      {"build", "--wedge-angles", "30,190"},
      {"build", "--wedge-angles", "30,nan"},
      {"build", "--threads", "0"},
      {"show", "--hull-angle", "5"},
      {"study"},
      {"study", "colour"},
      {"study", "accuracy", "--points", "0"},
      {"study", "accuracy", "--seed", "-1"},
      {"study", "1"},
      {"study", "accuracy", "--inner-radius", "0"},
      {"study", "accuracy", "--elements", "3"},
      {"build", "--fluid", "0"},
      {"query", "--speed", "1", "--hull-angle", "60", "--wedge-angle", "90"},
      query,
      query + Words{"--wedge-angle", "0"},
      query + Words{"--wedge-angle", "nan"},
      query + Words{"--front-angle", "30"},
      query + Words{"--front-angle", "0", "--back-angle", "0"},
      query + Words{"--wedge-angle", "90", "--front-angle", "30", "--back-angle", "60"},
      query + Words{"--wedge-angle", "90", "--density", "1100"}};
  for (const Words& words : wrong) {
    const Outcome outcome = database(words, folder);
    EXPECT_EQ(outcome.code, 2) << (words.empty() ? "" : words.front() + " … " + words.back());
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    EXPECT_FALSE(outcome.err.empty());
  }
}

// Each message names the option, what it was given and what it takes.
TEST(DatabaseCommand, UsageErrorsNameWhatIsTaken) {
  struct Row {
    Words words;
    std::string message;
  };
  const TemporaryFolder folder;
  for (const auto& [words, message] :
       {Row{{"build", "--fluid", "0"}, "winkler, local-mass, potential, free-surface"},
        Row{{"study", "1"}, "fluid, couple, accuracy"},
        Row{{"build", "--threads", "1.5"}, "--threads: 1.5 is not a whole number from 1 to 1024"},
        Row{{"study", "accuracy", "--points", "x"}, "--points: x is not a whole number from 1 to 100000"},
        Row{{"study", "accuracy", "--seed", "1.5"},
            "--seed: 1.5 is not a whole number from 0 to 9007199254740991"},
        Row{{"study", "accuracy", "--inner-radius", "1"},
            "--inner-radius: 1 is not a number from 1e-06 to 0.1"},
        Row{{"build", "--out", ""}, "--out: the name is empty"},
        Row{{"show", "--svg", ""}, "--svg: the name is empty"},
        Row{{"study", "accuracy", "--database", ""}, "--database: the name is empty"}}) {
    const Outcome outcome = database(words, folder);
    EXPECT_EQ(outcome.code, 2) << message;
    EXPECT_TRUE(contains(outcome.err, message)) << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "->")) << outcome.err;  // CLI11's enum maps
  }
}

TEST(DatabaseCommand, RefusesFilesThatAreNoDatabase) {
  const TemporaryFolder folder;
  const std::string& sound = small_database();
  std::string digit = sound;
  digit[sound.size() / 2] = digit[sound.size() / 2] == '1' ? '2' : '1';
  std::string later = sound;
  later.replace(later.find("database 1"), 10, "database 2");
  write_file(folder / "empty.txt", "");
  write_file(folder / "zeros.txt", std::string(5000, '\0'));
  write_file(folder / "half.txt", sound.substr(0, sound.size() / 2));
  write_file(folder / "digit.txt", digit);
  write_file(folder / "later.txt", later);
  write_file(folder / "escape.txt", "polynya-bending-database 1\nfluid \x1b[31mred\n");
  write_file(folder / "huge.txt", std::string(fracture::kLargestFile + 1, '7'));
  struct Row {
    std::string file, message;
  };
  for (const auto& [file, message] : {Row{"missing.txt", "missing.txt: "},
                                      {"/dev/zero", "/dev/zero: "},
                                      {folder.path().string(), folder.path().string() + ": "},
                                      {"huge.txt", "huge.txt: "},
                                      {"empty.txt", "empty.txt:1: "},
                                      {"zeros.txt", "zeros.txt:1: "},
                                      {"half.txt", "half.txt:"},
                                      {"digit.txt", "digit.txt:"},
                                      {"later.txt", "later.txt:1: expected 'polynya-bending-database 1'"},
                                      {"escape.txt", "escape.txt:2: no such fluid model"}}) {
    for (const Words& words :
         {Words{"show", file}, Words{"query", "--speed", "1", "--database", file} + kPaperWedge,
          Words{"study", "accuracy", "--database", file}}) {
      const Outcome outcome = database(words, folder);
      EXPECT_EQ(outcome.code, 5) << file;
      EXPECT_TRUE(outcome.out.empty());
      EXPECT_TRUE(contains(outcome.err, "polynya: " + message)) << outcome.err;
      EXPECT_FALSE(contains(outcome.err, "\x1b"));
    }
  }
}

// ---- show

TEST(DatabaseShowCommand, PrintsAllOfTheFilesParameters) {
  const TemporaryFolder folder;
  write_file(folder / "small.txt", small_database());
  const Outcome shown = database({"show", "small.txt"}, folder);
  EXPECT_EQ(shown.code, 0) << shown.err;
  const std::string hash = small_database().substr(small_database().rfind(' ') + 1, 16);
  for (const std::string& part :
       {hash, std::string("winkler"), std::string(" 2: 40 90\n"), std::string("1800:")})
    EXPECT_TRUE(contains(shown.out, part)) << part << '\n' << shown.out;
  const std::string shipped = database({"show"}, folder).out;
  EXPECT_TRUE(contains(shipped, "ships with Polynya"));
  for (const double value : fracture::default_grid().froude_numbers)
    EXPECT_TRUE(contains(shipped, fmt::format(" {:g}", value)));
}

TEST(DatabaseShowCommand, WritesTheNumbersOfItsThreePictures) {
  const TemporaryFolder folder;
  const Outcome drawn = database({"show", "--svg", "one/plots"}, folder);  // 5 where matplotlib is missing
  EXPECT_NE(drawn.out.find("numbers         one/plots/slices.json\n"), std::string::npos) << drawn.err;
  const std::string text = read_file(folder / "one/plots/slices.json");
  const auto json = io::parse_json(text);
  const io::JsonValue* figures = json.root.find("figures");
  ASSERT_EQ(figures->items().size(), 3U);
  for (const io::JsonValue& figure : figures->items()) {
    const std::size_t points = figure.find("x")->items().size();
    EXPECT_GT(points, 100U);
    ASSERT_EQ(figure.find("curves")->items().size(), 5U);
    for (const io::JsonValue& curve : figure.find("curves")->items()) {
      for (const char* key : {"vertical_force_N", "cusp_radius_m", "is_in_range"})
        EXPECT_EQ(curve.find(key)->items().size(), points) << key;
    }
  }
  write_file(folder / "file", "");
  EXPECT_EQ(database({"show", "--svg", "file"}, folder).code, 5);
}

// ---- study

/// The numbers of a Markdown table's rows.
std::vector<std::vector<double>> rows_of(const std::string& table) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    if (line.size() < 3 || line[0] != '|' || std::isdigit(static_cast<unsigned char>(line[2])) == 0) continue;
    for (char& c : line)
      if (c == '|' || c == ',') c = ' ';
    std::istringstream numbers(line);
    rows.emplace_back();
    for (double value = 0; numbers >> value;) rows.back().push_back(value);
  }
  return rows;
}

// Ice that sinks under the hull is reached later; the force that breaks it hardly changes.
TEST(DatabaseStudyCommand, Couple) {
  const TemporaryFolder folder;
  const Outcome study = database({"study", "couple"}, folder);
  EXPECT_EQ(study.code, 0) << study.err;
  const auto rows = rows_of(study.out);
  ASSERT_EQ(rows.size(), 7U) << study.out;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 7U);
    EXPECT_GT(row[6], row[3]);
    EXPECT_NEAR(row[4] / row[1], 1, 0.02);
  }
}

// At rest the water only carries; the free surface stays near the potential flow at every speed.
TEST(DatabaseStudyCommand, Fluid) {
  const TemporaryFolder folder;
  const Outcome study = database({"study", "fluid", "--thickness", "0.8"}, folder);
  EXPECT_EQ(study.code, 0) << study.err;
  const auto rows = rows_of(study.out);
  ASSERT_EQ(rows.size(), 7U) << study.out;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 9U);
    EXPECT_NEAR(row[7] / row[5], 1, 0.02) << "free-surface against potential at " << row[0];
  }
  for (const std::size_t fluid : {3U, 5U, 7U}) EXPECT_NEAR(rows[0][fluid] / rows[0][1], 1, 0.005);
}

TEST(DatabaseStudyCommand, AccuracyOfTheSeedWhateverTheThreads) {
  const TemporaryFolder folder;
  const Words words{"study", "accuracy", "--points", "8", "--seed", "5", "--threads"};
  const Outcome one = database(words + Words{"1"}, folder);
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(one.out, database(words + Words{"3"}, folder).out);
  EXPECT_TRUE(contains(one.out, "8 random points of the whole box, seed 5")) << one.out;
  EXPECT_TRUE(contains(one.out, "| force | 0.")) << one.out;
  EXPECT_TRUE(contains(one.out, "(36 elements from 0.001 l) against solution (40 elements from 0.00025 l)"))
      << one.out;
  const Outcome other = database(
      {"study", "accuracy", "--points", "2", "--seed", "5", "--inner-radius", "0.002", "--elements", "30"},
      folder);
  EXPECT_TRUE(contains(other.out, "against solution (30 elements from 0.002 l)")) << other.out;
}

}  // namespace
}  // namespace polynya::tests
