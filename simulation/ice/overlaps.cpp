#include <algorithm>
#include <span>
#include <utility>

#include "dynamics/chunks.hpp"
#include "dynamics/contact/paid_overlap.hpp"
#include "elementary/elementary.hpp"
#include "fracture/crushing.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/ice/pieces.hpp"
#include "simulation/world/limits.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {

// ---- overlaps are cut off

namespace {

using dynamics::Contact;
using dynamics::InseparableOverlap;

/// Condition under which an overlap is cut off.
enum class CutWhen {
  kAlways,
  kParts,  ///< only if two floes or more are left
};

/// An overlap of two bodies that is to be cut off a floe.
struct OverlapCut {
  BodyIndex a = 0;  ///< the pair of bodies, a < b
  BodyIndex b = 0;
  std::vector<geometry::Pose> a_from_b;  ///< relative poses of the two body frames at which the overlap is cut off
  geometry::Point middle;                ///< middle of the overlap, in the water frame [m]
  GrindCriterion criterion;              ///< criterion; the exact area of the cut is entered into it
  CutWhen when = CutWhen::kAlways;
};

/// Returns the force per metre at which the edge of a floe crushes, σ_c h [N/m].
double crushing_line_load(const fracture::Ice& ice) {
  return ice.compressive_strength * ice.thickness;
}

/// Returns the outline with which a body cuts a floe, in its own body frame [m].
geometry::Polygon tool_of(const Population& population, const Setup& setup, BodyIndex body) {
  const geometry::Polygon outline = population.is_hull(body)
                                        ? geometry::Polygon{hull_of(setup.scene, body).hull.waterline, {}}
                                        : population.floes[population.floe_of(body)].shape.polygon;
  return with_clearance(outline, population.bodies.centroid[body]);
}

/// Returns the event of a cut. `kind` has the members that differ between kinds of events.
template <class Kind>
Event event_of(const Population& population, const Instant& now, const OverlapCut& overlap, BodyIndex ground,
               Kind kind) {
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  kind.floe = population.floe_of(ground);
  kind.by_floe = population.floe_or_none(by);
  return {now.time, population.hull_or_none(by), overlap.middle + now.drift, std::move(kind)};
}

/// Returns true if a cut leaves two floes or more. Slivers and pieces that would become brash do not count.
bool is_parted(const Setup& setup, const geometry::CutResult& cut) {
  int floes = 0;
  for (const geometry::Piece& piece : cut.pieces) {
    const geometry::Measures measures = geometry::measure(piece.shape.polygon);
    floes += piece.part == geometry::Part::kOutside && can_be_floe(measures) &&
             measures.area >= setup.scene.fracture.smallest_floe_area;
  }
  return floes > 1;
}

/// Returns the area of the smaller of two bodies [m²].
double smaller_area(const Population& population, BodyIndex a, BodyIndex b) {
  return std::min(population.bodies.area[a], population.bodies.area[b]);
}

/// Returns true if the overlap of two bodies can still be cut: both exist and float, and geometry has not refused to
/// cut them.
bool can_cut(const Population& population, const Accounts& accounts, BodyIndex a, BodyIndex b) {
  const dynamics::Bodies& bodies = population.bodies;
  if (!bodies.is_alive[a] || !bodies.is_alive[b]) return false;  // broken in this step
  if (!population.is_hull(a) && !population.is_floating(population.floe_of(a))) return false;
  if (population.is_hull(b) || !population.is_floating(population.floe_of(b))) return false;
  return !is_refused(accounts, a, b);
}

/// Returns the body that loses the ice of an overlap: the floe if the other body is a hull; of two floes the weaker
/// one, or the smaller one if they are equally strong.
BodyIndex body_losing_ice(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b) {
  if (population.is_hull(a)) return b;
  const double stronger =
      crushing_line_load(ice_of_body(setup, population, a)) - crushing_line_load(ice_of_body(setup, population, b));
  if (stronger != 0) return stronger > 0 ? b : a;
  return population.bodies.area[a] < population.bodies.area[b] ? a : b;
}

/// Cuts an overlap from the floe that loses it, along the outline of the other body, and makes it brash (event
/// `grind`). Does nothing if the overlap is smaller than the criterion's least area, or if it should leave two floes
/// and does not. Returns true if the floe was cut. A cut that geometry refuses is recorded and not tried again.
bool cut_overlap(const Setup& setup, const Instant& now, const OverlapCut& overlap, Population& population,
                 Books books) {
  const BodyIndex ground = body_losing_ice(setup, population, overlap.a, overlap.b);
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  const geometry::Polygon outline = tool_of(population, setup, by);
  std::vector<geometry::Polygon> tools;
  for (const geometry::Pose& a_from_b : overlap.a_from_b)
    tools.push_back(transform(ground == overlap.a ? a_from_b : geometry::inverse(a_from_b), outline));
  const geometry::Shape& shape = population.floes[population.floe_of(ground)].shape;
  const geometry::CutOutcome outcome =
      tools.size() == 1 ? cut_by_polygon(shape, tools.front()) : cut_by_polygons(shape, tools);
  GrindCriterion criterion = overlap.criterion;
  if (outcome) {
    criterion.overlap_area = outcome->ledger.area_inside;
    if (criterion.overlap_area < criterion.least_area) return false;
    if (overlap.when == CutWhen::kParts && !is_parted(setup, *outcome)) return false;
    Event event = event_of(population, now, overlap, ground, Grind{{}, criterion});
    replace_by_pieces(setup, now,
                      {std::move(event), *outcome, InsideFate::kBrash, &EnergyFlows::grinding, &Counts::ground},
                      population, books);
    return true;
  }
  if (outcome.error().reason != geometry::CutFailure::kMisses) {  // otherwise the bodies have separated
    RejectedCut rejected =
        rejected_grind(criterion, shape.polygon, tools.front().outer, outcome.error(), books.accounts);
    books.journal.events.push_back(event_of(population, now, overlap, ground, std::move(rejected)));
    books.accounts.refused_grinds.emplace_back(overlap.a, overlap.b);
  }
  return false;
}

}  // namespace

