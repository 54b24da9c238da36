// Many successive cuts on one plate's descendants, their poses changing in between. POLYNYA_ENDURANCE_CUTS
// sets how many; the ctest label `endurance` runs 100 000.
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/pose.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

using trials::exact_area;
using trials::is_sound;

constexpr double kBrash = 1e-7;  // pieces below this area leave the trial [m²]

struct Floe {
  Shape shape;
  Pose world_from_body;
};

class Trial {
 public:
  explicit Trial(unsigned seed) : random_(seed) {
    floes_.push_back({Shape{{{{0, 0}, {110, 0}, {110, 200}, {0, 200}}, {}}}, {}});
    initial_ = exact_area(floes_.front().shape);
  }

  // One cut of one floe in a new pose, with all that must hold of it.
  void step() {
    const std::size_t i = pick();
    Floe floe = floes_[i];
    floe.world_from_body = {{1000 * unit(), 1000 * unit()}, Rotation::by(2 * std::numbers::pi * unit())};
    const CutOutcome outcome = cut(floe);
    ASSERT_TRUE(is_sound(floe.shape, outcome)) << trials::to_code(floe.shape.polygon);
    if (!outcome) return;
    ++cuts_;
    itemised_ += exact::Rational(outcome->ledger.rounding_defect);
    slivers_ += outcome->ledger.area_slivers;
    floes_[i] = std::move(floes_.back());
    floes_.pop_back();
    for (const Piece& piece : outcome->pieces) {
      if (measure(piece.shape.polygon).area < kBrash)
        brash_ += exact_area(piece.shape);
      else
        floes_.push_back({piece.shape, floe.world_from_body});
    }
  }

  void finish() const {
    EXPECT_GT(cuts_, 1000);
    exact::Rational sum = brash_ - initial_ - itemised_;
    for (const Floe& floe : floes_) sum += exact_area(floe.shape);
    // Each cut's defect is known to the nearest double of some 1e-15 m².
    EXPECT_LT(std::abs(sum.get_d() + slivers_), 1e-28 * cuts_ + 1e-14 * slivers_);
  }

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  // The largest of a few: floes stay worth cutting, and one keeps its edges of many generations.
  std::size_t pick() {
    std::size_t best = random_() % floes_.size();
    for (int k = 0; k < 3; ++k) {
      const std::size_t other = random_() % floes_.size();
      if (floes_[other].shape.polygon.outer.size() > floes_[best].shape.polygon.outer.size()) best = other;
    }
    return best;
  }

  Point to_body(const Floe& floe, Point in_world) {
    return inverse_transform(floe.world_from_body, in_world);
  }

  CutOutcome cut(const Floe& floe) {
    const Ring& ring = floe.shape.polygon.outer;
    const Point vertex = ring[random_() % ring.size()];
    const double size = std::sqrt(std::abs(signed_area(ring)));
    const auto kind = random_() % 10;
    if (kind == 0)
      return cut_along(floe.shape, {vertex, ring[random_() % ring.size()]});  // in the body: vertex to vertex
    if (kind == 1) return cut_by_polygon(floe.shape, {disc_polygon(vertex, 0.2 * size, 0.01 * size), {}});
    const Point in_world = transform(floe.world_from_body, vertex);
    const double angle = 2 * std::numbers::pi * unit();
    const Vector direction{std::cos(angle), std::sin(angle)};
    if (kind < 5) {
      const double reach = 4 * size + 50 * unit();
      const Point aim = in_world + 0.3 * size * direction;
      return cut_along(floe.shape,
                       {to_body(floe, aim - reach * direction), to_body(floe, aim + reach * direction)});
    }
    const Point centre = in_world + (0.1 * size * unit()) * direction;
    Ring cusp = disc_polygon(centre, size * (0.02 + 0.25 * unit()), 0.004 * size);
    for (Point& p : cusp) p = to_body(floe, p);
    return cut_by_polygon(floe.shape, {cusp, {}});
  }

  std::mt19937 random_;
  std::vector<Floe> floes_;
  exact::Rational initial_ = 0;
  exact::Rational brash_ = 0;
  exact::Rational itemised_ = 0;
  double slivers_ = 0;
  int cuts_ = 0;
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
