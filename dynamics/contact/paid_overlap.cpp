#include "dynamics/contact/paid_overlap.hpp"

#include <algorithm>

#include "elementary/elementary.hpp"

namespace polynya::dynamics {
namespace {

/// Fraction of an overlap that must be paid before the overlap is recorded for cutting [-]. Larger: the unpaid rest of
/// a deep overlap would delay the cut forever. Smaller: ice is cut off that no work has paid.
constexpr double kPaidShareOfCut = 0.9;

/// Largest exponent p of the power law [-]. An overlap with a larger p is a crescent. Larger values overestimate the
/// force of bodies in notches.
constexpr double kLargestPower = 3;

/// Returns the exponent p of the power law, within the limits that fracture::Overlap has for it [-].
double power_of(const Contact& c) {
  return std::clamp(c.depth * c.width / c.area, 1.0 / 3, kLargestPower);
}

/// Returns true if a contact has an area and a depth, so that the power law is defined.
bool has_shape(const Contact& c) {
  return c.area > 0 && c.depth > 0;
}

}  // namespace

bool is_crescent(double depth, double width, double area) {
  return depth * width > kLargestPower * area;
}

double depth_at(const Contact& c, double area) {
  if (!(area > 0) || !has_shape(c)) return 0;
  if (area == c.area) return c.depth;
  if (is_crescent(c)) return c.depth + (area - c.area) / c.width;
  return c.depth * elementary::pow(area / c.area, 1 / power_of(c));
}

double area_at(const Contact& c, double depth) {
  if (!(depth > 0) || !has_shape(c)) return 0;
  if (depth == c.depth) return c.area;
  if (is_crescent(c)) return std::max(0.0, c.area + c.width * (depth - c.depth));
  return c.area * elementary::pow(depth / c.depth, power_of(c));
}

double force_at(const CrushingForce& law, double depth) {
  if (law.exponent == 0 || depth == law.depth || !(law.depth > 0)) return law.force;
  return law.force * elementary::pow(std::max(0.0, depth) / law.depth, law.exponent);
}

double stiffness_over(const CrushingForce& law, double further) {
  constexpr double kSmallGrowth = 0.01;  // of the depth: the mean differs from dF/dξ by less than half of this [-]
  if (law.exponent == 0 || !(law.depth > 0)) return 0;
  if (law.exponent >= 1 || further <= kSmallGrowth * law.depth) return law.exponent * law.force / law.depth;
  return (force_at(law, law.depth + further) - law.force) / further;
}

Payment pay(const CrushingForce& law, double paid, double reached, double work) {
  if (!(work > 0 && law.force > 0 && law.depth > 0 && reached > paid)) return {paid, 0};
  const double n = law.exponent;
  const double scale = law.force * law.depth / (n + 1);  // ∫ F dξ from 0 to the depth [J]
  const auto paid_for = [&](double depth) {
    return depth == law.depth ? scale : scale * elementary::pow(depth / law.depth, n + 1);
  };
  const double before = paid_for(paid);
  const double to_reached = paid_for(reached) - before;
  if (work >= to_reached) return {reached, to_reached};
  return {std::clamp(law.depth * elementary::pow((before + work) / scale, 1 / (n + 1)), paid, reached), work};
}

void enter_paid_depth(Contact& c) {
  c.paid_depth = depth_at(c, c.record->paid_area);
}

void settle(bool are_prescribed, Contact& c) {
  PersistentContact& record = *c.record;
  record.area = area_at(c, c.depth_after);
  if (c.is_rigid() || !has_shape(c)) return;
  if (c.paid_depth_after > c.paid_depth) {
    // If the force is a fraction of the crushing force, its work has crushed the same fraction of the ice that it let
    // in. For the rest the floe's edge has given way.
    const double open = c.paid_depth_after == c.depth_after ? record.area : area_at(c, c.paid_depth_after);
    const double let_in = std::max(0.0, open - record.paid_area);
    c.paid_by_work = c.crushing_share * let_in;
    c.paid_by_giving_way = let_in - c.paid_by_work;
  }
  const bool is_all_paid = c.is_broken || c.gives_way || (are_prescribed && c.total_normal_impulse() > 0);
  const double left = std::max(0.0, record.area - record.paid_area - c.paid_by_work - c.paid_by_giving_way);
  if (is_all_paid) (are_prescribed ? c.paid_by_work : c.paid_by_giving_way) += left;
  record.paid_area += c.paid_by_work + c.paid_by_giving_way;
}

void settle_collision(const Contact& c) {
  if (c.total_normal_impulse() > 0) c.record->paid_area = c.area;
}

void remember_crushed(const Bodies& bodies, const Contact& c) {
  PersistentContact& record = *c.record;
  if (c.gives_way || !c.is_at_limit || c.area < record.crushed.area) return;
  if (record.paid_area < kPaidShareOfCut * c.area) return;
  record.crushed = {relative_pose(water_from_body(bodies, c.a), water_from_body(bodies, c.b)), c.area};
}

}  // namespace polynya::dynamics
