#include "analysis/run_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "fracture/crushing.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/box_tree.hpp"
#include "io/run/records.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::analysis {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Vector;
using simulation::FloeId;

using Body = simulation::ContactState::Body;
using BodyKey = std::int64_t;  ///< a floe's id, or −1 − the index of a hull
using PairKey = std::pair<BodyKey, BodyKey>;

BodyKey key_of(const Body& body) {
  return body.ship >= 0 ? -1 - BodyKey{body.ship} : body.floe;
}
bool is_hull(BodyKey body) {
  return body < 0;
}

/// Calls use(overlap) for each recorded crushed overlap at a time.
template <class Use>
void for_crushed(const io::Run& run, double time, Use use) {
  auto row = std::ranges::lower_bound(run.crushed, time, {}, &io::RunCrushed::time);
  for (; row != run.crushed.end() && row->time == time; ++row) use(row->overlap);
}

/// Compares the crushed ice of a run with the work that crushed it (crushed.csv), frame by frame, and stores the result
/// in its check.
class WorkCheck {
 public:
  WorkCheck(const io::Run& run, RunCheck& check) : run_(run), check_(check) {}

  void compare(double time) {
    double expected_then = 0;
    double work_then = 0;
    for_crushed(run_, time, [&](const simulation::CrushedOverlap& overlap) {
      const auto [first, second] =
          std::minmax(overlap.on, overlap.by, [](const Body& a, const Body& b) { return key_of(a) < key_of(b); });
      if (second.ship >= 0) return;  // steel on steel: no ice is crushed
      const fracture::Ice& of_second = ice_of(second);
      const fracture::Ice ice = first.ship >= 0 ? of_second : fracture::crushed_between(ice_of(first), of_second);
      const double expected = ice.compressive_strength * overlap.volume;
      expected_then += expected;
      work_then += overlap.work;
      const double smaller = std::min(area_of(first), area_of(second));
      if (overlap.volume > kUncrushedShare * smaller * ice.thickness)
        enter({key_of(first), key_of(second)}, {first, second, time, overlap.area, expected, overlap.work});
    });
    if (expected_then <= check_.most_expected) return;
    check_.most_expected = expected_then;
    check_.work_then = work_then;
  }

 private:
  const fracture::Ice& ice_of(const Body& floe) const {
    return simulation::ice_of(run_.scene.scene, run_.floe(floe.floe)->birth.own_ice);
  }

  /// Area of a body [m²].
  double area_of(const Body& body) const {
    if (body.ship < 0) return run_.floe(body.floe)->birth.area;
    return geometry::measure({hull_of(run_.scene.scene, static_cast<std::size_t>(body.ship)).hull.waterline, {}}).area;
  }

  /// Stores a difference. Of a pair that differs at several frames, the frame with the largest expected area is kept.
  void enter(const PairKey& pair, const UnpaidOverlap& overlap) {
    compared_.insert(pair);
    check_.paid_pairs = compared_.size();
    if (kMostWorkFactor * overlap.work >= overlap.expected && overlap.work <= kMostWorkFactor * overlap.expected)
      return;
    const auto [known, is_new] = unpaid_.try_emplace(pair, check_.unpaid.size());
    if (is_new)
      check_.unpaid.push_back(overlap);
    else if (overlap.expected > check_.unpaid[known->second].expected)
      check_.unpaid[known->second] = overlap;
  }

  const io::Run& run_;
  RunCheck& check_;
  std::set<PairKey> compared_;
  std::map<PairKey, std::size_t> unpaid_;  ///< index in the check's list
};

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

/// Returns the depth of the deepest outer vertex of `a` in `b` [m].
double deepest_vertex(const Polygon& a, const Polygon& b) {
  const Box box = bounding_box(b.outer);
  double depth = 0;
  for (const Point p : a.outer) {
    if (overlaps({p, p}, box)) depth = std::max(depth, depth_in(b, p));
  }
  return depth;
}

Box common_part(const Box& a, const Box& b) {
  return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y)},
          {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y)}};
}

void see(Worst& worst, double value, double scale, FloeId floe) {
  if (!(std::abs(value) <= std::abs(worst.value))) {
    worst.value = value;
    worst.floe = floe;
  }
  if (!(std::abs(value) <= kAreaTolerance * scale)) ++worst.wrong;
}

