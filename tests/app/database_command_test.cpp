// `polynya database` as users and scripts call it: the built program, its files and its exit codes.
#include <cmath>
#include <csignal>
#include <numbers>
#include <sstream>

#include "program.hpp"
#include <fmt/format.h>

#include "fracture/bending/database.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/crushing.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

class Database : public InFolder {
 protected:
  Outcome database(const Words& words) const { return polynya(Words("database") + words, folder); }
  /// The fewest wedges that make a database.
  const Words build_small = "build --fluid winkler --wedge-angles 40,90 --threads 2 --out";
  const Words paper_wedge = "query --json --thickness 0.5 --wedge-angle 90 --hull-angle 60 --speed";
};

/// Returns the number at a key of the answer's JSON, or NaN for null.
double number(const std::string& as_json, const std::string& key) {
  const std::size_t place = as_json.find('"' + key + "\": ");
  EXPECT_NE(place, std::string::npos) << key;
  const std::string value = as_json.substr(place + key.size() + 4, 40);
  return value.starts_with("null") ? std::nan("") : std::stod(value);
}

TEST_F(Database, BuildMakesTheShippedBytes) {
  const Outcome built = expect_code(0, database("build --threads 2 --progress json"));
  EXPECT_HAS(built.out, "byte for byte the database that ships with Polynya");
  EXPECT_EQ(read("icebreaking-database.txt"), fracture::default_database_text());
  EXPECT_HAS(built.err, R"("wedges":45,"wedges_total":45)");
}

