#include "geometry/cut/internal/window_pieces.hpp"

#include <algorithm>
#include <utility>

#include "geometry/exact/internal/predicates.hpp"

namespace polynya::geometry {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// The inner vertices of a far chain, in the direction of the step.
template <typename Append>
void for_each_inner(const WindowCut& cut, const WindowStep& step, Append append) {
  const FarChain& chain = cut.window.chains[at(step.chain)];
  const int n = static_cast<int>(cut.shape[chain.ring].size());
  for (int k = 1; k < chain.count; ++k)
    append(chain.ring, (chain.first + (step.is_forward ? k : chain.count - k)) % n);
}

Ring write(const WindowCut& cut, const WindowPieceRing& ring) {
  if (ring.far_ring >= 0) return cut.shape[ring.far_ring];
  Ring points;
  for (const WindowStep& step : ring.steps) {
    if (step.chain < 0) {
      points.push_back(cut.nearest[at(step.vertex)]);
    } else {
      for_each_inner(cut, step, [&](int r, int i) { points.push_back(cut.shape.point(r, i)); });
    }
  }
  return points;
}

exact::Ring write_exactly(const WindowCut& cut, const WindowPieceRing& ring) {
  exact::Ring points;
  if (ring.far_ring >= 0) {
    const int n = static_cast<int>(cut.shape[ring.far_ring].size());
    for (int i = 0; i < n; ++i) points.push_back(cut.shape.exact_point(ring.far_ring, i));
    return points;
  }
  for (const WindowStep& step : ring.steps) {
    if (step.chain < 0) {
      points.push_back(cut.overlay.graph.points[at(step.vertex)]);
    } else {
      for_each_inner(cut, step, [&](int r, int i) { points.push_back(cut.shape.exact_point(r, i)); });
    }
  }
  return points;
}

WindowPieceRing written(const WindowCut& cut, WindowRing steps, int far_ring) {
  WindowPieceRing ring{std::move(steps), far_ring, {}, {}, 0};
  ring.points = write(cut, ring);
  ring.area = ring_area(ring.points);
  const double clear = ring.area.doubt + 2 * ring.area.step_area;
  ring.turn = ring.area.area > clear
                  ? 1
                  : (-ring.area.area > clear ? -1 : sgn(exact::area(write_exactly(cut, ring))));
  return ring;
}

constexpr bool holds(const Box& outer, const Box& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

// Strictly inside the exact ring, on which the point is not. Rounding keeps order: nearest doubles decide
// wherever they differ.
bool encloses(const WindowCut& cut, const WindowPieceRing& ring, const exact::Point& p) {
  const Point near_p = exact::rounded(p);
  const exact::Ring exactly = write_exactly(cut, ring);
  bool inside = false;
  for (std::size_t i = 0; i < exactly.size(); ++i) {
    const std::size_t j = i + 1 == exactly.size() ? 0 : i + 1;
    const Point near_a = ring.points[i];
    const Point near_b = ring.points[j];
    if ((near_a.y > near_p.y && near_b.y > near_p.y) || (near_a.y < near_p.y && near_b.y < near_p.y))
      continue;
    if (near_a.x > near_p.x && near_b.x > near_p.x) continue;
    const exact::Point& a = exactly[i];
    const exact::Point& b = exactly[j];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if ((orientation(a, b, p) > 0) == (a.y > b.y)) inside = !inside;
  }
  return inside;
}

// Rings of one component whose shell is another's.
struct Homeless {
  std::vector<WindowPieceRing> rings;
  int component = 0;
};

class Planner {
 public:
  explicit Planner(const WindowCut& cut) : cut_(cut) {}

  // One outer ring at most: the graph knows which holes touch it.
  bool add(const RegionBoundary& boundary) {
    std::vector<WindowPieceRing> rings;
    for (const WindowRing& steps : boundary.rings) {
      WindowPieceRing ring = written(cut_, steps, -1);
      if (ring.turn == 0) return false;
      rings.push_back(std::move(ring));
    }
    return add(std::move(rings), boundary.label, boundary.component);
  }

  bool add(std::vector<WindowPieceRing> rings, int label, int component) {
    std::stable_partition(rings.begin(), rings.end(), [](const auto& ring) { return ring.turn > 0; });
    if (rings.front().turn < 0) {
      homeless_.push_back({std::move(rings), component});
      return true;
    }
    if (rings.size() > 1 && rings[1].turn > 0) return false;
    boxes_.push_back(bounding_box(rings.front().points));
    components_.push_back(component);
    pieces_.push_back({std::move(rings), label == 1 ? Part::kInside : Part::kOutside});
    return true;
  }

  std::optional<std::vector<WindowPiece>> pieces() {
    for (Homeless& group : homeless_) {
      const std::optional<std::size_t> home = home_of(group);
      if (!home) return {};
      std::move(group.rings.begin(), group.rings.end(), std::back_inserter(pieces_[*home].rings));
    }
    return std::move(pieces_);
  }

 private:
  // The innermost outer ring around the group, of another component. None where areas leave that open.
  std::optional<std::size_t> home_of(const Homeless& group) const {
    const WindowPieceRing& ring = group.rings.front();
    const Box box = bounding_box(ring.points);
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (components_[i] != group.component && holds(boxes_[i], box)) candidates.push_back(i);
    }
    if (candidates.size() == 1) return candidates.front();
    const exact::Point p = ring.far_ring >= 0 ? cut_.shape.exact_point(ring.far_ring, 0)
                                              : cut_.overlay.graph.points[at(first_vertex(ring.steps))];
    std::optional<std::size_t> home;
    for (const std::size_t i : candidates) {
      if (!encloses(cut_, pieces_[i].rings.front(), p)) continue;
      if (!home) {
        home = i;
        continue;
      }
      const RingArea& one = pieces_[i].rings.front().area;
      const RingArea& other = pieces_[*home].rings.front().area;
      const double doubt = one.doubt + other.doubt + 2 * (one.step_area + other.step_area);
      if (std::abs(one.area - other.area) <= doubt) return {};
      if (one.area < other.area) home = i;
    }
    return home;
  }

  static int first_vertex(const WindowRing& steps) {
    return steps.front().chain < 0 ? steps.front().vertex : steps[1].vertex;
  }

  const WindowCut& cut_;
  std::vector<WindowPiece> pieces_;
  std::vector<Box> boxes_;       // of each piece's outer ring
  std::vector<int> components_;  // of each piece
  std::vector<Homeless> homeless_;
};

}  // namespace

std::optional<std::vector<WindowPiece>> plan_pieces(const WindowCut& cut, const exact::Classifier& classify) {
  Planner planner(cut);
  for (const RegionBoundary& boundary : cut.overlay.boundaries) {
    if (!planner.add(boundary)) return {};
  }
  int component = cut.overlay.component_count;
  for (const int r : cut.window.far_rings) {
    std::vector<WindowPieceRing> rings;
    rings.push_back(written(cut, {}, r));
    if (rings.front().turn != (r == 0 ? 1 : -1)) return {};
    const int label = r == 0 ? classify({1, winding_left_of(cut.tool, cut.shape.exact_point(0, 0))}) : 0;
    if (!planner.add(std::move(rings), label, component++)) return {};
  }
  return planner.pieces();
}

exact::Polygon write_exactly(const WindowCut& cut, const WindowPiece& piece) {
  exact::Polygon polygon;
  for (const WindowPieceRing& ring : piece.rings)
    (polygon.outer.empty() ? polygon.outer : polygon.holes.emplace_back()) = write_exactly(cut, ring);
  return polygon;
}

}  // namespace polynya::geometry
