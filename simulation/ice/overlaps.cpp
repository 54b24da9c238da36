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

// ---- what two bodies share is cut off

namespace {

using dynamics::BlindOverlap;
using dynamics::Contact;

/// Which overlaps are cut off.
enum class CutWhen {
  kAlways,
  kParts,  ///< where two floes or more are left
};

/// What a floe loses to another body that is in it.
struct OverlapCut {
  BodyIndex a = 0;  ///< the pair
  BodyIndex b = 0;
  std::vector<geometry::Pose> a_from_b;  ///< of the two bodies' frames, where what they share is cut off
  geometry::Point middle;                ///< of the overlap, in the water frame [m]
  GrindCriterion criterion;              ///< the exact area is entered into it
  CutWhen when = CutWhen::kAlways;
};

/// What a floe's edge bears per metre before it crushes, σ_c h [N/m].
double crushing_line_load(const fracture::Ice& ice) {
  return ice.compressive_strength * ice.thickness;
}

/// The outline by which a body cuts.
geometry::Polygon tool_of(const Population& population, const Setup& setup, BodyIndex body) {
  const geometry::Polygon outline = population.is_hull(body)
                                        ? geometry::Polygon{hull_of(setup.scene, body).hull.waterline, {}}
                                        : population.floes[population.floe_of(body)].shape.polygon;
  return with_clearance(outline, population.bodies.centroid[body]);
}

/// A kind of event with what all that happens to overlaps has.
template <class Kind>
Event event_of(const Population& population, const Instant& now, const OverlapCut& overlap, BodyIndex ground,
               Kind kind) {
  const BodyIndex by = ground == overlap.a ? overlap.b : overlap.a;
  kind.floe = population.floe_of(ground);
  kind.by_floe = population.floe_or_none(by);
  return {now.time, population.hull_or_none(by), overlap.middle + now.drift, std::move(kind)};
}

/// Whether a cut leaves two floes or more, slivers and what would be brash aside.
bool is_parted(const Setup& setup, const geometry::CutResult& cut) {
  int floes = 0;
  for (const geometry::Piece& piece : cut.pieces) {
    const geometry::Measures measures = geometry::measure(piece.shape.polygon);
    floes += piece.part == geometry::Part::kOutside && can_be_floe(measures) &&
             measures.area >= setup.scene.fracture.smallest_floe_area;
  }
  return floes > 1;
}

double smaller_area(const Population& population, BodyIndex a, BodyIndex b) {
  return std::min(population.bodies.area[a], population.bodies.area[b]);
}

/// Whether both bodies can still be cut: they are in the world, and geometry has not refused it.
bool can_cut(const Population& population, const Accounts& accounts, BodyIndex a, BodyIndex b) {
  const dynamics::Bodies& bodies = population.bodies;
  if (!bodies.is_alive[a] || !bodies.is_alive[b]) return false;  // broken in this step
  if (!population.is_hull(a) && !population.is_floating(population.floe_of(a))) return false;
  if (population.is_hull(b) || !population.is_floating(population.floe_of(b))) return false;
  return !is_refused(accounts, a, b);
}

/// Which of two bodies loses ice: the floe in a hull; of two floes the weaker, or the smaller.
BodyIndex ground_of(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b) {
  if (population.is_hull(a)) return b;
  const double stronger =
      crushing_line_load(ice_of_body(setup, population, a)) - crushing_line_load(ice_of_body(setup, population, b));
  if (stronger != 0) return stronger > 0 ? b : a;
  return population.bodies.area[a] < population.bodies.area[b] ? a : b;
}

/// Cuts what the two share from the floe that is ground, by the other's outline, and makes it brash: event
/// `grind`. Nothing where that is less than the criterion's least area, or leaves no two floes that it is to
/// leave: returns whether it was cut.
bool cut_overlap(const Setup& setup, const Instant& now, const OverlapCut& overlap, Population& population,
                 Books books) {
  const BodyIndex ground = ground_of(setup, population, overlap.a, overlap.b);
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
  if (outcome.error().reason != geometry::CutFailure::kMisses) {  // else they have parted
    RejectedCut rejected =
        rejected_grind(criterion, shape.polygon, tools.front().outer, outcome.error(), books.accounts);
    books.journal.events.push_back(event_of(population, now, overlap, ground, std::move(rejected)));
    books.accounts.refused_grinds.emplace_back(overlap.a, overlap.b);
  }
  return false;
}

}  // namespace

// ---- what contacts paid is booked

