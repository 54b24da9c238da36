// Relations between neighbouring shapes, computed in doubles: whether there is room, how much of a piece lies in a
// band, and when two outlines that move in straight lines first touch.
#include "tests/shapes.hpp"

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "geometry/contact/near_boundaries.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"
#include "geometry/shape/power_diagram.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using scenery::Random;

Polygon square(double low, double high) {
  return shapes::rectangle(low, low, high, high);
}
Polygon frame() {
  return {square(-10, 10).outer, {shapes::reversed(square(-4, 4).outer)}};
}

bool is_clear_at(const Polygon& a, const Polygon& b, Point place, double turn = 0) {
  const Pose pose{place, Rotation::by(turn)};
  const bool by_outline = is_clear(make_outline(a), make_outline(b), pose);
  for (const bool has_circles : {false, true})
    EXPECT_EQ(is_clear(make_boundary(a, {1.0, has_circles}), make_outline(b), pose), by_outline);
  return by_outline;
}

TEST(Clearance, BodiesApartAreClearAndBodiesThatCrossAreNot) {
  EXPECT_TRUE(is_clear_at(square(-1, 1), square(-1, 1), {2.01, 0}));
  EXPECT_FALSE(is_clear_at(square(-1, 1), square(-1, 1), {1.99, 0}));
  EXPECT_FALSE(is_clear_at(square(-1, 1), square(-1, 1), {2.3, 0}, 0.785)) << "a corner reaches in";
  EXPECT_TRUE(is_clear_at(square(-1, 1), square(-1, 1), {2.5, 0}, 0.785));
}

TEST(Clearance, ABodyInsideAnotherIsNotClearButOneInAHoleIs) {
  EXPECT_FALSE(is_clear_at(square(-5, 5), square(-1, 1), {1, 1}));
  EXPECT_FALSE(is_clear_at(square(-1, 1), square(-5, 5), {1, 1}));
  EXPECT_TRUE(is_clear_at(frame(), square(-1, 1), {0, 0}));
  EXPECT_FALSE(is_clear_at(frame(), square(-1, 1), {7, 0})) << "in the ice of the frame";
  EXPECT_FALSE(is_clear_at(frame(), square(-1, 1), {4, 0})) << "across its edge";
  EXPECT_FALSE(is_clear_at(frame(), square(-3, 3), {0, 0}, 0.785));
}

/// The search through the tree of bounding circles misses no edge that matters. The test places a piece all over and
/// beside a plate with a channel in it.
TEST(Clearance, AReadyBoundaryAnswersAsAnOutlineDoes) {
  Polygon plate{{{0, 0}, {600, 0}, {600, 200}, {0, 200}}, {}};
  for (int i = 0; i <= 200; ++i) plate.outer.push_back({0.5 * i, 112 + 0.7 * (i % 2)});
  for (int i = 200; i >= 0; --i) plate.outer.push_back({0.5 * i, 88 - 0.7 * (i % 3)});
  const Boundary outline = make_outline(plate);
  const Boundary ready = make_boundary(plate, {1.0, false});
  ASSERT_LT(ready.cover->pieces.size(), 1200U) << "the rim of 1600 m is in coarse pieces, the channel is not";
  const Boundary piece = make_outline({{{-1, -0.6}, {1.2, -0.5}, {0.9, 0.8}, {-0.8, 0.7}}, {}});
  int clear = 0, blocked = 0;
  for (double x = -3; x < 130; x += 0.83) {
    for (double y = 80; y < 120; y += 0.71) {
      const Pose pose{{x, y}, Rotation::by(x + y)};
      ASSERT_EQ(is_clear(ready, piece, pose), is_clear(outline, piece, pose)) << x << " " << y;
      (is_clear(outline, piece, pose) ? clear : blocked) += 1;
    }
  }
  EXPECT_GT(clear, 1000);
  EXPECT_GT(blocked, 1000);
}

