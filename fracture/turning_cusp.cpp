#include "fracture/turning_cusp.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary/elementary.hpp"

namespace polynya::fracture {

double edge_mass(const Ice& ice, const Water& water, const TurningCusp& cusp) {
  if (cusp.area <= 0 || cusp.depth <= 0) return 0;
  const double length_over_width = cusp.depth * cusp.depth / cusp.area;
  const double finite = 1 / std::sqrt(1 + length_over_width * length_over_width);
  constexpr double kPlate = 9 * std::numbers::pi / 256;
  return ice.density * ice.thickness * cusp.second_moment / (cusp.depth * cusp.depth) +
         kPlate * water.density * cusp.area * cusp.depth * finite;
}

namespace {

/// C_d of openings with sharp edges [-] (recall). A larger value fills the deck faster, so that the hull carries less.
constexpr double kDischarge = 0.6;
constexpr int kHalvings = 14;      ///< bisections to find the pool's surface, within 1e-4 of its depth
constexpr int kStepsOfATurn = 40;  ///< steps in which the hull moves by the depth of the cusp; also most in a call
/// Smallest lever over the depth of the cusp, where it jams between sheet and hull [-]. A smaller value lets a jammed
/// cusp press on the hull with more force.
constexpr double kLeastLever = 0.1;

/// The part of an edge within a strip of the deck, as an interval of fractions of the edge.
struct Within {
  double from = 0, to = 0;
};

/// Returns the part of an edge from the distance r0 to r1 that lies between the distances `low` and `high` [m].
Within within(double r0, double r1, double low, double high) {
  if (r0 == r1) return r0 >= low && r0 < high ? Within{0, 1} : Within{};
  const double a = std::clamp((low - r0) / (r1 - r0), 0.0, 1.0);
  const double b = std::clamp((high - r0) / (r1 - r0), 0.0, 1.0);
  return {std::min(a, b), std::max(a, b)};
}

/// Adds an edge to the strips that it crosses. `farthest` is the x of the axis; distances r are measured from it
/// towards the hull. The widths are the areas under the edges of the closed outline, over the depth of a strip.
void add_edge(Deck& deck, double farthest, geometry::Point from, geometry::Point to, const DeckEdge& edge) {
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
    const double length = (b - a) * distance(from, to);
    s.width += middle * (b - a) * (r1 - r0) / strip;
    if (edge.beside == Beside::kWater) s.water += length;
    if (edge.beside == Beside::kSheet) {
      s.sheet += length;
      s.sheet_across += (b - a) * std::abs(to.y - from.y);
    }
    if (edge.beside != Beside::kOlderCusp || length <= 0) continue;
    DeckSide& side = s.sides[to.x < from.x ? 0 : 1];
    const double share = length / (side.length + length);
    side.facing += (b - a) * (from.y - to.y);
    side.length += length;
    side.axis += share * (farthest - edge.older_far - side.axis);
    side.depth += share * (edge.older_depth - side.depth);
  }
}

/// A plate of ice that a plane hull has pressed down about the lower corner of its far edge, in the plane of the hull's
/// normal. x runs from that edge towards the hull, z down from the upper side of the sheet.
class Plate {
 public:
  /// The waterline of the hull is at x = `waterline`.
  Plate(double depth, double thickness, double hull_angle, double waterline) : thickness_(thickness) {
    const double beta = elementary::atan2(thickness, depth);
    const double sine = elementary::sin(hull_angle);
    const double cosine = elementary::cos(hull_angle);
    const double along = thickness * (1 - sine) / cosine;  // waterline at which the plate lies along the hull
    const double at = std::clamp(waterline, along, std::max(along, depth));  // a short plate snaps over
    const double turned =
        elementary::acos(std::clamp((at * cosine + thickness * sine) / elementary::hypot(depth, thickness), -1.0, 1.0));
    tilt_ = std::clamp(turned + beta - hull_angle, 0.0, 0.5 * std::numbers::pi - hull_angle);
    if (waterline >= depth) tilt_ = 0;
    cosine_ = elementary::cos(tilt_);
    sine_ = elementary::sin(tilt_);
    sunk_ = std::max(0.0, along - waterline) * cosine / sine;
  }

