// Water on the deck of a cusp that a hull presses down.
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "fracture/turning_cusp.hpp"

namespace polynya::fracture {
namespace {

constexpr double kCuspDepth = 4, kCuspWidth = 10, kHullAngle = 0.7;  // [m, m, rad]
const Water kSea;

constexpr double kThickness = 0.5;

/// A rectangle whose far edge is at the sheet's edge, and whose other edges are beside `sides`. An older cusp is
/// equally deep, with its axis where this one begins.
Deck rectangle(Beside sides, double older_far = kCuspDepth) {
  Ice ice;
  ice.thickness = kThickness;
  const std::vector<geometry::Point> outline{
      {0, -kCuspWidth / 2}, {kCuspDepth, -kCuspWidth / 2}, {kCuspDepth, kCuspWidth / 2}, {0, kCuspWidth / 2}};
  const DeckEdge side{sides, older_far, kCuspDepth};
  return deck_of(ice, kSea, kHullAngle, outline, std::vector{side, DeckEdge{}, side, side});
}

/// Removes the sheet beside the strips, from strip `first` on.
Deck apart_from_sheet(Deck deck, std::size_t first = 0) {
  for (std::size_t i = first; i < deck.strips.size(); ++i) deck.strips[i].sheet = deck.strips[i].sheet_across = 0;
  return deck;
}

/// Work over a whole turn of a given duration without friction, done by the hull's force on the edge and by the missing
/// water before the hull [J].
struct Work {
  double down = 0, ahead = 0;
  double sum() const { return down - ahead; }
};

Work work(const Deck& deck, double duration, DeckState* end = nullptr, int steps = 2000) {
  const double way = distance_to_lie_along(deck) / steps;
  const double thrust = 1 / std::tan(deck.hull_angle);
  DeckState state;
  Work sum;
  for (int i = 0; i < steps; ++i) {
    const DeckForces forces = turn_deck(deck, kSea, {thrust, way, duration / steps}, state);
    sum.down += thrust * way * forces.down;
    sum.ahead += way * forces.ahead;
  }
  if (end != nullptr) *end = state;
  return sum;
}

TEST(FloodingDeck, HasTheOutlinesStrips) {
  const Deck deck = rectangle(Beside::kOlderCusp);
  double area = 0, sheet = 0, older = 0, facing = 0, water = 0;
  for (const DeckStrip& s : deck.strips) {
    EXPECT_NEAR(s.width, kCuspWidth, 1e-12);
    area += s.width * kCuspDepth / Deck::kStrips;
    sheet += s.sheet;
    water += s.water;
    for (const DeckSide& side : s.sides) {
      older += side.length;
      facing += side.facing;
    }
  }
  EXPECT_NEAR(area, kCuspWidth * kCuspDepth, 1e-12);
  EXPECT_NEAR(sheet, kCuspWidth, 1e-12);
  EXPECT_NEAR(older, kCuspWidth + 2 * kCuspDepth, 1e-12);
  EXPECT_NEAR(facing, kCuspWidth, 1e-12);  // of the near edge: the sides do not face the hull
  EXPECT_NEAR(deck.strips.front().sheet_across, kCuspWidth, 1e-12);
  const DeckSide& left = deck.strips.back().sides[0];
  EXPECT_NEAR(left.axis, 0, 1e-12);
  EXPECT_NEAR(left.depth, kCuspDepth, 1e-12);
  EXPECT_EQ(water, 0);
  EXPECT_EQ(rectangle(Beside::kWater).strips.front().water, 2 * kCuspDepth / Deck::kStrips);
}

TEST(FloodingDeck, DryGivesBackWhatItTook) {
  Deck deck = apart_from_sheet(rectangle(Beside::kSheet));
  deck.freeboard = 0;
  // ρ_w g b [R³/3 (1 − cos ψ) + h R²/2 (ψ − sin ψ)] over the turn to π/2 − θ_s.
  const double turn = std::numbers::pi / 2 - kHullAngle;
  const double r = kCuspDepth;
  const double dry = kSea.density * kGravity * kCuspWidth *
                     (r * r * r / 3 * (1 - std::cos(turn)) + kThickness * r * r / 2 * (turn - std::sin(turn)));
  for (const double duration : {1., 1000.}) {
    const Work done = work(deck, duration);
    EXPECT_NEAR(done.down / dry, 1, 0.01);
    EXPECT_NEAR(done.sum() / dry, 0, 0.01) << "a cavity that came and went";
  }
}

TEST(FloodingDeck, LiesAlongTheHullAtTheEndOfItsWay) {
  // The lower corner of the far edge is h below the level. The upper corner, at right angles to the deck from there, is
  // on the hull, whose waterline is R - s away.
  const Deck deck = rectangle(Beside::kSheet);
  const double waterline = kCuspDepth - distance_to_lie_along(deck);
  const double x = kThickness * std::cos(kHullAngle);
  const double z = kThickness * (1 - std::sin(kHullAngle));
  EXPECT_NEAR(waterline + z * std::tan(kHullAngle), x, 1e-12);
}

constexpr double kHasTurned = kCuspDepth - 3;  ///< where an older cusp ends that the hull has pressed farther down

/// The energy of water that falls into the pool is lost. It is zero if no water enters, or if the water enters without
/// a fall.
TEST(FloodingDeck, FloodsThroughWhatOpensTheSoonerTheSlowerTheHull) {
  const Deck deck = rectangle(Beside::kOlderCusp, kHasTurned);
  const Work dry = work(deck, 1e-3), fast = work(deck, 4), slow = work(deck, 4000);
  EXPECT_LT(fast.down, 0.9 * dry.down);
  EXPECT_LT(work(deck, 40).down, 0.5 * fast.down);
  EXPECT_LT(slow.down, 0.02 * dry.down);
  EXPECT_LT(work(rectangle(Beside::kSheet), 4000).down, 0.05 * dry.down);
  EXPECT_NEAR(dry.sum() / dry.down, 0, 0.01);
  EXPECT_GT(fast.sum(), 0.05 * dry.down);
  EXPECT_LT(slow.sum(), 0.02 * dry.down);
}

TEST(FloodingDeck, StaysDryWhereNothingHasOpened) {
  const auto pool = [](const Deck& deck, double way) {
    DeckState state;
    turn_deck(deck, kSea, {1, way, 10}, state);
    return state.pool;
  };
  const Deck sheet = apart_from_sheet(rectangle(Beside::kSheet), Deck::kStrips - 1);
  EXPECT_LT(pool(sheet, 0.2), pool(sheet, 1)) << "the far edge opens as it goes down";
  EXPECT_EQ(pool(apart_from_sheet(rectangle(Beside::kOlderCusp)), 1), 0)
      << "another that turns with it stays beside it";
  EXPECT_GT(pool(apart_from_sheet(rectangle(Beside::kOlderCusp, kHasTurned)), 1), 0) << "it has turned farther";
}

TEST(FloodingDeck, LiesBesideAnOlderCuspTooShortToTurn) {
  Deck deck = rectangle(Beside::kOlderCusp, kHasTurned);
  for (DeckStrip& s : deck.strips)
    for (DeckSide& side : s.sides) side.depth = 0.1 * kThickness;
  const Work done = work(deck, 4);
  EXPECT_GT(done.down, 0);
  EXPECT_TRUE(std::isfinite(done.sum()));
}

TEST(FloodingDeck, HoldsNoMoreThanThereIsRoomBetweenDeckAndHull) {
  DeckState end;
  const Deck deck = rectangle(Beside::kWater);
  work(deck, 40, &end);
  EXPECT_NEAR(end.displacement, distance_to_lie_along(deck), 1e-9);
  EXPECT_NEAR(end.pool, 0, 1e-3 * kCuspWidth * kCuspDepth * kCuspDepth) << "the hull has come to the axis";
}

TEST(FloodingDeck, DoesNotDependOnTheStepOfItsHull) {
  const Deck deck = rectangle(Beside::kOlderCusp, kHasTurned);
  EXPECT_NEAR(work(deck, 4, nullptr, 20).sum() / work(deck, 4).sum(), 1, 0.1);
}

// ---- the numbers of docs/theory/bow.md, "Water on the deck of a turning cusp", by its closed forms

/// Returns the distance that the hull has moved when a deck has turned by ψ: √(R² + h²) cos(ψ + θ_s − β) = x_w cos θ_s
/// + h sin θ_s.
double way_at_turn(const Deck& deck, double turn) {
  const double r = deck.depth, h = deck.thickness, theta = deck.hull_angle;
  return r - (std::hypot(r, h) * std::cos(turn + theta - std::atan2(h, r)) - h * std::sin(theta)) / std::cos(theta);
}

/// A deck at a turn ψ, strip by strip.
struct Turned {
  const Deck& deck;
  double turn;

