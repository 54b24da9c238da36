#include "fracture/flooding_deck.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::fracture {
namespace {

constexpr double kDischarge = 0.6;  ///< C_d of sharp-edged openings (recall)
constexpr int kHalvings = 14;       ///< to find the pool's surface: within 1e-4 of its depth
constexpr int kStepsOfATurn = 40;

/// The part of an edge within a strip of the deck, a share of the edge.
struct Within {
  double from = 0, to = 0;
};

Within within(double r0, double r1, double low, double high) {
  if (r0 == r1) return r0 >= low && r0 < high ? Within{0, 1} : Within{};
  const double a = std::clamp((low - r0) / (r1 - r0), 0.0, 1.0);
  const double b = std::clamp((high - r0) / (r1 - r0), 0.0, 1.0);
  return {std::min(a, b), std::max(a, b)};
}

void add_edge(Deck& deck, double farthest, geometry::Point from, geometry::Point to, Beside beside) {
  const double strip = deck.depth / Deck::kStrips;
  const double r0 = farthest - from.x;
  const double r1 = farthest - to.x;
  const int first = std::clamp(static_cast<int>(std::min(r0, r1) / strip), 0, Deck::kStrips - 1);
  const int last = std::clamp(static_cast<int>(std::max(r0, r1) / strip), 0, Deck::kStrips - 1);
  for (int k = first; k <= last; ++k) {
    const double high = k + 1 == Deck::kStrips ? 2 * deck.depth : (k + 1) * strip;
    const auto [a, b] = within(r0, r1, k * strip, high);
    DeckStrip& s = deck.strips[static_cast<std::size_t>(k)];
    const double middle = from.y + 0.5 * (a + b) * (to.y - from.y);
    s.width += middle * (b - a) * (r1 - r0) / strip;
    if (beside == Beside::kSheet) s.sheet += (b - a) * distance(from, to);
    if (beside == Beside::kOlderCusp) s.older += (b - a) * std::max(0.0, from.y - to.y);
    if (beside == Beside::kWater) s.water += (b - a) * distance(from, to);
  }
}

/// A deck at an instant of its turn.
class Turn {
 public:
  Turn(const Deck& deck, double way) : deck_(deck) {
    const double tilt =
        std::acos(std::clamp(std::cos(deck.hull_angle) * (1 - way / deck.depth), -1.0, 1.0)) - deck.hull_angle;
    cosine_ = std::cos(tilt);
    sine_ = std::sin(tilt);
    const double waterline = deck.depth * std::max(0.0, 1 - way / deck.depth);  // of the hull, from the axis
    for (int k = 0; k < Deck::kStrips; ++k) {
      const double r = at(k);
      depth_[k] = std::max(0.0, r * sine_ - deck.freeboard);
      hull_[k] = std::max(0.0, (r * cosine_ - waterline) / std::tan(deck.hull_angle));
    }
  }

  double deepest() const { return depth_[Deck::kStrips - 1]; }

  /// Of a pool whose surface is that far below the water level [m³].
  double pool_below(double surface) const {
    double volume = 0;
    for (int k = 0; k < Deck::kStrips; ++k) volume += width(k) * std::max(0.0, depth_[k] - std::max(surface, hull_[k]));
    return cosine_ * strip() * volume;
  }

  /// How far below the water level a pool's surface is [m].
  double surface_of(double pool) const {
    if (pool >= pool_below(0)) return 0;
    double low = 0;
    double high = deepest();
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (pool_below(middle) > pool ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// Into a pool with that surface [m³/s].
  double inflow(double surface) const {
    double flow = 0;
    for (int k = 0; k < Deck::kStrips; ++k) {
      const DeckStrip& s = deck_.strips[k];
      const double z = depth_[k];
      const double opened = at(k) * (1 - cosine_);  // of an edge that moves ahead
      flow += kDischarge * opened * s.older * fall(std::min(surface, z));
      const double below_sheet = at(k) * sine_ - deck_.thickness;
      if (below_sheet > 0) {
        const double middle = deck_.thickness - deck_.freeboard + 0.5 * below_sheet;
        flow += kDischarge * below_sheet * s.sheet * fall(std::min(surface, middle));
      }
      if (z > 0) flow += s.water * over_crest(z, std::max(0.0, z - surface));
    }
    return flow;
  }

  /// Of the pressure that is missing on the deck, M [N m].
  double moment(double surface, double density) const {
    double sum = 0;
    for (int k = 0; k < Deck::kStrips; ++k) sum += std::min(depth_[k], surface) * at(k) * width(k);
    return density * kGravity * strip() * sum;
  }

  double lever(double thrust) const { return deck_.depth * (cosine_ + thrust * sine_); }

 private:
  static double fall(double head) { return std::sqrt(2 * kGravity * head); }
  /// Over a metre of a broad crest under that head, with water that high behind it (Villemonte; recall) [m²/s].
  static double over_crest(double head, double behind) {
    const double critical = std::pow(2. / 3, 1.5) * std::sqrt(kGravity) * std::pow(head, 1.5);
    return critical * std::pow(std::max(0.0, 1 - std::pow(behind / head, 1.5)), 0.385);
  }
  double strip() const { return deck_.depth / Deck::kStrips; }
  double at(int k) const { return (k + 0.5) * strip(); }
  double width(int k) const { return deck_.strips[k].width; }

  const Deck& deck_;
  double cosine_ = 1, sine_ = 0;
  std::array<double, Deck::kStrips> depth_{};  ///< of the deck below the water level [m]
  std::array<double, Deck::kStrips> hull_{};   ///< of the hull above it [m]
};

}  // namespace

Deck deck_of(const Ice& ice, const Water& water, double hull_angle, std::span<const geometry::Point> outline,
             std::span<const Beside> beside) {
  Deck deck;
  const auto [near, far] = std::ranges::minmax(outline, {}, &geometry::Point::x);
  deck.depth = far.x - near.x;
  deck.thickness = ice.thickness;
  deck.freeboard = std::max(0.0, 1 - ice.density / water.density) * ice.thickness;
  deck.hull_angle = hull_angle;
  if (!(deck.depth > 0)) return deck;
  for (std::size_t i = 0; i < outline.size(); ++i)
    add_edge(deck, far.x, outline[i], outline[i + 1 < outline.size() ? i + 1 : 0], beside[i]);
  for (DeckStrip& s : deck.strips) s.width = std::max(0.0, s.width);
  return deck;
}

double turn_deck(const Deck& deck, const Water& water, double thrust, double way, double dt, DeckState& state) {
  const int steps = std::clamp(static_cast<int>(std::ceil(kStepsOfATurn * way / deck.depth)), 1, kStepsOfATurn);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    state.way = std::min(deck.depth, state.way + way / steps);
    const Turn turn(deck, state.way);
    const double surface = turn.surface_of(state.pool);
    sum += turn.moment(surface, water.density) / turn.lever(thrust);
    // What no longer has room leaves.
    state.pool = std::min(turn.pool_below(0), state.pool + turn.inflow(surface) * dt / steps);
  }
  return sum / steps;
}

}  // namespace polynya::fracture