void check_shape(const io::Run& run, const simulation::BirthRecord& birth, RunCheck& check) {
  ++check.shapes;
  const auto polygon = run.shape(birth.floe);
  if (const auto found = geometry::find_defect(*polygon))
    check.invalid.push_back({birth.floe, std::string(name_of(found->defect)), found->places});
  const Polygon* const ring[]{polygon.get()};
  const double recorded[]{birth.area};
  see(check.recorded_area, geometry::exact_balance({}, ring, recorded), birth.area, birth.floe);
}

void check_fracture(const io::Run& run, const simulation::Event& event, RunCheck& check) {
  const simulation::IceEvent& ice = *event.ice();
  const auto* stays = std::get_if<simulation::StayUnder>(&event.what);
  const double under_ice = stays ? stays->under_ice_area : 0;
  ++check.fractures;
  std::vector<FloeId> children;
  const auto parent = run.shape(ice.floe);
  std::vector<std::shared_ptr<const Polygon>> pieces;
  std::vector<const Polygon*> after;
  for (const FloeId child : ice.children) {
    if (!run.floe(child)) continue;
    children.push_back(child);
    pieces.push_back(run.shape(child));
    after.push_back(pieces.back().get());
  }
  const double before = run.floe(ice.floe)->birth.area;
  const Polygon* const parents[]{parent.get()};
  const double terms[]{ice.submerged_area, under_ice, ice.brash_area, -ice.rounding_defect};
  see(check.balance, geometry::exact_balance(after, parents, terms), before, ice.floe);
  for (std::size_t i = 0; i < children.size(); ++i) {
    for (std::size_t j = i + 1; j < children.size(); ++j) {
      const auto shared = shared_area(*pieces[i], {}, *pieces[j], {});
      if (!shared) ++check.undecided;
      if (shared && *shared > kAreaTolerance * before) ++check.overlapping_siblings;
      if (shared && *shared > check.siblings.area) check.siblings = {children[i], children[j], event.time, *shared, 0};
    }
  }
}

/// Measures the exact overlaps of the bodies of a run, instant by instant, and stores the result in its check.
class OverlapCheck {
 public:
  OverlapCheck(const io::Run& run, RunCheck& check) : run_(run), check_(check), motions_(run) {
    for (std::size_t i = 0; i < hull_count(run.scene.scene); ++i)
      hulls_.push_back(std::make_shared<Polygon>(Polygon{hull_of(run.scene.scene, i).hull.waterline, {}}));
  }

