#include "simulation/ice/prescribed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/contact/paid_overlap.hpp"
#include "elementary/elementary.hpp"
#include "simulation/ice/pieces.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Pose;

/// Distance that a hull advances before its outline is cut out of the ice: the smaller of a fraction of the hull's
/// radius [-] and a length [m]. Larger values make the contact line of a round hull shorter than the hull is wide (by
/// x²/8 of it at x times its radius), so loads are too small. Smaller values make more cuts, which cost time.
constexpr double kShareOfRadius = 0.05;
constexpr double kMostGrowth = 0.25;

/// Force of a contact at which the run ends as a numerical failure, as a multiple of the largest force that its ice can
/// carry [-]. Forces of crushing ice stay below 1; a body that pierces another has several contact lines in one
/// contact. Larger values detect wrong loads later.
constexpr double kOverloadFactor = 4;

/// Angle from the vertical above which a hull counts as inclined [rad]. It is far below the angle of any real hull.
constexpr double kVertical = 1e-6;

/// Returns tan θ_s of the hull at a contact; 0 between floes.
double tangent_of(const StepData& data, std::size_t i) {
  return i < data.slopes.size() ? std::max(0.0, data.slopes[i].tangent) : 0;
}

/// A cut by which the outline of a hull is carved out of a floe.
struct Carving {
  FloeId floe = 0;
  const Contact* contact = nullptr;
  geometry::Polygon tool;  ///< outline of the hull in the floe's body frame [m]
  GrindCriterion criterion;
};

/// Returns the pose of a body's frame a time ago, if its velocities were the same since [s].
Pose pose_ago(const dynamics::Bodies& bodies, BodyIndex i, double time) {
  const geometry::Rotation rotation = geometry::Rotation::by(bodies.angle[i] - time * bodies.angular_velocity[i]);
  const geometry::Point centre = bodies.position[i] - time * bodies.velocity[i];
  return {centre - rotate(rotation, bodies.centroid[i] - geometry::Point{}), rotation};
}

/// Returns the outline of a hull in the body frame of the floe, at the place that the hull had a time ago [s].
geometry::Polygon tool_of(const Setup& setup, const dynamics::Bodies& bodies, const Contact& c, double time_ago) {
  const geometry::Polygon outline = with_clearance({hull_of(setup.scene, c.a).hull.waterline, {}}, {});
  const Pose floe_from_hull = relative_pose(pose_ago(bodies, c.b, time_ago), pose_ago(bodies, c.a, time_ago));
  return transform(floe_from_hull, outline);
}

/// Returns the cuts of all hulls that have advanced far enough, at most one for each hull and floe, ordered by floe. A
/// cut leaves the part of an overlap that the hull has gained in the last step. Under an inclined hull it also leaves
/// the strip that the hull crushes below the waterline.
std::vector<Carving> due_carvings(const Setup& setup, const Step& step, const Population& population,
                                  const StepData& data, const Accounts& accounts) {
  const dynamics::Bodies& bodies = population.bodies;
  std::vector<Carving> due;
  for (std::size_t i = 0; i < data.contacts.size(); ++i) {
    const Contact& c = data.contacts[i];
    if (!population.is_hull(c.a)) break;
    if (population.is_hull(c.b) || !are_prescribed(bodies, c.a, c.b)) continue;
    if (c.total_normal_impulse() <= 0 || c.approach_speed <= 0 || !bodies.is_alive[c.b]) continue;
    const double facet = ice_of_body(setup, population, c.b).thickness * tangent_of(data, i);
    const double least = std::min(kMostGrowth, kShareOfRadius * bodies.bounding_radius[c.a]);
    const double least_area = c.width * (facet + least);
    if (c.area < least_area) continue;
    if (!due.empty() && due.back().contact->a == c.a && due.back().contact->b == c.b) continue;
    if (is_refused(accounts, c.a, c.b)) continue;
    const double time_ago = step.length + facet / c.approach_speed;
    due.push_back({population.floe_of(c.b), &c, tool_of(setup, bodies, c, time_ago), {c.area, least_area, c.width, 0}});
  }
  std::ranges::stable_sort(due, {}, &Carving::floe);
  return due;
}

/// Returns the event of a cut. `kind` has the members that differ between kinds of events.
template <class Kind>
Event event_of_carving(const Instant& now, const Carving& carving, Kind kind) {
  const Contact& c = *carving.contact;
  kind.floe = carving.floe;
  kind.normal_in_world = c.normal;
  kind.penetration = c.depth;
  return {now.time, c.a, c.middle() + now.drift, std::move(kind)};
}

/// Returns the fraction of the full friction that acts at a contact between bodies of prescribed motion [-]. Nothing
/// stops the slip of such bodies. Friction with its full value at any slip would change its sign with rounding errors.
/// Therefore it grows in proportion to the slip speed up to its full value at kCreepSpeed, as the crushing force grows
/// with the closing speed. Along the chord of a crescent, whose two flanks slip in opposite directions, it is the slip
/// speed's fraction of the relative speed.
double share_of_friction(const Contact& c, bool is_crescent) {
  const double slip = std::abs(c.slip_speed);
  if (slip == 0) return 0;
  return is_crescent ? slip / elementary::hypot(slip, c.approach_speed) : std::min(1.0, slip / dynamics::kCreepSpeed);
}

}  // namespace

