#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>

#include "bench/cut_cases.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::bench::polynya_cuts {

using geometry::CutOutcome;
using geometry::Part;
using geometry::Piece;
using geometry::Shape;

Result march(const March& march) {
  Shape plate{{march.plate, {}}};
  double area = 0;
  for (const geometry::Ring& cusp : march.cusps) {
    CutOutcome outcome = cut_by_polygon(plate, {cusp, {}});
    if (!outcome) throw std::runtime_error(outcome.error().detail);
    const auto largest = std::max_element(outcome->pieces.begin(), outcome->pieces.end(), [](auto& a, auto& b) {
      return std::pair(a.part == Part::kOutside, vertex_count(a.shape.polygon)) <
             std::pair(b.part == Part::kOutside, vertex_count(b.shape.polygon));
    });
    area = outcome->ledger.area_outside;
    plate = std::move(largest->shape);
  }
  return {area, plate.polygon.outer.size()};
}

Result split(const Split& split) {
  const CutOutcome outcome = cut_along(Shape{{split.floe, {}}, true}, {split.from, split.to});
  if (!outcome) throw std::runtime_error(outcome.error().detail);
  Result result;
  for (const Piece& piece : outcome->pieces) result.vertices += piece.shape.polygon.outer.size();
  result.area = outcome->ledger.area_outside;
  return result;
}

double seconds_to_validate(int vertices) {
  const geometry::Polygon floe{split_of_floe(vertices).floe, {}};
  const auto start = std::chrono::steady_clock::now();
  if (geometry::find_defect(floe)) throw std::runtime_error("the floe is not valid");
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

namespace {

double seconds_of(const std::function<bool()>& cut) {
  const auto start = std::chrono::steady_clock::now();
  if (!cut()) throw std::runtime_error("no cut");
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Near both ends of the split's line: most of the floe is far from them.
std::vector<geometry::Polygon> two_discs(const Split& split) {
  return {{geometry::disc_polygon(midpoint(split.from, split.to), 3, 0.02), {}},
          {geometry::disc_polygon(split.floe.front(), 3, 0.02), {}}};
}

}  // namespace

double seconds_to_cut_generally(int vertices) {
  const Split split = split_of_floe(vertices);
  const geometry::exact::Polygon floe = geometry::exact::exactly(geometry::Polygon{split.floe, {}});
  return seconds_of([&] { return geometry::cut_along_generally(floe, {{split.from, split.to}}).has_value(); });
}

double seconds_to_cut_by_two(int vertices) {
  const Split split = split_of_floe(vertices);
  const Shape floe{{split.floe, {}}, true};
  return seconds_of([&] { return cut_by_polygons(floe, two_discs(split)).has_value(); });
}

double seconds_to_cut_locally(int vertices) {
  const Split split = split_of_floe(vertices);
  const Shape floe{{split.floe, {}}, true};
  return seconds_of([&] { return cut_along(floe, {split.from, split.to}).has_value(); });
}

}  // namespace polynya::bench::polynya_cuts
