// Random fields. Cover, sizes, shapes, clearings and gaps are as requested, floes do not overlap, and the result is the
// same on every machine.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "simulation/field/convex.hpp"
#include "simulation/field/floe_field.hpp"
#include "simulation/field/portable_math.hpp"
#include "simulation/field/tessellation.hpp"
#include "tests/shapes.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

/// A corner is cut off at the same distance on both of its edges, by less than half of the shorter edge. The ring
/// therefore stays convex and keeps its other corners.
TEST(Convex, CornersAreCutOffByAShareOfTheShorterEdge) {
  for (int least = 5; least <= 8; ++least) {
    Ring ring = shapes::rectangle(12, 1).outer;
    add_corners(ring, least);
    ASSERT_EQ(ring.size(), static_cast<std::size_t>(least));
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point p = ring[i], q = ring[(i + 1) % ring.size()], r = ring[(i + 2) % ring.size()];
      EXPECT_GT(cross(q - p, r - q), 0) << least << " corners, at " << i;
    }
    if (least == 5) {
      EXPECT_NEAR(measure_convex(ring).area, 12 - 0.5 * 0.3 * 0.3, 1e-12);
    }
  }
}

FloeField field_in_square(double side, double concentration) {
  FloeField field;
  field.region = shapes::square({-20, 30}, side).outer;
  field.concentration = concentration;
  field.seed = 7;
  return field;
}

FloeField field_of(double side, double concentration, double spread) {
  FloeField field = field_in_square(side, concentration);
  field.size_spread = spread;
  return field;
}

FloeField field_of_law(const SizeLaw& law, double concentration, double floes) {
  FloeField field = field_in_square(std::sqrt(floes * mean_area(law) / concentration), concentration);
  field.law = law;
  field.most_corners = 16;
  return field;
}

/// FNV-1a of all coordinates' bytes, of the outer rings.
std::uint64_t hash_of(const std::vector<Polygon>& floes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const Polygon& floe : floes) {
    for (const Point p : floe.outer) {
      unsigned char bytes[sizeof p];
      std::memcpy(bytes, &p, sizeof p);
      for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211U;
    }
  }
  return hash;
}

double area_of(const std::vector<Polygon>& floes) {
  double area = 0;
  for (const Polygon& floe : floes) area += geometry::measure(floe).area;
  return area;
}

bool share_area(const Polygon& a, const Polygon& b) {
  return overlaps(bounding_box(a.outer), bounding_box(b.outer)) &&
         geometry::overlap({a}, {}, {b}, {})->exact_area != "0";
}

/// Checks exactly that no two floes overlap or are closer to each other than the gap. Returns the number of pairs that
/// are closer than a metre.
int expect_apart(const std::vector<Polygon>& floes, double gap) {
  int near = 0;
  for (std::size_t i = 0; i < floes.size(); ++i) {
    for (std::size_t k = i + 1; k < floes.size(); ++k) {
      const Ring &a = floes[i].outer, &b = floes[k].outer;
      if (!overlaps(grown(bounding_box(a), 1), bounding_box(b))) continue;
      EXPECT_FALSE(share_area(floes[i], floes[k]));
      EXPECT_FALSE(is_near_ring(a, b, gap - 1e-9));
      near += is_near_ring(a, b, 1) ? 1 : 0;
    }
  }
  return near;
}

/// Checks that the field is sound: all floes are valid, in the region and apart. Returns what expect_apart() returns.
int expect_sound(const FloeField& field, const std::vector<Polygon>& floes, std::size_t most_corners) {
  const geometry::Box region = bounding_box(field.region);
  for (const Polygon& floe : floes) {
    EXPECT_FALSE(geometry::find_defect(floe));
    EXPECT_LE(floe.outer.size(), most_corners);
    EXPECT_TRUE(contains(region, bounding_box(floe.outer)));
  }
  return expect_apart(floes, field.gap);
}

/// Checks that floes do not overlap the areas that are kept clear, and that outlines contain all floes.
void expect_kept_clear(const FloeField& field, const FloeFieldOutcome& outcome) {
  double inside = 0;
  for (const Polygon& floe : outcome.floes) {
    for (const Polygon& clear : field.kept_clear) {
      EXPECT_FALSE(share_area(floe, clear));
      EXPECT_FALSE(is_near_ring(floe.outer, clear.outer, field.gap - 2e-9));
    }
    const auto shared = geometry::overlap({floe}, {}, {{field.region, {}}}, {});
    inside += shared->area;
    EXPECT_NEAR(shared->area, geometry::measure(floe).area, 1e-6);
  }
  EXPECT_NEAR(inside, outcome.floe_area, 1e-6);
}

