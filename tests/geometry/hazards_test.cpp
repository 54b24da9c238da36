// Every hazard that is known to break floe cutters, met on purpose; and long trials. POLYNYA_ENDURANCE_CUTS
// sets how many cuts follow each other, POLYNYA_LONG_OUTLINES makes outlines longer (ctest -L endurance).
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/pose.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/geometry/trials.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

using trials::are_equal;
using trials::exact_area_of;
using trials::is_sound;

const Ring kSquareOfSix{{0, 0}, {6, 0}, {6, 6}, {0, 6}};

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

// Lazy sums overflow the stack at 50 000 vertices. Polynya sums rationals in pairs instead.
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
  const Shape shape{{transform(pose, kSquareOfSix), {}}};
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

// Input that CGAL or the arithmetic refuses gives an error value, even if it bypasses the checks.
TEST(Hazards, GarbagePastTheChecksIsAValueNotACrash) {
  std::mt19937 random(26);
  for (int i = 0; i < 300; ++i) {
    Ring ring;
    for (int k = 0; k < 8; ++k) ring.push_back({static_cast<double>(random() % 5), static_cast<double>(random() % 5)});
    const Ring shape = without_repeats(ring);
    if (shape.size() < 3) continue;
    static_cast<void>(cut_by_polygons_generally(exact::exactly(Polygon{shape, {}}), {{kSquareOfSix, {}}}));
    static_cast<void>(cut_along_generally(exact::exactly(Polygon{shape, {}}), {{{-1, 2}, {7, 3}}}));
    static_cast<void>(cut_by_polygon(Shape{{shape, {}}, true}, {disc_polygon({2, 2}, 1.5, 0.1), {}}));
    static_cast<void>(cut_along(Shape{{shape, {}}, true}, {{-1, 2}, {7, 3}}));
    static_cast<void>(cut_by_polygons(Shape{{shape, {}}, true},
                                      {{disc_polygon({2, 2}, 1.5, 0.1), {}}, {disc_polygon({4, 2}, 0.7, 0.1), {}}}));
    static_cast<void>(cut_along(Shape{{shape, {kSquareOfSix}}, true}, {{-1, 2}, {3, 3}, {2, 1}, {2.5, 7}}));
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
  const CutOutcome by_huge_tool = cut_along(Shape{{kSquareOfSix, {}}}, {{-1, 1}, {1e200, 1}});
  ASSERT_FALSE(by_huge_tool);
  EXPECT_EQ(by_huge_tool.error().reason, CutFailure::kInvalidTool);
}

// ---- floes as images of ice show them: outlines with bays, necks and ponds, thousands of vertices long

/// Returns the largest connected area that a crowd of discs covers, with its ponds, placed about its middle.
Polygon ragged_floe(int size, unsigned seed) {
  scenery::Random random(seed);
  const double largest = 0.06 * std::sqrt(60.0 * size);
  std::vector<Ring> discs;
  for (int i = 0; i < 4 * size; ++i) {
    const Point at = transform(scenery::random_pose(random, 0, 0.45 * size), Point{});
    discs.push_back(disc_polygon(at, random.between(0.17, 1) * largest, largest / 300));
  }
  const std::vector<Shape> floes = repair(discs, FillRule::kNonZero)->shapes;
  return std::ranges::max(floes, {}, [](const Shape& s) { return vertex_count(s.polygon); }).polygon;
}

class Outlines : public testing::TestWithParam<unsigned> {};

// Cuts the largest piece again and again by all kinds of tools: straight and wandering cracks, discs, several discs at
// once, and other floes.
TEST_P(Outlines, AreCutSoundly) {
  const unsigned seed = GetParam();
  const bool is_long = std::getenv("POLYNYA_LONG_OUTLINES") != nullptr;
  const int cells = is_long ? 200 + 100 * static_cast<int>(seed % 4) : 60 + 20 * static_cast<int>(seed % 3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.45 * cells, 0.45 * cells);
  const auto point = [&] { return Point{place(random), place(random)}; };
  const Shape whole{ragged_floe(cells, seed)};
  Shape shape = whole;
  ASSERT_FALSE(find_defect(shape.polygon));
  ASSERT_GT(vertex_count(shape.polygon), 500u);
  ASSERT_GT(shape.polygon.holes.size(), 2u) << "ponds";
  int cuts = 0;
  const int rounds = is_long ? 60 : 18;
  for (int i = 0; i < rounds && !HasFailure(); ++i) {
    if (i % 6 == 0) shape = whole;
    trials::ManyKnives knives;
    switch ((i + i / 6) % 6) {
      case 0:
        knives.is_crack = true;
        knives.crack = {{-cells * 1.0, place(random)}, {cells * 1.0, place(random)}};
        break;
      case 1:
        knives.is_crack = true;
        for (int k = 0; k < 30; ++k) knives.crack.push_back(point());
        break;
      case 2:
        knives.polygons = {{disc_polygon(shape.polygon.outer.front(), 0.05 * cells, 0.001 * cells), {}}};
        break;
      case 3:
        for (int k = 0; k < 6; ++k) knives.polygons.push_back({disc_polygon(point(), 0.06 * cells, 0.002 * cells), {}});
        break;
      case 4:
        knives.polygons = {ragged_floe(cells / 2, 1000 + seed + static_cast<unsigned>(i))};
        break;
      default: {  // a polygon over the floe's own vertices
        const Ring& ring = shape.polygon.outer;
        const auto vertex = [&] { return ring[random() % ring.size()]; };
        Ring triangle{vertex(), vertex(), vertex()};
        if (area_sign(triangle) < 0) std::reverse(triangle.begin(), triangle.end());
        if (area_sign(triangle) == 0) continue;
        knives.polygons = {{triangle, {}}};
      }
    }
    const CutOutcome outcome = trials::cut(shape, knives);
    ASSERT_TRUE(is_sound(shape, outcome)) << "round " << i;
    if (i % 5 == 1) {
      ASSERT_TRUE(are_equal(outcome, trials::cut_generally(shape, knives)));
    }
    if (!outcome) continue;
    ++cuts;
    const auto largest = std::max_element(
        outcome->pieces.begin(), outcome->pieces.end(),
        [](const Piece& a, const Piece& b) { return vertex_count(a.shape.polygon) < vertex_count(b.shape.polygon); });
    shape = largest->shape;
  }
  EXPECT_GT(2 * cuts, rounds);
}

INSTANTIATE_TEST_SUITE_P(Discs, Outlines, testing::Range(1u, 7u));

// ---- many successive cuts on one plate's descendants

constexpr double kBrash = 1e-7;  // pieces below this area leave the trial [m²]

class Trial {
 public:
  explicit Trial(unsigned seed) : random_(seed), floes_{Shape{shapes::rectangle(0, 0, 110, 200)}} {}

  // Makes one cut of one floe and checks all its properties.
  void step() {
    const std::size_t i = pick();
    const Shape floe = floes_[i];
    const CutOutcome outcome = cut(floe);
    ASSERT_TRUE(is_sound(floe, outcome)) << trials::to_code(floe.polygon);
    if (!outcome) {
      ++refused_;
      return;
    }
    ++cuts_;
    snap_rounded_ += outcome->ledger.snap_rounded;
    itemised_ += exact::Rational(outcome->ledger.rounding_defect);
    slivers_ += outcome->ledger.area_slivers;
    floes_.erase(floes_.begin() + static_cast<std::ptrdiff_t>(i));
    for (const Piece& piece : outcome->pieces) {
      if (measure(piece.shape.polygon).area < kBrash)
        brash_ += exact_area_of(piece.shape);
      else
        floes_.push_back(piece.shape);
    }
  }

  void finish() const {
    std::printf("%d cuts, %d refused, %zu floes, %d snap-rounded, slivers %.3g m²\n", cuts_, refused_, floes_.size(),
                snap_rounded_, slivers_);
    EXPECT_GT(cuts_, 1000);
    exact::Rational sum = brash_ - 110 * 200 - itemised_;
    for (const Shape& floe : floes_) sum += exact_area_of(floe);
    // The defect of each cut is known to the nearest double of about 1e-15 m².
    EXPECT_LT(std::abs(sum.get_d() + slivers_), 1e-28 * cuts_ + 1e-14 * slivers_);
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  // Returns the largest of a few pieces, so that floes stay large enough to cut and one keeps edges of many
  // generations.
  std::size_t pick() {
    std::size_t best = random_() % floes_.size();
    for (int k = 0; k < 3; ++k) {
      const std::size_t other = random_() % floes_.size();
      if (floes_[other].polygon.outer.size() > floes_[best].polygon.outer.size()) best = other;
    }
    return best;
  }

  // The tool is aimed in the world frame, in which the floe has a new pose, or in the body frame from vertex to vertex.
  CutOutcome cut(const Shape& floe) {
    const Pose world_from_body{{1000 * unit(), 1000 * unit()}, Rotation::by(2 * std::numbers::pi * unit())};
    const auto to_body = [&](Ring tool) {
      for (Point& p : tool) p = inverse_transform(world_from_body, p);
      return tool;
    };
    const Ring& ring = floe.polygon.outer;
    const Point vertex = ring[random_() % ring.size()];
    const double size = std::sqrt(std::abs(signed_area(ring)));
    const auto kind = random_() % 10;
    if (kind == 0) return cut_along(floe, {vertex, ring[random_() % ring.size()]});
    if (kind == 1) return cut_by_polygon(floe, {disc_polygon(vertex, 0.2 * size, 0.01 * size), {}});
    const Point in_world = transform(world_from_body, vertex);
    const double angle = 2 * std::numbers::pi * unit();
    const Vector direction{std::cos(angle), std::sin(angle)};
    if (kind < 5) {
      const double reach = 4 * size + 50 * unit();
      const Point aim = in_world + 0.3 * size * direction;
      return cut_along(floe, to_body({aim - reach * direction, aim + reach * direction}));
    }
    const Point centre = in_world + (0.1 * size * unit()) * direction;
    return cut_by_polygon(floe, {to_body(disc_polygon(centre, size * (0.02 + 0.25 * unit()), 0.004 * size)), {}});
  }

  std::mt19937 random_;
  std::vector<Shape> floes_;
  exact::Rational brash_ = 0, itemised_ = 0;
  double slivers_ = 0;
  int cuts_ = 0, refused_ = 0, snap_rounded_ = 0;
};

TEST(Endurance, EveryCutOfALongLineageIsSound) {
  const char* wanted = std::getenv("POLYNYA_ENDURANCE_CUTS");
  const int cuts = wanted != nullptr ? std::atoi(wanted) : 3000;
  Trial trial(2026);
  for (int i = 0; i < cuts && !HasFailure(); ++i) trial.step();
  trial.finish();
}

}  // namespace
}  // namespace polynya::geometry