  double at(int k) const { return (k + 0.5) * deck.depth / Deck::kStrips; }
  double x(double r) const { return r * std::cos(turn) + deck.thickness * std::sin(turn); }
  double z(double r) const { return r * std::sin(turn) + deck.thickness * (1 - std::cos(turn)) - deck.freeboard; }
  double hull_depth(double r) const {
    const double waterline = deck.depth - way_at_turn(deck, turn);
    return std::max(0.0, (x(r) - waterline) / std::tan(deck.hull_angle) - deck.freeboard);
  }
  double deepest() const { return z(at(Deck::kStrips - 1)); }
  /// Volume of a pool whose surface is that far below the water level [m³].
  double pool(double surface) const {
    double volume = 0;
    for (int k = 0; k < Deck::kStrips; ++k) {
      const double r = at(k);
      volume += deck.strips[static_cast<std::size_t>(k)].width *
                std::max(0.0, std::max(0.0, z(r)) - std::max(surface, hull_depth(r)));
    }
    return std::cos(turn) * deck.depth / Deck::kStrips * volume;
  }
};

/// Returns the inflow into a deck at the given turn, measured over a time in which nothing else changes [m³/s].
double inflow_at(const Deck& deck, double turn, double pool = 0) {
  constexpr double kShort = 1e-9;  // [s]
  DeckState state{way_at_turn(deck, turn), pool};
  turn_deck(deck, kSea, {1, 0, kShort}, state);
  return (state.pool - pool) / kShort;
}

TEST(FloodingDeck, AnArcThatOpensFloodsAsASharpEdgedOrifice) {
  const Deck deck = rectangle(Beside::kSheet);
  for (const double turn : {0.05, 0.1}) {  // r sin ψ < h at all strips
    const Turned turned{deck, turn};
    double flow = 0;
    for (int k = 0; k < Deck::kStrips; ++k) {
      const double r = turned.at(k), head = turned.z(r);
      const double opening = r * (1 - std::cos(turn)) * deck.strips[static_cast<std::size_t>(k)].sheet_across;
      if (head > 0) flow += 0.6 * opening * std::sqrt(2 * kGravity * head);
    }
    ASSERT_GT(flow, 0);
    EXPECT_NEAR(inflow_at(deck, turn) / flow, 1, 2e-5) << turn;  // the pool is found by 16 halvings
  }
}

TEST(FloodingDeck, AnEdgeOnOpenWaterFloodsOverItsCrestAndLessWhereThePoolBacksUp) {
  const Deck deck = apart_from_sheet(rectangle(Beside::kWater));
  const Turned turned{deck, 0.3};
  for (const double surface : {turned.deepest(), 0.5 * turned.deepest(), 0.2 * turned.deepest()}) {
    double flow = 0;
    for (int k = 0; k < Deck::kStrips; ++k) {
      const double head = turned.z(turned.at(k));
      if (head <= 0) continue;
      const double behind = std::max(0.0, head - surface) / head;
      flow += deck.strips[static_cast<std::size_t>(k)].water * std::pow(2. / 3, 1.5) *
              std::sqrt(kGravity * head * head * head) * std::pow(1 - std::pow(behind, 1.5), 0.385);
    }
    ASSERT_GT(flow, 0);
    EXPECT_NEAR(inflow_at(deck, turned.turn, turned.pool(surface)) / flow, 1, 2e-3) << surface;
  }
}

TEST(FloodingDeck, PressesAtALeverOfNotLessThanATenthOfItsDepth) {
  Deck deck = rectangle(Beside::kSheet);
  deck.freeboard = 0;
  const double turn = 0.02;
  const Turned turned{deck, turn};
  const auto down = [&](double thrust) {
    DeckState state{way_at_turn(deck, turn), 0};
    return turn_deck(deck, kSea, {thrust, 0, 1e-9}, state).down;
  };
  const double up = deck.depth * std::sin(turn) - deck.thickness * std::cos(turn);  // negative: thrust takes it away
  const double level = turned.x(deck.depth);
  const auto thrust_for = [&](double lever) { return (lever - level) / up; };
  for (const double share : {0.6, 0.3, 0.15})
    EXPECT_NEAR(down(0) * level / (down(thrust_for(share * deck.depth)) * share * deck.depth), 1, 1e-9) << share;
  EXPECT_NEAR(down(0) * level / (down(thrust_for(0.02 * deck.depth)) * 0.1 * deck.depth), 1, 1e-9) << "it jams";
}

// ---- the mass at the edge of a cusp that turns as it breaks off

TEST(TurningCusp, WeighsAThirdOfItsIceAndHalfOfAPlatesWaterWhereItIsWide) {
  Ice ice;
  ice.thickness = 0.5;
  ice.density = 900;
  const Water water;
  const double depth = 2;
  const double width = 2e4;
  const double area = depth * width;
  const double mass = edge_mass(ice, water, {area, depth, width * depth * depth * depth / 3});
  // A plate of width 2a about its edge, in two dimensions:
  // π ρ a⁴/8 about its middle, π ρ a⁴ of its middle's way.
  const double a = depth / 2;
  const double plate = 9. / 8 * std::numbers::pi * water.density * a * a * a * a;
  EXPECT_NEAR(mass / width, 900 * 0.5 * depth / 3 + plate / 2 / (depth * depth), 1e-4 * mass / width);
}

TEST(TurningCusp, OfALongOneTheWaterGoesRoundTheSides) {
  const Ice ice;
  const Water water;
  const auto water_of = [&](double depth) { return edge_mass(ice, water, {16, depth, 0}) / (16 * depth); };
  EXPECT_GT(water_of(2), 3 * water_of(8));
  EXPECT_EQ(edge_mass(ice, water, {}), 0);
}

}  // namespace
}  // namespace polynya::fracture