TEST(FloeField, CoversWhatIsAskedForWithoutOverlap) {
  for (const double concentration : {0.1, 0.53, 0.8, 0.95}) {
    FloeField field = field_of(400, concentration, 0.3);
    field.gap = 0.1;
    const FloeFieldOutcome outcome = make_floe_field(field);
    EXPECT_NEAR(area_of(outcome.floes) / (400.0 * 400.0), concentration, 1e-9);
    EXPECT_NEAR(outcome.concentration(), concentration, 1e-9);
    EXPECT_GT(expect_sound(field, outcome.floes, 8), concentration > 0.7 ? 200 : -1);
  }
}

TEST(FloeField, SizesAreLognormalAsAskedFor) {
  for (const double spread : {0.0, 0.15, 0.3, 0.5}) {
    const FloeField field = field_of(2500, 0.6, spread);
    const FloeFieldOutcome outcome = make_floe_field(field);
    EXPECT_GT(outcome.count, (spread > 0.3 ? 0.94 : 0.999) * floe_count(field)) << "outweighed altogether";
    std::vector<double> logs;
    for (const Polygon& floe : outcome.floes) logs.push_back(0.5 * std::log(geometry::measure(floe).area));
    const auto mean_of = [&](auto f) {
      double sum = 0;
      for (const double log : logs) sum += f(log) / static_cast<double>(logs.size());
      return sum;
    };
    const double mean = mean_of([](double log) { return log; });
    const double variance = mean_of([&](double log) { return std::pow(log - mean, 2); });
    const double third = mean_of([&](double log) { return std::pow(log - mean, 3); });
    const double sigma = std::sqrt(std::log1p(spread * spread));
    EXPECT_NEAR(std::sqrt(variance), sigma, (spread > 0.3 ? 0.2 : 0.04) * sigma + 1e-6) << spread;
    EXPECT_NEAR(mean, std::log(15) - 0.5 * sigma * sigma, 0.02) << spread;
    if (spread > 0 && spread < 0.4) {
      EXPECT_LT(std::abs(third) / std::pow(variance, 1.5), 0.4) << "the logarithm is not skewed";
    }
    EXPECT_NEAR(outcome.mean_size, 15, spread > 0.3 ? 0.6 : 0.15);
    EXPECT_NEAR(outcome.size_spread, spread, 0.02);
  }
}

TEST(FloeField, KeepsObstaclesClear) {
  FloeField field = field_of(400, 0.7, 0.25);
  field.gap = 0.5;
  // One area is not convex. The other is small and lies inside the cell of a single floe.
  field.kept_clear = {{{{100, 100}, {200, 100}, {200, 200}, {150, 120}, {100, 200}}, {}},
                      shapes::square({300, 300}, 0.5)};
  const FloeFieldOutcome outcome = make_floe_field(field);
  EXPECT_GT(outcome.left_out, 20);
  EXPECT_EQ(outcome.count + outcome.left_out, make_floe_field(field_of(400, 0.7, 0.25)).count);
  expect_kept_clear(field, outcome);
}

TEST(FloeField, StaysInsideAnOutline) {
  FloeField field = field_of(400, 0.7, 0.25);
  field.is_rectangle = false;
  field.region = {{0, 0}, {400, 0}, {400, 400}, {200, 100}, {0, 400}};
  const FloeFieldOutcome outcome = make_floe_field(field);
  EXPECT_GT(outcome.count, 150);
  EXPECT_GT(outcome.left_out, 100);
  EXPECT_DOUBLE_EQ(outcome.region_area, 400 * 400 - 0.5 * 400 * 300);
  EXPECT_LT(outcome.concentration(), 0.7);
  expect_kept_clear(field, outcome);
}

TEST(SizeLaw, QuantilesAndSharesAgreeAndMeansAreThoseOfTheLaw) {
  // PHYSICS-2 §5: sizes with a = 1.87 from 10 to 100 m have the mean 18.85 m and the mean square 508.8 m².
  const PowerLawSizes power{1.87, 10, 100};
  EXPECT_NEAR(mean_area(power), 508.8, 0.05);
  for (const SizeLaw& law : {SizeLaw(power), SizeLaw(PowerLawSizes{0, 0.5, 2}), SizeLaw(PowerLawSizes{-1, 1, 3}),
                             SizeLaw(LognormalSizes{15, 0.4})}) {
    double mean = 0;
    double square = 0;
    constexpr int kParts = 20000;
    for (int i = 0; i < kParts; ++i) {
      const double u = (i + 0.5) / kParts;
      const double size = size_at(law, u);
      ASSERT_NEAR(share_below(law, size), u, 1e-7);
      mean += size / kParts;
      square += size * size / kParts;
    }
    EXPECT_NEAR(mean_area(law), square, 2e-3 * square);
    if (std::holds_alternative<LognormalSizes>(law)) {
      EXPECT_NEAR(mean, 15, 0.05);
      EXPECT_NEAR(std::sqrt(square - mean * mean) / mean, 0.4, 0.01);
    }
  }
  EXPECT_NEAR(size_at(PowerLawSizes{-1, 1, 3}, 0.25), 1.5, 1e-12) << "even in d";
}