namespace {

/// What of an overlap's growth in the step was crushed.
struct CrushedGrowth {
  double share = 0;   ///< of the growth's area [-]
  double height = 0;  ///< mean height of the ice that was crushed: its volume over its area [m]
};

/// Where the ice edge bends away from the hull, the crushed part of the overlap is as deep as the hull has penetrated
/// the edge, and as narrow as the overlap is at that depth.
CrushedGrowth crushed_growth(double thickness, const HullSlope& hull, const Contact& c) {
  const double after = c.record->paid_area, before = after - c.paid_by_work - c.paid_by_giving_way;
  if (!(after > before)) return {hull.crushed_share, thickness};
  const bool edge_stands = hull.crushed_share == 1 && hull.penetration_share == 1;
  if (edge_stands && hull.tangent == 0) return {1, thickness};  // most contacts: no power is needed
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

/// Books by what the paid area of a contact has grown in the step: crushed as far as work has paid it and the ice edge
/// stood still, else tilted. The work is that of the normal force alone: friction along an inclined hull has the share
/// μ tan θ_s of it.
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

// ---- blind overlaps are ground

namespace {

/// Blind overlaps smaller than this share of the smaller body are left: what contacts part soon.
constexpr double kLeastBlindShare = 0.005;

/// Both sides of what decides.
GrindCriterion criterion_of(const Population& population, const BlindOverlap& overlap) {
  const dynamics::Bodies& bodies = population.bodies;
  const double smaller = smaller_area(population, overlap.a, overlap.b);
  GrindCriterion criterion{overlap.area, kLeastBlindShare * smaller, overlap.width, overlap.least_width};
  if (overlap.is_inside) {
    const double radius =
        bodies.bounding_radius[bodies.area[overlap.a] < bodies.area[overlap.b] ? overlap.a : overlap.b];
    criterion.overlap_area = smaller;
    criterion.least_width = geometry::kBlindShare * smaller / (2 * radius);
  }
  return criterion;
}

}  // namespace

void grind_blind_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                          Books books) {
  for (const BlindOverlap& overlap : data.blind_overlaps) {
    if (!can_cut(population, books.accounts, overlap.a, overlap.b)) continue;
    const GrindCriterion criterion = criterion_of(population, overlap);
    if (criterion.overlap_area < criterion.least_area) continue;
    const geometry::Pose pose = dynamics::a_from_b(population.bodies, overlap.a, overlap.b);
    cut_overlap(setup, step.end, {overlap.a, overlap.b, {pose}, overlap.middle, criterion}, population, books);
  }
}

// ---- floes that hulls have come through are cut

namespace {

/// Whether a hull may have come through a floe: a hull that has not carves an overlap of one stretch of each
/// boundary. Where nothing moves the two, carve_channels() cuts.
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

/// What a contact crushed is cut off from this share of the smaller body on; when it has parted also from h²
/// on. Smaller, floes become new ones at every touch; greater, bodies share more than 1 % of the smaller when
/// they part.
constexpr double kLeastCrushedShare = 0.005;

/// From which area on what a contact crushed that has parted is cut off [m²].
double least_parted(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b) {
  const double h = ice_of_body(setup, population, ground_of(setup, population, a, b)).thickness;
  return std::min(kLeastCrushedShare * smaller_area(population, a, b), h * h);
}

/// All contacts of a pair.
struct Touching {
  std::span<const Contact> contacts;
  std::span<const HullSlope> slopes;  ///< none of two floes

  bool is_pressing() const {
    return std::ranges::any_of(contacts, [](const Contact& c) { return c.total_normal_impulse() > 0; });
  }
  /// Against vertical walls the force depends on the contact's width alone. A hull that leans crushes a
  /// wedge: a new edge would take it from the start.
  bool is_vertical() const {
    return std::ranges::all_of(slopes, [](const HullSlope& slope) { return slope.tangent == 0; });
  }
  double crushed_area() const {  ///< of the overlap now [m²]
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

/// Where what a pair crushed is cut off: where the most of it pressed, and where they are, unless they press:
/// then what they come to share in the step goes on being their contact.
std::vector<geometry::Pose> poses_of(const dynamics::Bodies& bodies, const Touching& touching) {
  const Contact& c = touching.largest();
  std::vector<geometry::Pose> poses{c.record->crushed.a_from_b};
  if (!touching.is_pressing()) poses.push_back(dynamics::a_from_b(bodies, c.a, c.b));
  return poses;
}

/// Whether that is most of a floe: a hull that takes no ice, as a cone, has come over it and crushed it.
bool is_most(const Population& population, const Contact& c, double area) {
  return area > 0.5 * population.bodies.area[c.b];
}

bool is_tilted(const Population& population, BodyIndex ship, BodyIndex floe) {
  return std::ranges::any_of(population.tilted, [&](const TiltedFloe& tilted) {
    return tilted.ship == ship && population.body_of(tilted.floe) == floe;
  });
}

/// A body, or what it broke into in this step: its pieces have its frame.
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

/// Cuts off what a contact crushed that has parted.
void shed_parted(const Setup& setup, const Instant& now, const dynamics::PartedContact& parted, Population& population,
                 Books books) {
  for (const BodyIndex a : left_of(population, now, parted.a)) {
    for (const BodyIndex b : left_of(population, now, parted.b)) {
      const bool is_in_order = a < b;  // pieces have numbers of their own
      const BodyIndex low = is_in_order ? a : b;
      const BodyIndex high = is_in_order ? b : a;
      // Of prescribed bodies carve_channels() takes what they crush.
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

/// Cuts off what contacts crushed that last, where it is much.
void shed_touching(const Setup& setup, const Instant& now, const Touching& touching, Population& population,
                   Books books) {
  const Contact& c = touching.contacts.front();
  const dynamics::Bodies& bodies = population.bodies;
  if (!bodies.is_alive[c.a] || !bodies.is_alive[c.b]) return;  // their records may be gone
  const double crushed = touching.crushed_area();
  if (crushed == 0 || are_prescribed(bodies, c.a, c.b) || !can_cut(population, books.accounts, c.a, c.b)) return;
  const double least = kLeastCrushedShare * smaller_area(population, c.a, c.b);
  if (crushed < least || (touching.is_pressing() && !touching.is_vertical() && !is_most(population, c, crushed)))
    return;
  if (population.is_hull(c.a) && is_tilted(population, c.a, c.b)) return;
  const OverlapCut cut{c.a, c.b, poses_of(population.bodies, touching), touching.largest().middle(), {crushed, least}};
  std::vector<dynamics::CrushedIce> kept;  // the pieces inherit none of it
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