// ---- growth of paid overlaps is added to the accounts of contacts

namespace {

/// The crushed part of an overlap's growth in a step.
struct CrushedGrowth {
  double share = 0;   ///< crushed area as a fraction of the growth [-]
  double height = 0;  ///< mean height of the ice that was crushed: its volume over its area [m]
};

/// Returns the crushed part of the growth of a contact's paid area. `thickness` is that of the ice [m]. If the ice edge
/// bends or tilts away from the hull, only `penetration_share` of the depth so far is crushed, and `crushed_share` of
/// the growth in the step. The crushed part of the overlap is as wide as the overlap is at the crushed depth.
CrushedGrowth crushed_growth(double thickness, const HullSlope& hull, const Contact& c) {
  const double after = c.record->paid_area, before = after - c.paid_by_work - c.paid_by_giving_way;
  if (!(after > before)) return {hull.crushed_share, thickness};
  const bool edge_stands = hull.crushed_share == 1 && hull.penetration_share == 1;
  if (edge_stands && hull.tangent == 0) return {1, thickness};  // most contacts: no crushed depth is needed
  const double deepest = std::max(c.depth, c.paid_depth);
  const auto crushed_area_at = [&](double area) {
    const double further = dynamics::depth_at(c, area) - deepest;
    return dynamics::area_at(c, std::max(0.0, hull.penetration_share * deepest + hull.crushed_share * further));
  };
  const double from = crushed_area_at(before), to = crushed_area_at(after);
  if (!(to > from)) return {hull.crushed_share, thickness};
  const double share = edge_stands ? 1 : std::min(1.0, (to - from) / (after - before));
  if (hull.tangent == 0) return {share, thickness};
  const fracture::Overlap overlap{c.width, c.depth, c.area};
  const double angle = elementary::atan(hull.tangent);
  const auto volume_of = [&](double area) { return fracture::crushed_volume(overlap, area, thickness, angle); };
  return {share, (volume_of(to) - volume_of(from)) / (to - from)};
}

/// Adds the growth of a contact's paid area in the step to its account. The area counts as crushed as far as work has
/// paid it and the ice edge stood still, and otherwise as tilted. The work is that of the normal force alone; friction
/// along an inclined hull does μ tan θ_s times that work.
void book(double thickness, double friction, const HullSlope& hull, const Contact& c) {
  dynamics::Booked& booked = c.record->booked;
  const CrushedGrowth growth = crushed_growth(thickness, hull, c);
  const double crushed = growth.share * c.paid_by_work;
  booked.volume += growth.height * crushed;
  booked.crushed += crushed;
  booked.tilted += c.paid_by_work - crushed + c.paid_by_giving_way;
  booked.work += hull.crushed_share * c.paying_work / (1 + friction * hull.tangent);
}

}  // namespace