TEST(PortableMath, AgreesWithTheLibrary) {
  for (int i = 1; i < 4000; ++i) {
    const double x = -40 + 0.02003 * i;
    EXPECT_NEAR(portable_exponential(x) / std::exp(x), 1, 1e-14);
    EXPECT_NEAR(portable_logarithm(std::exp(x)), x, 1e-14 * std::max(1.0, std::abs(x)));
    const double u = i / 4000.0;
    EXPECT_NEAR(portable_direction(u).x, std::cos(2 * std::numbers::pi * u), 1e-14);
    EXPECT_NEAR(portable_direction(u).y, std::sin(2 * std::numbers::pi * u), 1e-14);
    const double z = portable_normal_quantile(u);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::numbers::sqrt2), u, 1e-8);
  }
}

TEST(SizeLaw, TheLikeliestExponentIsThatOfTheLaw) {
  for (const double exponent : {-1.0, 0.0, 1.15, 1.87, 4.0}) {
    const PowerLawSizes law{exponent, 5, 80};
    std::vector<double> sizes;
    for (int i = 0; i < 4000; ++i) sizes.push_back(size_at(law, (i + 0.5) / 4000));
    EXPECT_NEAR(likeliest_exponent({1, 5, 80}, sizes), exponent, 2e-3);
    EXPECT_LT(kolmogorov_smirnov(law, sizes), 2e-4);
    EXPECT_GT(kolmogorov_smirnov(PowerLawSizes{exponent + 0.3, 5, 80}, sizes), 0.02);
  }
}

TEST(PackedField, CoverAndLawsAreAsAskedFor) {
  const PowerLawSizes power{1.87, 10, 100};
  for (const auto& [law, concentration] : {std::pair<SizeLaw, double>{power, 0.98},
                                           {power, 0.35},
                                           {LognormalSizes{15, 0.5}, 0.98},
                                           {LognormalSizes{8, 0.2}, 0.9},
                                           {EqualSizes{12}, 0.98},
                                           {PowerLawSizes{0, 0.5, 2}, 0.8}}) {
    FloeField field = field_of_law(law, concentration, 5000);
    field.gap = std::holds_alternative<PowerLawSizes>(law) && mean_area(law) < 4 ? 0.01 : 0.05;
    field.packing = 0.75;
    const FloeFieldOutcome outcome = make_floe_field(field);
    const double region = geometry::signed_area(field.region);
    EXPECT_NEAR(area_of(outcome.floes) / region, concentration, 1e-6);
    EXPECT_NEAR(outcome.concentration(), concentration, 1e-6);
    EXPECT_NEAR(outcome.count, 5000, 5);
    const FieldStatistics& statistics = *outcome.statistics;
    EXPECT_LT(statistics.distance_to_law, std::holds_alternative<EqualSizes>(law) ? 0.02 : 0.005);
    if (law.index() == SizeLaw(power).index() && mean_area(law) > 4) {
      EXPECT_NEAR(std::get<PowerLawSizes>(*statistics.fitted).exponent, 1.87, 0.01);
      EXPECT_GT(statistics.largest_size, 95) << "the large ones come out";
      EXPECT_NEAR(outcome.mean_size, 18.85, 0.05);
    }
  }
}

TEST(PackedField, NoFloesShareAreaAndAllAreValid) {
  for (const double aspect : {1.0, 2.3}) {
    FloeField field = field_of_law(PowerLawSizes{1.87, 10, 100}, 0.97, 700);
    field.gap = 0.02;
    field.aspect = aspect;
    EXPECT_GT(expect_sound(field, make_floe_field(field).floes, 16), 1500);
  }
}

TEST(PackedField, ClearingsAndOutlinesAreKeptAndTheRestIsCovered) {
  FloeField field = field_of_law(PowerLawSizes{1.87, 8, 60}, 0.9, 900);
  const geometry::Point low = field.region[0];
  const double side = field.region[1].x - low.x;
  field.is_rectangle = false;
  const auto at = [&](double x, double y) { return low + Vector{x * side, y * side}; };
  field.region = {at(0, 0), at(1, 0), at(1, 1), at(0.6, 0.7), at(0, 1)};
  field.kept_clear = {{{at(0.1, 0.3), at(0.5, 0.3), at(0.55, 0.35), at(0.5, 0.4), at(0.1, 0.4)}, {}},
                      {{at(0.7, 0.1), at(0.9, 0.2), at(0.72, 0.13), at(0.68, 0.5)}, {}}};
  field.gap = 0.2;
  const FloeFieldOutcome outcome = make_floe_field(field);
  double free = geometry::signed_area(field.region);
  for (const Polygon& clear : field.kept_clear) free -= geometry::measure(clear).area;
  EXPECT_NEAR(free_area(field.region, field.kept_clear), free, 1e-6);
  EXPECT_NEAR(area_of(outcome.floes) / free, 0.9, 0.005);
  EXPECT_LT(outcome.statistics->distance_to_law, 0.02);
  expect_kept_clear(field, outcome);
}

