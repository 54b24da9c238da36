#include <algorithm>
#include <stdexcept>

#include "bench/cut_cases.hpp"
#include "geometry/cut.hpp"

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
    const auto largest =
        std::max_element(outcome->pieces.begin(), outcome->pieces.end(), [](auto& a, auto& b) {
          return std::pair(a.part == Part::kOutside, vertex_count(a.shape.polygon)) <
                 std::pair(b.part == Part::kOutside, vertex_count(b.shape.polygon));
        });
    area = outcome->ledger.area_outside;
    plate = std::move(largest->shape);
  }
  return {area, plate.polygon.outer.size()};
}

Result split(const Split& split) {
  const CutOutcome outcome = cut_along(Shape{{split.floe, {}}, nullptr, true}, {split.from, split.to});
  if (!outcome) throw std::runtime_error(outcome.error().detail);
  Result result;
  for (const Piece& piece : outcome->pieces) result.vertices += piece.shape.polygon.outer.size();
  result.area = outcome->ledger.area_outside;
  return result;
}

}  // namespace polynya::bench::polynya_cuts
