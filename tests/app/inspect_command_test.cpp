#include "program.hpp"
#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::tests {
namespace {

class InspectCommand : public PlateRun {
 protected:
  static Outcome inspect(const Words& words, const std::string& of = "run") { return on_run("inspect", words, of); }
  static std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }
  static std::size_t living_at(double time) {
    std::size_t count = 0;
    for (const io::RunFloe& floe : run->floes) count += run->is_alive(floe.birth.floe, time) ? 1 : 0;
    return count;
  }
};

TEST_F(InspectCommand, TheTableHasALineForEachLivingFloe) {
  const auto all = lines(expect_code(0, inspect("")).out);
  ASSERT_EQ(all.size(), 1 + living_at(run->end_time()));
  EXPECT_HAS(all[0], "floe", "parent", "born_s", "area_m2", "perimeter_m", "vertices", "holes", "mass_kg",
             "thickness_m", "valid");
  EXPECT_EQ(all[1].substr(all[1].size() - 4), " yes");
  const auto at_start = lines(inspect("--at 0").out);
  ASSERT_EQ(at_start.size(), 2U);
  std::istringstream first(at_start[1]);
  std::string id, parent, born;
  double area = 0, perimeter = 0, vertices = 0;
  first >> id >> parent >> born >> area >> perimeter >> vertices;
  EXPECT_EQ(id + parent + born, "0-0");
  EXPECT_EQ(area, 300 * 150);
  EXPECT_EQ(perimeter, 2 * (300 + 150));
  EXPECT_EQ(vertices, 4);
}

TEST_F(InspectCommand, AFloesShapeReadsBackToTheSameDoubles) {
  const simulation::BirthRecord& birth = run->floes[3].birth;
  for (const char* format : {"wkt", "geojson"}) {
    const auto floes = checked(io::read_floe_text(inspect({"--floe", "3", "--format", format}).out));
    EXPECT_EQ(geometry::normalised(floes->entries.at(0).polygon), *run->shape(3)) << format;
  }
  const simulation::BirthRecord& last = run->floes.back().birth;
  const auto moved = checked(io::read_floe_text(inspect({"--floe", std::to_string(last.floe), "--at", "30"}).out));
  const auto motion = io::MotionIndex(*run).floe_at(last.floe, 30);
  EXPECT_EQ(geometry::normalised(moved->entries.at(0).polygon),
            polygon_in_world(*run->shape(last.floe), last.centroid_in_body, *motion));
  const io::JsonDocument feature = io::parse_json(inspect("--floe 3 --format geojson").out);
  EXPECT_EQ(feature.root.find("properties")->find("parent_id")->number(), static_cast<double>(birth.parent));
  EXPECT_EQ(feature.root.find("properties")->find("frame")->text(), "body");
  EXPECT_HAS(inspect("--floe 3").err, "body frame");
  EXPECT_EQ(inspect({"--floe", std::to_string(last.floe), "--at", "30"}).err, "");
}

TEST_F(InspectCommand, EventsAreALineEachInOrderOfTime) {
  const auto all = lines(inspect("--events").out);
  ASSERT_EQ(all.size(), run->events.size());
  ASSERT_GT(all.size(), 3U);
  double before = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double time = std::stod(all[i]);
    EXPECT_GE(time, before);
    before = time;
    EXPECT_HAS(all[i], "(floe " + std::to_string(run->events[i].ice()->floe) + ")");
  }
  const io::JsonDocument printed = io::parse_json(inspect("--events --json").out);
  ASSERT_EQ(printed.root.find("events")->items().size(), run->events.size());
  EXPECT_EQ(printed.root.find("events")->items()[0].find("t_s")->number(), run->events[0].time);
}

TEST_F(InspectCommand, TheLineageLeadsFromTheSceneToTheFloe) {
  const simulation::FloeId last = run->floes.back().birth.floe;
  const auto ids = run->lineage(last);
  const std::string tree = inspect({"--lineage", std::to_string(last)}).out;
  std::size_t at = 0;
  for (const simulation::FloeId id : ids) {
    const std::size_t found = tree.find("floe " + std::to_string(id) + "  ", at);
    ASSERT_NE(found, std::string::npos) << id << "\n" << tree;
    at = found;
  }
  EXPECT_BEGINS(tree, "floe 0  45000.000000 m2  as in the scene");
  EXPECT_HAS(tree, "bend by icebreaker at (");
  std::size_t fractures = 0;
  for (const std::string& line : lines(tree)) fractures += line.find(" by icebreaker at (") != std::string::npos;
  EXPECT_EQ(fractures, ids.size() - 1) << "one fracture between each and the next";
}