/// Returns the mean of cos and sin of twice the angle of the floes' longer axes, with equal weights.
Vector mean_doubled_direction(const std::vector<Polygon>& floes) {
  Vector sum;
  for (const Polygon& floe : floes) {
    const auto centre = geometry::measure(floe).centroid;
    Vector moment;  // of the corners: good enough for the direction
    for (const auto p : floe.outer) {
      const Vector r = p - centre;
      moment += Vector{r.x * r.x - r.y * r.y, 2 * r.x * r.y};
    }
    sum += moment / length(moment);
  }
  return sum / static_cast<double>(floes.size());
}

TEST(PackedField, AspectAndOrientationAreAsAskedFor) {
  for (const double aspect : {1.6, 2.2, 3.4}) {
    FloeField field = field_of_law(LognormalSizes{15, 0.3}, 0.9, 1500);
    field.aspect = aspect;
    const FloeFieldOutcome any = make_floe_field(field);
    EXPECT_NEAR(any.statistics->mean_aspect, aspect, 0.07 * aspect);
    EXPECT_LT(length(mean_doubled_direction(any.floes)), 0.1) << "no direction is favoured";
    EXPECT_LT(any.statistics->distance_to_law, 0.01);
    field.orientation = 0.6;
    const FloeFieldOutcome along = make_floe_field(field);
    EXPECT_NEAR(along.statistics->mean_aspect, aspect, 0.07 * aspect);
    const Vector mean = mean_doubled_direction(along.floes);
    EXPECT_GT(length(mean), 0.7);
    EXPECT_NEAR(0.5 * std::atan2(mean.y, mean.x), 0.6, 0.05);
    EXPECT_NEAR(along.concentration(), 0.9, 1e-6);
  }
}

TEST(PackedField, CornersAreWithinTheirBounds) {
  FloeField field = field_of_law(LognormalSizes{15, 0.3}, 0.7, 300);
  field.least_corners = field.most_corners = 9;
  for (const Polygon& floe : make_floe_field(field).floes) ASSERT_EQ(floe.outer.size(), 9u);
  field.least_corners = 3;
  field.most_corners = 4;
  for (const Polygon& floe : make_floe_field(field).floes) ASSERT_LE(floe.outer.size(), 4u);
}

TEST(PackedField, HolesFavourNoSize) {
  FloeField field = field_of_law(PowerLawSizes{1.87, 10, 100}, 0.3, 3000);
  const FloeFieldOutcome even = make_floe_field(field);
  field.packing = 0.8;
  const FloeFieldOutcome holed = make_floe_field(field);
  EXPECT_EQ(even.count, holed.count);
  EXPECT_LT(holed.statistics->distance_to_law, 0.005);
  EXPECT_NEAR(holed.concentration(), 0.3, 1e-6);
  EXPECT_NEAR(holed.reachable_concentration, 0.3 / 0.8, 0.01) << "the rest is holes";
}

TEST(PackedField, ReportsWhatTheGapAndTheCornersAllow) {
  FloeField field = field_of_law(EqualSizes{10}, 0.95, 500);
  field.gap = 1;
  const FloeFieldOutcome outcome = make_floe_field(field);
  EXPECT_LT(outcome.reachable_concentration, 0.85);
  EXPECT_GT(outcome.reachable_without_gap, 0.99);
  EXPECT_NEAR(outcome.concentration(), outcome.reachable_concentration, 1e-9);
}

/// These hashes are fixed, because only + − × ÷ √ made the bytes.
TEST(FloeField, IsTheSameOnEveryMachineAndAnotherForAnotherSeed) {
  FloeField packed = field_of_law(PowerLawSizes{1.87, 10, 100}, 0.7, 400);
  packed.packing = 0.8;
  packed.aspect = 1.5;
  for (auto& [field, pinned] :
       {std::pair(field_of(600, 0.6, 0.3), 18442949971931436931U), std::pair(packed, 12706008380266857876U)}) {
    EXPECT_EQ(hash_of(make_floe_field(field).floes), pinned);
    FloeField other = field;
    other.seed = 8;
    EXPECT_NE(hash_of(make_floe_field(other).floes), pinned);
  }
}

}  // namespace
}  // namespace polynya::simulation
