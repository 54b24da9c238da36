#include "geometry/cut/repair.hpp"

#include <algorithm>
#include <iterator>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/cut/internal/snap_rounding.hpp"
#include "geometry/exact/internal/predicates.hpp"

namespace polynya::geometry {
namespace {

tl::expected<Repaired, CutError> repair_exactly(const std::vector<Ring>& rings, FillRule rule) {
  std::vector<exact::SourceSegment> segments;
  exact::Rational drawn = 0;
  for (const Ring& ring : rings) {
    append_segments(segments, exact::exactly(ring), 0);
    drawn += exact::area(ring);
  }
  const auto classify = [rule](exact::Winding w) {
    const bool is_filled = rule == FillRule::kNonZero ? w.shape != 0 : w.shape % 2 != 0;
    return is_filled ? 0 : -1;
  };
  std::vector<exact::ExactPiece> pieces;
  exact::Rational area = 0;
  for (exact::Region& region : exact::overlay(segments, classify, exact::Seams::kDissolve).regions) {
    area += exact::area(region.polygon);
    pieces.push_back({std::move(region.polygon), Part::kOutside});
  }
  Repaired repaired;
  CutOutcome rounded = exact::rounded_pieces(area, pieces);
  if (!rounded) return tl::unexpected(std::move(rounded.error()));
  for (Piece& piece : rounded->pieces) repaired.shapes.push_back(std::move(piece.shape));
  repaired.area_drawn = exact::nearest_double(abs(drawn));
  repaired.area = rounded->ledger.area_outside;
  repaired.area_changed = exact::nearest_double(exact::Rational(area - abs(drawn)));
  repaired.ledger = std::move(rounded->ledger);
  return repaired;
}

Ring oriented(Ring ring, int turn) {
  if (area_sign(ring) * turn < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace

tl::expected<Repaired, CutError> repair(const std::vector<Ring>& rings, FillRule rule) {
  std::vector<Ring> usable;
  for (const Ring& ring : rings) {
    if (!are_usable(ring)) return refuse(CutFailure::kInvalidShape, Defect::kNotFinite);
    if (Ring kept = without_repeats(ring); kept.size() > 2) usable.push_back(std::move(kept));
  }
  tl::expected<Repaired, CutError> repaired = guarded([&] { return repair_exactly(usable, rule); });
  if (!repaired || !repaired->shapes.empty()) return repaired;
  return refuse(CutFailure::kMisses, "the rings enclose nothing");
}

tl::expected<std::vector<Polygon>, CutError> union_of(const std::vector<Polygon>& polygons) {
  std::vector<Polygon> united;
  if (polygons.empty()) return united;
  std::vector<Ring> rings;
  for (const Polygon& polygon : polygons) std::ranges::copy(rings_of(polygon), std::back_inserter(rings));
  tl::expected<Repaired, CutError> repaired = repair(rings, FillRule::kNonZero);
  if (!repaired) return tl::unexpected(std::move(repaired.error()));
  for (Shape& shape : repaired->shapes) united.push_back(std::move(shape.polygon));
  return united;
}

std::vector<Ring> rings_of(const Polygon& polygon) {
  std::vector<Ring> rings{polygon.outer};
  rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  return rings;
}

Ring without_repeats(const Ring& ring) {
  Ring kept = ring;
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  return kept;
}

Polygon normalised(const Polygon& polygon) {
  // A ring that is not finite has no orientation; find_defect will name it.
  const auto turned = [&](const Ring& ring, int turn) {
    return are_usable(ring) ? oriented(without_repeats(ring), turn) : ring;
  };
  Polygon result{turned(polygon.outer, 1), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(turned(hole, -1));
  return result;
}

}  // namespace polynya::geometry
