#include "plate_run.hpp"
#include <gtest/gtest.h>

#include "geometry/cut/repair.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::tests {
namespace {

class InspectCommand : public PlateRun {
 protected:
  static Outcome inspect(const std::vector<std::string>& words, const std::string& of = "run") {
    return on_run("inspect", words, of);
  }
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
  const Outcome at_end = inspect({});
  ASSERT_EQ(at_end.code, 0) << at_end.err;
  const auto all = lines(at_end.out);
  ASSERT_EQ(all.size(), 1 + living_at(run->end_time()));
  for (const char* column : {"floe", "parent", "born_s", "area_m2", "perimeter_m", "vertices", "holes",
                             "mass_kg", "thickness_m", "valid"})
    EXPECT_NE(all[0].find(column), std::string::npos) << column;
  EXPECT_EQ(all[1].substr(all[1].size() - 4), " yes");
  const auto at_start = lines(inspect({"--at", "0"}).out);
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
    const auto floes = io::read_floe_text(inspect({"--floe", "3", "--format", format}).out);
    ASSERT_TRUE(floes.has_value());
    EXPECT_EQ(geometry::normalised(floes->entries.at(0).polygon), *run->shape(3)) << format;
  }
  const simulation::BirthRecord& last = run->floes.back().birth;
  const auto moved = io::read_floe_text(inspect({"--floe", std::to_string(last.floe), "--at", "30"}).out);
  ASSERT_TRUE(moved.has_value());
  const auto motion = io::MotionIndex(*run).floe_at(last.floe, 30);
  EXPECT_EQ(geometry::normalised(moved->entries.at(0).polygon),
            polygon_in_world(*run->shape(last.floe), last.centroid_in_body, *motion));
  const io::JsonDocument feature = io::parse_json(inspect({"--floe", "3", "--format", "geojson"}).out);
  EXPECT_EQ(feature.root.find("properties")->find("parent_id")->number(), static_cast<double>(birth.parent));
  EXPECT_EQ(feature.root.find("properties")->find("frame")->text(), "body");
  EXPECT_NE(inspect({"--floe", "3"}).err.find("body frame"), std::string::npos);
  EXPECT_EQ(inspect({"--floe", std::to_string(last.floe), "--at", "30"}).err, "");
  const std::string svg = inspect({"--floe", "3", "--format", "svg"}).out;
  EXPECT_NE(svg.find("in its body frame"), std::string::npos);
  EXPECT_EQ(svg.find("<svg "), 0U);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST_F(InspectCommand, EventsAreALineEachInOrderOfTime) {
  const auto all = lines(inspect({"--events"}).out);
  ASSERT_EQ(all.size(), run->events.size());
  ASSERT_GT(all.size(), 3U);
  double before = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double time = std::stod(all[i]);
    EXPECT_GE(time, before);
    before = time;
    EXPECT_NE(all[i].find("(floe " + std::to_string(run->events[i].ice()->floe) + ")"), std::string::npos)
        << all[i];
  }
  const io::JsonDocument json = io::parse_json(inspect({"--events", "--json"}).out);
  ASSERT_EQ(json.root.find("events")->items().size(), run->events.size());
  EXPECT_EQ(json.root.find("events")->items()[0].find("t_s")->number(), run->events[0].time);
  EXPECT_EQ(inspect({"--events", "--check"}).code, 2);
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
  EXPECT_EQ(tree.find("floe 0  45000.000000 m2  as in the scene"), 0U);
  EXPECT_NE(tree.find("bend by icebreaker at ("), std::string::npos);
  const auto count = [&](const char* words) {
    std::size_t many = 0;
    for (std::size_t from = tree.find(words); from != std::string::npos; from = tree.find(words, from + 1))
      ++many;
    return many;
  };
  EXPECT_EQ(count(" by icebreaker at ("), ids.size() - 1) << "one fracture between each and the next";
}

