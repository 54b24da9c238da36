#pragma once

#include <utility>
#include <vector>

#include "geometry/cut/internal/rounded_pieces.hpp"
#include "geometry/exact/internal/ring_area.hpp"

namespace polynya::geometry {

// The ends that a cut on part of a shape comes to. A plan is a list of pieces, each with its rings, written
// out, and their areas.

/// How a cut accounts for the edges it changed, in rationals.
struct AreaCheck {
  exact::Rational defect = 0;    ///< twice what the pieces' edges differ by from those of the shape
  exact::Rational rounding = 0;  ///< twice what rounding their new vertices changed
};

/// The pieces as planned, where rounding broke none of them.
template <typename Plan>
CutResult take_as_planned(std::vector<Plan> plans, double area_before, const AreaCheck& balance) {
  CutResult result;
  CutLedger& ledger = result.ledger;
  ledger.area_before = area_before;
  ledger.exact_balance = true;
  ledger.exact_defect = balance.defect.get_str();
  ledger.rounding_defect = exact::nearest_double(balance.rounding / 2);
  for (Plan& plan : plans) {
    Piece piece;
    piece.part = plan.part;
    piece.shape.known_valid = true;
    std::vector<RingArea> areas;
    Polygon& polygon = piece.shape.polygon;
    for (auto& ring : plan.rings) {
      areas.push_back(ring.area);
      (polygon.outer.empty() ? polygon.outer : polygon.holes.emplace_back()) = std::move(ring.points);
    }
    (plan.part == Part::kOutside ? ledger.area_outside : ledger.area_inside) += area_of(polygon, areas);
    result.pieces.push_back(std::move(piece));
  }
  exact::sort_pieces(result.pieces);
  return result;
}

/// The pieces rounded from their exact shapes, where it did.
template <typename Cut, typename Plan>
CutOutcome round_exactly(const Cut& cut, const std::vector<Plan>& plans, const exact::Rational& area_before) {
  std::vector<exact::ExactPiece> pieces;
  pieces.reserve(plans.size());
  for (const Plan& plan : plans) pieces.push_back({write_exactly(cut, plan), plan.part});
  return exact::rounded_pieces(area_before, pieces);
}

}  // namespace polynya::geometry
