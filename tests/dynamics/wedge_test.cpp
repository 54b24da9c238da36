// The wedge of ice at a contact, and the straight crack through a floe.

#include <algorithm>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "geometry/contact/crack_path.hpp"
#include "geometry/cut/cut.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using namespace scenery;

using shapes::kDegree;

Point towards(double degrees, double distance) {
  return {distance * std::cos(degrees * kDegree), distance * std::sin(degrees * kDegree)};
}

TEST(WedgeAngles, OfCornersAndEdgesAreMeasuredFromTheInwardDirection) {
  const Polygon square = rectangle(10, 10);
  // A wedge of 60°, looked at 10° off its bisector: 40° and 20°, the boundary after the tip first.
  const Polygon wedge{{{0, 0}, towards(-30, 20), towards(30, 20)}, {}};
  struct Row {
    Polygon floe;
    std::uint32_t edge;
    Point tip;
    Vector inward;
    double front, back;
  };
  std::vector<Row> rows{{square, 0, {1, -5}, {0, 1}, 90, 90}, {wedge, 0, {0, 0}, towards(10, 1) - Point{}, 40, 20}};
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    const Point tip = square.outer[corner];
    rows.push_back({square, corner, tip, (Point{} - tip) / length(Point{} - tip), 45, 45});
  }
  for (const auto& [floe, edge, tip, inward, front, back] : rows) {
    const WedgeAngles angles = wedge_angles(edge_list(floe), {edge, tip}, inward, 2.5);
    EXPECT_NEAR(angles.front, front * kDegree, 1e-12) << edge;
    EXPECT_NEAR(angles.back, back * kDegree, 1e-12) << edge;
  }
}

TEST(WedgeAngles, OfAJaggedEdgeAreThoseOfWhereItLeads) {
  // A straight edge with teeth of 5 cm. Over 3 m it is straight within the angle of the teeth, 0.05 / 3.
  Polygon jagged{{{10, 20}, {-10, 20}}, {}};
  for (int i = 200; i >= 0; --i) jagged.outer.insert(jagged.outer.begin(), {-10 + 0.1 * i, i % 2 == 0 ? 0.0 : 0.05});
  const WedgeAngles angles = wedge_angles(edge_list(jagged), {100, jagged.outer[100]}, {0, 1}, 3);
  EXPECT_NEAR(angles.front, 90 * kDegree, 0.05 / 3 * 1.01);
  EXPECT_NEAR(angles.back, 90 * kDegree, 0.05 / 3 * 1.01);
}

TEST(WedgeAngles, TurnWithTheFloeAndMirrorWithIt) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Polygon floe = random_star(random, 9, 5, 12);
    const EdgeList edges = edge_list(floe);
    const auto edge = static_cast<std::uint32_t>(random.below(9));
    const bool is_corner = i % 2 == 0;
    const Point tip = is_corner ? edges.from(edge) : midpoint(edges.from(edge), edges.to(edge));
    const Vector inward = (Point{} - tip) / length(Point{} - tip);
    const WedgeAngles angles = wedge_angles(edges, {edge, tip}, inward, 2);
    ASSERT_GE(std::min(angles.front, angles.back), 0);
    ASSERT_LE(std::max(angles.front, angles.back), std::numbers::pi);

    const Pose turn{{}, Rotation::by(random.angle())};
    const WedgeAngles same =
        wedge_angles(edge_list(transform(turn, floe)), {edge, transform(turn, tip)}, rotate(turn.rotation, inward), 2);
    ASSERT_NEAR(same.front, angles.front, 1e-9);
    ASSERT_NEAR(same.back, angles.back, 1e-9);

    Polygon mirrored;  // y → −y turns the ring around: vertex i becomes vertex 8 − i
    for (const Point p : floe.outer) mirrored.outer.insert(mirrored.outer.begin(), {p.x, -p.y});
    const std::uint32_t mirrored_edge = is_corner ? 8 - edge : (edge == 8 ? 8 : 7 - edge);
    const WedgeAngles swapped =
        wedge_angles(edge_list(mirrored), {mirrored_edge, {tip.x, -tip.y}}, {inward.x, -inward.y}, 2);
    ASSERT_NEAR(swapped.front, angles.back, 1e-9) << i;
    ASSERT_NEAR(swapped.back, angles.front, 1e-9) << i;
  }
}

