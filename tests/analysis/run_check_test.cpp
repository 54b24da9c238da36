#include "analysis/run_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"

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

/// The near part decides like the whole, and so does an edge that separates two: exact overlaps of long jagged floes
/// with small ones, and of convex with jagged ones, in any pose, with and without a hole, agree to the last bit with
/// those of the whole rings.
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

/// What is drawn straight far from the box may cross the rest of the ring: geometry::overlap takes that.
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

/// A square of 4 m breaks at 1 s into two halves; beside it another square drifts by 0.5 m a second towards it.
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
  // At 3 s floe 1 has come 0.5 m into both halves, over one metre of each.
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
}

TEST(RunCheck, CrushedIceIsComparedWithTheWorkThatItTook) {
  io::Run run = small_run();
  run.has_crushed = true;
  const fracture::Ice& ice = run.scene.scene.ice;
  const double volume = 0.5 * ice.thickness;
  const double work = ice.compressive_strength * volume;
  run.crushed = {{3, {{-1, 1}, {-1, 2}, 0.5, 0, 0, volume, work}}, {3, {{-1, 1}, {-1, 3}, 0.1, 0, 0.4, 0, 0}}};
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

}  // namespace
}  // namespace polynya::analysis
