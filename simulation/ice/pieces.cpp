#include "simulation/ice/pieces.hpp"

#include <algorithm>

#include "geometry/exact/measures.hpp"
#include "simulation/ice/under_hull.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::simulation {
namespace {

/// Returns the members that all pieces of a floe have in common. The pieces move on as parts of the body that they
/// were: velocity v + ω × r, with the same ω.
NewFloe child_of(const Population& population, FloeId parent) {
  const dynamics::Bodies& bodies = population.bodies;
  const BodyIndex body = population.body_of(parent);
  NewFloe child;
  child.own_ice = population.floes[parent].own_ice;
  child.parent = parent;
  child.generation = population.floes[parent].generation + 1;
  child.water_from_body = dynamics::water_from_body(bodies, body);
  child.angle = bodies.angle[body];
  child.angular_velocity = bodies.angular_velocity[body];
  child.velocity = dynamics::velocity_at(bodies, body, child.water_from_body.position - bodies.position[body]);
  return child;
}

/// Index that means "no piece".
constexpr std::size_t kNoPiece = SIZE_MAX;
/// Returns the index of the piece of fast ice that stays fast: the largest piece that floats. The others are free.
/// Returns kNoPiece if the floe was not fast or no piece floats.
std::size_t still_fast(const Population& population, const Breakage& breakage,
                       const std::vector<geometry::Measures>& measures) {
  const geometry::CutResult& cut = breakage.cut;
  if (!population.is_fast(breakage.event.ice()->floe)) return kNoPiece;
  std::size_t largest = kNoPiece;
  double most = 0;
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    if (cut.pieces[i].part == geometry::Part::kInside && breakage.inside != InsideFate::kFloats) continue;
    if (measures[i].area <= most) continue;
    most = measures[i].area;
    largest = i;
  }
  return largest;
}

std::vector<geometry::Measures> measures_of(const geometry::CutResult& cut) {
  std::vector<geometry::Measures> measures;
  measures.reserve(cut.pieces.size());
  for (const geometry::Piece& piece : cut.pieces) measures.push_back(geometry::measure(piece.shape.polygon));
  return measures;
}

/// Adds the kinetic energy and momentum of a piece that leaves the floe list with its parent's motion to the accounts.
void enter_removed(const NewFloe& piece, const geometry::Measures& measures, double mass_per_area, double& energy_sink,
                   AuditSums& audit) {
  const geometry::Vector arm = transform(piece.water_from_body, measures.centroid) - piece.water_from_body.position;
  const geometry::Vector velocity = piece.velocity + cross(piece.angular_velocity, arm);
  const geometry::Vector carried = mass_per_area * measures.area * velocity;
  energy_sink += 0.5 * (dot(carried, velocity) +
                        mass_per_area * measures.second_moment * piece.angular_velocity * piece.angular_velocity);
  audit.momentum.removed += carried;
  audit.impulses += length(carried);
}

/// Adds the slivers and the rounding of a cut to the event, and the event's areas and masses to the accounts.
void enter_areas(IceEvent& event, const geometry::CutLedger& cut, double mass_per_area, Accounts& accounts) {
  event.brash_area += cut.area_slivers;
  event.rounding_defect = cut.rounding_defect;
  accounts.counts.snap_rounded += cut.snap_rounded;
  const auto enter = [&](double per_area, IceLedger& ledger) {
    ledger.submerged += per_area * event.submerged_area;
    ledger.brash += per_area * event.brash_area;
    ledger.rounding += per_area * event.rounding_defect;
  };
  enter(1, accounts.areas);
  enter(mass_per_area, accounts.masses);
}

}  // namespace

