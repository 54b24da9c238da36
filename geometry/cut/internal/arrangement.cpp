#include "geometry/cut/internal/arrangement.hpp"

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>

#include <CGAL/Number_types/internal/Exact_type_selector.h>

/// CGAL's exact numbers are those of the other exact computations, whichever library they are of.
template <>
struct CGAL::internal::Exact_field_selector<double> {
  using Type = polynya::geometry::exact::Rational;
};

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/assertions_behaviour.h>

namespace polynya::geometry::exact {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<CGAL::Arr_segment_traits_2<Kernel>, std::size_t>;
using Arrangement = CGAL::Arrangement_2<Traits>;
using Vertex = Arrangement::Vertex_const_handle;
using Halfedge = Arrangement::Halfedge_const_handle;
using Face = Arrangement::Face_const_handle;

// CGAL reports a broken precondition by an exception, which the cut converts to a value, without a message to stderr.
void make_cgal_throw_quietly() {
  static const bool kDone = [] {
    CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});
    CGAL::set_warning_handler([](const char*, const char*, const char*, int, const char*) {});
    CGAL::set_error_behaviour(CGAL::THROW_EXCEPTION);
    return true;
  }();
  static_cast<void>(kDone);
}

static_assert(std::is_same_v<Kernel::FT::ET, Rational>, "CGAL computes in the rationals of internal/exact_polygon.hpp");

Kernel::Point_2 to_cgal(const Point& p) {
  return {Kernel::FT(p.x), Kernel::FT(p.y)};
}
Point from_cgal(const Kernel::Point_2& p) {
  return {p.x().exact(), p.y().exact()};
}

std::unique_ptr<const Arrangement> arrange(const std::vector<SourceSegment>& segments) {
  make_cgal_throw_quietly();
  std::vector<Traits::Curve_2> curves;
  curves.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    curves.emplace_back(Kernel::Segment_2(to_cgal(segments[i].from), to_cgal(segments[i].to)), i);
  }
  auto arrangement = std::make_unique<Arrangement>();
  CGAL::insert(*arrangement, curves.begin(), curves.end());
  return arrangement;
}

// Finds the faces, their windings and classes, and the regions that they form.
class Tracer {
 public:
  Tracer(const Arrangement& arrangement, const std::vector<SourceSegment>& segments, const Classifier& classify,
         Seams seams)
      : arrangement_(arrangement), segments_(segments), seams_(seams) {
    index_faces();
    wind_faces();
    for (const Winding& w : winding_) label_.push_back(classify(w));
    join_faces();
  }

  std::vector<Region> regions() {
    std::vector<Region> regions;
    std::unordered_map<std::size_t, std::size_t> region_of_root;
    std::unordered_set<const void*> visited;
    for (auto e = arrangement_.halfedges_begin(); e != arrangement_.halfedges_end(); ++e) {
      const std::size_t face = face_of(e);
      if (label_[face] < 0 || !is_boundary(e) || visited.count(&*e) != 0) continue;
      const auto [found, is_new] = region_of_root.try_emplace(root_of(face), regions.size());
      if (is_new) regions.push_back({{}, label_[face]});
      trace(e, visited, regions[found->second].polygon);
    }
    for (const Region& region : regions) {
      if (region.polygon.outer.empty()) throw OverlayFailure("a region has no outer ring");
    }
    return regions;
  }

  // Finds how the tool's segments lie in the shape's interior.
  void find_tool_inside(Overlay& result) const {
    for (auto e = arrangement_.edges_begin(); e != arrangement_.edges_end(); ++e) {
      const std::size_t left = face_of(e);
      const std::size_t right = face_of(e->twin());
      if (winding_[left].shape == 0 || winding_[right].shape == 0 || first_source(e) == 0) continue;
      result.tool_meets_interior = true;
      if (left != right) continue;
      result.dangling_length +=
          distance(rounded(from_cgal(e->source()->point())), rounded(from_cgal(e->target()->point())));
    }
  }

 private:
  std::size_t face_of(Halfedge e) const { return index_.at(&*e->face()); }

  std::size_t root_of(std::size_t face) const {
    while (parent_[face] != face) face = parent_[face];
    return face;
  }

  void index_faces() {
    for (auto f = arrangement_.faces_begin(); f != arrangement_.faces_end(); ++f) {
      index_.emplace(&*f, index_.size());
    }
  }

  // Returns the change of the winding when e is crossed from right to left.
  Winding step_over(Halfedge e) const {
    Winding step;
    const bool rightward = e->direction() == CGAL::ARR_LEFT_TO_RIGHT;
    for (const std::size_t s : e->curve().data()) {
      const auto& [from, to, source] = segments_[s];
      const bool runs_rightward = from.x < to.x || (from.x == to.x && from.y < to.y);
      (source == 0 ? step.shape : step.tool) += runs_rightward == rightward ? 1 : -1;
    }
    return step;
  }

  void wind_faces() {
    winding_.assign(index_.size(), {});
    std::vector<char> known(index_.size(), 0);
    std::vector<Face> open{arrangement_.unbounded_face()};
    known[index_.at(&*open.front())] = 1;
    while (!open.empty()) {
      const Face face = open.back();
      open.pop_back();
      const Winding here = winding_[index_.at(&*face)];
      const auto visit = [&](Halfedge e) {
        const std::size_t beyond = face_of(e->twin());
        if (known[beyond] != 0) return;
        known[beyond] = 1;
        const Winding step = step_over(e->twin());
        winding_[beyond] = {here.shape + step.shape, here.tool + step.tool};
        open.push_back(e->twin()->face());
      };
      for_each_ccb(face, visit);
    }
  }

