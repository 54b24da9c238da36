#include "geometry/exact/validity.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

const Ring kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

std::string defect_of(const Polygon& polygon) {
  const auto found = find_defect(polygon);
  return found ? std::string(name_of(found->defect)) : "valid";
}
std::string defect_of(const Ring& ring) {
  return defect_of(Polygon{ring, {}});
}
std::string defect_with_hole(const Ring& hole) {
  return defect_of(Polygon{kSquare, {hole}});
}
Ring hole_square(Point low, double side) {
  return shapes::reversed(shapes::square(low, side).outer);
}

TEST(Validity, NamesTheDefectsOfOneRing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(defect_of(kSquare), "valid");
  EXPECT_EQ(defect_of(Ring{}), "too-few-points");
  EXPECT_EQ(defect_of(Ring{{1, 1}, {2, 2}}), "too-few-points");
  EXPECT_EQ(defect_of(Ring{{1, 1}, {2, 2}, {1, 1}, {2, 2}}), "too-few-points");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, nan}, {1, 1}}), "not-finite");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {infinity, 0}, {1, 1}}), "not-finite");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, 0}, {1, 0}, {1, 1}}), "repeated-point");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "repeated-point");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, 1}, {3, 3}, {2, 2}}), "zero-area");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {2, 2}, {2, 0}, {0, 2}}), "self-crossing");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}), "self-crossing")
      << "a vertex on an edge";
  EXPECT_EQ(defect_of(Ring{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}), "self-crossing") << "a pinch";
  EXPECT_EQ(defect_of(Ring{{0, 0}, {4, 0}, {4, 4}, {8, 4}, {4, 4}, {0, 4}}), "overlapping-edges")
      << "a spike";
  EXPECT_EQ(defect_of(Ring{{0, 0}, {0, 1}, {1, 1}, {1, 0}}), "wrong-orientation");
}

TEST(Validity, NamesTheDefectsOfHoles) {
  EXPECT_EQ(defect_with_hole(hole_square({1, 1}, 2)), "valid");
  EXPECT_EQ(defect_with_hole({{1, 1}, {3, 1}, {3, 3}, {1, 3}}), "wrong-orientation");
  EXPECT_EQ(defect_with_hole(hole_square({20, 20}, 2)), "hole-outside");
  EXPECT_EQ(defect_with_hole(hole_square({9, 4}, 2)), "rings-cross");
  EXPECT_EQ(defect_with_hole({{0, 5}, {0, 7}, {2, 6}}), "overlapping-edges");
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 4), hole_square({2, 2}, 1)}}), "holes-overlap");
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 4), hole_square({3, 3}, 4)}}), "rings-cross");
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 4), hole_square({1, 1}, 4)}}), "overlapping-edges");
}

TEST(Validity, HolesMayTouchInPoints) {
  EXPECT_EQ(defect_with_hole({{0, 0}, {3, 6}, {6, 3}}), "valid") << "vertex on vertex";
  EXPECT_EQ(defect_with_hole({{0, 5}, {2, 6}, {2, 4}}), "valid") << "vertex on edge";
  EXPECT_EQ(defect_of({{{0, 0}, {5, 4}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 4}, {3, 6}, {8, 4}}}}), "valid")
      << "the shell's vertex on the hole's edge";
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 2), hole_square({3, 3}, 2)}}), "valid");
}

TEST(Validity, TouchesThatCutTheInteriorApartAreDefects) {
  EXPECT_EQ(defect_with_hole({{0, 5}, {5, 10}, {10, 5}, {5, 0}}), "disconnected");
  EXPECT_EQ(defect_of({kSquare, {{{0, 5}, {5, 6}, {5, 4}}, {{5, 5}, {10, 6}, {10, 4}}}}),
            "overlapping-edges");
  EXPECT_EQ(defect_of({kSquare, {{{0, 5}, {4, 6}, {5, 5}, {4, 4}}, {{5, 5}, {6, 6}, {10, 5}, {6, 4}}}}),
            "disconnected");
  // Three holes in a ring around a bit of ice, each touching the next.
  EXPECT_EQ(defect_of({kSquare,
                       {{{2, 2}, {5, 3}, {8, 2}, {5, 1}},
                        {{8, 2}, {6, 5}, {5, 8}, {7, 5}},
                        {{5, 8}, {4, 5}, {2, 2}, {3, 5}}}}),
            "disconnected");
}

TEST(Validity, RingsThatCrossInTheirVerticesCross) {
  EXPECT_EQ(defect_of({{{0, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}},
                       {{{5, 10}, {4, 12}, {7, 8}, {5, 5}, {3, 8}}}}),
            "rings-cross");
}

TEST(Validity, IsDecidedExactlyOneUlpApart) {
  // A notch whose tip comes to the diagonal from below: clear of it by one ulp, on it, past it.
  const auto with_tip_at = [](double y) {
    return Ring{{0, 0}, {3, -3}, {3, 0.4}, {0.5, y}, {3, 0.6}, {1, 1}};
  };
  EXPECT_EQ(defect_of(with_tip_at(std::nextafter(0.5, 0.0))), "valid");
  EXPECT_EQ(defect_of(with_tip_at(0.5)), "self-crossing");
  EXPECT_EQ(defect_of(with_tip_at(std::nextafter(0.5, 1.0))), "self-crossing");
}

TEST(Validity, IsNearLinear) {
  // A comb of 10 000 vertices and a spiral, both valid; an n² check of either would visit 5·10⁷ pairs
  // exactly.
  Ring comb{{0, 0}, {5000, 0}};
  for (int tooth = 2499; tooth >= 0; --tooth) {
    const double x = 2 * tooth;
    for (const Point p : {Point{x + 1.5, 100}, Point{x + 1, 1}, Point{x + 0.5, 1}, Point{x, 100}})
      comb.push_back(p);
  }
  EXPECT_EQ(defect_of(comb), "valid");
  Ring spiral;
  for (int i = 0; i < 5000; ++i)
    spiral.push_back({(10 + i * 0.01) * std::cos(i * 0.05), (10 + i * 0.01) * std::sin(i * 0.05)});
  for (int i = 4999; i >= 0; --i)
    spiral.push_back({(9.6 + i * 0.01) * std::cos(i * 0.05), (9.6 + i * 0.01) * std::sin(i * 0.05)});
  EXPECT_EQ(defect_of(spiral), "valid");
}

}  // namespace
}  // namespace polynya::geometry
