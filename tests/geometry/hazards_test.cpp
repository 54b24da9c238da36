// Every hazard that is known to break floe cutters, met on purpose.
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/pose.hpp"
#include "tests/geometry/trials.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

using trials::is_sound;

const Ring kSquare{{0, 0}, {6, 0}, {6, 6}, {0, 6}};

// 6250 second cuts on degenerate first results made 33 wrong areas and 5 crashes where invalid roundings were
// trusted.
void cut_degenerate_floes_again(const Pose& pose, unsigned seed, int first_cuts) {
  std::mt19937 random(seed);
  const auto coordinate = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 1); };
  const auto knife = [&] {
    Ring ring;
    const int corners = 3 + static_cast<int>(random() % 3);
    for (int i = 0; i < corners; ++i) ring.push_back({coordinate(), coordinate()});
    return transform(pose, ring);
  };
  int cuts = 0;
  for (int i = 0; i < first_cuts && !testing::Test::HasFailure(); ++i) {
    std::vector<Shape> generation{Shape{{transform(pose, kSquare), {}}}};
    for (int depth = 0; depth < 3; ++depth) {
      std::vector<Shape> next;
      for (const Shape& shape : generation) {
        trials::Knife by{random() % 2 == 0, knife()};
        if (by.is_ring) by.points = normalised({by.points, {}}).outer;
        const CutOutcome outcome = trials::cut(shape, by);
        ASSERT_TRUE(is_sound(shape, outcome)) << trials::to_code(shape.polygon) << trials::to_code(by);
        if (!outcome) {
          next.push_back(shape);
          continue;
        }
        ++cuts;
        for (const Piece& piece : outcome->pieces) next.push_back(piece.shape);
      }
      generation = std::move(next);
    }
  }
  EXPECT_GT(cuts, 2 * first_cuts);
}

TEST(Hazards, DegenerateCutsOnAGridAndMovedRigidlyInDoubles) {
  cut_degenerate_floes_again({}, 21, 250);
  cut_degenerate_floes_again({{11.3, -4.7}, Rotation::by(0.61)}, 22, 250);
}

// Polygon_set_2(ring) builds the complement of a ring pinched at its leftmost vertex.
TEST(Hazards, PinchAtTheLeftmostVertex) {
  const Ring pinched{{0, 3}, {6, 0}, {6, 6}, {0, 3}, {4, 4}, {4, 2}};
  EXPECT_TRUE(find_defect({pinched, {}}));
  const auto repaired = repair({pinched}, FillRule::kNonZero);
  ASSERT_TRUE(repaired);
  ASSERT_EQ(repaired->shapes.size(), 1u);
  EXPECT_EQ(repaired->area, 18 - 4);
  const CutOutcome outcome = cut_along(repaired->shapes[0], {{5, -1}, {5, 7}});
  EXPECT_TRUE(is_sound(repaired->shapes[0], outcome));
  EXPECT_EQ(outcome->pieces.size(), 2u);
}

// A valid polygon whose hole touches the shell's interior fails CGAL's own test and can crash a release
// build.
TEST(Hazards, HoleTouchingTheShellsInterior) {
  const Shape shape{{kSquare, {{{0, 3}, {2, 4}, {2, 2}}}}};
  ASSERT_FALSE(find_defect(shape.polygon));
  std::mt19937 random(23);
  std::uniform_real_distribution<double> place(-1, 7);
  for (int i = 0; i < 150; ++i) {
    const Ring crack = i % 3 == 0 ? Ring{{-1, 3}, {7, static_cast<double>(i % 7)}}
                                  : Ring{{place(random), place(random)}, {place(random), place(random)}};
    ASSERT_TRUE(is_sound(shape, cut_along(shape, crack)));
    const Point centre = i % 3 == 0 ? Point{0, 3} : Point{place(random), place(random)};
    ASSERT_TRUE(is_sound(shape, cut_by_polygon(shape, {disc_polygon(centre, 1.3, 0.05), {}})));
  }
}

