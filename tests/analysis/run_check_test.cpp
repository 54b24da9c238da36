#include "analysis/run_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "../io/expect_text.hpp"
#include "../io/temporary_folder.hpp"
#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::analysis {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Pose;
using geometry::Ring;

Ring square(double x, double y, double size) {
  return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

/// A star-shaped ring with a random radius at each vertex.
Ring star(std::mt19937& dice, int vertices, double radius) {
  std::uniform_real_distribution<double> part(0.3, 1);
  Ring ring;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2 * std::numbers::pi * i / vertices;
    const double r = radius * part(dice);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return ring;
}

/// The near part decides like the whole ring, and so does an edge that separates two floes. Exact overlaps of long
/// jagged floes with small floes, and of convex floes with jagged floes, agree to the last bit with the overlaps of the
/// whole rings, in any pose, with and without a hole.
TEST(NearPart, SharesTheSameAreaAsTheWhole) {
  std::mt19937 dice(11);
  std::uniform_real_distribution<double> place(-14, 14), turn(-4, 4);
  int overlapping = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const bool is_convex = trial % 4 == 3;
    Polygon large{is_convex ? geometry::convex_hull(star(dice, 7, 5)) : star(dice, 200, 10), {}};
    if (trial % 2 == 0) {
      Ring hole = star(dice, 40, 2.9);
      large.holes.emplace_back(hole.rbegin(), hole.rend());
    }
    const Polygon small{star(dice, is_convex ? 6 : 8, trial % 3 == 0 ? 6 : 1.5), {}};
    const Pose world_from_large{{place(dice), place(dice)}, geometry::Rotation::by(turn(dice))};
    const Pose world_from_small{{place(dice), place(dice)}, geometry::Rotation::by(turn(dice))};
    const auto whole = overlap({.polygon = large}, world_from_large, {.polygon = small}, world_from_small);
    const auto near = shared_area(small, world_from_small, large, world_from_large);
    ASSERT_TRUE(whole.has_value() && near.has_value());
    EXPECT_EQ(*near, whole->area) << trial;
    overlapping += whole->area > 0 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 100);
  const Polygon left{square(0, 0, 1), {}}, right{square(1, 0, 1), {}};
  EXPECT_EQ(shared_area(left, {}, right, {}), 0);
}

/// The edge that replaces the ring far from the box may cross the rest of the ring. geometry::overlap accepts such
/// rings.
TEST(NearPart, MayCrossItselfAndSharesTheSame) {
  std::mt19937 dice(29);
  std::uniform_real_distribution<double> place(-9, 9);
  int crossing = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Ring ring = star(dice, 120, 10);
    const geometry::Box box{{place(dice), place(dice)}, {10, 10}};
    const Polygon tile{{box.low, {10, box.low.y}, {10, 10}, {box.low.x, 10}}, {}};
    const Ring near = geometry::near_part(ring, box);
    if (near.size() > 2 && geometry::find_defect(geometry::normalised({near, {}}))) ++crossing;
    const auto whole = geometry::overlap({.polygon = {ring, {}}}, {}, {.polygon = tile}, {});
    const auto part = geometry::overlap({.polygon = {near, {}}}, {}, {.polygon = tile}, {});
    ASSERT_TRUE(whole.has_value() && part.has_value());
    EXPECT_EQ(part->exact_area, whole->exact_area) << trial;
  }
  EXPECT_GT(crossing, 10);
}

TEST(NearPart, LeavesFewVerticesOfALongRing) {
  std::mt19937 dice(3);
  const Ring ring = star(dice, 4000, 100);
  const Ring near = geometry::near_part(ring, {{60, 0}, {62, 2}});
  EXPECT_LT(near.size(), 200U);
  EXPECT_GT(near.size(), 2U);
}

void add_floe(io::Run& run, simulation::FloeId parent, double born, const Ring& ring) {
  io::RunFloe floe;
  floe.birth.floe = static_cast<simulation::FloeId>(run.floes.size());
  floe.birth.parent = parent;
  floe.birth.time = born;
  const geometry::Measures measures = geometry::measure({ring, {}});
  floe.birth.area = measures.area;
  floe.birth.centroid_in_body = measures.centroid;
  run.floes.push_back(floe);
  run.shapes.add({ring, {}});
}

