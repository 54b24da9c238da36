// Water on the deck of a cusp that a hull presses down.
#include "fracture/flooding_deck.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace polynya::fracture {
namespace {

constexpr double kCuspDepth = 4, kCuspWidth = 10, kHullAngle = 0.7;  // [m, m, rad]
const Water kSea;

/// A rectangle whose far edge is at the sheet's, its others beside `sides`.
Deck rectangle(Beside sides) {
  const Ice ice;
  const std::vector<geometry::Point> outline{
      {0, -kCuspWidth / 2}, {kCuspDepth, -kCuspWidth / 2}, {kCuspDepth, kCuspWidth / 2}, {0, kCuspWidth / 2}};
  return deck_of(ice, kSea, kHullAngle, outline, std::vector{sides, Beside::kSheet, sides, sides});
}

/// What the hull's force down on the edge does over a whole turn that takes that long, without friction [J].
double work(const Deck& deck, double duration, DeckState* end = nullptr) {
  constexpr int kSteps = 2000;
  const double way = deck.depth / kSteps;
  const double thrust = 1 / std::tan(deck.hull_angle);
  DeckState state;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += thrust * way * turn_deck(deck, kSea, thrust, way, duration / kSteps, state);
  if (end != nullptr) *end = state;
  return sum;
}

TEST(FloodingDeck, HasTheOutlinesStrips) {
  const Deck deck = rectangle(Beside::kOlderCusp);
  double area = 0, sheet = 0, older = 0, water = 0;
  for (const DeckStrip& s : deck.strips) {
    EXPECT_NEAR(s.width, kCuspWidth, 1e-12);
    area += s.width * kCuspDepth / Deck::kStrips;
    sheet += s.sheet;
    older += s.older;
    water += s.water;
  }
  EXPECT_NEAR(area, kCuspWidth * kCuspDepth, 1e-12);
  EXPECT_NEAR(sheet, kCuspWidth, 1e-12);
  EXPECT_NEAR(older, kCuspWidth, 1e-12);  // of the near edge: the sides do not face the hull
  EXPECT_NEAR(deck.strips.back().older, kCuspWidth, 1e-12);
  EXPECT_EQ(water, 0);
  EXPECT_EQ(rectangle(Beside::kWater).strips.front().water, 2 * kCuspDepth / Deck::kStrips);
}

TEST(FloodingDeck, DryTakesTheWorkOfTheWaterThatIsMissing) {
  Deck deck = rectangle(Beside::kSheet);
  for (DeckStrip& s : deck.strips) s.sheet = 0;
  deck.freeboard = 0;
  // ρ_w g J (1 − cos ψ), J = b R³/3, over the turn to π/2 − θ_s.
  const double dry =
      kSea.density * kGravity * kCuspWidth * kCuspDepth * kCuspDepth * kCuspDepth / 3 * (1 - std::sin(kHullAngle));
  EXPECT_NEAR(work(deck, 1) / dry, 1, 0.01);
  EXPECT_NEAR(work(deck, 1000) / dry, 1, 0.01) << "however slow";
}

TEST(FloodingDeck, FloodsThroughWhatOpensTheSoonerTheSlowerTheHull) {
  const Deck deck = rectangle(Beside::kOlderCusp);
  const double dry = work(deck, 1e-3);
  EXPECT_LT(work(deck, 4), 0.9 * dry);
  EXPECT_LT(work(deck, 40), 0.3 * work(deck, 4));
  EXPECT_LT(work(deck, 4000), 0.01 * dry);
  EXPECT_LT(work(rectangle(Beside::kWater), 4), work(deck, 4)) << "over open edges sooner";
}

TEST(FloodingDeck, StaysDryAlongTheSheetUntilItIsBelowIt) {
  const auto pool = [](Beside sides, double way) {
    DeckState state;
    turn_deck(rectangle(sides), kSea, 1, way, 10, state);
    return state.pool;
  };
  EXPECT_EQ(pool(Beside::kSheet, 0.2), 0);
  EXPECT_GT(pool(Beside::kOlderCusp, 0.2), 0);
  EXPECT_GT(pool(Beside::kSheet, 1), 0);
}

TEST(FloodingDeck, HoldsNoMoreThanThereIsRoomBetweenDeckAndHull) {
  DeckState end;
  work(rectangle(Beside::kWater), 40, &end);
  EXPECT_NEAR(end.way, kCuspDepth, 1e-9);
  EXPECT_NEAR(end.pool, 0, 1e-3 * kCuspWidth * kCuspDepth * kCuspDepth) << "the hull has come to the axis";
}

TEST(FloodingDeck, DoesNotDependOnTheStepOfItsHull) {
  const Deck deck = rectangle(Beside::kOlderCusp);
  const double thrust = 1 / std::tan(kHullAngle);
  DeckState state;
  double coarse = 0;
  for (int i = 0; i < 20; ++i)
    coarse += thrust * kCuspDepth / 20 * turn_deck(deck, kSea, thrust, kCuspDepth / 20, 0.2, state);
  EXPECT_NEAR(coarse / work(deck, 4), 1, 0.05);
}

}  // namespace
}  // namespace polynya::fracture