TEST_F(InspectCommand, ASoundRunPassesTheCheck) {
  const std::string text = expect_code(0, inspect("--check")).out;
  EXPECT_BEGINS(lines(text)[0], "files      ");
  EXPECT_HAS(lines(text)[0], " compared with checksums, 0 damaged");
  EXPECT_EQ(lines(text)[1], "validity   " + std::to_string(run->floes.size()) + " shapes, 0 invalid");
  EXPECT_EQ(lines(text).back(), "sound");
  EXPECT_HAS(text, std::to_string(run->frames.size()) + " instants", "Overlap is part of the contact model",
             "places     " + io::counted(living_at(30), "floe") + " at 30 s: ", "; 0 floes are wrong");
}

TEST_F(InspectCommand, ReportsAreJsonOnRequest) {
  const auto report = [](Words words) {
    words.emplace_back("--json");
    const Outcome outcome = expect_code(0, inspect(words));
    io::JsonDocument document = io::parse_json(outcome.out);
    EXPECT_TRUE(document.faults.empty()) << outcome.out;
    return std::move(document.root);
  };
  const io::JsonValue table = report({});
  ASSERT_EQ(table.find("floes")->items().size(), living_at(run->end_time()));
  double area = 0;
  for (const io::JsonValue& floe : table.find("floes")->items()) {
    area += floe.find("area_m2")->number();
    EXPECT_EQ(floe.find("valid")->text(), "yes");
    EXPECT_GT(floe.find("perimeter_m")->number(), 0);
  }
  const io::JsonValue sizes = report({"--fsd"});
  EXPECT_NEAR(sizes.find("area_m2")->number(), area, 1e-9 * area);
  double of_classes = 0, floes = 0;
  for (const io::JsonValue& one : sizes.find("classes")->items()) {
    of_classes += one.find("area_m2")->number();
    floes += one.find("floes")->number();
  }
  EXPECT_NEAR(of_classes, area, 1e-9 * area);
  EXPECT_EQ(floes, static_cast<double>(living_at(run->end_time())));
  EXPECT_BEGINS(inspect("--fsd").out, io::counted(living_at(run->end_time()), "floe") + ", ");
  const simulation::FloeId last = run->floes.back().birth.floe;
  const io::JsonValue lineage = report({"--lineage", std::to_string(last)});
  const auto& trunk = lineage.find("lineage")->items();
  ASSERT_EQ(trunk.size(), run->lineage(last).size());
  EXPECT_EQ(trunk.front().find("broken_by")->find("kind")->text(), "bend");
  EXPECT_TRUE(trunk.back().find("broken_by")->is_null());
  const io::JsonValue check = report({"--check"});
  EXPECT_TRUE(check.find("is_sound")->boolean());
  EXPECT_EQ(check.find("shapes")->number(), static_cast<double>(run->floes.size()));
  EXPECT_EQ(check.find("final_places")->find("floes")->number(), static_cast<double>(living_at(run->end_time())));
  EXPECT_LT(check.find("final_places")->find("farthest_m")->number(), 0.01);
}

