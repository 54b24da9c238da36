#include "bench/cut_cases.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::bench {
namespace {

using geometry::Point;
using geometry::Ring;

constexpr double kWidth = 110;   // [m]
constexpr double kLength = 200;  // [m]
constexpr int kCusps = 500;

// A point of the plate's outline, by arc length from its lower left corner.
Point on_outline(double s) {
  if (s < kWidth) return {s, 0};
  if (s < kWidth + kLength) return {kWidth, s - kWidth};
  if (s < 2 * kWidth + kLength) return {2 * kWidth + kLength - s, kLength};
  return {0, 2 * (kWidth + kLength) - s};
}

}  // namespace

March march_of_cusps() {
  const geometry::Pose turned{{3.1, -2.7}, geometry::Rotation::by(0.3)};
  const auto place = [&](Point p) { return geometry::transform(turned, p); };
  March march;
  for (const Point p : {Point{0, 0}, Point{kWidth, 0}, Point{kWidth, kLength}, Point{0, kLength}}) {
    march.plate.push_back(place(p));
  }
  const double step = 2 * (kWidth + kLength) / kCusps;
  for (int i = 0; i < kCusps; ++i) {
    const double radius = 0.95 + 0.1 * std::sin(i * 1.7);
    march.cusps.push_back(geometry::disc_polygon(place(on_outline((i + 0.37) * step)), radius, 0.0045));
  }
  return march;
}

Split split_of_floe(int vertices) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> ragged(0.97, 1.03);
  Split split;
  for (int i = 0; i < vertices; ++i) {
    const double angle = 2 * std::numbers::pi * i / vertices;
    const double radius = 60 * (1 + 0.15 * std::sin(3 * angle)) * ragged(random);
    split.floe.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  split.from = {-130, -41.3};
  split.to = {130, 52.9};
  return split;
}

Ring half_plane(const Split& split) {
  const geometry::Vector across = geometry::perpendicular(split.to - split.from);
  return {split.from, split.to, split.to + across, split.from + across};
}

}  // namespace polynya::bench