TEST(WedgeAngles, OfAFloeSmallerThanTheLengthAreFinite) {
  const EdgeList edges = edge_list(rectangle(1, 1));
  for (const Point tip : {Point{-0.5, -0.5}, Point{0.2, -0.5}}) {
    const WedgeAngles angles = wedge_angles(edges, {0, tip}, {0, 1}, 50);
    EXPECT_TRUE(std::isfinite(angles.front) && std::isfinite(angles.back));
    EXPECT_GE(std::min(angles.front, angles.back), 0);
    EXPECT_LE(std::max(angles.front, angles.back), std::numbers::pi);
  }
}

TEST(CrackPath, CountsTheIceAheadAndBeginsAndEndsBeyondTheEdges) {
  const Polygon plate = rectangle(110, 200), holed{plate.outer, {shapes::reversed(rectangle(20, 20).outer)}};
  // The plate has a slot from the bottom up to y = 40, and a hole ahead of the slot.
  const Polygon slotted{{{-55, -50}, {5, -50}, {5, 40}, {15, 40}, {15, -50}, {55, -50}, {55, 50}, {-55, 50}},
                        {{{-35, -5}, {-35, 5}, {-25, 5}, {-25, -5}}}};
  constexpr CrackReach kFar = CrackReach::kFarSide, kFirst = CrackReach::kFirstEdge;
  struct Row {
    const Polygon* floe;
    Point from;
    double degrees;
    CrackReach reach;
    double length, start = -55, end = 55;
  };
  for (const auto& [floe, from, degrees, reach, length, start, end] :
       {Row{&plate, {-55, 20}, 0, kFar, 110}, Row{&plate, {-55, 20}, 17, kFar, 110 / std::cos(17 * kDegree), -55, 55},
        Row{&plate, {-54, 20}, 0, kFar, 109},       // from inside
        Row{&plate, {-65, 20}, 0, kFirst, 110},     // from the water before the ice
        Row{&plate, {-65, 20}, 0, kFar, 110, -65},  // the paper's
        Row{&holed, {-55, 0}, 0, kFar, 90}, Row{&holed, {-55, 20}, 0, kFar, 110},
        Row{&slotted, {-55, 20}, 0, kFar, 100}, Row{&slotted, {-55, 20}, 0, kFirst, 60, -55, 5},  // to another channel
        Row{&slotted, {-55, 0}, 0, kFirst, 50, -55, 5},                                           // through a hole
        Row{&slotted, {-55, 45}, 0, kFirst, 110}}) {
    SCOPED_TRACE(testing::Message() << length << " m from " << from.x << " " << from.y);
    const CrackPath path = crack_path(make_outline(*floe), from, towards(degrees, 1) - Point{}, 1e-3, reach);
    EXPECT_NEAR(path.length_in_ice, length, 1e-10);
    if (degrees > 0) continue;
    EXPECT_NEAR(distance(path.start, {start - 1e-3, from.y}), 0, 1e-12);
    EXPECT_NEAR(distance(path.end, {end + 1e-3, from.y}), 0, 1e-12);
  }
  const Boundary boundary = make_outline(holed);
  const CrackSides sides = sides_of_crack(boundary, crack_path(boundary, {10.5, 0}, {1, 0}, 1e-3));
  EXPECT_EQ(std::pair(sides.left, sides.right), std::pair(0.0, 0.0)) << "out of a hole it parts nothing";
}