void book_overlaps(const Setup& setup, const Step& step, const Population& population, const StepData& data) {
  const std::vector<double>& thickness = population.bodies.thickness;
  const double friction = setup.scene.ice.friction;
  dynamics::for_contacts(data.contacts, step.threads, [&](const Contact& c, std::size_t i) {
    if (c.total_normal_impulse() == 0 || c.is_rigid()) return;
    const bool is_at_hull = i < data.slopes.size();
    book(is_at_hull ? thickness[c.b] : std::min(thickness[c.a], thickness[c.b]), friction,
         is_at_hull ? data.slopes[i] : HullSlope{}, c);
  });
}

// ---- inseparable overlaps are ground

namespace {

/// Smallest inseparable overlap that is ground, as a fraction of the area of the smaller body [-]. Larger values leave
/// more overlap that nothing removes. Smaller values cut floes for overlaps that separate soon by themselves.
constexpr double kLeastInseparableShare = 0.005;

/// Returns the criterion by which an inseparable overlap is ground. For a body that lies wholly inside the other, the
/// overlap is the smaller body itself, and kInseparableShare applies to its mean width, area / (2 × bounding radius).
GrindCriterion criterion_of(const Population& population, const InseparableOverlap& overlap) {
  const dynamics::Bodies& bodies = population.bodies;
  const double smaller = smaller_area(population, overlap.a, overlap.b);
  GrindCriterion criterion{overlap.area, kLeastInseparableShare * smaller, overlap.width, overlap.least_width};
  if (overlap.is_inside) {
    const double radius =
        bodies.bounding_radius[bodies.area[overlap.a] < bodies.area[overlap.b] ? overlap.a : overlap.b];
    criterion.overlap_area = smaller;
    criterion.least_width = geometry::kInseparableShare * smaller / (2 * radius);
  }
  return criterion;
}

}  // namespace

void grind_inseparable_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                                Books books) {
  for (const InseparableOverlap& overlap : data.inseparable_overlaps) {
    if (!can_cut(population, books.accounts, overlap.a, overlap.b)) continue;
    const GrindCriterion criterion = criterion_of(population, overlap);
    if (criterion.overlap_area < criterion.least_area) continue;
    const geometry::Pose pose = dynamics::a_from_b(population.bodies, overlap.a, overlap.b);
    cut_overlap(setup, step.end, {overlap.a, overlap.b, {pose}, overlap.middle, criterion}, population, books);
  }
}

// ---- floes that hulls have come through are cut

namespace {

/// Returns true if a hull may have come through the floe of a contact. An overlap whose boundaries have a single
/// stretch each cannot divide the floe. Bodies of prescribed motion are left to carve_channels().
bool may_part(const Population& population, const Contact& c) {
  return !population.is_hull(c.b) && !are_prescribed(population.bodies, c.a, c.b) && c.record->is_pierced;
}

}  // namespace