/// The accounts of ice, energy and momentum equal the accounts in summary.json, and so do those of moorings if there
/// are any.
TEST(InspectAccounts, AreThoseOfTheSummaryMooringsIncluded) {
  const TemporaryFolder folder;
  write_file(folder / "moored.json", R"({"time": {"until_s": 30},
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7,
      "moment_of_inertia_kg_m2": 5e9, "propulsion": {"thrust_N": 0},
      "mooring": {"surge_stiffness_N_per_m": 1e6, "surge_damping_N_s_per_m": 1e5, "position_m": [1, 0]}}]})");
  const Start start{folder.path()};
  EXPECT_HAS(expect_code(0, polynya(Words{"run", "moored.json", "--out", "run"}, start)).out, "moorings    ",
             "500 at the start");
  const std::string text = expect_code(0, polynya(Words{"inspect", "run", "--accounts"}, start)).out;
  EXPECT_HAS(text, "ledger\n", "energy\n", "  initial_stored_J                   500000\n", "mooring_damping_J",
             "moorings\n", "taken_up_J", "given_back_J", "momentum\n", "imbalance_Ns", "audit_closed");
  const auto report =
      io::parse_json(expect_code(0, polynya(Words{"inspect", "run", "--accounts", "--json"}, start)).out);
  const auto summary = io::parse_json(read_file(folder / "run/summary.json"));
  const auto of = [](const io::JsonDocument& document, const char* account, const char* key) {
    return document.root.find(account)->find(key)->number();
  };
  for (const char* key : {"initial_stored_J", "stored_J", "mooring_damping_J", "mooring_breaking_J", "kinetic_J"})
    EXPECT_EQ(of(report, "energy", key), of(summary, "energy", key)) << key;
  EXPECT_NEAR(
      of(report, "energy", "kinetic_J") + of(report, "energy", "stored_J") + of(report, "energy", "mooring_damping_J"),
      5e5, 1e-6);
  const double left = of(report, "moorings", "taken_up_J") - of(report, "moorings", "given_back_J");
  EXPECT_NEAR(5e5 + left, of(report, "moorings", "stored_J"), 1e-6);
  EXPECT_TRUE(report.root.find("audit_closed")->boolean() && report.root.find("ledger_closed")->boolean());
}

/// A ring with two vertices exchanged, an area that is not its ring's, or a floe at another place at the end: the check
/// names the floe.
TEST_F(InspectCommand, ADamagedRunFailsTheCheck) {
  const auto floes = folder->path() / "damaged/floes.ndjson";
  std::filesystem::copy(folder->path() / "run", folder->path() / "damaged");
  const std::string sound = read_file(floes);
  for (const auto& [good, wrong, words] :
       {std::tuple{"[300,-75],[300,75]", "[300,75],[300,-75]", "floe 0: self-crossing"},
        {"\"area_m2\":45000", "\"area_m2\":45001", "(floe 0), 1 beyond"}}) {
    write_file(floes, replaced(sound, good, wrong));
    const Outcome outcome = expect_code(4, inspect("--check", "damaged"));
    EXPECT_HAS(outcome.out, words);
    EXPECT_EQ(lines(outcome.out).back(), "NOT SOUND");
  }
  write_file(floes, sound);
  expect_code(0, inspect("--check", "damaged"));
  const std::string last = std::to_string(run->floes.back().birth.floe);
  const auto final_floes = folder->path() / "damaged/final.geojson";
  write_file(final_floes, replaced(read_file(final_floes), "\"floe_id\":" + last + ",", "\"floe_id\":0,"));
  EXPECT_HAS(expect_code(4, inspect("--check", "damaged")).out, "2 floes are wrong",
             "floe 0 at 30 s: final.geojson has the floe, which does not float then",
             "floe " + last + " at 30 s: the floe floats then, and final.geojson does not have it");
}

TEST(InspectSplit, TheLineageAndThePlayerStateBothSidesOfASplitByTrueForces) {
  const TemporaryFolder folder;
  write_file(folder.path() / "square.json",
             R"({"time": {"step_s": 0.005, "until_s": 1}, "fracture": {"splitting": {"model": "lefm"}},
        "ships": [{"hull": {"length_m": 60, "beam_m": 16, "entrance_angle_deg": 30, "stem_angle_deg": 60},
          "mass_kg": 3e6, "moment_of_inertia_kg_m2": 8e8, "position_m": [-30.01, 0],
          "propulsion": {"constant_speed_m_per_s": 1}}],
        "floes": [{"rectangle": {"corner_m": [0, -8], "size_m": [16, 16]}}]})");
  ASSERT_EQ(polynya("run square.json --out run", folder).code, 0);
  const std::string tree = polynya("inspect run --lineage 1", folder).out;
  EXPECT_HAS(tree, "split by", "opening force", ">= opening capacity", "crack length 15.", "contact force",
             "left flank", "K_IC 1.5e+05 Pa √m");
  ASSERT_EQ(polynya("view run", folder).code, 0);
  const std::string page = read_file(folder.path() / "run/view.html");
  EXPECT_HAS(page, "\"left_flank_force_N\":", "\"opening_capacity_N\":", "\"fracture_toughness_Pa_sqrt_m\":150000");
}

}  // namespace
}  // namespace polynya::tests