/// The crack starts at an edge and runs through the middle, which sees every edge of a star. It ends at the far side,
/// or turns aside to the first edge.
TEST(CrackPath, CutAlongItAFloeSeparatesWithoutLossOfAreaIntoPiecesOfItsAreas) {
  Random random(9);
  int pairs = 0;
  for (int i = 0; i < 600; ++i) {
    const bool is_through = i % 2 == 0;
    const Polygon floe = random_star(random, is_through ? 10 : 4 + random.below(20), 4, 12);
    const Boundary boundary = make_outline(floe), ready = make_boundary(floe, {random.between(0.3, 3)});
    const EdgeList& edges = boundary.edges;
    const auto edge = static_cast<std::uint32_t>(random.below(static_cast<int>(edges.size())));
    const Point from = edges.from(edge) + random.between(0.2, 0.8) * (edges.to(edge) - edges.from(edge));
    const auto aside = Rotation::by(is_through ? 0 : random.between(-0.5, 0.5));
    const Vector direction = rotate(aside, (Point{} - from) / length(Point{} - from));
    const CrackReach reach = is_through ? CrackReach::kFarSide : CrackReach::kFirstEdge;
    const CrackPath path = crack_path(boundary, from, direction, 1e-3, reach);
    const CrackPath same = crack_path(ready, from, direction, 1e-3, reach);
    EXPECT_EQ(std::tuple(path.start, path.end, path.length_in_ice),
              std::tuple(same.start, same.end, same.length_in_ice));
    const CutOutcome outcome = cut_along({floe}, {path.start, path.end});
    if (is_through) {
      ASSERT_TRUE(outcome) << i << ": " << outcome.error().detail;
      EXPECT_GE(outcome->pieces.size(), 2u);
      EXPECT_EQ(outcome->ledger.exact_defect, "0");
      EXPECT_GE(path.length_in_ice, 8 * 0.99) << "from the rim through the middle to the other rim";
    }
    if (!outcome || outcome->pieces.size() != 2) continue;
    ++pairs;
    const CrackSides sides = sides_of_crack(boundary, path);
    double left = 0;
    for (const auto& piece : outcome->pieces) {
      // Around the ice, counter-clockwise, the corner after the crack's end is on its left.
      const Ring& ring = piece.shape.polygon.outer;
      if (std::ranges::find(ring, edges.to(path.last_edge)) != ring.end()) left = measure(piece.shape.polygon).area;
    }
    ASSERT_NEAR(sides.left, left, 1e-9) << i;
    ASSERT_NEAR(sides.left + sides.right, signed_area(floe.outer), 1e-9);
  }
  EXPECT_GT(pairs, 400);
}

TEST(CrackPath, ItsWidthIsTwiceTheIceOnItsNarrowerSide) {
  const Boundary boundary = make_outline(rectangle(110, 200));
  const auto width = [&](double y, double turn, double share) {
    const CrackPath path = crack_path(boundary, {-55, y}, {std::cos(turn), std::sin(turn)}, 0);
    return crack_width(boundary, path, share);
  };
  EXPECT_NEAR(width(0, 0, 0.15), 200, 1e-9);
  EXPECT_NEAR(width(70, 0, 0.15), 60, 1e-9);
  const double slant = 0.3;  // ends at the side y = 100: at a tenth of its way 27 m from there
  EXPECT_NEAR(width(70, slant, 0.1), 2 * 27 / std::cos(slant), 1e-9);
  const Boundary holed =
      make_outline(Polygon{rectangle(110, 200).outer, {{{-45, 10}, {-45, 15}, {-30, 15}, {-30, 10}}}});
  EXPECT_NEAR(crack_width(holed, crack_path(holed, {-55, 0}, {1, 0}, 0), 0.15), 20, 1e-9) << "a hole beside it";
}

