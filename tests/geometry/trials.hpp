#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"
#include "tests/geometry/dice.hpp"

namespace polynya::geometry::trials {

/// Returns the area of a piece as stored, in rationals.
exact::Rational exact_area_of(const Shape& shape);

/// Checks the properties of every cut: exact balance, valid pieces, and a ledger that adds up to the last bit.
testing::AssertionResult is_sound(const Shape& shape, const CutOutcome& outcome);

/// Same failure, or the same pieces with the very same vertices (rings may start elsewhere).
testing::AssertionResult are_equal(const CutOutcome& one, const CutOutcome& other);

/// Makes the same cut as the product does, and by CGAL's arrangement of the whole shape.
CutOutcome cut(const Shape& shape, const Knife& knife);
CutOutcome cut(const Shape& shape, const ManyKnives& knives);
CutOutcome cut_generally(const Shape& shape, const Knife& knife);
CutOutcome cut_generally(const Shape& shape, const ManyKnives& knives);

/// Vertices as C++ that can be pasted into a fixture.
std::string to_code(const Polygon& polygon);
std::string to_code(const Ring& ring);
std::string to_code(const Knife& knife);
std::string to_code(const ManyKnives& knives);

}  // namespace polynya::geometry::trials