  template <typename Visit>
  static void for_each_ccb(Face face, Visit visit) {
    const auto walk = [&visit](Arrangement::Ccb_halfedge_const_circulator start) {
      auto e = start;
      do visit(e);
      while (++e != start);
    };
    for (auto c = face->outer_ccbs_begin(); c != face->outer_ccbs_end(); ++c) walk(*c);
    for (auto c = face->inner_ccbs_begin(); c != face->inner_ccbs_end(); ++c) walk(*c);
  }

  // Returns true if a region ends at this edge. An edge with one face on both sides (a dangle, a bridge) bounds
  // nothing.
  bool is_boundary(Halfedge e) const {
    const std::size_t left = face_of(e);
    const std::size_t right = face_of(e->twin());
    if (left == right || (label_[left] < 0 && label_[right] < 0)) return false;
    return seams_ == Seams::kKeep || label_[left] != label_[right];
  }

  void join_faces() {
    parent_.resize(index_.size());
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (auto e = arrangement_.edges_begin(); e != arrangement_.edges_end(); ++e) {
      if (is_boundary(e)) continue;
      const std::size_t root = root_of(face_of(e));
      parent_[face_of(e)] = root;
      parent_[root] = root_of(face_of(e->twin()));
    }
    for (std::size_t face = 0; face < parent_.size(); ++face) parent_[face] = root_of(face);
  }

  // Returns the next boundary edge of the region, turning within the region's own wedge. If two parts touch in a point,
  // the walk stays in its part.
  Halfedge next_boundary(Halfedge e) const {
    Halfedge next = e->next();
    while (!is_boundary(next)) next = next->twin()->next();
    return next;
  }

  // Returns false only for a point through which one segment passes straight and that bounds no third region. Where the
  // tool runs along the shape, the shape's segments decide, so its own vertices stay.
  bool is_corner(Halfedge in, Halfedge out) const {
    const int source = std::min(first_source(in), first_source(out));
    for (const std::size_t s : in->curve().data()) {
      if (segments_[s].source != source) continue;
      for (const std::size_t t : out->curve().data()) {
        if (s == t) return regions_around(in->target()) > 2;
      }
    }
    return true;
  }

  int first_source(Halfedge e) const {
    int source = 1;
    for (const std::size_t s : e->curve().data()) source = std::min(source, segments_[s].source);
    return source;
  }

  // Returns the number of regions that touch in a vertex; everything that is left out counts as one region.
  std::size_t regions_around(Vertex v) const {
    std::set<std::size_t> roots;
    auto e = v->incident_halfedges();
    const auto start = e;
    do {
      const std::size_t face = face_of(e);
      roots.insert(label_[face] < 0 ? parent_.size() : root_of(face));
    } while (++e != start);
    return roots.size();
  }

  void trace(Halfedge start, std::unordered_set<const void*>& visited, Polygon& polygon) const {
    std::vector<Halfedge> walk;
    std::unordered_map<const void*, std::size_t> place;  // for each vertex: the edge of the walk that ends there
    Halfedge e = start;
    do {
      visited.insert(&*e);
      walk.push_back(e);
      const auto [seen, is_new] = place.try_emplace(&*e->target(), walk.size() - 1);
      if (!is_new) {
        // The walk has returned to a vertex: the part between is a separate ring that touches here.
        const std::size_t from = seen->second + 1;
        for (std::size_t i = from; i + 1 < walk.size(); ++i) place.erase(&*walk[i]->target());
        add_ring({walk.begin() + static_cast<std::ptrdiff_t>(from), walk.end()}, polygon);
        walk.resize(from);
      }
      e = next_boundary(e);
    } while (e != start);
    if (!walk.empty()) add_ring(walk, polygon);
  }

  void add_ring(const std::vector<Halfedge>& edges, Polygon& polygon) const {
    Ring ring;
    ring.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Halfedge out = edges[i + 1 == edges.size() ? 0 : i + 1];
      if (is_corner(edges[i], out)) ring.push_back(from_cgal(edges[i]->target()->point()));
    }
    const int turn = sign(area(ring));
    if (turn < 0) {
      polygon.holes.push_back(std::move(ring));
    } else if (turn > 0 && polygon.outer.empty()) {
      polygon.outer = std::move(ring);
    } else {
      throw OverlayFailure("a region has no single outer ring");
    }
  }

  const Arrangement& arrangement_;
  const std::vector<SourceSegment>& segments_;
  Seams seams_;
  std::unordered_map<const void*, std::size_t> index_;
  std::vector<Winding> winding_;
  std::vector<int> label_;
  std::vector<std::size_t> parent_;
};

}  // namespace

void append_segments(std::vector<SourceSegment>& segments, const Ring& ring, int source) {
  for_ring_edges(ring, [&](const Point& from, const Point& to) {
    if (!(from == to)) segments.push_back({from, to, source});
  });
}

void append_segments(std::vector<SourceSegment>& segments, const Polygon& polygon, int source) {
  append_segments(segments, polygon.outer, source);
  for (const Ring& hole : polygon.holes) append_segments(segments, hole, source);
}

Overlay overlay(const std::vector<SourceSegment>& segments, const Classifier& classify, Seams seams) try {
  const std::unique_ptr<const Arrangement> arrangement = arrange(segments);
  Tracer tracer(*arrangement, segments, classify, seams);
  Overlay result{tracer.regions()};
  tracer.find_tool_inside(result);
  return result;
} catch (const CGAL::Failure_exception& failure) {
  throw OverlayFailure(failure.what());
}

}  // namespace polynya::geometry::exact