/// Returns a run in which a square of 4 m breaks at 1 s into two halves, while another square beside it drifts towards
/// it at 0.5 m/s.
io::Run small_run(const Ring& drifting = square(5, 1, 2), const Ring& second_half = {{0, 2}, {4, 2}, {4, 4}, {0, 4}}) {
  io::Run run;
  add_floe(run, simulation::kNoFloe, 0, square(0, 0, 4));
  add_floe(run, simulation::kNoFloe, 0, drifting);
  add_floe(run, 0, 1, {{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  add_floe(run, 0, 1, second_half);
  run.floes[0].died = 1;
  run.floes[0].death_event = 0;
  simulation::Split split;
  split.floe = 0;
  split.children = {2, 3};
  run.events.push_back({1, 0, {}, split});
  for (int t = 0; t <= 3; ++t) {
    io::Frame frame;
    frame.time = t;
    for (const io::RunFloe& one : run.floes) {
      if (!run.is_alive(one.birth.floe, t)) continue;
      io::Motion motion;
      motion.position = one.birth.centroid_in_body;
      if (one.birth.floe == 1) motion.position.x -= 0.5 * t;
      frame.floes.push_back({one.birth.floe, motion});
    }
    run.frames.push_back(std::move(frame));
  }
  return run;
}

TEST(RunCheck, ReportsHowMuchIsDone) {
  std::vector<double> parts;
  check_run(small_run(), {}, [&](double part) { parts.push_back(part); });
  EXPECT_TRUE(std::ranges::is_sorted(parts));
  ASSERT_FALSE(parts.empty());
  EXPECT_NEAR(parts.back(), 1, 1e-12);
}

TEST(RunCheck, ASoundRunIsSoundAndItsOverlapIsMeasured) {
  const RunCheck check = check_run(small_run());
  EXPECT_TRUE(check.is_sound());
  EXPECT_EQ(check.shapes, 4U);
  EXPECT_EQ(check.fractures, 1U);
  EXPECT_EQ(check.siblings.area, 0);
  EXPECT_EQ(check.instants, 4U);
  // At 3 s floe 1 overlaps both halves by 0.5 m, over one metre of each.
  EXPECT_EQ(check.overlapping_pairs, 2U);
  EXPECT_EQ(check.most_shared, 1.0);
  EXPECT_EQ(check.most_shared_time, 3);
  EXPECT_EQ(check.ice_then, 20);
  EXPECT_EQ(check.worst.area, 0.5);
  EXPECT_EQ(check.worst.depth, 0.5);
  EXPECT_EQ(check.deepest.depth, 0.5);
  EXPECT_EQ(check_run(small_run(), 2).most_shared, 0) << "they touch at 2 s";
}

TEST(RunCheck, OverlapsThatWereNotCrushedAreFoundHullsIncluded) {
  io::Run run = small_run();
  simulation::Structure pile;
  pile.name = "pile";
  pile.hull.waterline = square(0, 0, 1);
  pile.position_in_world = {5, 2.5};
  run.scene.scene.structures.push_back(pile);
  for (io::Frame& frame : run.frames) {
    io::Motion motion;
    motion.position = pile.position_in_world;
    frame.ships.push_back(motion);
  }
  EXPECT_TRUE(check_run(run).is_sound()) << "the run does not state what was crushed";
  EXPECT_EQ(check_run(run, 3).worst_with_hull.area, 0.25);
  EXPECT_EQ(check_run(run, 3).worst_hull, 0);
  run.has_crushed = true;
  const RunCheck check = check_run(run, 3);
  EXPECT_FALSE(check.is_sound());
  ASSERT_EQ(check.uncrushed.size(), 3U);
  EXPECT_EQ(check.uncrushed_pairs, 3U);
  const auto with_pile = std::ranges::find(check.uncrushed, 0, [](const auto& pair) { return pair.first.ship; });
  ASSERT_NE(with_pile, check.uncrushed.end());
  EXPECT_EQ(with_pile->second.floe, 1);
  EXPECT_EQ(with_pile->shared, 0.25);
  EXPECT_LT(distance(with_pile->place_in_world, {5.25, 2.75}), 1e-6);
  run.crushed = {{3, {{0, simulation::kNoFloe}, {-1, 1}, 0.25, 0}},
                 {3, {{-1, 1}, {-1, 2}, 0.5, 0}},
                 {3, {{-1, 1}, {-1, 3}, 0.43, 0}}};
  EXPECT_EQ(check_run(run, 3).uncrushed_pairs, 1U);
  run.crushed.back().overlap.area = 0.48;
  EXPECT_TRUE(check_run(run, 3).is_sound()) << "1 % of the smaller floe may be missing";
  run.crushed.back().overlap.area = 0.2;
  EXPECT_FALSE(check_run(run, 3).is_sound());
  run.crushed.back().overlap.unpaid = 0.28;
  const RunCheck with_contact = check_run(run, 3);
  EXPECT_TRUE(with_contact.is_sound()) << "overlap that presses in a contact is on record";
  EXPECT_EQ(with_contact.most_in_contact.in_contact, 0.28);
  EXPECT_EQ(with_contact.most_in_contact.second.floe, 3);
}

TEST(RunCheck, CrushedIceIsComparedWithTheWorkThatItTook) {
  io::Run run = small_run();
  run.has_crushed = true;
  const fracture::Ice& ice = run.scene.scene.ice;
  const double volume = 0.5 * ice.thickness;
  const double work = ice.compressive_strength * volume;
  run.crushed = {{3, {{-1, 1}, {-1, 2}, 0.5, 0, 0, 0, volume, work}}, {3, {{-1, 1}, {-1, 3}, 0.1, 0, 0.4, 0, 0, 0}}};
  RunCheck check = check_run(run, 3);
  EXPECT_TRUE(check.is_sound()) << "what is tilted takes no crushing";
  EXPECT_EQ(check.paid_pairs, 1U);
  EXPECT_NEAR(check.most_expected, work, 1e-9 * work);
  EXPECT_EQ(check.work_then, work);
  for (const double factor : {0.7, 1.45}) {
    run.crushed.front().overlap.work = factor * work;
    EXPECT_TRUE(check_run(run, 3).is_sound()) << factor;
  }
  for (const double factor : {0.0, 0.6, 1.55}) {
    run.crushed.front().overlap.work = factor * work;
    check = check_run(run, 3);
    EXPECT_FALSE(check.is_sound()) << factor;
    ASSERT_EQ(check.unpaid.size(), 1U);
    EXPECT_EQ(check.unpaid.front().second.floe, 2);
    EXPECT_NEAR(check.unpaid.front().expected, work, 1e-9 * work);
  }
}

TEST(RunCheck, WhatIsWrongIsFound) {
  Ring swapped = square(5, 1, 2);
  std::swap(swapped[0], swapped[1]);
  const auto crossed = small_run(swapped);
  const RunCheck of_crossed = check_run(crossed, 0);
  ASSERT_EQ(of_crossed.invalid.size(), 1U);
  EXPECT_EQ(of_crossed.invalid.front().floe, 1);
  EXPECT_EQ(of_crossed.invalid.front().defect, "self-crossing");

  auto misprinted = small_run();
  misprinted.floes[1].birth.area += 1e-6;
  EXPECT_EQ(check_run(misprinted).recorded_area.wrong, 1U);
  EXPECT_EQ(check_run(misprinted).recorded_area.floe, 1);

  const auto leaking = small_run(square(5, 1, 2), {{0, 2}, {4, 2}, {4, 3.999}, {0, 4}});
  const RunCheck of_leaking = check_run(leaking);
  EXPECT_EQ(of_leaking.balance.wrong, 1U);
  EXPECT_NEAR(of_leaking.balance.value, -0.002, 1e-12);

  const auto doubled = small_run(square(5, 1, 2), {{0, 1}, {4, 1}, {4, 3}, {0, 3}});
  const RunCheck of_doubled = check_run(doubled);
  EXPECT_EQ(of_doubled.balance.wrong, 0U) << "the areas add up";
  EXPECT_EQ(of_doubled.siblings.area, 4) << "but the pieces share a strip";
  for (const RunCheck& check : {of_crossed, of_leaking, of_doubled}) EXPECT_FALSE(check.is_sound());
}

// ---- final.geojson and frames.bin

/// The last instant of small_run() in a folder with a final.geojson, from which a test may change the floes' motions.
class FinalPlacesOfARun : public testing::Test {
 protected:
  FinalPlacesOfARun() { run.folder = folder.path(); }

  /// Returns the motion of a floe in the last frame.
  io::Motion& in_frame(simulation::FloeId floe) {
    return std::ranges::find(run.frames.back().floes, floe, &io::FloeMotion::floe)->motion;
  }

  /// Writes final.geojson with the motions of the last frame, including the motions that the test changed.
  void write_final() {
    io::GeojsonLayer layer(run.end_time());
    for (const io::FloeMotion& floe : run.frames.back().floes) {
      if (left_out == floe.floe) continue;
      const auto changed = std::ranges::find(in_file, floe.floe, &io::FloeMotion::floe);
      layer.start().key("floe_id").value(floe.floe);
      layer.end_with(polygon_in_world(*run.shape(floe.floe), run.floe(floe.floe)->birth.centroid_in_body,
                                      changed != in_file.end() ? changed->motion : floe.motion));
    }
    write(layer.finish());
  }
  void write(const std::string& text) { tests::write_file(folder / "final.geojson", text); }
  std::string text() const { return tests::read_file(folder / "final.geojson"); }

  /// Checks the run, in which exactly one floe must be wrong, and returns the defect of that floe.
  MisplacedFloe only_misplaced() {
    const RunCheck check = check_run(run);
    EXPECT_FALSE(check.is_sound());
    EXPECT_EQ(check.final_places.misplaced.size(), 1U) << to_text(check, run.scene.scene);
    return check.final_places.misplaced.empty() ? MisplacedFloe{} : check.final_places.misplaced.front();
  }

  const tests::TemporaryFolder folder;
  io::Run run = small_run();
  std::vector<io::FloeMotion> in_file;  ///< motions of final.geojson that are not the frame's
  simulation::FloeId left_out = simulation::kNoFloe;
};

TEST_F(FinalPlacesOfARun, AreTheSameInASoundRun) {
  in_frame(1).angle = 0.7 + 6 * std::numbers::pi;
  in_file = {{1, in_frame(1)}};
  in_file.front().motion.angle = 0.7;
  write_final();
  const RunCheck check = check_run(run);
  EXPECT_TRUE(check.is_sound()) << to_text(check, run.scene.scene);
  EXPECT_EQ(check.final_places.compared, 3U);
  EXPECT_EQ(check.final_places.time, 3);
  EXPECT_LT(check.final_places.farthest, 1e-13) << "whole turns make no difference";
  EXPECT_HAS(to_text(check, run.scene.scene), "places     3 floes at 3 s: ", "; 0 floes are wrong\nsound");
  EXPECT_EQ(check_run(run, 0).final_places.compared, 3U) << "compared at the end, also where --at is another instant";
}

/// Floe 2 is 4 m by 2 m: its corners are √5 m from its centre.
TEST_F(FinalPlacesOfARun, AFloeTurnedInFinalGeojsonIsNamed) {
  in_file = {{2, in_frame(2)}};
  in_file.front().motion.angle += 0.01;
  write_final();
  const MisplacedFloe wrong = only_misplaced();
  EXPECT_EQ(wrong.floe, 2);
  EXPECT_NEAR(wrong.distance, 2 * std::sqrt(5) * std::sin(0.005), 1e-12);
  EXPECT_NEAR(wrong.allowed, std::sqrt(2) * 1e-3 + 1e-5 * std::sqrt(5), 1e-7);
  const RunCheck check = check_run(run);
  EXPECT_HAS(to_text(check, run.scene.scene), "(floe 2); 1 floe is wrong\n",
             "floe 2 at 3 s: a vertex in final.geojson is 0.0223606 m from its place by frames.bin, 0.00143658 m are "
             "allowed\nNOT SOUND");
  const io::JsonDocument json = io::parse_json(to_json_text(check, run.scene.scene));
  EXPECT_FALSE(json.root.find("is_sound")->boolean());
  const io::JsonValue& named = json.root.find("final_places")->find("misplaced")->items().at(0);
  EXPECT_EQ(named.find("floe_id")->number(), 2);
  EXPECT_EQ(named.find("t_s")->number(), 3);
  EXPECT_EQ(named.find("distance_m")->number(), wrong.distance);
}

TEST_F(FinalPlacesOfARun, AFloeTurnedInAFrameIsNamed) {
  write_final();
  in_frame(3).angle -= 0.01;
  const MisplacedFloe wrong = only_misplaced();
  EXPECT_EQ(wrong.floe, 3);
  EXPECT_NEAR(wrong.distance, 2 * std::sqrt(5) * std::sin(0.005), 1e-12);
}

/// Frames are right to 1 mm along each axis and 1e-5 rad.
TEST_F(FinalPlacesOfARun, MayDifferByWhatAFrameMayBeWrongBy) {
  for (const auto& [part, is_sound] : {std::pair{0.999, true}, {1.01, false}}) {
    in_file = {{1, in_frame(1)}};
    in_file.front().motion.position += geometry::Vector{part * 1e-3, part * 1e-3};
    in_file.front().motion.angle += part * 1e-5;
    write_final();
    EXPECT_EQ(check_run(run).is_sound(), is_sound) << part;
  }
}

TEST_F(FinalPlacesOfARun, AFloeThatIsInOneFileAloneIsNamed) {
  left_out = 3;
  write_final();
  EXPECT_EQ(only_misplaced().floe, 3);
  EXPECT_HAS(only_misplaced().defect, "final.geojson does not have it");
  left_out = simulation::kNoFloe;
  write_final();
  const std::string sound = text();
  const std::size_t line = sound.find("\n{") + 1;
  const std::string first = sound.substr(line, sound.find('\n', line) + 1 - line);
  write(tests::replaced(sound, first, first + tests::replaced(first, "\"floe_id\":1", "\"floe_id\":0")));
  EXPECT_EQ(only_misplaced().floe, 0);
  EXPECT_HAS(only_misplaced().defect, "which does not float then");
  write(tests::replaced(sound, first, first + first));
  EXPECT_HAS(only_misplaced().defect, "twice");
  write(sound);
  std::erase_if(run.frames.back().floes, [](const io::FloeMotion& floe) { return floe.floe == 2; });
  for (io::Frame& frame : run.frames)
    std::erase_if(frame.floes, [](const io::FloeMotion& floe) { return floe.floe == 2; });
  EXPECT_HAS(only_misplaced().defect, "no frame has it");
}

/// Two corners that round to one point are one in final.geojson; any other corner may not be missing.
TEST_F(FinalPlacesOfARun, OnlyCornersAtOnePointMayBeOne) {
  run = small_run({{5, 1}, {7, 1}, {7, 3}, {7, 3 + 1e-11}, {5, 3}});
  run.folder = folder.path();
  in_frame(1).angle = 0.3;
  write_final();
  const std::string all = text();
  const RunCheck check = check_run(run);
  EXPECT_TRUE(check.final_places.is_sound());
  const auto without = [&](std::size_t corner) {
    std::size_t from = all.find("[[[") + 2;
    for (std::size_t i = 0; i < corner; ++i) from = all.find("],[", from) + 2;
    return std::string(all).erase(from, all.find("],[", from) + 2 - from);
  };
  write(without(2));
  EXPECT_TRUE(check_run(run).final_places.is_sound());
  write(without(1));
  EXPECT_HAS(only_misplaced().defect, "a ring of the floe has 4 vertices in final.geojson and 5 in floes.ndjson");
}

/// Runs that were stopped, are large or are old may have nothing to compare. They are checked without this comparison.
TEST_F(FinalPlacesOfARun, AreNotComparedWhereThereIsNoFileOrNoFrame) {
  RunCheck check = check_run(run);
  EXPECT_TRUE(check.is_sound());
  EXPECT_HAS(to_text(check, run.scene.scene), "places     not compared: the run has no final.geojson\nsound");
  write_final();
  write(tests::replaced(text(), "\"t_s\":3", "\"t_s\":2.5"));
  check = check_run(run);
  EXPECT_TRUE(check.is_sound());
  EXPECT_HAS(to_text(check, run.scene.scene), "not compared: final.geojson is of 2.5 s, and no frame is\nsound");
  const io::JsonDocument json = io::parse_json(to_json_text(check, run.scene.scene));
  EXPECT_TRUE(json.root.find("final_places")->find("t_s")->is_null());
}

/// Older versions wrote the comma between two floes at the start of a line.
TEST_F(FinalPlacesOfARun, AreReadFromOlderFiles) {
  write_final();
  std::string older = text();
  for (std::size_t at = 0; (at = older.find(",\n{", at)) != std::string::npos;) older.replace(at, 3, "\n,{");
  write(older);
  EXPECT_EQ(check_run(run).final_places.compared, 3U);
  EXPECT_TRUE(check_run(run).is_sound());
}

TEST_F(FinalPlacesOfARun, AFileThatCannotBeReadIsNamedWithItsLine) {
  write_final();
  const std::string sound = text();
  for (const auto& [from, to, words] :
       {std::tuple{"features\":[\n", "features\":[", "final.geojson:1: the file is not written as a run writes it"},
        {"\"t_s\":3", "\"t_s\":null", "final.geojson:1: \"t_s\" is not a number"},
        {"\"floe_id\":2", "\"floe_id\":null", "final.geojson:3: \"floe_id\" is not a number"},
        {"\"floe_id\":3", "\"id\":3", "final.geojson:4: "},
        {"[[[3.5,", "[[[\"\",", "final.geojson:2: "},
        {"[[[0,0],", "[[[0,0,", "final.geojson:3: not JSON"}}) {
    write(tests::replaced(sound, from, to));
    const RunCheck check = check_run(run);
    EXPECT_FALSE(check.is_sound()) << to;
    EXPECT_HAS(to_text(check, run.scene.scene), "places     not compared: ", words, "NOT SOUND");
    EXPECT_HAS(to_json_text(check, run.scene.scene), "\"fault\": \"");
  }
}

}  // namespace
}  // namespace polynya::analysis
