// Overlap of ice that gives way under a hull is booked as tilted, and no floe lies in a hull for the most part, or
// on both sides of it (docs/theory/under-hull.md, docs/theory/contact.md).
#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

/// A ship with a draught at constant speed, whose stem leans that far from the horizontal, before thick ice that does
/// not bend.
Build thick_ice(double stem_angle, double speed) {
  Ship ship = icebreaker({0, 0}, ConstantSpeed{speed}, speed);
  ship.hull.draught = 5.5;
  ship.hull.stem_angle = stem_angle;
  Build scene = Build().step(0.005).unbreakable().ship(ship);
  scene.ice.thickness = 1.6;
  scene.fracture.going_under.is_enabled = true;
  return scene;
}

/// Of five trials in which floes of 2.5 m, and one of 3 x 24 m across the stem, were all or for the most part in the
/// hull.
Build floes_before_the_stem(double stem_angle) {
  return thick_ice(stem_angle, 1.5)
      .floe(rectangle(0.2, -1.25, 2.7, 1.25))
      .floe(rectangle(3, -1.25, 5.5, 1.25))
      .floe(rectangle(3, 2, 5.5, 4.5))
      .floe(rectangle(3, -4.5, 5.5, -2));
}

Build floe_across_the_stem() {
  return thick_ice(24.5 * kDegree, 1.5).floe(rectangle(0.2, -12, 3.2, 12));
}

geometry::Polygon hull_of_ship(const Simulation& simulation) {
  return {simulation.scene().ships[0].hull.waterline, {}};
}

/// The largest share of a floe that the ship covers.
double most_covered(const Simulation& simulation) {
  double most = 0;
  const geometry::Polygon hull = hull_of_ship(simulation);
  for (const FloeState& floe : simulation.floe_states()) {
    const auto shared = geometry::shared_area(*floe.polygon_in_body, floe.world_from_body, hull,
                                              simulation.ship_states()[0].world_from_ship);
    most = std::max(most, shared.value() / floe.area);
  }
  return most;
}

/// The most floes that the ship's waterline would make of one.
int most_parts(const Simulation& simulation) {
  int most = 0;
  for (const FloeState& floe : simulation.floe_states()) {
    const geometry::Pose floe_from_ship =
        relative_pose(floe.world_from_body, simulation.ship_states()[0].world_from_ship);
    const geometry::CutOutcome cut =
        cut_by_polygon({.polygon = *floe.polygon_in_body}, transform(floe_from_ship, hull_of_ship(simulation)));
    int parts = 0;
    if (cut)
      for (const geometry::Piece& piece : cut->pieces)
        parts += piece.part == geometry::Part::kOutside && geometry::measure(piece.shape.polygon).area > 1;
    most = std::max(most, parts);
  }
  return most;
}

CrushedOverlap overlap_with(const Simulation& simulation, FloeId floe) {
  for (const CrushedOverlap& overlap : simulation.crushed_overlaps())
    if (overlap.on.ship == 0 && overlap.by.floe == floe) return overlap;
  return {};
}

TEST(Tilted, TheOverlapOfAFloeThatTiltsIsNotBookedAsCrushed) {
  Simulation simulation(floes_before_the_stem(24.5 * kDegree));
  const fracture::Ice ice = simulation.scene().ice;
  CrushedOverlap last;
  Story story;
  while (simulation.time() < 10 && story.submerged().empty()) {
    last = overlap_with(simulation, 0);
    simulation.step();
    listen(simulation, story);
  }
  ASSERT_EQ(story.submerged().size(), 1U);
  EXPECT_EQ(story.submerged()[0].ice()->floe, 0);
  const double if_crushed = ice.compressive_strength * ice.thickness * (last.area + last.tilted);
  EXPECT_GT(last.tilted, 2 * last.area);
  EXPECT_GT(if_crushed, 10 * last.work);
  expect_closed(simulation);
}

/// Each with its wedge: what an inclined hull crushes is less than the overlap's area times the thickness.
TEST(Tilted, CrushedIceIsWhatTheWorkCrushes) {
  for (const double angle : {0.0, 20 * kDegree, 50 * kDegree}) {
    Build scene = Build().without_drag().unbreakable().pile({0, 0}, 10, angle);
    scene.floe(rectangle(10.001, -40, 50, 40), {-1, 0});
    Simulation simulation(scene);
    run(simulation, 0.8);
    const CrushedOverlap overlap = overlap_with(simulation, 0);
    const double all = simulation.scene().ice.thickness * overlap.area;
    EXPECT_GT(overlap.area, 0.5) << angle;
    EXPECT_EQ(overlap.tilted, 0);
    EXPECT_NEAR(overlap.work / (simulation.scene().ice.compressive_strength * overlap.volume), 1, 0.05) << angle;
    if (angle == 0)
      EXPECT_NEAR(overlap.volume / all, 1, 1e-9);
    else
      EXPECT_LT(overlap.volume, 0.95 * all);
  }
}

TEST(Tilted, NoFloeFloatsOfWhichAHullCoversMost) {
  for (const double stem_angle : {16 * kDegree, 24.5 * kDegree, 43 * kDegree}) {
    Simulation simulation(floes_before_the_stem(stem_angle));
    Story story;
    while (simulation.time() < 10) {
      simulation.step();
      listen(simulation, story);
      EXPECT_LT(most_covered(simulation), 0.52) << "a contact is found a step late; at " << simulation.time();
    }
    EXPECT_GE(story.submerged().size(), 1U);
    expect_closed(simulation);
  }
}

TEST(Tilted, AFloeThatAHullCoversGoesUnderBeforeItsEdgeIsDeep) {
  const Story story = run(floes_before_the_stem(16 * kDegree), 10).story;
  ASSERT_FALSE(story.submerged().empty());
  const TiltCriterion criterion = std::get<Submerge>(story.submerged()[0].what).criterion;
  EXPECT_LT(criterion.deflection, criterion.least_deflection);
  EXPECT_NEAR(criterion.covered_share, 0.5, 0.02);
}

TEST(Tilted, NoFloeStaysOneThatAHullHasCutInTwo) {
  Simulation simulation(floe_across_the_stem());
  Story story;
  double in_two_since = 0;
  while (simulation.time() < 15) {
    simulation.step();
    listen(simulation, story);
    if (most_parts(simulation) < 2) in_two_since = simulation.time();
    EXPECT_LE(simulation.time() - in_two_since, 0.3);
  }
  expect_closed(simulation);
}

TEST(Tilted, IsBookedAlikeWhereARunIsResumed) {
  const Scene scene = floes_before_the_stem(24.5 * kDegree);
  const Simulation whole = run(scene, 1.5).simulation;
  const Simulation parts = expect_resumes(scene, 0.7, 1.5, 2).simulation;
  ASSERT_FALSE(whole.crushed_overlaps().empty());
  for (std::size_t i = 0; i < whole.crushed_overlaps().size(); ++i) {
    EXPECT_EQ(parts.crushed_overlaps()[i].tilted, whole.crushed_overlaps()[i].tilted);
    EXPECT_EQ(parts.crushed_overlaps()[i].work, whole.crushed_overlaps()[i].work);
  }
}

}  // namespace
}  // namespace polynya::simulation