TEST(Clearance, TheAreaInABandIsWhatIsLeftOfThePolygonThere) {
  EXPECT_NEAR(area_in_band(square(-5, 5), 12), 100, 1e-12) << "all of it";
  EXPECT_NEAR(area_in_band(square(-5, 5), 2), 40, 1e-12);
  EXPECT_NEAR(area_in_band(square(3, 5), 2), 0, 1e-12) << "beside it";
  EXPECT_NEAR(area_in_band(square(1, 5), 2), 4, 1e-12) << "half in";
  EXPECT_NEAR(area_in_band(frame(), 6), 20 * 12 - 64, 1e-12) << "without its hole";
  const Polygon triangle{{{0, 0}, {4, 0}, {0, 4}}, {}};
  EXPECT_NEAR(area_in_band(triangle, 1), 8 - 4.5, 1e-12);
  const Polygon comb{{{0, -3}, {9, -3}, {9, 3}, {6, 3}, {6, -1}, {3, -1}, {3, 3}, {0, 3}}, {}};
  EXPECT_NEAR(area_in_band(comb, 2), 9 * 1 + 2 * 3 * 3, 1e-12) << "not convex: two teeth";
}

const Ring kSquareOfTwo = square(0, 2).outer;

Ring moved(const Ring& ring, Vector by) {
  return transform(Pose{Point{} + by, {}}, ring);
}

double shared_area(const Ring& a, const Ring& b) {
  const auto shared = overlap({{a, {}}}, {}, {{b, {}}}, {});
  EXPECT_TRUE(shared.has_value());
  return shared ? shared->area : 0;
}

TEST(FirstContact, OfTwoSquares) {
  const auto touch = [](Vector at, Vector velocity, double from = 0, double until = 100) {
    return first_contact(kSquareOfTwo, moved(kSquareOfTwo, at), velocity, from, until);
  };
  const auto found = touch({5, 1}, {-0.5, 0});
  ASSERT_TRUE(found.has_value());
  EXPECT_DOUBLE_EQ(found->time, 6);
  EXPECT_EQ(found->normal, (Vector{1, 0}));
  EXPECT_DOUBLE_EQ(found->point.x, 2);
  EXPECT_FALSE(touch({5, 1}, {-0.5, 0}, 0, 5.9)) << "later than asked";
  EXPECT_FALSE(touch({5, 1}, {0.5, 0})) << "apart from each other";
  EXPECT_FALSE(touch({5, 2.5}, {-0.5, 0})) << "past each other";
  EXPECT_FALSE(touch({2, 0}, {0, 0.5})) << "along each other";
  EXPECT_FALSE(touch({2 + 1e-14, 0}, {0, 0.5})) << "likewise";
  EXPECT_TRUE(touch({2 - 1e-12, 0}, {-0.5, 0}, -1, 0)) << "just now";
  EXPECT_TRUE(touch({3, 3}, {-0.5, -0.5})) << "corner on corner";
}

// The two do not overlap before the time of first contact, and a little after it they do. If there is no contact, they
// pass each other.
TEST(FirstContact, IsWhereOverlapBegins) {
  scenery::Random random(7);
  const auto star = [&](double radius) { return scenery::random_star(random, 9, 0.3 * radius, radius).outer; };
  int touching = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Ring a = star(10), b = moved(star(6), {40, random.between(-25, 25)});
    const Vector velocity{-2, random.between(-0.5, 0.5)};
    const auto touch = first_contact(a, b, velocity, 0, 60);
    const double end = touch ? touch->time : 60;
    for (int i = 0; i <= 40; ++i) {
      const double time = end * i / 40 * (1 - 1e-9);
      ASSERT_LT(shared_area(a, moved(b, time * velocity)), 1e-6) << "trial " << trial << " at " << time;
    }
    if (!touch) continue;
    ++touching;
    EXPECT_GT(shared_area(a, moved(b, (end + 0.01) * velocity)), 0) << trial;
    EXPECT_GT(-dot(velocity, touch->normal), 0) << "closing";
  }
  EXPECT_GT(touching, 20);
  EXPECT_LT(touching, 60);
}

// ---- polygons that overlap: found, made disjoint; and simplified

Polygon square(double x, double y, double side) {
  return shapes::square({x, y}, side);
}

/// A ragged outline about a centre.
Polygon ragged(Random& random, Point centre, double radius, int corners) {
  return transform(Pose{centre, {}}, scenery::random_star(random, corners, 0.7 * radius, 1.3 * radius));
}

TEST(Disjoint, TheOverlapStaysWithTheLarger) {
  const auto trimmed = make_disjoint({square(0, 0, 10), square(5, 5, 20), square(100, 0, 1)}, 0);
  ASSERT_EQ(trimmed.size(), 3U);
  EXPECT_EQ(trimmed[1].pieces, std::vector{square(5, 5, 20)});
  EXPECT_EQ(trimmed[2].pieces, std::vector{square(100, 0, 1)});
  ASSERT_EQ(trimmed[0].pieces.size(), 1U);
  EXPECT_EQ(measure(trimmed[0].pieces[0]).area, 75);
  EXPECT_EQ(trimmed[0].area_trimmed, 25);
  EXPECT_EQ(trimmed[0].yields, std::vector<std::size_t>{1});
  EXPECT_EQ(trimmed[0].rounding_defect, 0);
}