  double cosine() const { return cosine_; }
  double sine() const { return sine_; }
  /// Returns the coordinates of the point of the plate's upper side at the distance r from its far edge.
  double x(double r) const { return r * cosine_ + thickness_ * sine_; }
  double z(double r) const { return r * sine_ + thickness_ * (1 - cosine_) + sunk_; }

 private:
  double thickness_ = 0, tilt_ = 0, cosine_ = 1, sine_ = 0;
  double sunk_ = 0;  ///< distance that it has slid down along the hull [m]
};

/// Returns the open area between a side of a turning plate at r and the plate of an older cusp [m²].
double open_area(const DeckSide& side, double r, const Plate& plate, const Plate& older, double thickness) {
  // Distances from the upper corner of the side to both corners of the older cusp's face, along and across the deck.
  const double x = side.axis + older.x(r - side.axis) - plate.x(r);
  const double z = older.z(r - side.axis) - plate.z(r);
  const auto along =
      std::minmax({x * plate.cosine() + z * plate.sine(),
                   (x - thickness * older.sine()) * plate.cosine() + (z + thickness * older.cosine()) * plate.sine()});
  const auto across =
      std::minmax({z * plate.cosine() - x * plate.sine(),
                   (z + thickness * older.cosine()) * plate.cosine() - (x - thickness * older.sine()) * plate.sine()});
  const double apart = side.facing > 0 ? along.first : -along.second;
  const double below = std::max(across.first - thickness, -across.second);
  return std::max({0.0, apart * std::abs(side.facing), below * side.length});
}

/// A deck at one instant of its rotation.
class Turn {
 public:
  Turn(const Deck& deck, double displacement)
      : deck_(deck),
        waterline_(deck.depth - displacement),
        plate_(deck.depth, deck.thickness, deck.hull_angle, waterline_) {
    for (int k = 0; k < Deck::kStrips; ++k) {
      const double r = at(k);
      depth_[k] = std::max(0.0, plate_.z(r) - deck.freeboard);
      hull_[k] = std::max(0.0, (plate_.x(r) - waterline_) / elementary::tan(deck.hull_angle) - deck.freeboard);
    }
  }

  double deepest() const { return depth_[Deck::kStrips - 1]; }

  /// Returns the volume of a pool whose surface is at this depth below the water level [m³].
  double pool_below(double surface) const {
    double volume = 0;
    for (int k = 0; k < Deck::kStrips; ++k) volume += width(k) * std::max(0.0, depth_[k] - std::max(surface, hull_[k]));
    return plate_.cosine() * strip() * volume;
  }

  /// Returns the depth of a pool's surface below the water level [m].
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

  /// Returns the inflow into a pool with this surface [m³/s].
  double inflow(double surface) const {
    double flow = 0;
    if (surface <= 0) return flow;
    for (int k = 0; k < Deck::kStrips; ++k) {
      const double z = depth_[k];
      if (z <= 0) continue;
      flow += kDischarge * open_at(k) * std::sqrt(2 * kGravity * std::min(surface, z));
      flow += deck_.strips[k].water * over_crest(z, std::max(0.0, z - surface));
    }
    return flow;
  }

  /// Returns the moment M of the missing pressure on the deck [N m].
  double moment(double surface, double density) const {
    double sum = 0;
    for (int k = 0; k < Deck::kStrips; ++k) sum += std::min(depth_[k], surface) * at(k) * width(k);
    return density * kGravity * strip() * sum;
  }

  /// Returns the force of the missing pressure on the hull's face, along its normal [N].
  double ahead(double surface, double density) const {
    double sum = 0;
    for (int k = 0; k < Deck::kStrips; ++k) sum += std::min(hull_[k], surface) * width(k);
    return density * kGravity * strip() * plate_.cosine() / elementary::tan(deck_.hull_angle) * sum;
  }

  /// Returns the lever, about the axis, of a force down on the near edge with this thrust per force [m].
  double lever(double thrust) const {
    const double h = deck_.thickness;
    const double up = deck_.depth * plate_.sine() - h * plate_.cosine();
    return std::max(plate_.x(deck_.depth) + thrust * up, kLeastLever * deck_.depth);
  }

