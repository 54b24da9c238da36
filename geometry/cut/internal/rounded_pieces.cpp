#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/cut/internal/snap_rounding.hpp"
#include "geometry/exact/internal/areas.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::geometry::exact {
namespace {

// The most area that rounding can have moved across the ring: every edge, at its longest, by the farther step
// of its two ends.
double moved_area(const Ring& ring, const geometry::Ring& rounded_ring) {
  std::vector<double> moved;
  moved.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Rational dx = ring[i].x - Rational(rounded_ring[i].x);
    const Rational dy = ring[i].y - Rational(rounded_ring[i].y);
    moved.push_back(std::abs(dx.get_d()) + std::abs(dy.get_d()));
  }
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t j = i + 1 == ring.size() ? 0 : i + 1;
    const double length = distance(rounded_ring[i], rounded_ring[j]) + moved[i] + moved[j];
    sum += length * std::max(moved[i], moved[j]);
  }
  return sum;
}

double moved_area(const Polygon& polygon, const geometry::Polygon& rounded) {
  double sum = moved_area(polygon.outer, rounded.outer);
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) sum += moved_area(polygon.holes[h], rounded.holes[h]);
  return sum;
}

class Rounding {
 public:
  bool add(const ExactPiece& piece) {
    const Rational exact_area = area(piece.polygon);
    change_ -= exact_area;
    const geometry::Polygon nearest = rounded(piece.polygon);
    geometry::Polygon kept = welded(nearest);
    if (!kept.outer.empty() && !find_defect(kept)) {
      add(std::move(kept), piece.part);
      return true;
    }
    // A piece of no more area than rounding moves has no width that doubles can express.
    if (exact_area.get_d() <= moved_area(piece.polygon, nearest)) {
      add_sliver(exact_area);
      return true;
    }
    for (const Lattice& lattice : {Lattice::of_doubles(), Lattice::spanning(piece.polygon)}) {
      std::optional<std::vector<geometry::Polygon>> parts = snapped(piece.polygon, lattice);
      if (!parts) continue;
      if (parts->empty()) add_sliver(exact_area);
      result_.ledger.snap_rounded += parts->empty() ? 0 : 1;
      for (geometry::Polygon& part : *parts) add(std::move(part), piece.part);
      return true;
    }
    return false;
  }

  CutResult result() && {
    result_.ledger.area_slivers = nearest_double(slivers_);
    result_.ledger.rounding_defect = nearest_double(change_);
    sort_pieces(result_.pieces);
    return std::move(result_);
  }

 private:
  void add(geometry::Polygon polygon, Part part) {
    CutLedger& ledger = result_.ledger;
    (part == Part::kOutside ? ledger.area_outside : ledger.area_inside) += nearest_area(polygon);
    change_ += area(polygon);
    result_.pieces.push_back({Shape{std::move(polygon), true}, part});
  }

  void add_sliver(const Rational& exact_area) {
    slivers_ += exact_area;
    change_ += exact_area;
    ++result_.ledger.slivers;
  }

  CutResult result_;
  Rational slivers_ = 0;
  Rational change_ = 0;  // Σ (returned − exact)
};

}  // namespace

void sort_pieces(std::vector<Piece>& pieces) {
  if (pieces.size() == 2 && pieces[0].part != pieces[1].part) {  // the common cut: the parts decide
    if (pieces[1].part < pieces[0].part) std::swap(pieces[0], pieces[1]);
    return;
  }
  using Key = std::tuple<Part, double, double, std::size_t, std::size_t>;
  std::vector<Key> order;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const geometry::Ring& ring = pieces[i].shape.polygon.outer;
    const geometry::Point lowest = *std::ranges::min_element(ring, geometry::precedes);
    order.emplace_back(pieces[i].part, lowest.x, lowest.y, ring.size(), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Piece> sorted;
  sorted.reserve(pieces.size());
  for (const Key& key : order) sorted.push_back(std::move(pieces[std::get<4>(key)]));
  pieces = std::move(sorted);
}

CutOutcome rounded_pieces(const Rational& area_before, const std::vector<ExactPiece>& pieces) {
  Rational sum = 0;
  for (const ExactPiece& piece : pieces) sum += area(piece.polygon);
  const Rational defect = sum - area_before;
  if (defect != 0) return refuse(CutFailure::kInternal, "exact piece areas are off by " + defect.get_str());
  Rounding rounding;
  for (const ExactPiece& piece : pieces) {
    if (!rounding.add(piece))
      return refuse(CutFailure::kInternal, "a piece is not a valid polygon before it is rounded");
  }
  CutResult result = std::move(rounding).result();
  result.ledger.area_before = nearest_double(area_before);
  result.ledger.exact_balance = true;
  result.ledger.exact_defect = defect.get_str();
  return result;
}

}  // namespace polynya::geometry::exact
