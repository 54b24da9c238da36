#include <algorithm>
#include <cmath>

#include "dynamics/collision.hpp"
#include "fracture/crushing.hpp"
#include "fracture/splitting.hpp"
#include "geometry/contact/crack_path.hpp"
#include "geometry/contact/wedge.hpp"
#include "simulation/crushed_overlap.hpp"
#include "simulation/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;
using geometry::Point;
using geometry::Vector;

/// The cusp is expected about this many characteristic lengths away; the wedge is measured over that length.
constexpr double kWedgeLengthOverL = 0.3;
/// A crack starts and ends this far outside the ice, so that it separates [m].
constexpr double kCrackMargin = 1e-3;

/// Eq. (5) needs the masses of the bodies as they are, also of one whose speed is held.
dynamics::Mobility true_mobility(const dynamics::Bodies& bodies, BodyIndex i, Point at) {
  return {1 / bodies.mass[i], 1 / bodies.moment[i], at - bodies.position[i]};
}

double eq5_impulse(const World& world, const Contact& c) {
  const double mass = dynamics::effective_mass(true_mobility(world.bodies, c.a, c.middle()),
                                               true_mobility(world.bodies, c.b, c.middle()), c.normal);
  return dynamics::collision_impulse(c.approach_speed, world.scene.contact.restitution, mass);
}

/// θ_s where the contact is: by the waterline's normal from the stem angle, or from the hull's own table
/// [rad].
double hull_angle_at(const World& world, const Contact& c) {
  const Hull& hull = world.scene.ships[c.a].hull;
  const geometry::Pose pose = dynamics::water_from_body(world.bodies, c.a);
  if (hull.angles_from_vertical.empty()) {
    return fracture::hull_angle_from_vertical(rotate_back(pose.rotation, c.normal).x, hull.stem_angle);
  }
  const Point here = inverse_transform(pose, c.middle());
  double nearest = std::numeric_limits<double>::infinity();
  double angle = 0;
  for (std::size_t i = 0; i < hull.waterline.size(); ++i) {
    const std::size_t next = (i + 1) % hull.waterline.size();
    const double along = nearest_part(hull.waterline[i], hull.waterline[next], here);
    const double d =
        squared_length(here - (hull.waterline[i] + along * (hull.waterline[next] - hull.waterline[i])));
    if (d >= nearest) continue;
    nearest = d;
    angle = (1 - along) * hull.angles_from_vertical[i] + along * hull.angles_from_vertical[next];
  }
  return angle;
}

/// The fracture load of one ship contact while ice crushes there.
struct CrushingContact {
  double hull_angle = 0;    ///< θ_s [rad]
  double normal_force = 0;  ///< F_n on the facet [N]
  fracture::CrushingShares shares;
};

CrushingContact crushing_at(const World& world, const Contact& c) {
  CrushingContact crushing;
  crushing.hull_angle = hull_angle_at(world, c);
  const double area =
      crushed_overlap_area({c.width, c.depth, c.area}, world.scene.ice.thickness, crushing.hull_angle);
  crushing.normal_force = fracture::crushing_force(world.scene.ice, area);
  crushing.shares = fracture::crushing_shares(crushing.hull_angle, world.scene.ice.friction, c.approach_speed,
                                              c.slip_speed);
  return crushing;
}

geometry::WedgeAngles wedge_at(const World& world, const Contact& c) {
  const geometry::Pose water_from_floe = dynamics::water_from_body(world.bodies, c.b);
  const double l = fracture::characteristic_length(world.scene.ice, world.scene.water.water);
  return geometry::wedge_angles(world.bodies.boundary[c.b]->edges, c.tip_edge_of_b,
                                inverse_transform(water_from_floe, c.tip_of_b),
                                rotate_back(water_from_floe.rotation, c.normal), kWedgeLengthOverL * l);
}

fracture::BendingLoad bending_load(const World& world, const Contact& c, const CrushingContact& crushing) {
  const geometry::WedgeAngles wedge = wedge_at(world, c);
  fracture::BendingLoad load;
  load.ice = world.scene.ice;
  load.water = world.scene.water.water;
  load.front_half_angle = std::clamp(wedge.front, fracture::kSmallestHalfAngle, fracture::kLargestHalfAngle);
  load.back_half_angle = std::clamp(wedge.back, fracture::kSmallestHalfAngle, fracture::kLargestHalfAngle);
  load.hull_angle = crushing.hull_angle;
  load.mean_approach_speed = c.record->age > 0 ? c.record->approach / c.record->age : c.approach_speed;
  load.penetration = c.depth;
  load.vertical_to_crushing = crushing.shares.vertical;
  return load;
}

/// The least force at which any crack that counts could split: cracks shorter than κ l do not.
double least_splitting_force(const World& world) {
  return fracture::splitting_force(world.scene.fracture.splitting, world.scene.ice, world.breakable_size,
                                   world.scene.fracture.splitting_shape_factor);
}