TEST(Disjoint, OfEqualOnesTheFirstKeepsItAndACopyIsGone) {
  const auto trimmed = make_disjoint({square(0, 0, 10), square(0, 0, 10), square(10, 0, 10)}, 0);
  EXPECT_EQ(trimmed[0].pieces.size(), 1U);
  EXPECT_TRUE(trimmed[1].pieces.empty());
  EXPECT_EQ(trimmed[1].area_trimmed, 100);
  EXPECT_EQ(trimmed[2].pieces, std::vector{square(10, 0, 10)}) << "neighbours that touch stay as they are";
  EXPECT_TRUE(trimmed[2].yields.empty());
}

TEST(Disjoint, AFloeThatALargerOneCrossesIsTwo) {
  const Polygon bar{{{-20, 4}, {30, 4}, {30, 6}, {-20, 6}}, {}};
  const auto trimmed = make_disjoint({square(0, 0, 9), bar}, 0);  // 81 and 100 m²
  ASSERT_EQ(trimmed[0].pieces.size(), 2U);
  EXPECT_EQ(exact_area(trimmed[0].pieces[0]) + exact_area(trimmed[0].pieces[1]), 81 - 18);
}

TEST(Disjoint, AGapIsOpenedToTheSmaller) {
  const auto trimmed = make_disjoint({square(0, 0, 10), square(10, 2, 5), square(15.5, 2, 2)}, 1);
  EXPECT_EQ(measure(trimmed[0].pieces[0]).area, 100);
  EXPECT_NEAR(measure(trimmed[1].pieces[0]).area, 20, 1e-6);
  EXPECT_NEAR(bounding_box(trimmed[1].pieces[0].outer).low.x, 11, 1e-6);
  EXPECT_NEAR(bounding_box(trimmed[2].pieces[0].outer).low.x, 16, 1e-6);
  // At a corner the strip is a polygon about the disc: never less than the gap.
  const auto corner = make_disjoint({square(0, 0, 10), square(10.3, 10.3, 4)}, 1);
  for (const Point p : corner[1].pieces[0].outer) EXPECT_GE(distance(p, {10, 10}), 1);
}

/// For any overlapping floes, nothing overlaps afterwards, all floes are valid, and the areas add up.
TEST(Disjoint, RaggedCrowdsComeApartAndTheirAreasAddUp) {
  for (const double gap : {0.0, 0.5}) {
    Random random(7);
    std::vector<Polygon> crowd;
    for (int i = 0; i < 120; ++i)
      crowd.push_back(ragged(random, {random.between(0, 100), random.between(0, 100)}, random.between(2, 12), 20));
    const auto trimmed = make_disjoint(crowd, gap);
    std::vector<Polygon> pieces;
    std::vector<const Polygon*> after, before;
    double taken = 0;
    for (const Polygon& floe : crowd) before.push_back(&floe);
    for (const auto& floe : trimmed) {
      ASSERT_FALSE(floe.error);
      taken += floe.area_trimmed - floe.rounding_defect;
      pieces.insert(pieces.end(), floe.pieces.begin(), floe.pieces.end());
    }
    for (const Polygon& piece : pieces) {
      EXPECT_FALSE(find_defect(piece));
      after.push_back(&piece);
    }
    EXPECT_TRUE(find_overlapping_pairs(pieces, 1).empty());
    const double terms[] = {taken};
    EXPECT_NEAR(exact_balance(after, before, terms), 0, 1e-9);
    EXPECT_GT(taken, 100);
  }
}

TEST(Simplified, EveryVertexStaysWithinTheTolerance) {
  Random random(11);
  for (int i = 0; i < 30; ++i) {
    Polygon polygon = ragged(random, {50, -20}, 100, 60);
    polygon.holes.push_back({{48, -18}, {52, -18}, {52, -22}, {48, -22}});
    const double tolerance = random.between(0.5, 8);
    const Polygon fewer = simplified(polygon, tolerance);
    EXPECT_FALSE(find_defect(fewer));
    EXPECT_LT(vertex_count(fewer), vertex_count(polygon));
    for (const Point p : polygon.outer) {
      double nearest = 1e9;
      for (std::size_t k = 0; k < fewer.outer.size(); ++k)
        nearest = std::min(nearest, distance_to_segment(p, fewer.outer[k], fewer.outer[(k + 1) % fewer.outer.size()]));
      EXPECT_LE(nearest, tolerance * (1 + 1e-12));
    }
  }
  EXPECT_EQ(simplified(square(0, 0, 4), 0.5).outer.size(), 4U);
}

