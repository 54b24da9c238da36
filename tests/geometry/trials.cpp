#include "tests/geometry/trials.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <tuple>
#include <utility>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::geometry::trials {
namespace {

using Corners = std::vector<std::pair<double, double>>;

// A ring from its lowest vertex on.
Corners canonical(const Ring& ring) {
  Corners corners;
  for (const Point p : ring) corners.emplace_back(p.x, p.y);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

// Returns the part that the piece belongs to, its outer ring, and its holes in order.
std::tuple<Part, Corners, std::vector<Corners>> canonical(const Piece& piece) {
  std::vector<Corners> holes;
  for (const Ring& hole : piece.shape.polygon.holes) holes.push_back(canonical(hole));
  std::ranges::sort(holes);
  return {piece.part, canonical(piece.shape.polygon.outer), holes};
}

// Returns the largest error of a nearest double.
exact::Rational half_step(double value) {
  const double far = std::numeric_limits<double>::infinity();
  return (exact::Rational(std::nextafter(std::abs(value), far)) - exact::Rational(std::abs(value))) / 2;
}

double dangling_of(const CutOutcome& outcome) {
  return outcome ? outcome->ledger.dangling_length : outcome.error().dangling_length;
}

}  // namespace

exact::Rational exact_area_of(const Shape& shape) {
  return exact::area(shape.polygon);
}

testing::AssertionResult is_sound(const Shape& shape, const CutOutcome& outcome) {
  if (!outcome) {
    if (outcome.error().reason != CutFailure::kInternal) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "internal: " << outcome.error().detail;
  }
  const CutLedger& ledger = outcome->ledger;
  if (ledger.exact_defect != "0") return testing::AssertionFailure() << "no exact balance";
  exact::Rational sum = 0, of_part[2] = {0, 0};
  for (const Piece& piece : outcome->pieces) {
    sum += exact_area_of(piece.shape);
    of_part[piece.part == Part::kOutside ? 0 : 1] += exact_area_of(piece.shape);
    if (exact_area_of(piece.shape) <= 0) return testing::AssertionFailure() << "a piece of no area";
    if (const auto found = find_defect(piece.shape.polygon)) {
      return testing::AssertionFailure() << name_of(found->defect) << ": " << to_code(piece.shape.polygon);
    }
  }
  for (const double apart : {exact::Rational(of_part[0] - exact::Rational(ledger.area_outside)).get_d(),
                             exact::Rational(of_part[1] - exact::Rational(ledger.area_inside)).get_d()}) {
    // A term of a shoelace sum about a vertex has an error of up to 4ε of its two products, each at most (size/2)².
    // Thin pieces with long edges have such errors, although their own area is much smaller.
    const double size = perimeter(shape.polygon);
    if (std::abs(apart) > 1e-14 * ledger.area_before + std::numeric_limits<double>::epsilon() * size * size)
      return testing::AssertionFailure() << "a part's area is off by " << apart << " m²";
  }
  // The pieces and the removed area add up to the parent exactly, except for the two nearest doubles that the ledger
  // states.
  const exact::Rational off =
      sum - exact_area_of(shape) + exact::Rational(ledger.area_slivers) - exact::Rational(ledger.rounding_defect);
  if (abs(off) > half_step(ledger.rounding_defect) + half_step(ledger.area_slivers))
    return testing::AssertionFailure() << "the ledger is off by " << off.get_d() << " m²";
  return testing::AssertionSuccess();
}

testing::AssertionResult are_equal(const CutOutcome& one, const CutOutcome& other) {
  const double dangling = dangling_of(one);
  if (std::abs(dangling - dangling_of(other)) > 1e-12 * dangling + 1e-9) {
    return testing::AssertionFailure() << "dangling " << dangling << " m and " << dangling_of(other) << " m";
  }
  if (one.has_value() != other.has_value()) {
    return testing::AssertionFailure() << "one fails: " << name_of((one ? other : one).error().reason);
  }
  if (!one) {
    if (one.error().reason == other.error().reason) return testing::AssertionSuccess();
    return testing::AssertionFailure() << name_of(one.error().reason) << " and " << name_of(other.error().reason);
  }
  const auto listed = [](const CutOutcome& outcome) {
    std::vector<decltype(canonical(Piece{}))> pieces;
    for (const Piece& piece : outcome->pieces) pieces.push_back(canonical(piece));
    std::ranges::sort(pieces);
    return pieces;
  };
  if (listed(one) == listed(other)) {
    const double apart = one->ledger.rounding_defect - other->ledger.rounding_defect;
    if (std::abs(apart) < 1e-300) return testing::AssertionSuccess();  // subnormal defects do not scale
    return testing::AssertionFailure() << "rounding defects differ: " << one->ledger.rounding_defect << " and "
                                       << other->ledger.rounding_defect;
  }
  testing::AssertionResult failure = testing::AssertionFailure();
  failure << one->pieces.size() << " and " << other->pieces.size() << " pieces";
  for (const CutOutcome* outcome : {&one, &other}) {
    failure << "\n--";
    for (const Piece& piece : (*outcome)->pieces)
      failure << "\n" << static_cast<int>(piece.part) << " " << to_code(piece.shape.polygon);
  }
  return failure;
}

CutOutcome cut(const Shape& shape, const Knife& knife) {
  return knife.is_ring ? cut_by_polygon(shape, {knife.points, {}}) : cut_along(shape, knife.points);
}

CutOutcome cut(const Shape& shape, const ManyKnives& knives) {
  return knives.is_crack ? cut_along(shape, knives.crack) : cut_by_polygons(shape, knives.polygons);
}

CutOutcome cut_generally(const Shape& shape, const Knife& knife) {
  const exact::Polygon exact_shape = exact::exactly(shape.polygon);
  return knife.is_ring ? cut_by_polygons_generally(exact_shape, {{knife.points, {}}})
                       : cut_along_generally(exact_shape, {knife.points});
}

CutOutcome cut_generally(const Shape& shape, const ManyKnives& knives) {
  const exact::Polygon exact_shape = exact::exactly(shape.polygon);
  return knives.is_crack ? cut_along_generally(exact_shape, {knives.crack})
                         : cut_by_polygons_generally(exact_shape, knives.polygons);
}

std::string to_code(const Knife& knife) {
  return (knife.is_ring ? "\nring " : "\ncrack ") + to_code(knife.points);
}

std::string to_code(const ManyKnives& knives) {
  if (knives.is_crack) return "\ncrack " + to_code(knives.crack);
  std::string code;
  for (const Polygon& polygon : knives.polygons) code += "\npolygon " + to_code(polygon);
  return code;
}

std::string to_code(const Ring& ring) {
  std::ostringstream out;
  out << std::hexfloat << "{";
  for (const Point p : ring) out << "{" << p.x << ", " << p.y << "}, ";
  out << "}";
  return out.str();
}

std::string to_code(const Polygon& polygon) {
  std::string code = "{" + to_code(polygon.outer) + ", {";
  for (const Ring& hole : polygon.holes) code += to_code(hole) + ", ";
  return code + "}}";
}

}  // namespace polynya::geometry::trials
