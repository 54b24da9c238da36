#include "geometry/internal/settle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/internal/arrangement.hpp"
#include "geometry/measures.hpp"
#include "geometry/validity.hpp"

namespace polynya::geometry::exact {
namespace {

// Rounding can make neighbours equal and fold an edge back on the one before: neither encloses anything.
geometry::Ring weld(const geometry::Ring& ring) {
  geometry::Ring kept;
  kept.reserve(ring.size());
  for (const geometry::Point p : ring) {
    if (!kept.empty() && kept.back() == p) continue;
    if (kept.size() > 1 && kept[kept.size() - 2] == p) {
      kept.pop_back();
      continue;
    }
    kept.push_back(p);
  }
  for (bool changed = true; changed && kept.size() > 1;) {
    changed = false;
    if (kept.front() == kept.back() || kept[kept.size() - 2] == kept.front()) {
      kept.pop_back();
      changed = true;
    } else if (kept[1] == kept.back()) {
      kept.erase(kept.begin());
      changed = true;
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

geometry::Polygon weld(const geometry::Polygon& polygon) {
  geometry::Polygon result{weld(polygon.outer), {}};
  for (const geometry::Ring& hole : polygon.holes) {
    if (geometry::Ring welded = weld(hole); !welded.empty()) result.holes.push_back(std::move(welded));
  }
  return result;
}

bool is_valid(const geometry::Polygon& polygon) {
  return !polygon.outer.empty() && !find_defect(polygon);
}

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
    sum += distance(rounded_ring[i], rounded_ring[j]) * std::max(moved[i], moved[j]);
  }
  return sum;
}

// The most area that rounding can have moved across the boundary: every edge by the step of its ends.
double moved_area(const Polygon& polygon, const geometry::Polygon& rounded) {
  double sum = moved_area(polygon.outer, rounded.outer);
  for (std::size_t h = 0; h < polygon.holes.size(); ++h)
    sum += moved_area(polygon.holes[h], rounded.holes[h]);
  return sum;
}

// The regions that the rings of a rounded piece enclose.
std::vector<Polygon> enclosed_regions(const geometry::Polygon& rounded) {
  std::vector<SourceSegment> segments;
  append_segments(segments, exactly(rounded), 0);
  const auto inside = [](Winding w) { return w.shape > 0 ? 0 : -1; };
  std::vector<Polygon> polygons;
  for (Region& region : overlay(segments, inside, Seams::kDissolve).regions)
    polygons.push_back(std::move(region.polygon));
  return polygons;
}

// Rounded rings that are no longer simple, retraced into polygons that are. Where they cross, the crossing is
// a new vertex that must be rounded in turn: some rounds of that settle nearly always. None where they do
// not, or where the area has changed by more than rounding can explain.
std::vector<geometry::Polygon> retraced(const geometry::Polygon& rounded, double exact_area, double moved) {
  constexpr int kRounds = 6;
  std::vector<geometry::Polygon> open{rounded};
  std::vector<geometry::Polygon> settled;
  for (int round = 0; round < kRounds && !open.empty(); ++round) {
    std::vector<geometry::Polygon> still_open;
    for (const geometry::Polygon& polygon : open) {
      for (const Polygon& region : enclosed_regions(polygon)) {
        geometry::Polygon welded = weld(exact::rounded(region));
        if (welded.outer.empty()) continue;
        (is_valid(welded) ? settled : still_open).push_back(std::move(welded));
      }
    }
    open = std::move(still_open);
  }
  if (!open.empty()) return {};
  double area_sum = 0;
  for (const geometry::Polygon& polygon : settled) area_sum += measure(polygon).area;
  // A crossing lies near the ends whose rounding made it: each round moves about as much as the first.
  if (std::abs(area_sum - exact_area) > 2 * kRounds * moved + 1e-14 * exact_area) return {};
  return settled;
}

// The edge's vertices with the points of other rings that lie on it between them, in order along it.
void append_touches(const Point& a, const Point& b, const std::vector<const Point*>& others, Ring& ring) {
  std::vector<const Point*> touches;
  const auto [low_x, high_x] = std::minmax(a.x, b.x);
  const auto [low_y, high_y] = std::minmax(a.y, b.y);
  for (const Point* p : others) {
    if (p->x < low_x || high_x < p->x || p->y < low_y || high_y < p->y || *p == a || *p == b) continue;
    if (orientation(a, b, *p) == 0) touches.push_back(p);
  }
  const bool by_x = a.x != b.x;
  const bool ascending = by_x ? a.x < b.x : a.y < b.y;
  std::sort(touches.begin(), touches.end(), [&](const Point* p, const Point* q) {
    return (by_x ? p->x < q->x : p->y < q->y) == ascending && !(*p == *q);
  });
  for (const Point* p : touches) {
    if (!(ring.back() == *p)) ring.push_back(*p);
  }
}

// Where a hole touches the inside of an edge, rounding an end of that edge tears them apart or pushes one
// through the other. With the point of touch as a vertex of both rings they stay together, and the region is
// the same.
Polygon with_touches_as_vertices(const Polygon& polygon) {
  std::vector<const Ring*> rings{&polygon.outer};
  for (const Ring& hole : polygon.holes) rings.push_back(&hole);
  const auto split = [&rings](const Ring& ring) {
    std::vector<const Point*> others;
    for (const Ring* other : rings) {
      if (other == &ring) continue;
      for (const Point& p : *other) others.push_back(&p);
    }
    Ring result;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      result.push_back(ring[i]);
      append_touches(ring[i], ring[(i + 1) % ring.size()], others, result);
    }
    return result;
  };
  Polygon result{split(polygon.outer), {}};
  for (const Ring& hole : polygon.holes) result.holes.push_back(split(hole));
  return result;
}

struct Settling {
  CutResult result;
  Rational change = 0;  // Σ (returned − exact)

