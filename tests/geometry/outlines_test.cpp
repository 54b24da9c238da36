// Floes as images of ice show them: contours of noise with bays, necks and ponds, thousands of vertices long.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/internal/predicates.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

using trials::are_equal;
using trials::is_sound;

// Noise of several octaves over a disc: positive is ice. Drawn on a grid and contoured by marching squares.
class NoisyField {
 public:
  NoisyField(int cells, unsigned seed) : n_(cells + 1), values_(static_cast<std::size_t>(n_ * n_)) {
    std::mt19937 random(seed);
    for (int step = cells / 3; step >= 1; step /= 2) add_octave(step, random);
    for (int y = 0; y < n_; ++y) {
      for (int x = 0; x < n_; ++x) {
        const double r = 2 * std::hypot(x - cells / 2.0, y - cells / 2.0) / cells;
        double& v = values_[at(x, y)];
        v = r > 0.97 ? -1 : 0.9 - r * r + 0.7 * v;
        if (x == 0 || y == 0 || x == cells || y == cells) v = -1;
      }
    }
  }

  // All contours, ice on their left: outer ones counter-clockwise, ponds clockwise.
  std::vector<Ring> contours() const {
    std::map<Key, std::pair<Key, Point>> next;
    for (int y = 0; y + 1 < n_; ++y) {
      for (int x = 0; x + 1 < n_; ++x) add_cell(x, y, next);
    }
    std::vector<Ring> rings;
    while (!next.empty()) {
      Ring& ring = rings.emplace_back();
      for (auto here = next.begin(); here != next.end();) {
        const Key follows = here->second.first;
        ring.push_back(here->second.second);
        next.erase(here);
        here = next.find(follows);
      }
    }
    return rings;
  }

 private:
  using Key = std::pair<int, int>;  // a grid edge: its lower left end, and 0 along x or 1 along y

  static std::size_t in_row_major(int row, int column, int columns) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  std::size_t at(int x, int y) const { return in_row_major(y, x, n_); }

  void add_octave(int step, std::mt19937& random) {
    const int m = n_ / step + 2;
    std::vector<double> knots(in_row_major(m, 0, m));
    std::uniform_real_distribution<double> height(-1, 1);
    for (double& knot : knots) knot = height(random);
    const auto knot = [&](int i, int j) { return knots[in_row_major(j, i, m)]; };
    const double weight = std::pow(static_cast<double>(step) / n_, 0.3);
    for (int y = 0; y < n_; ++y) {
      for (int x = 0; x < n_; ++x) {
        const double u = static_cast<double>(x % step) / step;
        const double v = static_cast<double>(y % step) / step;
        const int i = x / step;
        const int j = y / step;
        values_[at(x, y)] += weight * ((1 - v) * ((1 - u) * knot(i, j) + u * knot(i + 1, j)) +
                                       v * ((1 - u) * knot(i, j + 1) + u * knot(i + 1, j + 1)));
      }
    }
  }

  Point crossing(int x0, int y0, int x1, int y1) const {
    const double a = values_[at(x0, y0)];
    const double b = values_[at(x1, y1)];
    const double t = std::clamp(a / (a - b), 0.01, 0.99);
    return {x0 + t * (x1 - x0), y0 + t * (y1 - y0)};
  }

  // Walking around the cell counter-clockwise, contours leave where water turns to ice, and enter where ice
  // turns to water; in a saddle each joins the next.
  void add_cell(int x, int y, std::map<Key, std::pair<Key, Point>>& next) const {
    const int corner_x[]{x, x + 1, x + 1, x, x};
    const int corner_y[]{y, y, y + 1, y + 1, y};
    const auto key = [&](int side) {
      const Key keys[]{{2 * static_cast<int>(at(x, y)), 0},
                       {2 * static_cast<int>(at(x + 1, y)) + 1, 0},
                       {2 * static_cast<int>(at(x, y + 1)), 0},
                       {2 * static_cast<int>(at(x, y)) + 1, 0}};
      return keys[side];
    };
    const auto is_ice = [&](int k) { return values_[at(corner_x[k], corner_y[k])] > 0; };
    for (int side = 0; side < 4; ++side) {
      if (!is_ice(side) || is_ice(side + 1)) continue;  // ice to water: a contour enters here
      for (int turn = 1; turn < 4; ++turn) {
        const int other = (side + turn) % 4;
        if (is_ice(other) || !is_ice(other + 1)) continue;
        next[key(side)] = {key(other),
                           crossing(corner_x[side], corner_y[side], corner_x[side + 1], corner_y[side + 1])};
        break;
      }
    }
  }

