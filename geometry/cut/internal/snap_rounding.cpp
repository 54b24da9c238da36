#include "geometry/cut/internal/snap_rounding.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/weld.hpp"
#include "geometry/exact/internal/edge_tree.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::geometry::exact {
namespace {

// The part of an edge that lies in a cell: from `first` to `last` along it, of 0 to 1.
struct Stretch {
  Rational first = 0;
  Rational last = 1;
  bool has_first = true;
  bool has_last = true;

  bool is_empty() const { return first > last || (first == last && !(has_first && has_last)); }

  // Keeps what of from + t·along is in the cell.
  void clip(const Rational& from, const Rational& along, const Cell& cell) {
    const int direction = sgn(along);
    if (direction == 0) {
      const bool is_in = (cell.has_low ? from >= cell.low : from > cell.low) &&
                         (cell.has_high ? from <= cell.high : from < cell.high);
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

// A cell between an edge's ends that the edge passes through.
struct Bend {
  Stretch stretch;
  geometry::Point at;
};

// Farther from the line than cells reach, in doubles with room for their errors?
bool is_far(const Edge& e, geometry::Point p, const Lattice& lattice) {
  const double width =
      lattice.width(std::max({std::abs(e.a.x), std::abs(e.a.y), std::abs(e.b.x), std::abs(e.b.y)}));
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
      const auto precedes = [](const Bend& p, const Bend& q) {
        return std::tie(p.stretch.first, p.stretch.last) < std::tie(q.stretch.first, q.stretch.last);
      };
      std::sort(bends.begin(), bends.end(), precedes);
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
    for (std::size_t i = first; i < edges_.size(); ++i)
      edges_[i].b = edges_[i + 1 == edges_.size() ? first : i + 1].a;
  }

  // Rounding keeps order: an edge's points round to points in the box of its rounded ends.
  void find_bends() {
    geometry::Ring centres;
    for (const Edge& e : edges_) centres.push_back(e.a);
    const auto precedes = [](geometry::Point p, geometry::Point q) {
      return std::tie(p.x, p.y) < std::tie(q.x, q.y);
    };
    std::sort(centres.begin(), centres.end(), precedes);
    centres.erase(std::unique(centres.begin(), centres.end()), centres.end());
    const EdgeTree tree(edges_);
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
  std::vector<const Point*> starts_;  // of each edge
  std::vector<const Point*> ends_;
  std::vector<Edge> edges_;  // with rounded ends
  std::vector<std::vector<Bend>> bends_;
};

std::vector<Region> enclosed_regions(const geometry::Polygon& rings) {
  std::vector<SourceSegment> segments;
  append_segments(segments, exactly(rings), 0);
  const auto inside = [](Winding w) { return w.shape > 0 ? 0 : -1; };
  return overlay(segments, inside, Seams::kDissolve).regions;
}

}  // namespace

std::optional<std::vector<geometry::Polygon>> snapped(const Polygon& polygon, const Lattice& lattice) {
  const geometry::Polygon rings = welded(Snapping(polygon, lattice).polygon());
  if (!rings.outer.empty() && !find_defect(rings)) return std::vector{rings};
  std::vector<geometry::Polygon> parts;
  for (const Region& region : enclosed_regions(rings)) {
    geometry::Polygon part = welded(rounded(region.polygon));
    if (part.outer.empty()) continue;
    if (find_defect(part)) return {};
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace polynya::geometry::exact
