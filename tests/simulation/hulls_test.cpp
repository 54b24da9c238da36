// Ships, structures and walls are hulls: what they have in common goes by their number.
#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

TEST(Hulls, AreNumberedShipsFirstThenStructuresThenWallsAndFloesFollow) {
  Scene scene = paper_scene();
  scene.ships = {icebreaker({0, 0}, ConstantThrust{0}), barge({0, 300}, ConstantSpeed{1})};
  scene.structures = {pile({200, 0}, 5)};
  scene.walls = {wall_between({-500, -500}, {500, -500}, 5)};
  scene.walls[0].name = "south";
  scene.floes = {floe(rectangle(300, 0, 310, 10))};
  const Simulation simulation(scene);
  const Population& population = simulation.world().population;
  ASSERT_EQ(population.hull_count, 4);
  const std::pair<const char*, BodyKind> hulls[] = {{"icebreaker", BodyKind::kShip},
                                                    {"barge", BodyKind::kShip},
                                                    {"pile", BodyKind::kStructure},
                                                    {"south", BodyKind::kWall}};
  for (BodyIndex i = 0; i < 4; ++i) {
    const auto& [name, kind] = hulls[i];
    EXPECT_EQ(hull_of(scene, i).name, name);
    EXPECT_EQ(hull_named(scene, name), i);
    EXPECT_EQ(kind_of_hull(scene, i), kind);
    EXPECT_EQ(population.kind(i), kind);
    EXPECT_TRUE(population.is_hull(i));
    EXPECT_EQ(population.bodies.position[i], hull_of(scene, i).position_in_world);
    EXPECT_EQ(population.bodies.inverse_mass[i] == 0, i > 0) << "only the icebreaker can be pushed";
  }
  EXPECT_EQ(hull_named(scene, "north"), -1);
  EXPECT_EQ(population.kind(population.body_of(0)), BodyKind::kFloe);
  EXPECT_EQ(population.helms.size(), 2U) << "only ships are steered";
}

}  // namespace
}  // namespace polynya::simulation