/// The crack that would start at the contact, along the hull's normal through all ice ahead, and what it
/// takes.
void measure_crack(const World& world, const Contact& c, PendingFracture& pending) {
  const geometry::Pose water_from_floe = dynamics::water_from_body(world.bodies, c.b);
  pending.crack_in_body =
      geometry::crack_path(*world.bodies.boundary[c.b], inverse_transform(water_from_floe, c.middle()),
                           rotate_back(water_from_floe.rotation, c.normal), kCrackMargin);
  const double length = pending.crack_in_body.length_in_ice;
  // At the corner that an earlier crack left, the next one would run along its face and pare it strip by
  // strip.
  const geometry::WedgeAngles wedge = wedge_at(world, c);
  pending.criteria.has_ice_beside = std::min(wedge.front, wedge.back) >= fracture::kSmallestHalfAngle;
  pending.criteria.crack_length = length;
  pending.criteria.splitting_force = fracture::splitting_force(
      world.scene.fracture.splitting, world.scene.ice, length, world.scene.fracture.splitting_shape_factor);
}

PendingFracture judge(World& world, const Contact& c, const CrushingContact& crushing, double impulse) {
  PendingFracture pending;
  fracture::FailureCriteria& criteria = pending.criteria;
  criteria.floe_size = std::sqrt(world.floes[world.floe_of(c.b)].area);
  criteria.breakable_size = world.breakable_size;
  criteria.collision_force = impulse / world.scene.contact.contact_time;
  if (criteria.floe_size < criteria.breakable_size || c.approach_speed <= 0) return pending;

  if (criteria.collision_force > least_splitting_force(world)) measure_crack(world, c, pending);
  if (crushing.shares.vertical > 0) {
    // The contact crushes with all of F_n only where the bodies' inertia can press that hard within the step.
    const double crushing_impulse =
        crushing.shares.horizontal * crushing.normal_force * world.scene.time.step;
    const double pressed = crushing_impulse > 0 ? std::min(1.0, impulse / crushing_impulse) : 0;
    criteria.vertical_force = pressed * crushing.shares.vertical * crushing.normal_force;
    const fracture::BendingCapacity capacity = world.bending->capacity(bending_load(world, c, crushing));
    criteria.bending_capacity = capacity.vertical_force;
    pending.cusp_radius = capacity.cusp_radius;
    if (!capacity.is_in_range && criteria.vertical_force >= criteria.bending_capacity) {
      ++world.counts.database_out_of_range;
    }
  }
  pending.failure = fracture::decide(criteria);
  // Too weak for any crack, but the record of a bend states the other criterion's two sides as well.
  if (pending.failure == fracture::Failure::kBend && criteria.crack_length == 0)
    measure_crack(world, c, pending);
  pending.ship = c.a;
  pending.floe = world.floe_of(c.b);
  pending.point_in_water = c.middle();
  pending.first_touch_in_body = c.record->first_touch_in_b;
  pending.normal = c.normal;
  pending.penetration = c.depth;
  pending.record = c.record;
  return pending;
}

/// Adds j/τ_c of a ship's contact with ice.
void add_peak(World& world, const Contact& c, double impulse) {
  const Vector force = -(impulse / world.scene.contact.contact_time) * c.normal;
  ShipLoads& loads = world.step_loads[c.a];
  loads.peak += rotate_back(world.bodies.rotation[c.a], force);
  loads.peak_moment += cross(c.middle() - world.bodies.position[c.a], force);
}

}  // namespace

void decide(World& world) {
  world.fractures.clear();
  world.step_loads.assign(world.loads.size(), {});
  const double dt = world.scene.time.step;
  for (Contact& c : world.contacts) {
    c.friction = world.scene.ice.friction;
    if (!world.is_ship(c.a)) {  // floe against floe: vertical walls, of the same ice
      c.impulse_limit = fracture::crushing_force(
                            world.scene.ice,
                            crushed_overlap_area({c.width, c.depth, c.area}, world.scene.ice.thickness, 0)) *
                        dt;
      continue;
    }
    if (world.is_ship(c.b)) continue;  // steel against steel does not crush
    const double impulse = eq5_impulse(world, c);
    add_peak(world, c, impulse);
    const CrushingContact crushing = crushing_at(world, c);
    c.impulse_limit = crushing.shares.horizontal * crushing.normal_force * dt;
    c.friction = crushing.shares.tangential / crushing.shares.horizontal;
    const PendingFracture pending = judge(world, c, crushing, impulse);
    const bool breaks =
        pending.failure == fracture::Failure::kBend || pending.failure == fracture::Failure::kSplit;
    if (breaks && !c.record->was_refused) world.fractures.push_back(pending);
  }
}

}  // namespace polynya::simulation