double longest_line(const dynamics::Bodies& bodies, const Contact& c) {
  const BodyIndex smaller = bodies.bounding_radius[c.a] < bodies.bounding_radius[c.b] ? c.a : c.b;
  const geometry::Vector along_in_body = rotate_back(bodies.rotation[smaller], perpendicular(c.normal));
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const geometry::Point& corner : bodies.boundary[smaller]->edges.outer_corners()) {
    const double place = dot(corner - geometry::Point{}, along_in_body);
    least = std::min(least, place);
    most = std::max(most, place);
  }
  return most - least;
}

double largest_ice_force(const Setup& setup, const Population& population, const Contact& c, double slope_tangent) {
  const dynamics::Bodies& bodies = population.bodies;
  const fracture::Ice& of_b = ice_of_body(setup, population, c.b);
  const fracture::Ice ice =
      population.is_hull(c.a) ? of_b : fracture::crushed_between(ice_of_body(setup, population, c.a), of_b);
  return ice.compressive_strength * (ice.thickness * longest_line(bodies, c)) * (1 + ice.friction * slope_tangent);
}

void press_prescribed(const Setup& setup, const Step& step, const Population& population, HullContactLoad& load) {
  const Contact& c = load.contact;
  if (!are_prescribed(population.bodies, c.a, c.b)) return;
  // Area of the facet that the hull cuts into the ice along the whole contact line, h w / cos θ_s [m²].
  const double line = load.ice.thickness * c.width / elementary::cos(load.hull_angle);
  fracture::CrushedArea crushed{line, 0};
  const bool is_crescent = dynamics::is_crescent(c);
  const double facet = load.ice.thickness * elementary::tan(load.hull_angle);
  // True where the hull stands in a notch that was carved out and has advanced far enough to crush the whole facet,
  // h tan θ_s. The force is then that of the whole facet, whatever the power law of the overlap gives.
  const bool spans_facet = is_crescent && c.area >= c.width * facet;
  if (load.hull_angle > kVertical && !spans_facet) {
    crushed.area = std::min(load.normal_force / load.ice.compressive_strength, line);
    crushed.slope = load.stiffness / load.ice.compressive_strength;
  }
  const double most =
      largest_ice_force(setup, population, c, elementary::tan(load.hull_angle)) / load.shares.horizontal;
  load.normal_force = std::min(fracture::crushing_force(load.ice, crushed.area), most);
  load.vertical_force = load.shares.vertical * load.normal_force;
  load.shares.tangential *= share_of_friction(c, spans_facet);
  load.stiffness = fracture::crushing_force(load.ice, crushed.slope);
  const double way = step.length * std::max(0.0, c.approach_speed);
  if (way * load.stiffness > most - load.normal_force) load.stiffness = (most - load.normal_force) / way;
}

void close_prescribed_gap(const Step& step, const dynamics::Bodies& bodies, Contact& c) {
  if (!are_prescribed(bodies, c.a, c.b)) return;
  c.paid_depth = std::max(c.paid_depth, c.depth);
  if (c.approach_speed <= 0) return;
  // Growth of the area in half of a step [m²].
  const double half_a_step = 0.5 * c.width * c.approach_speed * step.length;
  if (c.area + half_a_step >= c.record->paid_area) c.paid_depth = c.depth;
}

void carve_channels(const Setup& setup, const Step& step, const StepData& data, Population& population, Books books) {
  const std::vector<Carving> due = due_carvings(setup, step, population, data, books.accounts);
  for (auto first = due.begin(); first != due.end();) {
    std::vector<geometry::Polygon> tools;
    auto next = first;
    for (; next != due.end() && next->floe == first->floe; ++next) tools.push_back(next->tool);
    const geometry::Shape& shape = population.floes[first->floe].shape;
    const geometry::CutOutcome outcome = geometry::cut_by_polygons(shape, tools);
    if (outcome) {
      Event event = event_of_carving(step.end, *first, Grind{{}, first->criterion});
      replace_by_pieces(setup, step.end,
                        {std::move(event), *outcome, InsideFate::kBrash, &EnergyFlows::grinding, &Counts::ground},
                        population, books);
    } else if (outcome.error().reason != geometry::CutFailure::kMisses) {
      RejectedCut rejected =
          rejected_grind(first->criterion, shape.polygon, tools.front().outer, outcome.error(), books.accounts);
      books.journal.events.push_back(event_of_carving(step.end, *first, std::move(rejected)));
      for (auto refused = first; refused != next; ++refused)
        books.accounts.refused_grinds.emplace_back(refused->contact->a, refused->contact->b);
    }
    first = next;
  }
}

std::optional<std::string> overload_of(const Setup& setup, const Step& step, const Population& population,
                                       const StepData& data) {
  const double dt = step.length;
  for (std::size_t i = 0; i < data.contacts.size(); ++i) {
    const Contact& c = data.contacts[i];
    if (c.is_rigid() || c.total_normal_impulse() <= 0) continue;
    const double force = c.step_share * c.total_normal_impulse() / dt;
    const double most = largest_ice_force(setup, population, c, tangent_of(data, i));
    if (!(force > kOverloadFactor * most)) continue;
    return "bodies " + std::to_string(c.a) + " and " + std::to_string(c.b) + " press each other with " +
           std::to_string(1e-6 * force) + " MN, their ice bears " + std::to_string(1e-6 * most) +
           " MN, at t = " + std::to_string(step.begin.time) + " s";
  }
  return std::nullopt;
}

}  // namespace polynya::simulation