Polygon box(double x, double y, double w, double h) {
  return shapes::rectangle(x, y, x + w, y + h);
}

Polygon turned(const Polygon& polygon, double angle) {
  return transform(Pose{{3, 4}, Rotation::by(angle)}, polygon);
}

TEST(OverlappingPairs, AreGivenWithTheirAreaAndNoneByEdgesAndCornersThatAreShared) {
  for (const double angle : {0.0, 0.3, 1.0, 2.5}) {
    std::vector<Polygon> floes;
    for (const Polygon& floe : {box(0, 0, 10, 10), box(10, 0, 10, 10), box(10, 10, 5, 5), box(-7, -7, 7, 7)})
      floes.push_back(turned(floe, angle));
    EXPECT_TRUE(find_overlapping_pairs(floes, 100).empty());
    floes.push_back(turned(box(8, 2, 2, 3), angle));
    floes.push_back(turned(box(2, 2, 1, 1), angle));
    const auto found = find_overlapping_pairs(floes, 100);
    ASSERT_EQ(found.size(), 2U);
    for (const auto& [pair, second, area] : {std::tuple{found[0], 4U, 6.0}, {found[1], 5U, 1.0}}) {
      EXPECT_EQ(pair.first, 0U);
      EXPECT_EQ(pair.second, second);
      EXPECT_NEAR(pair.area, area, 1e-9);
    }
  }
}

TEST(Overlap, IsRefusedBeyondWhatAreasCanExpress) {
  const Shape near{{{{0, 0}, {9, 0}, {0, 9}}, {}}};
  for (const double far : {1e71, 1e300, std::numeric_limits<double>::infinity()}) {
    const auto found = overlap(near, {}, Shape{{{{0, 0}, {far, 0}, {0, far}}, {}}}, {});
    ASSERT_FALSE(found.has_value());
    EXPECT_EQ(found.error().reason, CutFailure::kInvalidShape);
  }
  EXPECT_EQ(overlap(near, {}, Shape{{{{0, 0}, {1e60, 0}, {0, 1e60}}, {}}}, {})->area, 40.5);
}

TEST(OverlappingPairs, AFloeMayLieInAnothersHoleOrBay) {
  Polygon ring = box(0, 0, 10, 10);
  ring.holes.push_back({{2, 2}, {2, 8}, {8, 8}, {8, 2}});
  EXPECT_TRUE(find_overlapping_pairs({ring, box(3, 3, 4, 4)}, 100).empty());
  EXPECT_TRUE(find_overlapping_pairs({ring, box(2, 2, 6, 6)}, 100).empty());  // fills it
  EXPECT_EQ(find_overlapping_pairs({ring, box(3, 3, 6, 4)}, 100).size(), 1U);
  const Polygon bay{{{0, 0}, {10, 0}, {10, 10}, {8, 10}, {8, 2}, {2, 2}, {2, 10}, {0, 10}}, {}};
  EXPECT_TRUE(find_overlapping_pairs({bay, box(3, 3, 4, 4)}, 100).empty());
  EXPECT_EQ(find_overlapping_pairs({bay, box(3, 1, 4, 4)}, 100).size(), 1U);
}

