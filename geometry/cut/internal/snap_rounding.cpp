#include "geometry/cut/internal/snap_rounding.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry::exact {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

double farthest(const Polygon& polygon) {
  double size = 0;
  const auto include = [&size](const Ring& ring) {
    for (const Point& p : ring) size = std::max({size, std::abs(nearest_double(p.x)), std::abs(nearest_double(p.y))});
  };
  include(polygon.outer);
  std::ranges::for_each(polygon.holes, include);
  return size;
}

// The part of an edge that lies in a cell: from `first` to `last` along it, as fractions of the edge.
struct Stretch {
  Rational first = 0;
  Rational last = 1;
  bool has_first = true;
  bool has_last = true;

  bool is_empty() const { return first > last || (first == last && !(has_first && has_last)); }

  // Keeps the part of from + t·along that is in the cell.
  void clip(const Rational& from, const Rational& along, const Cell& cell) {
    const int direction = sign(along);
    if (direction == 0) {
      const bool is_in =
          (cell.has_low ? from >= cell.low : from > cell.low) && (cell.has_high ? from <= cell.high : from < cell.high);
      if (!is_in) last = -1;
      return;
    }
    const Rational enters((direction > 0 ? cell.low : cell.high) - from);
    const Rational leaves((direction > 0 ? cell.high : cell.low) - from);
    raise_first(enters / along, direction > 0 ? cell.has_low : cell.has_high);
    lower_last(leaves / along, direction > 0 ? cell.has_high : cell.has_low);
  }

 private:
  void raise_first(const Rational& t, bool has_t) {
    if (t == first) has_first = has_first && has_t;
    if (t <= first) return;
    first = t;
    has_first = has_t;
  }
  void lower_last(const Rational& t, bool has_t) {
    if (t == last) has_last = has_last && has_t;
    if (t >= last) return;
    last = t;
    has_last = has_t;
  }
};

// A cell, between an edge's ends, through which the edge passes.
struct Bend {
  Stretch stretch;
  geometry::Point at;
};

// Returns true if a point is farther from the line than cells reach, in doubles with a margin for their errors.
bool is_far(const Edge& e, geometry::Point p, const Lattice& lattice) {
  const double width = lattice.width(std::max({std::abs(e.a.x), std::abs(e.a.y), std::abs(e.b.x), std::abs(e.b.y)}));
  const Vector along = e.b - e.a;
  return std::abs(cross(along, p - e.a)) > 8 * width * (std::abs(along.x) + std::abs(along.y) + width);
}

class Snapping {
 public:
  Snapping(const Polygon& polygon, const Lattice& lattice) : lattice_(lattice) {
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
    bends_.resize(edges_.size());
    find_bends();
  }

  geometry::Polygon polygon() {
    geometry::Polygon result;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (edges_[i].index == 0 && i > 0) result.holes.emplace_back();
      geometry::Ring& ring = result.holes.empty() ? result.outer : result.holes.back();
      ring.push_back(edges_[i].a);
      std::vector<Bend>& bends = bends_[i];
      std::ranges::sort(bends, {}, [](const Bend& b) { return std::tie(b.stretch.first, b.stretch.last); });
      for (const Bend& bend : bends) ring.push_back(bend.at);
    }
    return result;
  }

 private:
  void add(const Ring& ring) {
    const std::size_t first = edges_.size();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      starts_.push_back(&ring[i]);
      ends_.push_back(&ring[i + 1 == ring.size() ? 0 : i + 1]);
      edges_.push_back({lattice_.nearest(ring[i]), {}, 0, static_cast<int>(i)});
    }
    for (std::size_t i = first; i < edges_.size(); ++i) edges_[i].b = edges_[i + 1 == edges_.size() ? first : i + 1].a;
  }

  // Rounding keeps the order: points of an edge round to points in the box of its rounded ends.
  void find_bends() {
    geometry::Ring centres;
    for (const Edge& e : edges_) centres.push_back(e.a);
    std::sort(centres.begin(), centres.end(), geometry::precedes);
    centres.erase(std::unique(centres.begin(), centres.end()), centres.end());
    const BoxTree tree(edges_);
    for (const geometry::Point p : centres) {
      tree.for_each_near({p, p}, [&](std::size_t i) {
        if (p != edges_[i].a && p != edges_[i].b && !is_far(edges_[i], p, lattice_)) add_bend(i, p);
        return true;
      });
    }
  }

  void add_bend(std::size_t i, geometry::Point p) {
    const Point& from = *starts_[i];
    const Point& to = *ends_[i];
    Stretch stretch;
    stretch.clip(from.x, to.x - from.x, lattice_.cell(p.x));
    stretch.clip(from.y, to.y - from.y, lattice_.cell(p.y));
    if (!stretch.is_empty()) bends_[i].push_back({std::move(stretch), p});
  }

  const Lattice& lattice_;
  std::vector<const Point*> starts_;  // start of each edge
  std::vector<const Point*> ends_;
  std::vector<Edge> edges_;  // edges with rounded ends
  std::vector<std::vector<Bend>> bends_;
};

