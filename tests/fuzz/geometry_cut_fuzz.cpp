// libFuzzer target for the cuts. Two ways to read the bytes: as the stories of tests/geometry/dice.hpp, or as
// raw doubles, which may be anything at all. Aborts where a cut is not sound or where the local path and
// CGAL's differ.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/dice.hpp"
#include "tests/geometry/trials.hpp"

namespace {

using namespace polynya::geometry;
using trials::Dice;
using trials::Knife;

template <class Knives>
void require(const testing::AssertionResult& result, const Shape& shape, const Knives& knives) {
  if (result) return;
  std::fprintf(stderr, "%s\n%s%s\n", result.message(), trials::to_code(shape.polygon).c_str(),
               trials::to_code(knives).c_str());
  std::abort();
}

CutOutcome cut_and_check(const Shape& shape, const Knife& knife) {
  CutOutcome outcome = trials::cut(shape, knife);
  require(trials::is_sound(shape, outcome), shape, knife);
  const bool was_tried = outcome || outcome.error().reason == CutFailure::kMisses ||
                         outcome.error().reason == CutFailure::kDoesNotSeparate;
  if (was_tried) require(trials::are_equal(outcome, trials::cut_generally(shape, knife)), shape, knife);
  return outcome;
}

// Several polygons with holes, cracks that cross themselves.
void cut_by_many_and_check(Dice& dice, const Shape& shape) {
  const trials::ManyKnives knives = trials::roll_knives(dice, shape.polygon);
  if (!knives.is_crack && knives.polygons.empty()) return;
  const CutOutcome outcome = trials::cut(shape, knives);
  if (!outcome && outcome.error().reason == CutFailure::kInvalidTool) return;
  require(trials::is_sound(shape, outcome), shape, knives);
  require(trials::are_equal(outcome, trials::cut_generally(shape, knives)), shape, knives);
}

// A shape that is said to be valid and is not: any answer will do, but there must be one.
void cut_past_the_checks(Dice& dice, Shape shape) {
  shape.known_valid = true;
  const trials::ManyKnives knives = trials::roll_knives(dice, shape.polygon);
  static_cast<void>(trials::cut(shape, knives));
}

void tell_story(Dice dice) {
  Shape shape{trials::roll_floe(dice)};
  if (const auto found = find_defect(shape.polygon)) {
    if (found->defect != Defect::kNotFinite && shape.polygon.outer.size() > 2) cut_past_the_checks(dice, shape);
    return;
  }
  if (dice.below(4) == 0) return cut_by_many_and_check(dice, shape);
  for (int cut = 0; cut < 3 && !dice.is_empty(); ++cut) {
    const CutOutcome outcome = cut_and_check(shape, trials::roll_knife(dice, shape.polygon));
    if (!outcome || outcome->pieces.empty()) continue;
    const auto i = static_cast<std::size_t>(dice.below(static_cast<int>(outcome->pieces.size())));
    shape = outcome->pieces[i].shape;
  }
}

// The first bytes say how many points are the floe's, the hole's and the knife's.
void read_doubles(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return;
  std::size_t at = 3;
  const auto ring_of = [&](int count) {
    Ring ring;
    for (int i = 0; i < count && at + sizeof(Point) <= size; ++i, at += sizeof(Point)) {
      Point p;
      std::memcpy(&p, data + at, sizeof p);
      ring.push_back(p);
    }
    return ring;
  };
  Polygon floe{ring_of(data[0] % 24), {}};
  if (Ring hole = ring_of(data[1] % 8); !hole.empty()) floe.holes.push_back(hole);
  const Ring knife = ring_of(data[2] % 24);
  floe = normalised(floe);
  static_cast<void>(repair({floe.outer, knife}, FillRule::kNonZero));
  if (find_defect(floe)) return;
  cut_and_check(Shape{floe}, {true, normalised({knife, {}}).outer});
  cut_and_check(Shape{floe}, {false, knife});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 4096) return 0;
  if (data[0] % 4 == 0) {
    read_doubles(data + 1, size - 1);
  } else {
    tell_story(Dice({data + 1, data + size}));
  }
  return 0;
}