// Lazy sums overflow the stack at 50 000 vertices: ours are rationals, summed in pairs.
TEST(Hazards, FiftyThousandVerticesOnTheGeneralPath) {
  Shape shape{shapes::regular(50000, 100)};
  for (std::size_t i = 1; i < 50000; i += 2)
    shape.polygon.outer[i] = Point{} + 1.01 * (shape.polygon.outer[i] - Point{});
  ASSERT_FALSE(find_defect(shape.polygon));
  const CutOutcome outcome =
      cut_by_polygons_generally(exact::exactly(shape.polygon), {{disc_polygon({100, 3}, 5, 0.01), {}}});
  EXPECT_TRUE(is_sound(shape, outcome));
  EXPECT_TRUE(trials::are_equal(outcome, cut_by_polygon(shape, {disc_polygon({100, 3}, 5, 0.01), {}})));
}

// GEOS lost a whole floe in 2 of 10 000 near-collinear cracks, Boost.Geometry erred grossly in 111.
TEST(Hazards, NearCollinearCracks) {
  std::mt19937 random(24);
  const Pose pose{{3, 1}, Rotation::by(0.3)};
  const Shape shape{{transform(pose, kSquare), {}}};
  const Ring& ring = shape.polygon.outer;
  const auto nudge = [&](Point p) {
    const auto step = [&](double v) {
      const double far = std::numeric_limits<double>::infinity();
      for (auto n = random() % 4; n > 0; --n) v = std::nextafter(v, random() % 2 == 0 ? far : -far);
      return v;
    };
    return Point{step(p.x), step(p.y)};
  };
  for (int i = 0; i < 2000; ++i) {
    const Point a = ring[static_cast<std::size_t>(i) % 4];
    const Point b = ring[static_cast<std::size_t>(i + 1) % 4];
    const Vector along = b - a;
    const double before = i % 3 == 0 ? 0 : 0.3;
    ASSERT_TRUE(is_sound(shape, cut_along(shape, {nudge(a - before * along), nudge(b + before * along)})));
  }
}

// What CGAL or the arithmetic refuses is a value, whatever is fed past the checks.
TEST(Hazards, GarbagePastTheChecksIsAValueNotACrash) {
  std::mt19937 random(26);
  for (int i = 0; i < 300; ++i) {
    Ring ring;
    for (int k = 0; k < 8; ++k)
      ring.push_back({static_cast<double>(random() % 5), static_cast<double>(random() % 5)});
    const Ring shape = without_repeats(ring);
    if (shape.size() < 3) continue;
    static_cast<void>(cut_by_polygons_generally(exact::exactly(Polygon{shape, {}}), {{kSquare, {}}}));
    static_cast<void>(cut_along_generally(exact::exactly(Polygon{shape, {}}), {{-1, 2}, {7, 3}}));
    static_cast<void>(cut_by_polygon(Shape{{shape, {}}, true}, {disc_polygon({2, 2}, 1.5, 0.1), {}}));
    static_cast<void>(cut_along(Shape{{shape, {}}, true}, {{-1, 2}, {7, 3}}));
    static_cast<void>(cut_by_polygons(Shape{{shape, {}}, true}, {{disc_polygon({2, 2}, 1.5, 0.1), {}},
                                                                 {disc_polygon({4, 2}, 0.7, 0.1), {}}}));
    static_cast<void>(cut_along(Shape{{shape, {kSquare}}, true}, {{-1, 2}, {3, 3}, {2, 1}, {2.5, 7}}));
  }
  SUCCEED();
}

TEST(Hazards, HugeCoordinatesAreRefusedByName) {
  const Shape shape{{{{0, 0}, {1e200, 0}, {1e200, 1e200}}, {}}};
  const CutOutcome outcome = cut_along(shape, {{-1, 1}, {5, 1}});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().reason, CutFailure::kInvalidShape);
  EXPECT_EQ(outcome.error().detail, "not-finite");
  EXPECT_EQ(repair({shape.polygon.outer}, FillRule::kNonZero).error().reason, CutFailure::kInvalidShape);
  const CutOutcome by_huge_tool = cut_along(Shape{{kSquare, {}}}, {{-1, 1}, {1e200, 1}});
  ASSERT_FALSE(by_huge_tool);
  EXPECT_EQ(by_huge_tool.error().reason, CutFailure::kInvalidTool);
}

}  // namespace
}  // namespace polynya::geometry
