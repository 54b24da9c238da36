// Repair, overlap, cuts by many polygons, and the rounding of exact polygons.
#include <cmath>
#include <fstream>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/snap_rounding.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

using exact::Lattice;
using exact::Rational;

const Ring kBowTie{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
// A square that winds around its middle twice.
const Ring kTwice{{0, 0}, {6, 0}, {6, 6}, {1, 6}, {1, 1}, {5, 1}, {5, 5}, {0, 5}};

double repaired_area(const std::vector<Ring>& rings, FillRule rule) {
  const auto repaired = repair(rings, rule);
  EXPECT_TRUE(repaired.has_value());
  if (!repaired) return -1;
  for (const Shape& shape : repaired->shapes) EXPECT_FALSE(find_defect(shape.polygon));
  EXPECT_NEAR(repaired->area - repaired->area_drawn, repaired->area_changed, 1e-12);
  return repaired->area;
}

TEST(Repair, FillsByTheRuleAskedFor) {
  EXPECT_DOUBLE_EQ(repaired_area({kBowTie}, FillRule::kEvenOdd), 2);
  EXPECT_DOUBLE_EQ(repaired_area({kBowTie}, FillRule::kNonZero), 2);
  const double once = repaired_area({kTwice}, FillRule::kEvenOdd);
  const double both = repaired_area({kTwice}, FillRule::kNonZero);
  EXPECT_DOUBLE_EQ(both - once, 16) << "the square wound around twice";
  EXPECT_DOUBLE_EQ(both + 16, std::abs(exact::area(kTwice).get_d())) << "the signed area counts it twice";
}

TEST(Repair, LeavesValidPolygonsAsTheyAre) {
  const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring hole{{0, 5}, {2, 6}, {2, 4}};
  const auto repaired = repair({square, hole}, FillRule::kNonZero);
  ASSERT_TRUE(repaired.has_value());
  ASSERT_EQ(repaired->shapes.size(), 1u);
  EXPECT_EQ(repaired->area_changed, 0);
  EXPECT_EQ(repaired->shapes[0].polygon.holes.size(), 1u);
}

TEST(Repair, DropsSpikesAndRefusesWhatEnclosesNothing) {
  EXPECT_DOUBLE_EQ(repaired_area({{{0, 0}, {4, 0}, {4, 4}, {9, 4}, {4, 4}, {0, 4}}}, FillRule::kEvenOdd), 16);
  EXPECT_EQ(repair({{{0, 0}, {1, 1}, {2, 2}}}, FillRule::kEvenOdd).error().reason, CutFailure::kMisses);
  EXPECT_EQ(repair({{{0, 0}, {1, std::nan("")}, {2, 2}}}, FillRule::kEvenOdd).error().reason,
            CutFailure::kInvalidShape);
}

TEST(Repair, NormalisingOrientsAndDropsRepeats) {
  const Polygon drawn{{{0, 0}, {0, 10}, {0, 10}, {10, 10}, {10, 0}, {0, 0}},
                      {{{2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}}}};
  EXPECT_FALSE(find_defect(normalised(drawn)));
  EXPECT_EQ(normalised(drawn).outer.size(), 4u);
}

TEST(Overlap, IsExactWhereFloesAreSiblings) {
  const Shape square{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
  const auto pieces = cut_along(square, {{-1, 3}, {11, 3}});  // a cut whose vertices need no rounding
  ASSERT_TRUE(pieces.has_value());
  const Pose pose{{3, 4}, Rotation::by(0.7)};
  EXPECT_EQ(overlap(pieces->pieces[0].shape, pose, pieces->pieces[1].shape, pose)->exact_area, "0");
  EXPECT_EQ(overlap(square, {}, square, {{2, 3}, {}})->exact_area, "56");
  EXPECT_EQ(overlap(square, {}, square, {{20, 3}, {}})->exact_area, "0");
  // The quarter turn in doubles is a turn by a little less; the shared area is still what those doubles say.
  EXPECT_NEAR(overlap(square, {}, square, {{10, 0}, Rotation::by(std::acos(0.0))})->area, 100, 1e-13);
}

// Rings that cross themselves and each other, on a grid: each unit cell is covered or not as they wind around
// its centre, counted independently along a ray.
TEST(Overlap, TakesRingsThatCrossThemselvesByTheirWinding) {
  std::mt19937 random(17);
  const auto walk = [&] {
    Ring ring;
    Point p{4, 4};
    for (int i = 0; i < 10; ++i) {
      p.x = static_cast<double>(random() % 8);
      ring.push_back(p);
      p.y = static_cast<double>(random() % 8);
      ring.push_back(p);
    }
    ring.push_back({ring.front().x, p.y});
    return without_repeats(ring);
  };
  const auto winding = [](const Ring& ring, Point p) {
    int sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      if (a.x > p.x && (a.y < p.y) != (b.y < p.y)) sum += a.y < b.y ? 1 : -1;
    }
    return sum;
  };
  int shared_cells = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Shape a{{walk(), {walk()}}};
    const Shape b{{walk(), {}}};
    int expected = 0;
    for (int x = 0; x < 8; ++x) {
      for (int y = 0; y < 8; ++y) {
        const Point centre{x + 0.5, y + 0.5};
        const bool in_a = winding(a.polygon.outer, centre) + winding(a.polygon.holes[0], centre) > 0;
        expected += in_a && winding(b.polygon.outer, centre) > 0 ? 1 : 0;
      }
    }
    const auto shared = overlap(a, {}, b, {});
    ASSERT_TRUE(shared.has_value());
    EXPECT_EQ(shared->exact_area, std::to_string(expected));
    shared_cells += expected;
  }
  EXPECT_GT(shared_cells, 100);
}