TEST_F(Database, BuildMakesWhatIsAskedAndOverwritesOnlyWhenTold) {
  ASSERT_EQ(database(build_small + "small.txt").code, 0);
  const std::string small = read("small.txt");
  const auto built = checked(fracture::parse_database(small));
  EXPECT_EQ(built->settings().fluid, fracture::FluidModel::kWinkler);
  EXPECT_EQ(built->grid().opening_angles_deg, (std::vector<double>{40, 90}));
  EXPECT_EQ(built->grid().softnesses, fracture::default_grid().softnesses);

  write("kept.txt", "mine");
  const Words build = "database build --fluid winkler --wedge-angles 40,90 --threads 1 --out kept.txt";
  expect_refusals({{build, 5, "kept.txt: it exists already"}}, {folder.path()});
  expect_refusals({{build + "--overwrite", 5, "kept.txt: "}}, {folder.path(), 10'000});  // as on a full disk
  EXPECT_EQ(read("kept.txt"), "mine");
  done(build + "--overwrite");
  EXPECT_EQ(read("kept.txt"), small) << "one thread makes what two made";
  EXPECT_FALSE(std::filesystem::exists(folder / "kept.txt.part"));

  EXPECT_HAS(expect_code(0, database("show small.txt")).out, small.substr(small.rfind(' ') + 1, 16), "winkler",
             " 2: 40 90\n", "1800:");
  const Outcome of_small = database(paper_wedge + "1 --database small.txt");
  EXPECT_HAS(of_small.out, R"("fluid": "winkler")");
  EXPECT_NE(number(of_small.out, "vertical_force_N"), number(database(paper_wedge + "1").out, "vertical_force_N"));
}

// The fault is found before the work: no wedge is solved, otherwise --progress json would report it.
TEST_F(Database, NowhereToWriteIsFoundBeforeTheWork) {
  std::filesystem::create_directory(folder / "folder");
  for (const std::string& out : Words("missing/file.txt folder /dev/full")) {
    const Outcome outcome = expect_code(5, database(Words("build --overwrite --progress json --out") + out));
    EXPECT_HAS(outcome.err, "polynya: ");
    EXPECT_LACKS(outcome.err, "wedges_total");
  }
}

TEST_F(Database, BuildLeavesNothingWhenStopped) {
  const Start start{folder.path()};
  const pid_t child = start_polynya("database build --threads 1", start);
  usleep(300'000);  // the whole takes seconds at the least
  kill(child, SIGTERM);
  EXPECT_EQ(wait_for(child, start).code, -SIGTERM);
  EXPECT_FALSE(std::filesystem::exists(folder / "icebreaking-database.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "icebreaking-database.txt.part"));
}

TEST_F(Database, QueryIsTheModelOfTheSimulation) {
  const Outcome outcome = done(
      "database query --json --thickness 1.2 --speed 2.5 --front-angle 30 --back-angle 70 --hull-angle 50 "
      "--slip-speed 1.5 --friction 0.1 --flexural-strength 6e5 --compressive-strength 2e6 --youngs-modulus 4e9 "
      "--density 910 --water-density 1025");
  constexpr double kDegree = std::numbers::pi / 180;
  fracture::BendingLoad load;
  load.ice.thickness = 1.2;
  load.ice.friction = 0.1;
  load.ice.flexural_strength = 6e5;
  load.ice.compressive_strength = 2e6;
  load.ice.youngs_modulus = 4e9;
  load.ice.density = 910;
  load.water.density = 1025;
  load.front_half_angle = 30 * kDegree;
  load.back_half_angle = 70 * kDegree;
  load.hull_angle = 50 * kDegree;
  load.mean_approach_speed = 2.5;
  load.vertical_to_crushing = fracture::crushing_shares(load.hull_angle, 0.1, 2.5, 1.5).vertical;
  const fracture::BendingForecast forecast = fracture::FsiDatabaseModel().forecast(load);
  for (const auto& [key, value] : {std::pair{"vertical_force_N", forecast.capacity.vertical_force},
                                   {"normal_force_N", forecast.normal_force},
                                   {"time_s", forecast.time},
                                   {"cusp_radius_m", forecast.capacity.cusp_radius},
                                   {"penetration_m", forecast.penetration}})
    EXPECT_NEAR(number(outcome.out, key) / value, 1, 1e-12) << key;
  EXPECT_TRUE(io::parse_json(outcome.out).faults.empty());
  EXPECT_HAS(outcome.out, R"("radial_crack_first": )", R"("in_range": true)");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Database, QueryNamesWhatIsOutside) {
  struct Row {
    Words words;
    std::string as_json, note;
  };
  for (const auto& [words, as_json, note] :
       {Row{"--wedge-angle 10 --hull-angle 60", R"([    "opening angle"  ])",
            "opening angle 10, the table's 20 to 180;"},
        Row{"--wedge-angle 90 --hull-angle 60 --poisson-ratio 0.25", R"([    "Poisson ratio"  ])",
            "Poisson ratio 0.25, the table's 0.3;"},
        Row{"--wedge-angle 90 --hull-angle 60 --youngs-modulus 1e4", R"([    "mass ratio",    "softness"  ])",
            "mass ratio 1.369, the table's 0.02 to 0.1; softness 0.7476, the table's 3e-05 to 0.1;"},
        // Just below the angle where the hull no longer presses the ice down, the contact crushes far through the
        // thickness: outside is the softness of the equivalent push, not the load's own.
        Row{"--wedge-angle 90 --hull-angle 12", R"([    "equivalent softness"  ])", "equivalent softness "}}) {
    const Outcome outcome = expect_code(0, database(Words("query --json --thickness 0.5 --speed 1") + words));
    std::string one_line = outcome.out;
    std::erase(one_line, '\n');
    EXPECT_HAS(one_line, R"("outside": )" + as_json, R"("in_range": false)");
    EXPECT_HAS(outcome.err, "note: outside the database: " + note);
  }
}

// Friction 0.2 outweighs the downward push of hulls steeper than atan 0.2 = 11.3 degrees.
TEST_F(Database, ASteepHullOnlyCrushesAndAtRestNothingBreaksInTime) {
  const Words words = "query --json --thickness 0.5 --speed 1 --wedge-angle 90 --hull-angle";
  const Outcome steep = expect_code(0, database(words + "11"));
  EXPECT_TRUE(std::isnan(number(steep.out, "vertical_force_N")));
  EXPECT_TRUE(std::isnan(number(steep.out, "time_s")));
  EXPECT_HAS(steep.err, "only crushes");
  EXPECT_GT(number(database(words + "12").out, "vertical_force_N"), 0);
  const Outcome rest = expect_code(0, database(paper_wedge + "0"));
  EXPECT_TRUE(std::isnan(number(rest.out, "time_s")));
  EXPECT_GT(number(rest.out, "vertical_force_N"), 0);
  EXPECT_HAS(database("query --speed 0 --thickness 0.5 --wedge-angle 90 --hull-angle 60").out, "never");
}

TEST_F(Database, FilesThatAreNoDatabaseAreRefused) {
  const std::string sound(fracture::default_database_text());
  std::string digit = sound;
  digit[sound.size() / 2] = digit[sound.size() / 2] == '1' ? '2' : '1';
  const std::vector<std::tuple<std::string, std::string, std::string>> files{
      {"empty.txt", "", "1: "},
      {"zeros.txt", std::string(5000, '\0'), "1: "},
      {"half.txt", sound.substr(0, sound.size() / 2), ""},
      {"digit.txt", digit, ""},
      {"later.txt", replaced(sound, "database 1", "database 2"), "1: expected 'polynya-bending-database 1'"},
      {"escape.txt", "polynya-bending-database 1\nfluid \x1b[31mred\n", "2: no such fluid model"},
      {"huge.txt", std::string(fracture::kLargestFile + 1, '7'), " "}};
  std::vector<std::pair<std::string, std::string>> rows{
      {"missing.txt", " "}, {"/dev/zero", " "}, {folder.path().string(), " "}};
  for (const auto& [name, text, message] : files) {
    write(name, text);
    rows.emplace_back(name, message);
  }
  for (const auto& [file, message] : rows) {
    for (const Words& words : {Words("show") + file, paper_wedge + "1 --database" + file}) {
      const Refusal refusal{Words("database") + words, 5, "polynya: " + file + ":" + message};
      expect_refusals({refusal}, {folder.path()});
      EXPECT_LACKS(polynya(refusal.words, folder).err, "\x1b");
    }
  }
}

TEST_F(Database, ShowPrintsTheShippedParametersAndWritesTheNumbersOfItsThreePictures) {
  const std::string shipped = database("show").out;
  EXPECT_HAS(shipped, "ships with Polynya");
  for (const double value : fracture::default_grid().froude_numbers) EXPECT_HAS(shipped, fmt::format(" {:g}", value));
  const Outcome drawn = database("show --svg one/plots");  // 5 where matplotlib is missing
  EXPECT_HAS(drawn.out, "numbers         one/plots/slices.json\n") << drawn.err;
  const auto as_json = io::parse_json(read("one/plots/slices.json"));
  const io::JsonValue* figures = as_json.root.find("figures");
  ASSERT_EQ(figures->items().size(), 3U);
  for (const io::JsonValue& figure : figures->items()) {
    const std::size_t points = figure.find("x")->items().size();
    EXPECT_GT(points, 100U);
    ASSERT_EQ(figure.find("curves")->items().size(), 5U);
    for (const io::JsonValue& curve : figure.find("curves")->items())
      for (const char* key : {"vertical_force_N", "cusp_radius_m", "is_in_range"})
        EXPECT_EQ(curve.find(key)->items().size(), points) << key;
  }
  write("file", "");
  EXPECT_EQ(database("show --svg file").code, 5);
}

}  // namespace
}  // namespace polynya::tests