void cut_through_floes(const Setup& setup, const Step& step, const StepData& data, Population& population,
                       Books books) {
  for (std::size_t i = 0; i < data.slopes.size(); ++i) {
    const Contact& c = data.contacts[i];
    if (!can_cut(population, books.accounts, c.a, c.b) || !may_part(population, c)) continue;
    const geometry::Pose pose = dynamics::a_from_b(population.bodies, c.a, c.b);
    cut_overlap(setup, step.end, {c.a, c.b, {pose}, c.middle(), {c.area, 0}, CutWhen::kParts}, population, books);
  }
}

// ---- crushed ice is shed

namespace {

/// Smallest crushed overlap that is cut off a floe while the contact lasts, as a fraction of the area of the smaller
/// body [-]. After the contact has ended, h² is the limit if it is smaller. Smaller values replace floes by new ones at
/// every touch; larger values leave more overlap when the bodies separate.
constexpr double kLeastCrushedShare = 0.005;

/// Returns the smallest crushed overlap that is cut off after a contact has ended [m²].
double least_parted(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b) {
  const double h = ice_of_body(setup, population, body_losing_ice(setup, population, a, b)).thickness;
  return std::min(kLeastCrushedShare * smaller_area(population, a, b), h * h);
}

/// All contacts of a pair.
struct Touching {
  std::span<const Contact> contacts;
  std::span<const HullSlope> slopes;  ///< slopes of the hull; empty for two floes