TEST_F(InspectCommand, ASoundRunPassesTheCheck) {
  const Outcome outcome = inspect({"--check"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  const auto all = lines(outcome.out);
  EXPECT_EQ(all.front().find("validity   " + std::to_string(run->floes.size()) + " shapes, 0 invalid"), 0U)
      << outcome.out;
  EXPECT_EQ(all.back(), "sound");
  EXPECT_NE(outcome.out.find(std::to_string(run->frames.size()) + " instants"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("Overlap is part of the contact model"), std::string::npos);
}

/// The same reports as JSON.
TEST_F(InspectCommand, ReportsAreJsonOnRequest) {
  const auto json = [](std::vector<std::string> words) {
    words.emplace_back("--json");
    const Outcome outcome = inspect(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    io::JsonDocument document = io::parse_json(outcome.out);
    EXPECT_TRUE(document.faults.empty()) << outcome.out;
    return std::move(document.root);
  };
  const io::JsonValue table = json({});
  ASSERT_EQ(table.find("floes")->items().size(), living_at(run->end_time()));
  double area = 0;
  for (const io::JsonValue& floe : table.find("floes")->items()) {
    area += floe.find("area_m2")->number();
    EXPECT_EQ(floe.find("valid")->text(), "yes");
    EXPECT_GT(floe.find("perimeter_m")->number(), 0);
  }
  const io::JsonValue sizes = json({"--fsd"});
  EXPECT_NEAR(sizes.find("area_m2")->number(), area, 1e-9 * area);
  double of_classes = 0;
  for (const io::JsonValue& one : sizes.find("classes")->items()) of_classes += one.find("area_m2")->number();
  EXPECT_NEAR(of_classes, area, 1e-9 * area);
  const simulation::FloeId last = run->floes.back().birth.floe;
  const io::JsonValue lineage = json({"--lineage", std::to_string(last)});
  const auto& trunk = lineage.find("lineage")->items();
  ASSERT_EQ(trunk.size(), run->lineage(last).size());
  EXPECT_EQ(trunk.front().find("broken_by")->find("kind")->text(), "bend");
  EXPECT_TRUE(trunk.back().find("broken_by")->is_null());
  const io::JsonValue check = json({"--check"});
  EXPECT_TRUE(check.find("is_sound")->boolean());
  EXPECT_EQ(check.find("shapes")->number(), static_cast<double>(run->floes.size()));
  EXPECT_EQ(inspect({"--floe", "3", "--json"}).code, 2);
}

/// As into `| head` or onto a full disk.
TEST_F(InspectCommand, WhatCannotBeWrittenIsNoCrash) {
  const Start cramped{.folder = folder->path(), .largest_file = 20};
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{}, {"--floe", "3"}, {"--lineage", "3"}, {"--fsd"}, {"--at", "-1"}}) {
    std::vector<std::string> all{"inspect", "run"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = polynya(all, cramped);
    EXPECT_EQ(outcome.code, words.empty() || words.front() != "--at" ? 5 : 2);
    EXPECT_LE(outcome.out.size(), 20U);
  }
}

/// A ring with two vertices exchanged, or an area that is not its ring's: the check names the floe.
TEST_F(InspectCommand, ADamagedRunFailsTheCheck) {
  for (const bool is_ring : {true, false}) {
    std::filesystem::remove_all(folder->path() / "damaged");
    std::filesystem::copy(folder->path() / "run", folder->path() / "damaged");
    std::string floes = read_file(folder->path() / "damaged/floes.ndjson");
    const std::string good = is_ring ? "[300,-75],[300,75]" : "\"area_m2\":45000";
    const std::size_t at = floes.find(good);
    ASSERT_NE(at, std::string::npos);
    floes.replace(at, good.size(), is_ring ? "[300,75],[300,-75]" : "\"area_m2\":45001");
    write_file(folder->path() / "damaged/floes.ndjson", floes);
    const Outcome outcome = inspect({"--check"}, "damaged");
    EXPECT_EQ(outcome.code, 4) << outcome.out;
    EXPECT_NE(outcome.out.find(is_ring ? "floe 0: self-crossing" : "(floe 0), 1 beyond"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(lines(outcome.out).back(), "NOT SOUND");
  }
}

TEST_F(InspectCommand, TheSizeDistributionCountsEveryFloe) {
  const auto all = lines(inspect({"--fsd"}).out);
  ASSERT_GT(all.size(), 3U);
  EXPECT_EQ(all[0].find(io::counted(living_at(run->end_time()), "floe") + ", "), 0U);
  std::size_t floes = 0;
  double percent = 0;
  for (std::size_t i = 3; i < all.size(); ++i) {
    std::istringstream row(all[i]);
    double from = 0, below = 0, area = 0, share = 0;
    std::size_t count = 0;
    row >> from >> below >> count >> area >> share;
    EXPECT_LT(from, below);
    floes += count;
    percent += share;
  }
  EXPECT_EQ(floes, living_at(run->end_time()));
  EXPECT_NEAR(percent, 100, 0.01);
}

TEST_F(InspectCommand, WrongUsageIsTwoAndNoRunIsFive) {
  const std::vector<std::vector<std::string>> wrong{{"--floe", "99999"},
                                                    {"--floe", "-1"},
                                                    {"--lineage", "99999"},
                                                    {"--at", "1e9"},
                                                    {"--at", "-1"},
                                                    {"--at", "soon"},
                                                    {"--format", "svg"},
                                                    {"--floe", "1", "--format", "png"},
                                                    {"--floe", "1", "--check"},
                                                    {"--check", "--fsd"},
                                                    {"--floe", "1", "--lineage", "1"},
                                                    {"--floe", "0", "--at", "30"}};
  for (const auto& words : wrong) {
    const Outcome outcome = inspect(words);
    EXPECT_EQ(outcome.code, 2) << words.front() << outcome.out;
    EXPECT_FALSE(outcome.err.empty());
    EXPECT_TRUE(outcome.out.empty());
  }
  EXPECT_EQ(polynya({"inspect"}, {folder->path()}).code, 2);
  EXPECT_EQ(inspect({}, "no-such-run").code, 5);
  EXPECT_EQ(inspect({}, "run/scene.json").code, 5);
}

TEST(InspectSplit, TheLineageAndThePlayerStateBothSidesOfASplitByTrueForces) {
  const TemporaryFolder folder;
  write_file(folder.path() / "square.json",
             R"({"time": {"step_s": 0.005, "until_s": 1}, "fracture": {"splitting": {"model": "lefm"}},
        "ships": [{"hull": {"length_m": 60, "beam_m": 16, "entrance_angle_deg": 30}, "mass_kg": 3e6,
          "moment_of_inertia_kg_m2": 8e8, "position_m": [-30.01, 0], "propulsion": {"constant_speed_m_per_s": 1}}],
        "floes": [{"rectangle": {"corner_m": [0, -8], "size_m": [16, 16]}}]})");
  ASSERT_EQ(polynya({"run", "square.json", "--out", "run"}, {folder.path()}).code, 0);
  const std::string tree = polynya({"inspect", "run", "--lineage", "1"}, {folder.path()}).out;
  for (const char* part : {"split by", "opening force", ">= opening capacity", "crack length 15.",
                           "contact force", "left flank", "K_IC 1.5e+05 Pa √m"})
    EXPECT_NE(tree.find(part), std::string::npos) << part << "\n" << tree;
  ASSERT_EQ(polynya({"view", "run"}, {folder.path()}).code, 0);
  const std::string page = read_file(folder.path() / "run/view.html");
  for (const char* key :
       {"\"left_flank_force_N\":", "\"opening_capacity_N\":", "\"fracture_toughness_Pa_sqrt_m\":150000"})
    EXPECT_NE(page.find(key), std::string::npos) << key;
}

}  // namespace
}  // namespace polynya::tests