// Parts of a tool that are nowhere near the shape are removed before the cut. This does not change the result.
TEST(CutByPolygons, FarPartsOfToolsChangeNothing) {
  const Shape square{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
  const Ring coast{{5, -90}, {95, -90}, {95, 90}, {5.3, 90}};
  const Ring lagoon{{60, 0}, {60, 9}, {69, 9}};
  const Polygon island{{{-30, 0}, {-20, 0}, {-20, 9}}, {}};
  const CutOutcome plain = cut_by_polygon(square, {coast, {}});
  ASSERT_TRUE(plain.has_value());
  EXPECT_TRUE(trials::are_equal(plain, cut_by_polygon(square, {coast, {lagoon}})));
  EXPECT_TRUE(trials::are_equal(plain, cut_by_polygons(square, {island, {coast, {lagoon}}})));
  EXPECT_EQ(cut_by_polygons(square, {island}).error().reason, CutFailure::kMisses);
  EXPECT_EQ(cut_by_polygons(square, {}).error().reason, CutFailure::kMisses);
  const Ring outside{{-9, 0}, {-9, 9}, {-8, 9}};
  EXPECT_EQ(cut_by_polygon(square, {coast, {outside}}).error().reason, CutFailure::kInvalidTool) << "still judged";
}

TEST(CutByPolygons, TakesWhatAnyToolCovers) {
  const Shape square{{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
  const Polygon with_hole{{{1, 1}, {5, 1}, {5, 5}, {1, 5}}, {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}}};
  const Polygon overlapping{{{3, 3}, {7, 3}, {7, 7}, {3, 7}}, {}};
  const CutOutcome outcome = cut_by_polygons(square, {with_hole, overlapping});
  ASSERT_TRUE(outcome.has_value());
  EXPECT_TRUE(trials::is_sound(square, outcome));
  // 16 − 4 and 16, sharing the 2×2 square less the hole's unit corner.
  EXPECT_DOUBLE_EQ(outcome->ledger.area_inside, 12 + 16 - 3);
  EXPECT_EQ(outcome->ledger.exact_defect, "0");
}

// ---- snap rounding: always valid on even lattices, and no area moved but along the edges

// Valid polygons of rationals whose vertices are near one line, at scales many decades apart: the areas that closed
// paths through such points enclose.
class NearCollinear {
 public:
  explicit NearCollinear(unsigned seed) : random_(seed) {}

  std::vector<exact::Polygon> roll() {
    const double large = std::ldexp(1.0, below(30));
    const double small = std::ldexp(1.0, -below(60));
    const Rational slope(unit_(random_));
    exact::Ring path;
    for (int i = 4 + below(8); i > 0; --i) {
      const double scale = below(2) == 0 ? large : small;
      const Rational x = Rational(scale * unit_(random_)) / 3;
      const Rational aside = Rational(scale * std::ldexp(unit_(random_), -below(70))) / 7;
      path.push_back({x, slope * x + aside});
    }
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, path, 0);
    const auto odd = [](exact::Winding w) { return w.shape % 2 != 0 ? 0 : -1; };
    std::vector<exact::Polygon> polygons;
    for (exact::Region& region : exact::overlay(segments, odd, exact::Seams::kDissolve).regions)
      polygons.push_back(std::move(region.polygon));
    return polygons;
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{-1, 1};
};

Rational area_of(const std::vector<Polygon>& parts) {
  Rational sum = 0;
  for (const Polygon& part : parts) sum += exact::area(part);
  return sum;
}

// An edge moves by at most the width of a cell, at its ends and where it bends.
double most_moved(const exact::Polygon& polygon, const Lattice& lattice) {
  const EdgeList edges = edge_list(exact::rounded(polygon));
  double sum = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    const Point a = edges.from(e), b = edges.to(e);
    const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
    const double width = 2 * lattice.width(size);
    sum += (std::abs(b.x - a.x) + std::abs(b.y - a.y) + 2 * width) * width;
  }
  return sum;
}

void expect_sound(const std::vector<Polygon>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    EXPECT_FALSE(find_defect(parts[i]));
    for (std::size_t j = 0; j < i; ++j) EXPECT_EQ(overlap(Shape{parts[i]}, {}, Shape{parts[j]}, {})->exact_area, "0");
  }
}

