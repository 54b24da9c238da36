// Laws of the cut over random and degenerate inputs. RapidCheck's seed is fixed; RC_PARAMS in the environment
// overrides.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/dice.hpp"
#include "tests/geometry/trials.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

using namespace trials;

const bool kSeeded = [] {
  ::setenv("RC_PARAMS", "seed=20260101 max_success=1500 max_size=200 max_discard_ratio=30", 0);
  return true;
}();

// Returns a random floe, perhaps one that was cut before, so that knives also meet vertices of earlier cuts.
Shape roll_shape(Dice& dice) {
  Shape shape{roll_floe(dice)};
  if (find_defect(shape.polygon)) return {};
  for (int earlier = dice.below(3); earlier > 0; --earlier) {
    CutOutcome outcome = cut(shape, roll_knife(dice, shape.polygon));
    if (!outcome || outcome->pieces.empty()) continue;
    const auto i = static_cast<std::size_t>(dice.below(static_cast<int>(outcome->pieces.size())));
    shape = outcome->pieces[i].shape;
  }
  return shape;
}

/// Rolls the dice for a law as often as RapidCheck is asked to.
template <typename Law>
void check_dice(const char* name, int bytes, Law law) {
  ASSERT_TRUE(kSeeded);
  EXPECT_TRUE(rc::check(name, [&] {
    law(Dice(*rc::gen::container<std::vector<std::uint8_t>>(bytes, rc::gen::arbitrary<std::uint8_t>())));
  }));
}

template <typename Law>
void check(const char* name, Law law) {
  check_dice(name, 120, [&](Dice dice) {
    const Shape shape = roll_shape(dice);
    RC_PRE(!shape.polygon.outer.empty());
    law(shape, roll_knife(dice, shape.polygon));
  });
}

template <typename Knives>
void require(const testing::AssertionResult& result, const Shape& shape, const Knives& knives) {
  if (!result) RC_FAIL(std::string(result.message()) + "\n" + to_code(shape.polygon) + to_code(knives));
}

TEST(Laws, EveryCutIsSoundAndLocalEqualsGeneral) {
  int local = 0;
  int cuts = 0;
  check("exact balance, valid pieces, the same bits by CGAL's path", [&](const Shape& shape, const Knife& knife) {
    const CutOutcome outcome = cut(shape, knife);
    require(is_sound(shape, outcome), shape, knife);
    RC_PRE(outcome || outcome.error().reason != CutFailure::kInvalidTool);
    require(are_equal(outcome, cut_generally(shape, knife)), shape, knife);
    ++cuts;
    if (outcome) local += cut_locally(shape.polygon, {knife.points, knife.is_ring}).has_value() ? 1 : 0;
  });
  EXPECT_GT(4 * local, cuts) << "the law would be empty if the local path seldom answered";
}

TEST(Laws, CutsByManyToolsEqualTheGeneral) {
  check_dice("several polygons with holes, cracks that cross themselves", 150, [](Dice dice) {
    const Shape shape{roll_floe(dice)};
    RC_PRE(!find_defect(shape.polygon));
    const ManyKnives knives = roll_knives(dice, shape.polygon);
    RC_PRE(knives.is_crack || !knives.polygons.empty());
    const CutOutcome outcome = cut(shape, knives);
    RC_PRE(outcome || outcome.error().reason != CutFailure::kInvalidTool);
    require(is_sound(shape, outcome), shape, knives);
    require(are_equal(outcome, cut_generally(shape, knives)), shape, knives);
  });
}

// A quarter turn and a power of two are exact in doubles and commute with rounding: the result must follow to
// the bit.
bool has_subnormals(const Ring& ring) {
  return std::any_of(ring.begin(), ring.end(), [](Point p) {
    return std::fpclassify(p.x) == FP_SUBNORMAL || std::fpclassify(p.y) == FP_SUBNORMAL;
  });
}

TEST(Laws, QuarterTurnsAndPowersOfTwoCommuteWithTheCut) {
  check("cut(turn(x)) = turn(cut(x))", [](const Shape& shape, const Knife& knife) {
    RC_PRE(!has_subnormals(shape.polygon.outer) && !has_subnormals(knife.points));
    const auto turned_ring = [](Ring ring) {
      for (Point& p : ring) p = {-4 * p.y, 4 * p.x};
      return ring;
    };
    const auto turned = [&](Polygon polygon) {
      polygon.outer = turned_ring(polygon.outer);
      for (Ring& hole : polygon.holes) hole = turned_ring(hole);
      return polygon;
    };
    CutOutcome first = cut(shape, knife);
    const CutOutcome second = cut(Shape{turned(shape.polygon)}, {knife.is_ring, turned_ring(knife.points)});
    if (first) {
      RC_PRE(first->ledger.slivers == 0 && first->ledger.snap_rounded == 0);  // judged by boxes, which turning changes
      for (Piece& piece : first->pieces) piece.shape.polygon = turned(piece.shape.polygon);
      first->ledger.rounding_defect *= 16;
      first->ledger.dangling_length *= 4;
    } else {
      first.error().dangling_length *= 4;
    }
    require(are_equal(first, second), shape, knife);
  });
}