  bool is_pressing() const {
    return std::ranges::any_of(contacts, [](const Contact& c) { return c.total_normal_impulse() > 0; });
  }
  /// Returns true if the hull is vertical at all contacts. The force then depends on the width of the contact alone,
  /// and ice may be cut off while the bodies press. An inclined hull crushes a wedge, and a new edge would be crushed
  /// from its upper corner again.
  bool is_vertical() const {
    return std::ranges::all_of(slopes, [](const HullSlope& slope) { return slope.tangent == 0; });
  }
  double crushed_area() const {  ///< crushed area of the present overlaps [m²]
    double area = 0;
    for (const Contact& c : contacts) area += c.record->crushed.area > 0 ? std::min(c.area, c.record->paid_area) : 0;
    return area;
  }
  const Contact& largest() const {
    return *std::ranges::max_element(contacts, {}, [](const Contact& c) { return c.record->crushed.area; });
  }
};

/// Calls use(touching) for each pair that touched in the step.
template <class Use>
void for_touching(const StepData& data, Use use) {
  const std::span<const Contact> all(data.contacts);
  for (std::size_t first = 0; first < all.size();) {
    std::size_t end = first + 1;
    while (end < all.size() && all[end].a == all[first].a && all[end].b == all[first].b) ++end;
    const bool has_slopes = first < data.slopes.size();
    use(Touching{all.subspan(first, end - first),
                 has_slopes ? std::span(data.slopes).subspan(first, end - first) : std::span<const HullSlope>()});
    first = end;
  }
}

/// Returns the relative poses at which the crushed ice of a pair is cut off. The first is the pose at which the largest
/// overlap pressed. The second is the present pose, unless the bodies press each other: then the overlap that has grown
/// since the first pose is kept, so that the bodies stay in contact.
std::vector<geometry::Pose> poses_of(const dynamics::Bodies& bodies, const Touching& touching) {
  const Contact& c = touching.largest();
  std::vector<geometry::Pose> poses{c.record->crushed.a_from_b};
  if (!touching.is_pressing()) poses.push_back(dynamics::a_from_b(bodies, c.a, c.b));
  return poses;
}

/// Returns true if an area is most of a floe. A hull that takes no ice under it, such as a cone, has then moved over
/// the floe and crushed it.
bool is_most(const Population& population, const Contact& c, double area) {
  return area > 0.5 * population.bodies.area[c.b];
}

/// Returns true if a ship presses the edge of a floe down.
bool is_tilted(const Population& population, BodyIndex ship, BodyIndex floe) {
  return std::ranges::any_of(population.tilted, [&](const TiltedFloe& tilted) {
    return tilted.ship == ship && population.body_of(tilted.floe) == floe;
  });
}

/// Returns a body, or the pieces into which it broke in this step, in ascending order. Pieces have the body frame of
/// their parent.
std::vector<BodyIndex> left_of(const Population& population, const Instant& now, BodyIndex body) {
  if (population.bodies.is_alive[body]) return {body};
  const FloeId first = population.floe_of(body);
  std::vector<BodyIndex> left;
  for (FloeId id = population.floe_count() - 1; id > first && population.floes[id].born == now.time; --id) {
    FloeId ancestor = population.floes[id].parent;
    while (ancestor > first) ancestor = population.floes[ancestor].parent;
    if (ancestor == first && population.is_alive(id)) left.push_back(population.body_of(id));
  }
  std::ranges::sort(left);
  return left;
}

/// Cuts off the crushed ice of a contact that has ended.
void shed_parted(const Setup& setup, const Instant& now, const dynamics::PartedContact& parted, Population& population,
                 Books books) {
  for (const BodyIndex a : left_of(population, now, parted.a)) {
    for (const BodyIndex b : left_of(population, now, parted.b)) {
      const bool is_in_order = a < b;  // pieces have other indices than their parents
      const BodyIndex low = is_in_order ? a : b;
      const BodyIndex high = is_in_order ? b : a;
      // carve_channels() cuts the overlaps of bodies of prescribed motion.
      if (are_prescribed(population.bodies, low, high) || !can_cut(population, books.accounts, low, high)) continue;
      const double least = least_parted(setup, population, low, high);
      if (parted.crushed.area < least) continue;
      const geometry::Pose pose = parted.crushed.a_from_b;
      cut_overlap(
          setup, now,
          {low, high, {is_in_order ? pose : geometry::inverse(pose)}, parted.middle, {parted.crushed.area, least}},
          population, books);
    }
  }
}

/// Cuts off the crushed ice of the contacts of a pair that still touches, if it is large enough.
void shed_touching(const Setup& setup, const Instant& now, const Touching& touching, Population& population,
                   Books books) {
  const Contact& c = touching.contacts.front();
  const dynamics::Bodies& bodies = population.bodies;
  // a body has broken, and the records of its contacts may not exist any more
  if (!bodies.is_alive[c.a] || !bodies.is_alive[c.b]) return;
  const double crushed = touching.crushed_area();
  if (crushed == 0 || are_prescribed(bodies, c.a, c.b) || !can_cut(population, books.accounts, c.a, c.b)) return;
  const double least = kLeastCrushedShare * smaller_area(population, c.a, c.b);
  if (crushed < least || (touching.is_pressing() && !touching.is_vertical() && !is_most(population, c, crushed)))
    return;
  if (population.is_hull(c.a) && is_tilted(population, c.a, c.b)) return;
  const OverlapCut cut{c.a, c.b, poses_of(population.bodies, touching), touching.largest().middle(), {crushed, least}};
  std::vector<dynamics::CrushedIce> kept;  // cleared first, so that the pieces do not inherit it
  for (const Contact& contact : touching.contacts) kept.push_back(std::exchange(contact.record->crushed, {}));
  if (cut_overlap(setup, now, cut, population, books)) return;
  for (std::size_t i = 0; i < kept.size(); ++i) touching.contacts[i].record->crushed = kept[i];
}

}  // namespace

void shed_crushed_ice(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books) {
  for (const dynamics::PartedContact& parted : data.parted) shed_parted(setup, step.end, parted, population, books);
  for_touching(data, [&](const Touching& touching) { shed_touching(setup, step.end, touching, population, books); });
}

}  // namespace polynya::simulation