  double& area_of(Part part) {
    return part == Part::kOutside ? result.ledger.area_outside : result.ledger.area_inside;
  }

  void add(geometry::Polygon polygon, Part part) {
    area_of(part) += measure(polygon).area;
    change += area(polygon);
    result.pieces.push_back({Shape{std::move(polygon), nullptr, true}, part});
  }

  void add_exact(Polygon polygon, geometry::Polygon looks, Part part, const Rational& exact_area) {
    area_of(part) += nearest_double(exact_area);
    change += exact_area;
    ++result.ledger.kept_exact;
    auto kept = std::make_shared<const Polygon>(std::move(polygon));
    result.pieces.push_back({Shape{std::move(looks), std::move(kept), true}, part});
  }

  void add_sliver(const Rational& exact_area) {
    result.ledger.area_slivers += nearest_double(exact_area);
    change += exact_area;
    ++result.ledger.slivers;
  }
};

void settle_piece(ExactPiece piece, Settling& settling) {
  const Rational exact_area = area(piece.polygon);
  settling.change -= exact_area;
  const geometry::Polygon rounded = exact::rounded(piece.polygon);
  geometry::Polygon welded = weld(rounded);
  if (is_valid(welded)) return settling.add(std::move(welded), piece.part);
  if (!piece.polygon.holes.empty()) {
    welded = weld(exact::rounded(with_touches_as_vertices(piece.polygon)));
    if (is_valid(welded)) return settling.add(std::move(welded), piece.part);
  }
  const double moved = moved_area(piece.polygon, rounded);
  // A piece of no more area than rounding moves has no width that doubles can express.
  if (exact_area.get_d() <= moved) return settling.add_sliver(exact_area);
  std::vector<geometry::Polygon> parts = retraced(rounded, exact_area.get_d(), moved);
  if (parts.empty()) {
    geometry::Polygon looks = weld(rounded);  // no edge of no length, for those who only look
    if (looks.outer.empty()) looks = rounded;
    return settling.add_exact(std::move(piece.polygon), std::move(looks), piece.part, exact_area);
  }
  for (geometry::Polygon& part : parts) settling.add(std::move(part), piece.part);
}

}  // namespace

void sort_pieces(std::vector<Piece>& pieces) {
  const auto lowest = [](const Piece& piece) {
    const geometry::Ring& ring = piece.shape.polygon.outer;
    const auto less = [](geometry::Point a, geometry::Point b) {
      return std::tie(a.x, a.y) < std::tie(b.x, b.y);
    };
    return *std::min_element(ring.begin(), ring.end(), less);
  };
  if (pieces.size() == 2 &&
      pieces[0].part != pieces[1].part) {  // the common cut: no need to look for vertices
    if (pieces[1].part < pieces[0].part) std::swap(pieces[0], pieces[1]);
    return;
  }
  using Key = std::tuple<Part, double, double, std::size_t, std::size_t>;
  std::vector<Key> order;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const geometry::Point p = lowest(pieces[i]);
    order.emplace_back(pieces[i].part, p.x, p.y, pieces[i].shape.polygon.outer.size(), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Piece> sorted;
  sorted.reserve(pieces.size());
  for (const Key& key : order) sorted.push_back(std::move(pieces[std::get<4>(key)]));
  pieces = std::move(sorted);
}

CutOutcome settle(const Rational& area_before, std::vector<ExactPiece> pieces) {
  Rational sum = 0;
  for (const ExactPiece& piece : pieces) sum += area(piece.polygon);
  const Rational defect = sum - area_before;
  if (defect != 0) {
    return tl::unexpected(
        CutError{CutFailure::kInternal, "exact piece areas are off by " + defect.get_str()});
  }
  Settling settling;
  CutLedger& ledger = settling.result.ledger;
  ledger.area_before = nearest_double(area_before);
  ledger.exact_balance = true;
  ledger.exact_defect = defect.get_str();
  for (ExactPiece& piece : pieces) settle_piece(std::move(piece), settling);
  ledger.rounding_defect = nearest_double(settling.change);
  sort_pieces(settling.result.pieces);
  return std::move(settling.result);
}

}  // namespace polynya::geometry::exact