TEST(SnapRounding, EveryPolygonRoundsValidlyOnAnEvenLatticeAndItsPartsAreDisjoint) {
  NearCollinear polygons(11);
  int rounded = 0, parted = 0, vanished = 0;
  for (int trial = 0; (trial < 400 || parted < 20) && !HasFailure(); ++trial) {
    for (const exact::Polygon& polygon : polygons.roll()) {
      for (const Lattice& lattice : {Lattice::spanning(polygon), Lattice::of_doubles()}) {
        const auto parts = exact::snapped(polygon, lattice);
        if (!parts) {
          ASSERT_EQ(lattice.width(0), Lattice::of_doubles().width(0)) << "on an even lattice it is a theorem";
          continue;
        }
        expect_sound(*parts);
        const Rational moved = area_of(*parts) - exact::area(polygon);
        ASSERT_LE(std::abs(moved.get_d()), most_moved(polygon, lattice));
        ++rounded;
        parted += parts->size() > 1 ? 1 : 0;
        vanished += parts->empty() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(vanished, 50);
  EXPECT_LT(vanished, rounded / 2);
}

// This polygon was found by search, once in 65 000 of the polygons above. Near the origin cells are much smaller than
// at the ends of an edge, so rounding carries the edge across a vertex there.
TEST(SnapRounding, EvenCellsHoldWhereThoseOfDoublesDoNot) {
  std::ifstream numbers(POLYNYA_SOURCE_DIR "/tests/geometry/snap_rounding_across_a_vertex.txt");
  exact::Polygon polygon;
  for (exact::Point p; numbers >> p.x >> p.y;) polygon.outer.push_back(p);
  ASSERT_EQ(polygon.outer.size(), 9u);
  EXPECT_FALSE(exact::snapped(polygon, Lattice::of_doubles()));
  const auto parts = exact::snapped(polygon, Lattice::spanning(polygon));
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 1u);
  EXPECT_FALSE(find_defect(parts->front()));
}

TEST(SnapRounding, ANeckNarrowerThanACellParts) {
  // Two squares of 4 m, 8 m apart, joined by a strip of 1e-17 m.
  const Rational thin(1, mpz_class("100000000000000000"));
  const exact::Ring left{{-8, thin}, {-8, 2}, {-12, 2}, {-12, -2}, {-8, -2}, {-8, 0}};
  exact::Polygon dumbbell{left, {}};
  for (const exact::Point& p : left)
    dumbbell.outer.push_back({-p.x, p.y == 0 ? thin : p.y == thin ? Rational(0) : -p.y});
  const auto parts = exact::snapped(dumbbell, Lattice::spanning(dumbbell));
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ(area_of(*parts), 32);
}

TEST(SnapRounding, RingsThatTouchStayTogether) {
  // The corner of the hole lies on the edge from (0, 0) to (9, 1/3), at 1/3 of it, and is not a double.
  const exact::Polygon polygon{{{0, 0}, {9, Rational(1, 3)}, {9, 9}, {0, 9}}, {{{3, Rational(1, 9)}, {2, 4}, {4, 4}}}};
  for (const Lattice& lattice : {Lattice::of_doubles(), Lattice::spanning(polygon)}) {
    const auto parts = exact::snapped(polygon, lattice);
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), 1u);
    ASSERT_EQ(parts->front().holes.size(), 1u);
    EXPECT_EQ(parts->front().outer.size(), 5u) << "the point of touch is a vertex of both";
  }
}

}  // namespace
}  // namespace polynya::geometry