  void measure(double time) {
    ++check_.instants;
    place_bodies(time);
    read_crushed(time);
    double shared = 0;
    double ice = 0;
    for (const Placed& body : bodies_) ice += is_hull(body.body) ? 0 : body.area;
    for_near_pairs([&](const Placed& a, const Placed& b) {
      if (is_hull(a.body) && is_hull(b.body)) return;  // no ice is involved; events.ndjson records contacts of hulls
      ++(is_hull(a.body) ? check_.hull_pairs : check_.pairs);
      const Known& known = shared_by(a, b);
      if (is_recorded_) compare_with_crushed(a, b, known.area, time);
      const SharedIce pair{is_hull(a.body) ? simulation::kNoFloe : a.body, b.body, time, known.area, known.depth};
      if (is_hull(a.body)) {
        if (pair.area > check_.worst_with_hull.area) {
          check_.worst_with_hull = pair;
          check_.worst_hull = static_cast<int>(-1 - a.body);
        }
        return;
      }
      shared += known.area;
      if (known.area > geometry::kTouchingArea) overlapping_.insert({a.body, b.body});
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
  struct Placed {
    BodyKey body = 0;
    io::Motion motion;
    geometry::Pose world_from_body;
    geometry::Box box_in_world;
    double area = 0;    ///< [m²]
    double radius = 0;  ///< radius about the middle of its box [m]
  };
  /// Results for a pair at the instant at which it was measured last.
  struct Known {
    bool is_set = false;
    io::Motion a, b;
    double area = 0;   ///< [m²]
    double depth = 0;  ///< 0 if they share less than kTouchingArea [m]
  };

  std::shared_ptr<const Polygon> polygon_of(BodyKey body) const {
    return is_hull(body) ? hulls_[static_cast<std::size_t>(-1 - body)] : run_.shape(body);
  }

  Point centre_of(BodyKey body) const { return is_hull(body) ? Point{} : run_.floe(body)->birth.centroid_in_body; }

  Body name_of(BodyKey body) const {
    if (is_hull(body)) return {static_cast<int>(-1 - body), simulation::kNoFloe};
    return {-1, body};
  }

  Placed placed(BodyKey body, const io::Motion& motion) const {
    const auto polygon = polygon_of(body);
    const auto rotation = geometry::Rotation::by(motion.angle);
    Placed placed{body, motion, {motion.position - rotate(rotation, centre_of(body) - Point{}), rotation}, {}, 0, 0};
    if (!is_hull(body)) placed.world_from_body = pose_of(run_.floe(body)->birth, motion);
    const Box box = bounding_box(transform(placed.world_from_body, polygon->outer));
    placed.box_in_world = grown(box, 1e-9 * (1 + length(box.high - box.low)));
    placed.area = is_hull(body) ? geometry::measure(*polygon).area : run_.floe(body)->birth.area;
    placed.radius = 0.5 * length(box.high - box.low);
    return placed;
  }

  void place_bodies(double time) {
    std::map<BodyKey, Placed> before;
    for (Placed& body : bodies_) before[body.body] = body;
    bodies_.clear();
    const auto add = [&](BodyKey body, const std::optional<io::Motion>& motion) {
      if (!motion) return;
      const auto known = before.find(body);
      const bool is_still = known != before.end() && is_same_place(known->second.motion, *motion);
      bodies_.push_back(is_still ? known->second : placed(body, *motion));
      bodies_.back().motion = *motion;
    };
    for (std::size_t hull = 0; hull < hulls_.size(); ++hull)
      add(-1 - static_cast<BodyKey>(hull), motions_.ship_at(hull, time));
    for (const io::RunFloe& floe : run_.floes) {
      if (run_.is_alive(floe.birth.floe, time)) add(floe.birth.floe, motions_.floe_at(floe.birth.floe, time));
    }
  }

  void read_crushed(double time) {
    crushed_.clear();
    is_recorded_ =
        run_.has_crushed && std::ranges::any_of(run_.frames, [&](const io::Frame& f) { return f.time == time; });
    for_crushed(run_, time, [&](const simulation::CrushedOverlap& overlap) {
      crushed_[std::minmax({key_of(overlap.on), key_of(overlap.by)})] = overlap;
      if (overlap.unpaid > check_.most_in_contact.in_contact)
        check_.most_in_contact = {.first = overlap.on,
                                  .second = overlap.by,
                                  .time = time,
                                  .crushed = overlap.area + overlap.tilted,
                                  .in_contact = overlap.unpaid};
    });
  }

  template <class Use>
  void for_near_pairs(Use use) const {
    const auto box_of = [](const Placed& body) { return body.box_in_world; };
    for (const auto& [i, j] : geometry::pairs_of_boxes(geometry::boxes_of(bodies_, box_of))) {
      const bool is_first = bodies_[i].body < bodies_[j].body;
      use(is_first ? bodies_[i] : bodies_[j], is_first ? bodies_[j] : bodies_[i]);
    }
  }

  const Known& shared_by(const Placed& a, const Placed& b) {
    Known& known = known_[{a.body, b.body}];
    if (known.is_set && is_same_place(known.a, a.motion) && is_same_place(known.b, b.motion)) return known;
    const auto polygon_a = polygon_of(a.body);
    const auto polygon_b = polygon_of(b.body);
    const auto area = shared_area(*polygon_a, a.world_from_body, *polygon_b, b.world_from_body);
    if (!area) ++check_.undecided;
    known = {true, a.motion, b.motion, area.value_or(0), 0};
    if (known.area > geometry::kTouchingArea) {
      const Polygon first = polygon_in_world(*polygon_a, centre_of(a.body), a.motion);
      const Polygon second = polygon_in_world(*polygon_b, centre_of(b.body), b.motion);
      known.depth = std::max(deepest_vertex(first, second), deepest_vertex(second, first));
    }
    return known;
  }

  void compare_with_crushed(const Placed& a, const Placed& b, double shared, double time) {
    const auto recorded = crushed_.find({a.body, b.body});
    const simulation::CrushedOverlap of_pair =
        recorded != crushed_.end() ? recorded->second : simulation::CrushedOverlap{};
    const double crushed = of_pair.area + of_pair.tilted;
    const double beyond = shared - crushed - of_pair.unpaid;
    const double smaller = std::min(a.area, b.area);
    if (beyond <= kUncrushedShare * smaller) return;
    // Allow for the delay of one step after which contacts and crushed ice are recorded, and for the accuracy of
    // frames.
    const Box common = common_part(a.box_in_world, b.box_in_world);
    const Placed& small = a.radius < b.radius ? a : b;
    const Placed& large = a.radius < b.radius ? b : a;
    const Vector arm = small.motion.position - large.motion.position;
    const double speed =
        length(small.motion.velocity - large.motion.velocity - cross(large.motion.angular_velocity, arm)) +
        std::abs(small.motion.angular_velocity - large.motion.angular_velocity) * small.radius;
    const double off = 2 * io::kFramePositionTolerance + io::kFrameAngleTolerance * (a.radius + b.radius);
    const double allowed =
        kUncrushedShare * smaller + (run_.scene.scene.time.step * speed + off) * length(common.high - common.low);
    if (beyond <= allowed) return;
    ++check_.uncrushed_pairs;
    if (check_.uncrushed.size() < kMostUncrushed)
      check_.uncrushed.push_back({name_of(a.body), name_of(b.body), time, shared, crushed, of_pair.unpaid, allowed,
                                  midpoint(common.low, common.high)});
  }

  const io::Run& run_;
  RunCheck& check_;
  io::MotionIndex motions_;
  std::vector<std::shared_ptr<const geometry::Polygon>> hulls_;
  std::vector<Placed> bodies_;                             ///< bodies that exist at the instant
  std::map<PairKey, simulation::CrushedOverlap> crushed_;  ///< crushed overlaps at the instant
  bool is_recorded_ = false;                               ///< true if the instant is the time of a frame
  std::map<PairKey, Known> known_;
  std::set<PairKey> overlapping_;
};

}  // namespace

RunCheck check_run(const io::Run& run, std::optional<double> only_at, const std::function<void(double)>& on_part) {
  RunCheck check;
  check.files = io::check_files(run.folder);
  check.has_crushed = run.has_crushed;
  const std::size_t instants = only_at ? 1 : run.frames.size();
  // For the progress, an instant counts as much as checking an eighth of the shapes, since most pairs have not moved.
  const double all = static_cast<double>(run.floes.size()) * (1 + static_cast<double>(instants) / 8) +
                     static_cast<double>(run.events.size());
  double done = 0;
  const auto advance = [&](double work) {
    done += work;
    if (on_part && all > 0) on_part(std::min(1.0, done / all));
  };
  for (const io::RunFloe& floe : run.floes) {
    check_shape(run, floe.birth, check);
    advance(1);
  }
  for (const simulation::Event& event : run.events) {
    if (event.ends_floe()) check_fracture(run, event, check);
    advance(1);
  }
  OverlapCheck overlaps(run, check);
  WorkCheck work(run, check);
  for (std::size_t i = 0; i < instants; ++i) {
    const double time = only_at ? *only_at : run.frames[i].time;
    overlaps.measure(time);
    work.compare(time);
    advance(static_cast<double>(run.floes.size()) / 8);
  }
  check.final_places = compare_final_places(run);
  return check;
}

// ---- texts of the results

namespace {

using io::counted;
using io::id_or_none;
using io::JsonWriter;

void add_hulls_and_crushed(std::string& text, const RunCheck& check, const simulation::Scene& scene) {
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  if (check.worst_with_hull.area > 0)
    add(fmt::format(
        "hulls      {} with floes whose boxes meet; largest: {} and floe {} at {:.6g} s, {:.6g} m2, a "
        "vertex {:.4g} m deep",
        counted(check.hull_pairs, "pair"), io::hull_name(scene, check.worst_hull), check.worst_with_hull.second,
        check.worst_with_hull.time, check.worst_with_hull.area, check.worst_with_hull.depth));
  if (!check.has_crushed) {
    add("crushed    not on record (no crushed.csv): overlaps are measured, not judged");
  } else {
    add(fmt::format("crushed    {} more than was crushed there, presses in a contact, and {:g} % of the smaller body",
                    check.uncrushed_pairs == 1 ? "1 pair shares" : fmt::format("{} pairs share", check.uncrushed_pairs),
                    100 * kUncrushedShare));
    const auto name = [&](const simulation::ContactState::Body& body) {
      return body.ship >= 0 ? std::string(io::hull_name(scene, body.ship)) : fmt::format("floe {}", body.floe);
    };
    for (const UncrushedOverlap& pair : check.uncrushed)
      add(
          fmt::format("           {} and {} at {:.6g} s about ({:.3f}, {:.3f}): {:.6g} m2 shared, {:.6g} m2 crushed, "
                      "{:.6g} m2 in contact, {:.6g} m2 beyond these allowed",
                      name(pair.first), name(pair.second), pair.time, pair.place_in_world.x, pair.place_in_world.y,
                      pair.shared, pair.crushed, pair.in_contact, pair.allowed));
    if (const UncrushedOverlap& most = check.most_in_contact; most.in_contact > 0)
      add(fmt::format("           most in contact that is not crushed yet: {} and {} at {:.6g} s, {:.6g} m2",
                      name(most.first), name(most.second), most.time, most.in_contact));
    add(fmt::format("work       {} of more than that; {} from the work on record by more than a factor of {:g}",
                    counted(check.paid_pairs, "crushed overlap"),
                    check.unpaid.size() == 1 ? "1 differs" : fmt::format("{} differ", check.unpaid.size()),
                    kMostWorkFactor));
    add(fmt::format(
        "           most at once, smaller overlaps included: {:.6g} kJ by what is crushed, {:.6g} kJ on record",
        1e-3 * check.most_expected, 1e-3 * check.work_then));
    for (std::size_t i = 0; i < std::min(check.unpaid.size(), kMostUncrushed); ++i) {
      const UnpaidOverlap& pair = check.unpaid[i];
      add(fmt::format("           {} and {} at {:.6g} s: {:.6g} m2 crushed, which takes {:.6g} kJ; {:.6g} kJ on record",
                      name(pair.first), name(pair.second), pair.time, pair.area, 1e-3 * pair.expected,
                      1e-3 * pair.work));
    }
  }
}

void write_worst(JsonWriter& json, std::string_view key, const Worst& worst) {
  json.key(key).open('{').key("largest_m2").value(worst.value);
  json.key("floe_id").value(id_or_none(worst.floe)).key("wrong").value(worst.wrong).close('}');
}

void write_shared(JsonWriter& json, std::string_view key, const SharedIce& shared) {
  json.key(key);
  if (shared.first == simulation::kNoFloe) {
    json.null();
    return;
  }
  json.open('{').key("floe_ids").list(std::array{shared.first, shared.second});
  json.key("t_s").value(shared.time).key("area_m2").value(shared.area).key("depth_m").value(shared.depth);
  json.close('}');
}

void write_hulls(JsonWriter& json, const RunCheck& check, const simulation::Scene& scene) {
  const auto write_body = [&](std::string_view key, const simulation::ContactState::Body& body) {
    json.key(key);
    if (body.ship >= 0)
      json.value(io::hull_name(scene, body.ship));
    else
      json.value(body.floe);
  };
  json.key("hull_pairs").value(check.hull_pairs).key("largest_overlap_with_hull");
  if (check.worst_hull >= 0) {
    json.open('{').key("ship").value(io::hull_name(scene, check.worst_hull));
    json.key("floe_id").value(check.worst_with_hull.second).key("t_s").value(check.worst_with_hull.time);
    json.key("area_m2").value(check.worst_with_hull.area).key("depth_m").value(check.worst_with_hull.depth);
    json.close('}');
  } else {
    json.null();
  }
  json.key("has_crushed").value(check.has_crushed).key("uncrushed_pairs").value(check.uncrushed_pairs);
  json.key("uncrushed").object_lines(check.uncrushed, [&](const UncrushedOverlap& pair) {
    write_body("first", pair.first);
    write_body("second", pair.second);
    json.key("t_s").value(pair.time).key("place_m").value(pair.place_in_world);
    json.key("shared_m2").value(pair.shared).key("crushed_m2").value(pair.crushed);
    json.key("in_contact_m2").value(pair.in_contact);
    json.key("allowed_beyond_m2").value(pair.allowed);
  });
  json.key("compared_with_work").value(check.paid_pairs).key("most_expected_J").value(check.most_expected);
  json.key("crushing_then_J").value(check.work_then);
  json.key("unpaid").object_lines(check.unpaid, [&](const UnpaidOverlap& pair) {
    write_body("first", pair.first);
    write_body("second", pair.second);
    json.key("t_s").value(pair.time).key("crushed_m2").value(pair.area);
    json.key("expected_J").value(pair.expected).key("crushing_J").value(pair.work);
  });
}

}  // namespace

std::string to_text(const RunCheck& check, const simulation::Scene& scene) {
  std::string text;
  const auto add = [&text](const std::string& line) { text += line + "\n"; };
  const auto from = [](FloeId floe) {
    return floe == simulation::kNoFloe ? std::string() : fmt::format(" (floe {})", floe);
  };
  add(!check.files.has_checksums ? std::string("files      without checksums: of an older version, or not finished")
                                 : fmt::format("files      {} compared with checksums, {} damaged",
                                               counted(check.files.files, "file"), check.files.damaged.size()));
  for (const std::string& file : check.files.damaged) add("           " + file);
  add(fmt::format("validity   {}, {} invalid", counted(check.shapes, "shape"), check.invalid.size()));
  for (const InvalidFloe& floe : check.invalid) {
    add(fmt::format("           floe {}: {}{}", floe.floe, floe.defect, io::places_in_words(floe.places_in_body, 4)));
  }
  add(fmt::format("areas      recorded - ring at most {:.2e} m2{}, {} beyond {:g} of the area",
                  check.recorded_area.value, from(check.recorded_area.floe), check.recorded_area.wrong,
                  kAreaTolerance));
  add(
      fmt::format("fractures  {}: pieces + submerged + brash - rounding - parent at most {:.2e} m2{}, {} "
                  "beyond {:g} of it",
                  check.fractures, check.balance.value, from(check.balance.floe), check.balance.wrong, kAreaTolerance));
  add(check.siblings.area > 0 ? fmt::format("           pieces of one fracture share at most {:.2e} m2 in "
                                            "their body frame (floes {} and {})",
                                            check.siblings.area, check.siblings.first, check.siblings.second)
                              : "           pieces of one fracture share 0 m2 in their body frame, exactly");
  add(fmt::format("overlap    {}, {} with boxes that meet, {} not decided; {} more than 1e-6 m2 at some instant",
                  counted(check.instants, "instant"), counted(check.pairs, "pair"), check.undecided,
                  check.overlapping_pairs == 1 ? "1 pair of floes shares"
                                               : fmt::format("{} pairs of floes share", check.overlapping_pairs)));
  add(fmt::format("           most at once {:.6g} m2 at {:.6g} s, {:.2e} of the {:.6g} m2 of ice", check.most_shared,
                  check.most_shared_time, check.ice_then > 0 ? check.most_shared / check.ice_then : 0, check.ice_then));
  const auto add_pair = [&](const char* words, const SharedIce& pair) {
    if (pair.first == simulation::kNoFloe) return;
    add(fmt::format("           {}: floes {} and {} at {:.6g} s, {:.6g} m2, a vertex {:.4g} m deep", words, pair.first,
                    pair.second, pair.time, pair.area, pair.depth));
  };
  add_pair("largest", check.worst);
  add_pair("deepest", check.deepest);
  add_hulls_and_crushed(text, check, scene);
  add("           Overlap is part of the contact model: ice in contact is let in by what it crushes, and "
      "frames are right to");
  add("           1 mm and 1e-5 rad. All areas are exact for the rings and poses on record.");
  add_text(text, check.final_places);
  add(check.is_sound() ? "sound" : "NOT SOUND");
  return text;
}

std::string to_json_text(const RunCheck& check, const simulation::Scene& scene) {
  const auto write = [&](JsonWriter& json) {
    json.key("is_sound").value(check.is_sound()).key("has_checksums").value(check.files.has_checksums);
    json.key("files").value(check.files.files).key("damaged_files").list(check.files.damaged);
    json.key("shapes").value(check.shapes);
    json.key("invalid").objects(check.invalid, [&](const InvalidFloe& floe) {
      json.key("floe_id").value(floe.floe).key("defect").value(floe.defect).key("places_m").value(floe.places_in_body);
    });
    write_worst(json, "recorded_area", check.recorded_area);
    json.key("fractures").value(check.fractures);
    write_worst(json, "balance", check.balance);
    json.key("overlapping_siblings").value(check.overlapping_siblings);
    json.key("most_shared_by_siblings_m2").value(check.siblings.area);
    json.key("moments").value(check.instants).key("pairs").value(check.pairs);
    json.key("undecided").value(check.undecided).key("overlapping_pairs").value(check.overlapping_pairs);
    json.key("most_shared_m2").value(check.most_shared).key("most_shared_s").value(check.most_shared_time);
    json.key("ice_then_m2").value(check.ice_then);
    write_shared(json, "largest_overlap", check.worst);
    write_shared(json, "deepest_overlap", check.deepest);
    write_hulls(json, check, scene);
    write_members(json, check.final_places);
  };
  return io::json_object(write, JsonWriter::Layout::kIndented);
}

}  // namespace polynya::analysis
