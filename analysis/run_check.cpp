#include "analysis/run_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "geometry/cut/overlap.hpp"
#include "geometry/cut/overlapping_pairs.hpp"
#include "geometry/exact/exact_area.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/placed_floes.hpp"

namespace polynya::analysis {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Pose;
using simulation::FloeId;

void see(Worst& worst, double value, double scale, FloeId floe) {
  if (!(std::abs(value) <= std::abs(worst.value))) {
    worst.value = value;
    worst.floe = floe;
  }
  if (!(std::abs(value) <= kAreaTolerance * scale)) ++worst.wrong;
}

void check_shapes(const io::Run& run, RunCheck& check) {
  for (const io::RunFloe& floe : run.floes) {
    ++check.shapes;
    const simulation::BirthRecord& birth = floe.birth;
    const auto polygon = run.shape(birth.floe);
    if (const auto found = geometry::find_defect(*polygon)) {
      check.invalid.push_back({birth.floe, std::string(name_of(found->defect)), found->places});
    }
    const Polygon* const ring[]{polygon.get()};
    const double recorded[]{birth.area};
    see(check.recorded_area, geometry::exact_balance({}, ring, recorded), birth.area, birth.floe);
  }
}

void check_fracture(const io::Run& run, const simulation::Event& event, RunCheck& check) {
  ++check.fractures;
  std::vector<FloeId> children;
  const auto parent = run.shape(event.floe);
  std::vector<std::shared_ptr<const Polygon>> pieces;
  std::vector<const Polygon*> after;
  for (const FloeId child : event.children) {
    if (!run.floe(child)) continue;
    children.push_back(child);
    pieces.push_back(run.shape(child));
    after.push_back(pieces.back().get());
  }
  const double before = run.floe(event.floe)->birth.area;
  const Polygon* const parents[]{parent.get()};
  const double terms[]{event.submerged_area, event.brash_area, -event.rounding_defect};
  see(check.balance, geometry::exact_balance(after, parents, terms), before, event.floe);
  for (std::size_t i = 0; i < children.size(); ++i) {
    for (std::size_t j = i + 1; j < children.size(); ++j) {
      const auto shared = shared_area(*pieces[i], {}, *pieces[j], {});
      if (!shared) ++check.undecided;
      if (shared && *shared > kAreaTolerance * before) ++check.overlapping_siblings;
      if (shared && *shared > check.siblings.area)
        check.siblings = {children[i], children[j], event.time, *shared, 0};
    }
  }
}

/// A floe at an instant.
struct Placed {
  FloeId floe = 0;
  io::Motion motion;
  Pose world_from_body;
  Box box_in_world;
};

Placed placed(const simulation::BirthRecord& birth, const Polygon& polygon_in_body,
              const io::Motion& motion) {
  Placed floe{birth.floe, motion, pose_of(birth, motion), {}};
  const Box box = bounding_box(transform(floe.world_from_body, polygon_in_body.outer));
  floe.box_in_world = grown(box, 1e-9 * (1 + length(box.high - box.low)));
  return floe;
}

bool is_same_place(const io::Motion& a, const io::Motion& b) {
  return a.position == b.position && a.angle == b.angle;
}

double depth_in(const Polygon& polygon, Point point) {
  if (!contains(polygon, point)) return 0;
  double nearest = INFINITY;
  const auto see_ring = [&](const geometry::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      nearest = std::min(nearest, distance_to_segment(point, ring[i], ring[(i + 1) % ring.size()]));
  };
  see_ring(polygon.outer);
  std::ranges::for_each(polygon.holes, see_ring);
  return nearest;
}

/// Of the deepest outer vertex of `a` in `b` [m].
double deepest_vertex(const Polygon& a, const Polygon& b) {
  const Box box = bounding_box(b.outer);
  double depth = 0;
  for (const Point p : a.outer) {
    if (overlaps({p, p}, box)) depth = std::max(depth, depth_in(b, p));
  }
  return depth;
}

class OverlapCheck {
 public:
  OverlapCheck(const io::Run& run, RunCheck& check) : run_(run), check_(check), motions_(run) {}

