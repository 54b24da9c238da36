// The general path on the window around the cut against the same on the whole shape: the same bits, always.
#include "geometry/cut/internal/window_cut.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "geometry/cut/internal/general_cut.hpp"
#include "geometry/cut/internal/window.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/dice.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

using namespace trials;

const bool kSeeded = [] {
  ::setenv("RC_PARAMS", "seed=20260101 max_success=1500 max_size=200 max_discard_ratio=30", 0);
  return true;
}();

template <typename Law>
void check(const char* name, Law law) {
  ASSERT_TRUE(kSeeded);
  EXPECT_TRUE(rc::check(name, [&] {
    Dice dice(*rc::gen::container<std::vector<std::uint8_t>>(150, rc::gen::arbitrary<std::uint8_t>()));
    law(dice);
  }));
}

void require_same(const Shape& shape, const ManyKnives& knives) {
  const std::string story = to_code(shape.polygon) + to_code(knives);
  const std::optional<CutOutcome> window = cut_in_window(shape, knives);
  if (!window) RC_FAIL("the window gives no answer\n" + story);
  const testing::AssertionResult sound = is_sound(shape, *window);
  if (!sound) RC_FAIL(std::string(sound.message()) + "\n" + story);
  const testing::AssertionResult equal = are_equal(*window, cut_generally(shape, knives));
  if (!equal) RC_FAIL(std::string(equal.message()) + "\n" + story);
}

TEST(WindowCut, EqualsTheWholeOverlay) {
  check("several polygons with holes, cracks that cross themselves", [](Dice& dice) {
    const Shape shape{roll_floe(dice)};
    RC_PRE(!find_defect(shape.polygon));
    const ManyKnives knives = roll_knives(dice, shape.polygon);
    RC_PRE(knives.is_crack || !knives.polygons.empty());
    require_same(shape, knives);
  });
}

Ring ragged_ring(int vertices, double radius, double depth) {
  Ring ring;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2 * std::numbers::pi * i / vertices;
    const double r = radius + depth * std::sin(37 * angle) * std::cos(11.3 * i);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return ring;
}

TEST(WindowCut, ArrangesOnlyWhatIsNearTheTool) {
  Shape shape{{ragged_ring(4000, 100, 4), {}}};
  for (int i = 0; i < 20; ++i) {
    Ring hole = ragged_ring(60, 5, 0.5);
    const double angle = 0.3 + 2 * std::numbers::pi * i / 20;
    for (Point& p : hole) p = p + Vector{60 * std::cos(angle), 60 * std::sin(angle)};
    std::reverse(hole.begin(), hole.end());
    shape.polygon.holes.push_back(hole);
  }
  ASSERT_FALSE(find_defect(shape.polygon));
  const std::vector<Polygon> tools{{disc_polygon({100, 0}, 3, 0.02), {}},
                                   {disc_polygon({-60, 10}, 9, 0.02), {}}};
  std::vector<exact::SourceSegment> tool;
  for (const Polygon& polygon : tools) append_segments(tool, exact::exactly(polygon), 1);
  const Rings rings(shape.polygon);
  const Window window = open_window(rings, tool);
  EXPECT_LT(window.near.size(), 250u);
  EXPECT_EQ(window.far_rings.size(), 18u);
  std::size_t edges = window.near.size();
  for (const FarChain& chain : window.chains) edges += static_cast<std::size_t>(chain.count);
  for (const int r : window.far_rings) edges += rings[r].size();
  EXPECT_EQ(edges, vertex_count(shape.polygon));
  const auto outcome = cut_by_polygons_in_window(shape, tools);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(is_sound(shape, *outcome));
  EXPECT_TRUE(are_equal(*outcome, cut_by_polygons_generally(exact::exactly(shape.polygon), tools)));
  const Ring looped{{90, 30}, {70, -20}, {110, 20}, {80, 40}, {110, -60}};
  const auto along = cut_along_in_window(shape, looped);
  ASSERT_TRUE(along);
  EXPECT_TRUE(are_equal(*along, cut_along_generally(exact::exactly(shape.polygon), looped)));
}

// Rings that touch far from the cut: joining them by a cut there parts the floe here.
TEST(WindowCut, PartsPiecesWhereTheirRingsTouchFarAway) {
  const Shape shape{{{{0, 0}, {40, 0}, {40, 10}, {20, 10}, {0, 10}}, {{{20, 10}, {22, 6}, {18, 6}}}}};
  ASSERT_FALSE(find_defect(shape.polygon));
  const Ring crack{{20, 7}, {20, -1}};
  const auto outcome = cut_along_in_window(shape, crack);
  ASSERT_TRUE(outcome && *outcome);
  EXPECT_EQ((*outcome)->pieces.size(), 2u);
  EXPECT_TRUE(are_equal(*outcome, cut_along_generally(exact::exactly(shape.polygon), crack)));
}

TEST(WindowCut, AnswersForToolsAroundAndBesideTheFloe) {
  const Shape shape{{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}}};
  const Ring around{{-9, -9}, {9, -9}, {9, 9}, {-9, 9}};
  const Ring small{{20, 20}, {21, 20}, {21, 21}};
  const auto inside = cut_by_polygons_in_window(shape, {{around, {}}, {small, {}}});
  ASSERT_TRUE(inside && *inside);
  ASSERT_EQ((*inside)->pieces.size(), 1u);
  EXPECT_EQ((*inside)->pieces[0].part, Part::kInside);
  EXPECT_EQ((*inside)->pieces[0].shape.polygon, shape.polygon);
  const auto beside = cut_by_polygons_in_window(shape, {{small, {}}, {small, {}}});
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->error().reason, CutFailure::kMisses);
  // In the hole of the tool, and a tool in the hole of the floe.
  Ring moat{{-1, -1}, {5, -1}, {5, 5}, {-1, 5}};
  std::reverse(moat.begin(), moat.end());
  EXPECT_EQ(cut_by_polygons(shape, {{around, {moat}}}).error().reason, CutFailure::kMisses);
  const Ring in_hole{{1.2, 1.2}, {1.5, 1.2}, {1.5, 1.5}};
  EXPECT_EQ(cut_by_polygons(shape, {{in_hole, {}}, {small, {}}}).error().reason, CutFailure::kMisses);
}

}  // namespace
}  // namespace polynya::geometry