 private:
  /// Returns the open area next to ice [m²].
  double open_at(int k) const {
    double open = beside_sheet(k);
    for (const DeckSide& side : deck_.strips[k].sides) {
      if (side.length <= 0) continue;
      const Plate older(side.depth, deck_.thickness, deck_.hull_angle, waterline_ - side.axis);
      open += open_area(side, at(k), plate_, older, deck_.thickness);
    }
    return open;
  }
  /// Returns the open area between the strip's edge and the sheet [m²]: the gap between both faces while the edge has
  /// sunk by less than the thickness, later that between the edge's upper corner and the sheet's lower corner.
  double beside_sheet(int k) const {
    const double r = at(k);
    const double h = deck_.thickness;
    const DeckStrip& s = deck_.strips[k];
    if (r * plate_.sine() < h) return r * (1 - plate_.cosine()) * s.sheet_across;
    return elementary::hypot((plate_.x(r) - r) * s.sheet_across, (plate_.z(r) - h) * s.sheet);
  }
  /// Returns the flow per metre of a broad crest at this head, with water of the depth `behind` behind it (Villemonte;
  /// recall) [m²/s].
  static double over_crest(double head, double behind) {
    const double critical = elementary::pow(2. / 3, 1.5) * std::sqrt(kGravity) * elementary::pow(head, 1.5);
    return critical * elementary::pow(std::max(0.0, 1 - elementary::pow(behind / head, 1.5)), 0.385);
  }
  double strip() const { return deck_.depth / Deck::kStrips; }
  double at(int k) const { return (k + 0.5) * strip(); }
  double width(int k) const { return deck_.strips[k].width; }

  const Deck& deck_;
  double waterline_ = 0;  ///< x_w of the hull at the upper side of the sheet [m]
  Plate plate_;
  std::array<double, Deck::kStrips> depth_{};  ///< depth of the deck below the water level [m]
  std::array<double, Deck::kStrips> hull_{};   ///< depth, below the water level, of the hull above the deck [m]
};

}  // namespace

double distance_to_lie_along(const Deck& deck) {
  return deck.depth - deck.thickness * (1 - elementary::sin(deck.hull_angle)) / elementary::cos(deck.hull_angle);
}

Deck deck_of(const Ice& ice, const Water& water, double hull_angle, std::span<const geometry::Point> outline,
             std::span<const DeckEdge> edges) {
  Deck deck;
  const auto [near, far] = std::ranges::minmax(outline, {}, &geometry::Point::x);
  deck.depth = far.x - near.x;
  deck.thickness = ice.thickness;
  deck.freeboard = std::max(0.0, 1 - ice.density / water.density) * ice.thickness;
  deck.hull_angle = hull_angle;
  if (!(deck.depth > 0)) return deck;
  for (std::size_t i = 0; i < outline.size(); ++i)
    add_edge(deck, far.x, outline[i], outline[i + 1 < outline.size() ? i + 1 : 0], edges[i]);
  for (DeckStrip& s : deck.strips) s.width = std::max(0.0, s.width);
  return deck;
}

DeckForces turn_deck(const Deck& deck, const Water& water, const HullAdvance& advance, DeckState& state) {
  const auto [thrust, distance, dt] = advance;
  const double end = distance_to_lie_along(deck);
  const int steps = std::clamp(static_cast<int>(std::ceil(kStepsOfATurn * distance / deck.depth)), 1, kStepsOfATurn);
  DeckForces sum;
  for (int i = 0; i < steps; ++i) {
    state.displacement = std::min(end, state.displacement + distance / steps);
    const Turn turn(deck, state.displacement);
    const double surface = turn.surface_of(state.pool);
    sum.down += turn.moment(surface, water.density) / turn.lever(thrust) / steps;
    sum.ahead += turn.ahead(surface, water.density) / steps;
    // Water that no longer has room flows off.
    state.pool = std::min(turn.pool_below(0), state.pool + turn.inflow(surface) * dt / steps);
  }
  return sum;
}

}  // namespace polynya::fracture