void replace_by_pieces(const Setup& setup, const Instant& now, Breakage breakage, Population& population, Books books) {
  const geometry::CutResult& cut = breakage.cut;
  IceEvent& event = *breakage.event.ice();
  const int ship = breakage.event.ship;
  NewFloe child = child_of(population, event.floe);
  const bool was_fast = population.is_fast(event.floe);
  const double own_mass_per_area = mass_per_area(ice_of_floe(setup, population, event.floe));
  const std::vector<geometry::Measures> all_measures = measures_of(cut);
  const std::size_t fast = still_fast(population, breakage, all_measures);
  const dynamics::ContactMemory memory =
      population.pairs.contact_memory_of(population.bodies, population.body_of(event.floe));
  retire_floe(event.floe, population, books.journal);
  std::vector<Event> submersions;  // events of pieces that go under the hull
  double& energy_sink = books.accounts.audit.energy.*breakage.energy_sink;
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    const geometry::Piece& piece = cut.pieces[i];
    const geometry::Measures& measures = all_measures[i];
    const bool is_inside = piece.part == geometry::Part::kInside;
    const bool is_submerged = is_inside && breakage.inside == InsideFate::kSubmerged;
    const bool is_brash = (is_inside && breakage.inside == InsideFate::kBrash) ||
                          measures.area < setup.scene.fracture.smallest_floe_area || !can_be_floe(measures);
    if (is_submerged || is_brash) {
      (is_submerged ? event.submerged_area : event.brash_area) += measures.area;
      books.accounts.counts.brash_pieces += is_submerged ? 0 : 1;
      if (!was_fast) enter_removed(child, measures, own_mass_per_area, energy_sink, books.accounts.audit);
      continue;
    }
    child.shape = piece.shape;
    child.measures = measures;
    child.is_fast = i == fast;
    const FloeId id = add_floe(setup, now, child, population, books.journal);
    event.children.push_back(id);
    if (was_fast && !child.is_fast)  // the momentum came from the fast ice, a body of prescribed motion
      enter_motion(population.bodies, population.body_of(id), books.accounts.audit.energy.thrust,
                   books.accounts.audit.momentum.held, books.accounts.audit);
    if (is_inside && breakage.inside == InsideFate::kUnderHull) {
      std::get<Bend>(breakage.event.what).under_hull_area += measures.area;
      submersions.push_back(submersion_event(now, population, {id, ship}));
      go_under(setup, now, {id, ship, breakage.has_decks}, population, books.accounts);
      continue;
    }
    wake(population.body_of(id), population);
    population.pairs.pass_contact_memory(population.bodies, population.body_of(id), memory);
    books.accounts.counts.floated_cusps += is_inside ? 1 : 0;
  }
  enter_areas(event, cut.ledger, own_mass_per_area, books.accounts);
  ++(books.accounts.counts.*breakage.count);
  books.journal.events.push_back(std::move(breakage.event));
  for (Event& submersion : submersions) books.journal.events.push_back(std::move(submersion));
}

geometry::Polygon with_clearance(geometry::Polygon outline, geometry::Point centre) {
  /// Enlargement of the outline as a fraction of the distance from the centre [-]; see the header.
  constexpr double kClearance = 1e-6;
  const auto widen = [&](geometry::Ring& ring) {
    for (geometry::Point& p : ring) p = centre + (1 + kClearance) * (p - centre);
  };
  widen(outline.outer);
  for (geometry::Ring& hole : outline.holes) widen(hole);
  return outline;
}

RejectedCut rejected_grind(const GrindCriterion& criterion, const geometry::Polygon& floe, geometry::Ring tool,
                           const geometry::CutError& error, Accounts& accounts) {
  RejectedCut rejected;
  rejected.criterion = criterion;
  rejected.reason = to_string(error);
  rejected.input = {++accounts.counts.rejected_cuts, floe, std::move(tool), {}};
  return rejected;
}

bool is_refused(const Accounts& accounts, BodyIndex a, BodyIndex b) {
  const std::pair<std::int64_t, std::int64_t> both{a, b};
  return std::ranges::find(accounts.refused_grinds, both) != accounts.refused_grinds.end();
}

}  // namespace polynya::simulation