TEST(CrackPath, OfTwoLegsHasTheAreasOfTheTwoPiecesThatItLeaves) {
  // The path starts at the left side, 6 m above the lower edge, runs along that edge and then down to it. A second path
  // does the same at the upper edge.
  const Polygon plate = rectangle(100, 40);
  const Boundary boundary = make_outline(plate);
  for (const double side : {-1.0, 1.0}) {
    const Point mouth{-50, side * 14};
    const CrackPath straight = crack_path(boundary, mouth, {1, 0}, 1e-3, CrackReach::kFirstEdge);
    const auto arm = arm_beside(boundary, mouth, {1, 0}, 0.36);
    ASSERT_TRUE(arm);
    EXPECT_NEAR(arm->width, 6, 1e-9);
    EXPECT_EQ(arm->is_left, side > 0);
    const Vector onward{3.0 / 5, side * 4.0 / 5};
    const auto path = turned_path(boundary, straight, mouth, {{-45, side * 14}, onward}, 1e-3);
    ASSERT_TRUE(path);
    EXPECT_NEAR(path->length_in_ice, 5 + 6 / 0.8, 1e-9);
    const CrackSides sides = sides_of_crack(boundary, *path);
    EXPECT_NEAR(side > 0 ? sides.left : sides.right, 5 * 6 + 0.5 * 6 * 4.5, 1e-9);
    EXPECT_NEAR(sides.left + sides.right, 4000, 1e-9);
    const CutOutcome outcome = cut_along({plate}, path->points());
    ASSERT_TRUE(outcome);
    ASSERT_EQ(outcome->pieces.size(), 2u);
    const double first = measure(outcome->pieces[0].shape.polygon).area;
    EXPECT_NEAR(std::min(first, 4000 - first), std::min(sides.left, sides.right), 1e-2) << "its margins are outside";
  }
}

TEST(CrackPath, DoesNotTurnAcrossWaterOrBeyondItsOwnEnd) {
  const Boundary boundary =
      make_outline(Polygon{rectangle(100, 40).outer, {{{-44, -18}, {-44, -16}, {-38, -16}, {-38, -18}}}});
  const CrackPath straight = crack_path(boundary, {-50, -14}, {1, 0}, 1e-3, CrackReach::kFirstEdge);
  EXPECT_FALSE(turned_path(boundary, straight, {-50, -14}, {{-45, -14}, {0.6, -0.8}}, 1e-3)) << "a hole";
  EXPECT_TRUE(turned_path(boundary, straight, {-50, -14}, {{-35, -14}, {0.6, -0.8}}, 1e-3));
  EXPECT_FALSE(turned_path(boundary, straight, {-50, -14}, {{51, -14}, {0.6, -0.8}}, 1e-3));
}

TEST(CrackPath, HasALigamentOnEitherSideOfEachHole) {
  Polygon plate = rectangle(100, 40);
  plate.holes = {{{-30, -5}, {-30, 5}, {-20, 5}, {-20, -5}}, {{10, -5}, {10, 5}, {40, 5}, {40, -5}}};
  const Boundary boundary = make_outline(plate);
  const CrackPath path = crack_path(boundary, {-49, 1}, {1, 0}, 1e-3, CrackReach::kFirstEdge);
  EXPECT_EQ(path.stretches, 3);
  const auto ligaments = ligaments_of(boundary, {-49, 1}, {1, 0}, 1e-3, path);
  ASSERT_EQ(ligaments.size(), 3u);
  EXPECT_NEAR(ligaments[0].length_in_ice, 19, 1e-12) << "from the mouth on";
  EXPECT_NEAR(ligaments[1].length_in_ice, 30, 1e-12);
  EXPECT_NEAR(ligaments[2].length_in_ice, 10, 1e-12);
  EXPECT_NEAR(ligaments[1].start.x, -20 - 1e-3, 1e-12);
  EXPECT_NEAR(ligaments[2].end.x, 50 + 1e-3, 1e-12);
}

TEST(Passage, IsTheStretchOfALineInABodyAndWhereItMeetsTheBodyAgain) {
  // A U that opens to the right.
  const Boundary u = make_outline(Polygon{{{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 8}, {10, 8}, {10, 10}, {0, 10}}, {}});
  const Passage up = passage_through(u, {5, 1}, {0, 1});
  EXPECT_NEAR(up.behind, -1, 1e-12);
  EXPECT_NEAR(up.ahead, 1, 1e-12);
  EXPECT_NEAR(up.again, 7, 1e-12);
  const Passage from_water = passage_through(u, {5, 5}, {-1, 0});
  EXPECT_EQ(from_water.ahead, 0);
  EXPECT_NEAR(from_water.again, 3, 1e-12);
  const Passage away = passage_through(u, {10, 1}, {1, 0});
  EXPECT_EQ(away.ahead, 0) << "from its boundary outwards";
  EXPECT_TRUE(std::isinf(away.again));
}

}  // namespace
}  // namespace polynya::geometry