// In any other frame rounding differs, but not by more than rounding.
TEST(Laws, MotionLeavesGenericCutsCongruent) {
  check_dice("areas of the pieces in a moved frame", 80, [](Dice dice) {
    Ring floe = disc_polygon({0, 0}, 10, 0.05);
    for (Point& p : floe) p = Point{} + dice.between(0.6, 1.2) * (p - Point{});
    const Ring disc = disc_polygon({dice.between(-10, 10), dice.between(-10, 10)}, dice.between(1, 6), 0.03);
    const Pose pose{{dice.between(-500, 500), dice.between(-500, 500)}, Rotation::by(dice.between(-3, 3))};
    const CutOutcome here = cut_by_polygon(Shape{{floe, {}}}, {disc, {}});
    const CutOutcome there = cut_by_polygon(Shape{{transform(pose, floe), {}}}, {transform(pose, disc), {}});
    RC_ASSERT(here.has_value() == there.has_value());
    if (!here) return;
    RC_ASSERT(here->pieces.size() == there->pieces.size());
    RC_ASSERT(std::abs(here->ledger.area_outside - there->ledger.area_outside) < 1e-9);
    RC_ASSERT(std::abs(here->ledger.area_inside - there->ledger.area_inside) < 1e-9);
  });
}

// On a grid of quarters with axis-parallel and diagonal tools every crossing is a double. Nothing is rounded, so the
// exact laws can be checked on the result.
Ring grid_tool(Dice& dice) {
  const Point c{static_cast<double>(dice.below(9)), static_cast<double>(dice.below(9))};
  const double r = 0.5 * (1 + dice.below(6));
  return dice.below(2) == 0 ? shapes::square({c.x - r, c.y - r}, 2 * r).outer
                            : shapes::diamond({c.x - r, c.y}, r).outer;
}

TEST(Laws, PiecesPartitionTheirParentBeforeRounding) {
  check_dice("disjoint, inside the parent, and together all of it", 60, [](Dice dice) {
    Shape shape{{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {}}};
    for (int i = 0; i < 3; ++i) {
      const Ring tool = grid_tool(dice);
      const CutOutcome outcome = cut_by_polygon(shape, {tool, {}});
      if (!outcome) continue;
      RC_ASSERT(outcome->ledger.rounding_defect == 0);
      exact::Rational sum = 0;
      const std::vector<Piece>& pieces = outcome->pieces;
      for (std::size_t p = 0; p < pieces.size(); ++p) {
        const exact::Rational area = exact_area_of(pieces[p].shape);
        sum += area;
        RC_ASSERT(overlap(pieces[p].shape, {}, shape, {})->exact_area == area.get_str());
        const std::string in_tool = overlap(pieces[p].shape, {}, Shape{{tool, {}}}, {})->exact_area;
        RC_ASSERT(in_tool == (pieces[p].part == Part::kInside ? area.get_str() : "0"));
        for (std::size_t q = 0; q < p; ++q)
          RC_ASSERT(overlap(pieces[p].shape, {}, pieces[q].shape, {})->exact_area == "0");
      }
      RC_ASSERT(sum == exact_area_of(shape));
      shape = pieces[static_cast<std::size_t>(dice.below(static_cast<int>(pieces.size())))].shape;
    }
  });
}

// The result of two tools does not depend on their order, and counting areas commutes with cutting.
TEST(Laws, TheOrderOfTwoToolsDoesNotMatter) {
  check_dice("cut(A, B) = cut(B, A)", 60, [](Dice dice) {
    const Shape shape{{{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {}}};
    const Ring one = grid_tool(dice);
    const Ring other = grid_tool(dice);
    const auto outside = [](const Shape& floe, const Ring& tool) {
      std::vector<Shape> left;
      const CutOutcome outcome = cut_by_polygon(floe, {tool, {}});
      if (!outcome) return std::vector{floe};
      for (const Piece& piece : outcome->pieces)
        if (piece.part == Part::kOutside) left.push_back(piece.shape);
      return left;
    };
    const auto left_by = [&](const Ring& first, const Ring& second) {
      exact::Rational left = 0;
      int pieces = 0;
      for (const Shape& start : outside(shape, first)) {
        for (const Shape& end : outside(start, second)) {
          left += exact_area_of(end);
          ++pieces;
        }
      }
      return std::pair(left, pieces);
    };
    RC_ASSERT(left_by(one, other) == left_by(other, one));
  });
}

}  // namespace
}  // namespace polynya::geometry