  void measure(double time) {
    ++check_.instants;
    place_floes(time);
    double shared = 0;
    double ice = 0;
    for (const Placed& floe : floes_) ice += birth(floe.floe).area;
    for_near_pairs([&](const Placed& a, const Placed& b) {
      ++check_.pairs;
      const Known& known = shared_by(a, b);
      shared += known.area;
      if (known.area > geometry::kTouchingArea) overlapping_.insert({a.floe, b.floe});
      const SharedIce pair{a.floe, b.floe, time, known.area, known.depth};
      if (pair.area > check_.worst.area) check_.worst = pair;
      if (pair.depth > check_.deepest.depth) check_.deepest = pair;
    });
    if (shared > check_.most_shared || check_.instants == 1) {
      check_.most_shared = shared;
      check_.most_shared_time = time;
      check_.ice_then = ice;
    }
    check_.overlapping_pairs = overlapping_.size();
  }

 private:
  const simulation::BirthRecord& birth(FloeId floe) const { return run_.floe(floe)->birth; }

  void place_floes(double time) {
    std::map<FloeId, Placed> before;
    for (Placed& floe : floes_) before[floe.floe] = floe;
    floes_.clear();
    for (const io::RunFloe& floe : run_.floes) {
      if (!run_.is_alive(floe.birth.floe, time)) continue;
      const auto motion = motions_.floe_at(floe.birth.floe, time);
      if (!motion) continue;
      const auto known = before.find(floe.birth.floe);
      const bool is_still = known != before.end() && is_same_place(known->second.motion, *motion);
      floes_.push_back(is_still ? known->second : placed(floe.birth, *run_.shape(floe.birth.floe), *motion));
    }
    std::ranges::stable_sort(floes_, {}, [](const Placed& floe) { return floe.box_in_world.low.x; });
  }

  template <class Use>
  void for_near_pairs(Use use) const {
    for (std::size_t i = 0; i < floes_.size(); ++i) {
      const Box& box = floes_[i].box_in_world;
      for (std::size_t j = i + 1; j < floes_.size() && floes_[j].box_in_world.low.x <= box.high.x; ++j) {
        if (!overlaps(box, floes_[j].box_in_world)) continue;
        const bool is_first = floes_[i].floe < floes_[j].floe;
        use(is_first ? floes_[i] : floes_[j], is_first ? floes_[j] : floes_[i]);
      }
    }
  }

  /// What is known of a pair from the last instant it was measured.
  struct Known {
    bool is_set = false;
    io::Motion a, b;
    double area = 0;   ///< [m²]
    double depth = 0;  ///< 0 where they share less than kTouchingArea [m]
  };

  const Known& shared_by(const Placed& a, const Placed& b) {
    Known& known = known_[{a.floe, b.floe}];
    if (known.is_set && is_same_place(known.a, a.motion) && is_same_place(known.b, b.motion)) return known;
    const auto polygon_a = run_.shape(a.floe);
    const auto polygon_b = run_.shape(b.floe);
    const auto area = shared_area(*polygon_a, a.world_from_body, *polygon_b, b.world_from_body);
    if (!area) ++check_.undecided;
    known = {true, a.motion, b.motion, area.value_or(0), 0};
    if (known.area > geometry::kTouchingArea) {
      const Polygon first = polygon_in_world(*polygon_a, birth(a.floe).centroid_in_body, a.motion);
      const Polygon second = polygon_in_world(*polygon_b, birth(b.floe).centroid_in_body, b.motion);
      known.depth = std::max(deepest_vertex(first, second), deepest_vertex(second, first));
    }
    return known;
  }

  const io::Run& run_;
  RunCheck& check_;
  io::MotionIndex motions_;
  std::vector<Placed> floes_;  ///< living, by the left of their boxes
  std::map<std::pair<FloeId, FloeId>, Known> known_;
  std::set<std::pair<FloeId, FloeId>> overlapping_;
};

}  // namespace

RunCheck check_run(const io::Run& run, std::optional<double> only_at) {
  RunCheck check;
  check_shapes(run, check);
  for (const simulation::Event& event : run.events) {
    if (event.kind != simulation::EventKind::kRejectedCut) check_fracture(run, event, check);
  }
  OverlapCheck overlaps(run, check);
  if (only_at) {
    overlaps.measure(*only_at);
  } else {
    for (const io::Frame& frame : run.frames) overlaps.measure(frame.time);
  }
  return check;
}

}  // namespace polynya::analysis
