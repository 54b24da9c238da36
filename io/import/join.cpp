#include "io/import/join.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Edge;
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

Box grown(Box box, double by) {
  return {{box.low.x - by, box.low.y - by}, {box.high.x + by, box.high.y + by}};
}

/// Disjoint sets with union.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }
  /// Returns the least member of the set that contains i.
  std::size_t find(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) {
    const auto [low, high] = std::minmax({find(i), find(j)});  // a pair of values, not of references to temporaries
    parents_[high] = low;
  }

 private:
  std::vector<std::size_t> parents_;
};

/// Joins the polygons of one group.
class Weld {
 public:
  Weld(const std::vector<Polygon>& polygons, std::vector<std::size_t> members, double reach)
      : polygons_(polygons), members_(std::move(members)), reach_(reach), sets_(members_.size()) {}

  std::vector<Joined> run() {
    gather();
    merge_vertices();
    split_edges();
    if (!find_shared_edges()) return {};
    return unions();
  }

 private:
  struct WeldRing {
    std::size_t member = 0;  ///< index in members_
    Ring points;
  };

  void gather() {
    for (std::size_t m = 0; m < members_.size(); ++m) {
      for (Ring& ring : geometry::rings_of(polygons_[members_[m]]))
        if (ring.size() > 2) rings_.push_back({m, std::move(ring)});
    }
  }

  /// Replaces vertices within reach of each other by the first of them.
  void merge_vertices() {
    std::vector<Point*> vertices;
    for (WeldRing& ring : rings_)
      for (Point& p : ring.points) vertices.push_back(&p);
    const auto boxes = geometry::boxes_of(vertices, [&](const Point* p) { return grown({*p, *p}, reach_ / 2); });
    DisjointSets same(vertices.size());
    for (const auto& [i, j] : geometry::pairs_of_boxes(boxes))
      if (distance(*vertices[i], *vertices[j]) <= reach_) same.unite(i, j);
    const auto places = [&] {
      std::vector<Point> all;
      for (const Point* p : vertices) all.push_back(*p);
      return all;
    }();
    for (std::size_t i = 0; i < vertices.size(); ++i) *vertices[i] = places[same.find(i)];
    for (WeldRing& ring : rings_) ring.points = geometry::without_repeats(ring.points);
  }

  /// Makes edges pass through the vertices that are within reach of them.
  void split_edges() {
    std::vector<Edge> edges;
    std::vector<Point> vertices;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const Ring& points = rings_[r].points;
      for (std::size_t i = 0; i < points.size(); ++i) {
        edges.push_back({points[i], points[(i + 1) % points.size()], static_cast<int>(r), static_cast<int>(i)});
        vertices.push_back(points[i]);
      }
    }
    const geometry::BoxTree tree(edges);
    std::map<std::pair<int, int>, std::vector<Point>> splits;
    for (const Point p : vertices) {
      tree.for_each_near(grown({p, p}, reach_), [&](std::size_t e) {
        const Edge& edge = edges[e];
        if (p == edge.a || p == edge.b) return true;
        if (distance(nearest_on_segment(edge.a, edge.b, p), p) <= reach_) splits[{edge.ring, edge.index}].push_back(p);
        return true;
      });
    }
    for (std::size_t r = 0; r < rings_.size(); ++r) rings_[r].points = with_splits(static_cast<int>(r), splits);
  }

  Ring with_splits(int r, std::map<std::pair<int, int>, std::vector<Point>>& splits) const {
    Ring result;
    const Ring& points = rings_[static_cast<std::size_t>(r)].points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      result.push_back(points[i]);
      const auto found = splits.find({r, static_cast<int>(i)});
      if (found == splits.end()) continue;
      std::ranges::sort(found->second, {},
                        [&](Point p) { return std::pair(squared_length(p - points[i]), std::pair(p.x, p.y)); });
      for (const Point p : found->second)
        if (p != result.back()) result.push_back(p);
    }
    return geometry::without_repeats(result);
  }

  /// Finds edges that are drawn in both directions, along which polygons were cut apart. Returns true if there are any.
  bool find_shared_edges() {
    using Ends = std::pair<std::pair<double, double>, std::pair<double, double>>;
    std::multimap<Ends, std::size_t> edges;
    const auto ends_of = [](Point a, Point b) { return Ends{{a.x, a.y}, {b.x, b.y}}; };
    const auto for_edges = [&](auto use) {
      for (const WeldRing& ring : rings_)
        for (std::size_t i = 0; i < ring.points.size(); ++i)
          use(ring.points[i], ring.points[(i + 1) % ring.points.size()], ring.member);
    };
    for_edges([&](Point a, Point b, std::size_t member) { edges.emplace(ends_of(a, b), member); });
    for_edges([&](Point a, Point b, std::size_t member) {
      const auto [first, last] = edges.equal_range(ends_of(b, a));
      for (auto other = first; other != last; ++other) {
        sets_.unite(member, other->second);
        shared_.insert(member);
        shared_.insert(other->second);
      }
    });
    return !shared_.empty();
  }

  std::vector<Joined> unions() {
    std::map<std::size_t, Joined> joined;
    for (const std::size_t member : shared_) joined[sets_.find(member)].members.push_back(members_[member]);
    std::vector<Joined> result;
    for (auto& [set, one] : joined) {
      std::vector<Ring> rings;
      for (const WeldRing& ring : rings_)
        if (sets_.find(ring.member) == set) rings.push_back(ring.points);
      const auto united = geometry::repair(rings, geometry::FillRule::kNonZero);
      if (!united) continue;
      for (const geometry::Shape& shape : united->shapes) one.polygons.push_back(shape.polygon);
      result.push_back(std::move(one));
    }
    return result;
  }

  const std::vector<Polygon>& polygons_;
  std::vector<std::size_t> members_;
  const double reach_;
  std::vector<WeldRing> rings_;
  DisjointSets sets_;
  std::set<std::size_t> shared_;
};

}  // namespace

std::vector<Joined> join(const std::vector<Polygon>& polygons, const std::vector<std::size_t>& groups, double reach) {
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < polygons.size(); ++i) members[groups[i]].push_back(i);
  std::vector<Joined> result;
  for (auto& [group, of_group] : members) {
    for (Joined& one : Weld(polygons, std::move(of_group), reach).run()) result.push_back(std::move(one));
  }
  return result;
}

}  // namespace polynya::io