  int n_;
  std::vector<double> values_;
};

// The largest floe of a field, with its ponds, about its middle.
Polygon noisy_floe(int cells, unsigned seed) {
  std::vector<Ring> rings = NoisyField(cells, seed).contours();
  for (Ring& ring : rings) {
    for (Point& p : ring) p = p - Vector{cells / 2.0, cells / 2.0};
  }
  const auto largest = std::max_element(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) {
    return std::pair(area_sign(a), a.size()) < std::pair(area_sign(b), b.size());
  });
  Polygon floe{*largest, {}};
  std::vector<Ring> ponds;
  for (Ring& ring : rings) {
    if (area_sign(ring) < 0 && side_of_ring(floe.outer, ring.front()) > 0) ponds.push_back(std::move(ring));
  }
  const auto lies_in = [](const Ring& inner, const Ring& outer) {
    return &inner != &outer && side_of_ring(outer, inner.front()) > 0;
  };
  for (const Ring& pond : ponds) {  // but for those of islands in ponds
    if (std::none_of(ponds.begin(), ponds.end(), [&](const Ring& other) { return lies_in(pond, other); }))
      floe.holes.push_back(pond);
  }
  return floe;
}

class Outlines : public testing::TestWithParam<unsigned> {};

// Cut after cut into the largest piece, by everything: straight and wandering cracks, discs, several discs at
// once, and other floes.
TEST_P(Outlines, AreCutSoundly) {
  const unsigned seed = GetParam();
  const bool is_long = std::getenv("POLYNYA_LONG_OUTLINES") != nullptr;
  const int cells = is_long ? 200 + 100 * static_cast<int>(seed % 4) : 60 + 20 * static_cast<int>(seed % 3);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.45 * cells, 0.45 * cells);
  const auto point = [&] { return Point{place(random), place(random)}; };
  const Shape whole{noisy_floe(cells, seed)};
  Shape shape = whole;
  ASSERT_FALSE(find_defect(shape.polygon));
  RecordProperty("vertices", static_cast<int>(vertex_count(shape.polygon)));
  int cuts = 0;
  const int rounds = is_long ? 60 : 18;
  for (int i = 0; i < rounds && !HasFailure(); ++i) {
    if (i % 6 == 0) shape = whole;
    trials::ManyKnives knives;
    switch ((i + i / 6) % 6) {
      case 0:
        knives.is_crack = true;
        knives.crack = {{-cells * 1.0, place(random)}, {cells * 1.0, place(random)}};
        break;
      case 1:
        knives.is_crack = true;
        for (int k = 0; k < 30; ++k) knives.crack.push_back(point());
        break;
      case 2:
        knives.polygons = {{disc_polygon(shape.polygon.outer.front(), 0.05 * cells, 0.001 * cells), {}}};
        break;
      case 3:
        for (int k = 0; k < 6; ++k)
          knives.polygons.push_back({disc_polygon(point(), 0.06 * cells, 0.002 * cells), {}});
        break;
      case 4:
        knives.polygons = {noisy_floe(cells / 2, 1000 + seed + static_cast<unsigned>(i))};
        break;
      default: {  // a polygon over the floe's own vertices
        const Ring& ring = shape.polygon.outer;
        const auto vertex = [&] { return ring[random() % ring.size()]; };
        Ring triangle{vertex(), vertex(), vertex()};
        if (area_sign(triangle) < 0) std::reverse(triangle.begin(), triangle.end());
        if (area_sign(triangle) == 0) continue;
        knives.polygons = {{triangle, {}}};
      }
    }
    const CutOutcome outcome = trials::cut(shape, knives);
    ASSERT_TRUE(is_sound(shape, outcome)) << "round " << i;
    if (i % 5 == 1) {
      ASSERT_TRUE(are_equal(outcome, trials::cut_generally(shape, knives)));
    }
    if (!outcome) continue;
    ++cuts;
    const auto largest =
        std::max_element(outcome->pieces.begin(), outcome->pieces.end(), [](const Piece& a, const Piece& b) {
          return vertex_count(a.shape.polygon) < vertex_count(b.shape.polygon);
        });
    shape = largest->shape;
  }
  EXPECT_GT(2 * cuts, rounds);
}

INSTANTIATE_TEST_SUITE_P(Noise, Outlines, testing::Range(1u, 7u));

}  // namespace
}  // namespace polynya::geometry