geometry::Ring without_spikes(const geometry::Ring& ring) {
  geometry::Ring kept;
  for (const geometry::Point p : ring) {
    if (!kept.empty() && kept.back() == p) continue;
    if (kept.size() > 1 && kept[kept.size() - 2] == p) {
      kept.pop_back();
    } else {
      kept.push_back(p);
    }
  }
  while (kept.size() > 1) {  // also where the ring closes
    if (kept.front() == kept.back() || kept[kept.size() - 2] == kept.front()) {
      kept.pop_back();
    } else if (kept[1] == kept.back()) {
      kept.erase(kept.begin());
    } else {
      break;
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

// Returns the polygon without parts that rounding can leave in a ring and that enclose nothing: equal neighbours and
// spikes, which are edges folded back on the one before. Rings that enclose nothing are dropped; an outer one becomes
// empty.
geometry::Polygon without_spikes(const geometry::Polygon& polygon) {
  geometry::Polygon result{without_spikes(polygon.outer), {}};
  for (const geometry::Ring& hole : polygon.holes) {
    if (geometry::Ring kept = without_spikes(hole); !kept.empty()) result.holes.push_back(std::move(kept));
  }
  return result;
}

}  // namespace

Lattice Lattice::spanning(const Polygon& polygon) {
  // Exponent of the smallest double above 0: a finer lattice would have points that are no doubles.
  constexpr int kFinest = std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
  const double size = farthest(polygon);
  if (size == 0) return Lattice(false, kFinest);
  return Lattice(false, std::max(std::ilogb(size) + 1 - std::numeric_limits<double>::digits, kFinest));
}

double Lattice::nearest(const Rational& value) const {
  if (is_of_doubles_) return nearest_double(value);
  return std::ldexp(whole_below(Rational(scaled(value, -exponent_) + Rational(1, 2))), exponent_);
}

Cell Lattice::cell(double centre) const {
  const Rational middle(centre);
  if (!is_of_doubles_) {
    const Rational half = scaled(1, exponent_ - 1);
    return {middle - half, middle + half, true, false};
  }
  const bool is_even = std::bit_cast<std::uint64_t>(centre) % 2 == 0;
  return {(middle + Rational(std::nextafter(centre, -kFar))) / 2, (middle + Rational(std::nextafter(centre, kFar))) / 2,
          is_even, is_even};
}

double Lattice::width(double size) const {
  return is_of_doubles_ ? std::nextafter(size, kFar) - size : std::ldexp(1.0, exponent_);
}

std::optional<std::vector<geometry::Polygon>> snapped(const Polygon& polygon, const Lattice& lattice) {
  const geometry::Polygon rings = without_spikes(Snapping(polygon, lattice).polygon());
  if (!rings.outer.empty() && !find_defect(rings)) return std::vector{rings};
  std::vector<SourceSegment> segments;
  append_segments(segments, exactly(rings), 0);
  const auto inside = [](Winding w) { return w.shape > 0 ? 0 : -1; };
  std::vector<geometry::Polygon> parts;
  for (const Region& region : overlay(segments, inside, Seams::kDissolve).regions) {
    geometry::Polygon part = without_spikes(rounded(region.polygon));
    if (part.outer.empty()) continue;
    if (find_defect(part)) return {};
    parts.push_back(std::move(part));
  }
  return parts;
}

// ---- pieces

namespace {

// Returns the largest area that rounding can have moved across the ring: every edge at its longest, times the larger
// displacement of its two ends.
double moved_area(const Ring& ring, const geometry::Ring& rounded_ring) {
  std::vector<double> moved;
  moved.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Rational dx = ring[i].x - Rational(rounded_ring[i].x);
    const Rational dy = ring[i].y - Rational(rounded_ring[i].y);
    moved.push_back(std::abs(truncated_double(dx)) + std::abs(truncated_double(dy)));
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
    geometry::Polygon kept = without_spikes(nearest);
    if (!kept.outer.empty() && !find_defect(kept)) {
      add(std::move(kept), piece.part);
      return true;
    }
    // A piece whose area is at most the area that rounding moves has no width that doubles can express.
    if (truncated_double(exact_area) <= moved_area(piece.polygon, nearest)) {
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
  if (pieces.size() == 2 && pieces[0].part != pieces[1].part) {  // the usual cut: the parts decide
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
  if (defect != 0) return refuse(CutFailure::kInternal, "exact piece areas are off by " + digits_of(defect));
  Rounding rounding;
  for (const ExactPiece& piece : pieces) {
    if (!rounding.add(piece))
      return refuse(CutFailure::kInternal, "a piece is not a valid polygon before it is rounded");
  }
  CutResult result = std::move(rounding).result();
  result.ledger.area_before = nearest_double(area_before);
  result.ledger.exact_defect = digits_of(defect);
  return result;
}

}  // namespace polynya::geometry::exact