/// The grid finds the same pairs as a comparison of all pairs.
TEST(OverlappingPairs, AgreesWithAllPairs) {
  Random random(5);
  std::vector<Polygon> boxes;
  for (int i = 0; i < 150; ++i)
    boxes.push_back(
        box(random.between(0, 100), random.between(0, 100), random.between(0.5, 12), random.between(0.5, 12)));
  boxes.push_back(box(-20, 50, 400, 1));  // one that reaches over everything
  std::vector<std::pair<std::size_t, std::size_t>> expected, found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const Box a = bounding_box(boxes[i].outer), b = bounding_box(boxes[j].outer);
      const double w = std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x);
      const double h = std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y);
      if (w > 0 && h > 0 && w * h > kTouchingArea) expected.emplace_back(i, j);
    }
  }
  for (const OverlappingPair& o : find_overlapping_pairs(boxes, 100'000)) found.emplace_back(o.first, o.second);
  EXPECT_GT(expected.size(), 20U);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(find_overlapping_pairs(boxes, 3).size(), 3U);
}

// ---- power diagrams: every point belongs to the site of least power distance

constexpr std::uint64_t kSeed = 91;

std::vector<Site> random_sites(Random& random, int count, double weight) {
  std::vector<Site> sites;
  for (int i = 0; i < count; ++i)
    sites.push_back({{random.between(-3, 7), random.between(100, 104)}, random.between(-weight, weight)});
  return sites;
}

double power(const Site& site, Point p) {
  return squared_length(p - site.point) - site.weight;
}

TEST(PowerDiagram, CellsTileTheBoxAreConvexAndHaveThePointsOfLeastPowerDistance) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  for (int trial = 0; trial < 200; ++trial) {
    const auto sites = random_sites(random, 1 + random.below(80), trial % 3 == 0 ? 0 : trial % 3 - 0.7);
    const auto cells = power_diagram(sites, {{-3, 100}, {7, 104}});
    double sum = 0;
    for (const Ring& cell : cells) {
      for (std::size_t i = 0; i < cell.size(); ++i) {
        const Point b = cell[(i + 1) % cell.size()];
        ASSERT_GE(cross(b - cell[i], cell[(i + 2) % cell.size()] - b), -1e-12);
      }
      if (!cell.empty()) sum += signed_area(cell);
    }
    ASSERT_NEAR(sum, 40, 1e-10);
    for (int k = 0; k < 25; ++k) {
      const Point p{random.between(-3, 7), random.between(100, 104)};
      const auto power_at_p = [&](const Site& site) { return power(site, p); };
      const double least = power_at_p(std::ranges::min(sites, {}, power_at_p));
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const bool is_in_cell = !cells[i].empty() && contains({cells[i], {}}, p);
        const double beyond = power_at_p(sites[i]) - least;
        ASSERT_TRUE(std::abs(beyond) < 1e-9 || !is_in_cell) << trial << " " << p.x << " " << p.y;
      }
    }
  }
}

TEST(PowerCells, AreThoseOfThePowerDiagramWhateverTheWeights) {
  Random random(kSeed + 2);
  const Ring region{{-3, 100}, {7, 100}, {7, 104}, {-3, 104}};
  for (int trial = 0; trial < 200; ++trial) {
    auto sites = random_sites(random, 2 + random.below(80), 0.3);
    for (Site& site : sites) {  // few of great weight
      if (trial % 2 == 0 && random.below(8) == 0) site.weight += random.between(1, 40);
    }
    const auto cells = power_diagram(sites, {{-3, 100}, {7, 104}});
    std::vector<std::vector<std::uint32_t>> neighbours(sites.size());
    std::size_t next = 0;
    visit_power_cells(sites, region, [&](const PowerCell& cell) {
      ASSERT_EQ(cell.site, next++);
      const double area = cell.ring.empty() ? 0 : signed_area(cell.ring);
      ASSERT_NEAR(area, cells[cell.site].empty() ? 0 : signed_area(cells[cell.site]), 1e-10);
      ASSERT_EQ(cell.ring.size(), cell.beyond.size());
      for (std::size_t k = 0; k < cell.ring.size(); ++k) {
        const Point middle = midpoint(cell.ring[k], cell.ring[(k + 1) % cell.ring.size()]);
        if (cell.beyond[k] == kNoSite) {
          ASSERT_TRUE(middle.x < -3 + 1e-9 || middle.x > 7 - 1e-9 || middle.y < 100 + 1e-9 || middle.y > 104 - 1e-9);
        } else {  // an edge is as far from the site beyond it
          ASSERT_NEAR(power(sites[cell.beyond[k]], middle), power(sites[cell.site], middle), 1e-9);
        }
      }
    });
    ASSERT_EQ(next, sites.size());
  }
}

TEST(PowerCells, OfTwoSitesInOnePlaceOneHasTheCell) {
  double sum = 0;
  int cells = 0;
  visit_power_cells({{{1, 1}, 0}, {{1, 1}, 0}, {{3, 1}, 0}}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}},
                    [&](const PowerCell& cell) {
                      if (cell.ring.empty()) return;
                      sum += signed_area(cell.ring);
                      ++cells;
                    });
  EXPECT_DOUBLE_EQ(sum, 8);
  EXPECT_EQ(cells, 2);
}

}  // namespace
}  // namespace polynya::geometry
