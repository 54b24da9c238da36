#include "fracture/bending/fsi_database_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "elementary/elementary.hpp"
#include "fracture/bending/database.hpp"
#include "fracture/bending/edge_deflection.hpp"
#include "fracture/bending/sinking_edge.hpp"
#include "fracture/characteristic_length.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::fracture {
namespace {

/// Returns the groups to look up if the contact's force at its penetration is known. The softness belongs to the push κ
/// ξ² with this force at this penetration, whatever the shapes of hull and ice there.
WedgeGroups measured_groups(const ScaledLoad& scaled_load, const BendingLoad& load) {
  WedgeGroups groups = scaled_load.groups;
  const double depth = load.penetration / scaled_load.length_scale;
  groups.softness = depth * depth * scaled_load.force_scale / load.vertical_force;
  return groups;
}

/// Returns the groups to look up for a load with this penetration [m]. The softness belongs to the push κ ξ² with the
/// true push's force at this penetration.
WedgeGroups looked_up_groups(const ScaledLoad& load, double penetration) {
  WedgeGroups groups = load.groups;
  const double depth = penetration / load.length_scale;
  if (load.full_depth <= 0 || depth <= load.full_depth) return groups;
  const double share = 1 - load.full_depth / depth;
  groups.softness /= 1 - share * share;
  return groups;
}

BendingCapacity to_capacity(const DatabaseAnswer& answer, const ScaledLoad& load, bool has_table_poisson) {
  BendingCapacity capacity;
  capacity.vertical_force = answer.force * load.force_scale;
  capacity.cusp_radius = answer.cusp_radius * load.length_scale;
  capacity.is_in_range = answer.is_in_range() && has_table_poisson;
  capacity.radial_crack_first = answer.crack_ratio >= 1;
  return capacity;
}

/// Returns the force of a wedge that radial cracks have split into 2, 4, … equal parts. Each crack opens along the
/// bisector of a part if its bottom fibre fails before its top fibre does. The parts carry equal shares of V, so each
/// is pushed with a fraction of the stiffness κ: its softness is larger. If they carry less than the load that opened
/// the last crack, they break under that load.
DatabaseAnswer with_radial_cracks(const BendingDatabase& database, const WedgeGroups& whole) {
  constexpr int kMostParts = 16;  // of a half plane: 11° each, narrower than the table's smallest wedge
  const double crack_ratio = database.look_up(whole).crack_ratio;
  double at_crack = 0;
  for (int parts = 1;; parts *= 2) {
    WedgeGroups part = whole;
    part.opening_angle /= parts;
    part.softness *= parts;
    DatabaseAnswer answer = database.look_up(part);
    answer.force *= parts;
    if (answer.crack_ratio >= 1 && parts < kMostParts) {
      at_crack = std::max(at_crack, answer.force / answer.crack_ratio);
      continue;
    }
    answer.force = std::max(answer.force, at_crack);
    answer.crack_ratio = crack_ratio;
    return answer;
  }
}

/// Returns the length λ over which a push is supported, in l. At rest the water alone supports it and λ is 1; in a fast
/// push the inertia of ice and water supports it too. λ follows from the R of a narrow wedge in the database, with and
/// without speed, by R ∝ λ^½. The radii of sections with this λ then follow the radii of the database with the speed,
/// within 12 % up to 3 m/s (test FollowTheDatabaseWithSpeed).
double effective_length(const BendingDatabase& database, const WedgeGroups& whole) {
  constexpr double kNarrow = 60 * geometry::kRadiansPerDegree;  // parts this narrow do not crack
  WedgeGroups part = whole;
  part.softness *= std::max(1.0, whole.opening_angle / kNarrow);
  part.opening_angle = kNarrow;
  WedgeGroups at_rest = part;
  at_rest.froude = 0;
  const double ratio = database.look_up(part).cusp_radius / database.look_up(at_rest).cusp_radius;
  return ratio * ratio;
}

/// Returns the load of the hull on the edge at its penetration. The thrust acts on the crushed facet, at a third of its
/// height below the top of the ice.
EdgeLoad edge_load(const BendingLoad& load, double length, double effective_length) {
  const double depth = load.penetration / load.ice.thickness;
  EdgeLoad edge;
  edge.length = length / load.ice.thickness;
  edge.effective_length = effective_length * edge.length;
  edge.distance = load.load_place * depth;
  edge.facet = depth;
  edge.thrust = load.thrust;
  edge.lever = std::max(0.0, 0.5 - depth / (3 * elementary::tan(load.hull_angle)));
  return edge;
}

/// Returns by how much the tip sinks, in thicknesses, per V / (σ_f h²).
double sinking_of(const BendingLoad& load, const ScaledLoad& scaled_load, double opening_angle) {
  const double duration = load.mean_approach_speed > 0
                              ? load.penetration / load.mean_approach_speed / scaled_load.time_scale
                              : std::numeric_limits<double>::infinity();
  const double l = scaled_load.length_scale;
  return tip_compliance(opening_angle, duration) * scaled_load.force_scale /
         (load.water.density * kGravity * l * l * load.ice.thickness);
}

bool has_poisson_ratio_of(const BendingDatabase& database, const BendingLoad& load) {
  constexpr double kTolerance = 1e-9;  // for rounding: exact equality would count every other load as outside
  return std::abs(load.ice.poisson_ratio - database.settings().poisson_ratio) <= kTolerance;
}

}  // namespace

ScaledLoad scaled(const BendingLoad& load) {
  const Ice& ice = load.ice;
  const double l = characteristic_length(ice, load.water);
  const double h = ice.thickness;
  ScaledLoad result;
  result.length_scale = l;
  result.force_scale = ice.flexural_strength * h * h;
  result.time_scale = std::sqrt(l / kGravity);
  result.groups.opening_angle =
      load.opening_angle > 0 ? load.opening_angle : load.front_half_angle + load.back_half_angle;
  result.groups.mass_ratio = ice.density * h / (load.water.density * l);
  result.groups.froude = std::max(load.mean_approach_speed, 0.0) / std::sqrt(kGravity * l);
  const double tangent_sum = elementary::tan(load.front_half_angle) + elementary::tan(load.back_half_angle);
  const double crushing =
      ice.compressive_strength * load.vertical_to_crushing * tangent_sum / (2 * elementary::sin(load.hull_angle));
  result.groups.softness = crushing > 0 && std::isfinite(crushing) ? result.force_scale / (crushing * l * l)
                                                                   : std::numeric_limits<double>::infinity();
  result.full_depth = h * elementary::tan(load.hull_angle) / l;
  result.feedback = result.force_scale * elementary::tan(load.hull_angle) / (load.water.density * kGravity * l * l * l);
  return result;
}

WedgePush wedge_push_of(const ScaledLoad& load, Feedback feedback) {
  return {load.groups.froude, load.groups.softness, load.full_depth,
          feedback == Feedback::kCoupled ? load.feedback : 0};
}

FsiDatabaseModel::FsiDatabaseModel(RadialCracks radial_cracks)
    // The shipped database lives as long as the program, so there is nothing to delete.
    : database_(std::shared_ptr<const BendingDatabase>(), &default_database()), radial_cracks_(radial_cracks) {}

FsiDatabaseModel::FsiDatabaseModel(std::shared_ptr<const BendingDatabase> database) : database_(std::move(database)) {
  assert(database_ != nullptr);
}

BendingCapacity FsiDatabaseModel::capacity(const BendingLoad& load) const {
  const ScaledLoad scaled_load = scaled(load);
  const WedgeGroups groups =
      load.vertical_force > 0 ? measured_groups(scaled_load, load) : looked_up_groups(scaled_load, load.penetration);
  const DatabaseAnswer answer =
      radial_cracks_ == RadialCracks::kSplitWedge ? with_radial_cracks(*database_, groups) : database_->look_up(groups);
  BendingCapacity capacity = to_capacity(answer, scaled_load, has_poisson_ratio_of(*database_, load));
  if (!load.openings) return capacity;
  const SectionBreak found = weakest_section_of_sinking(
      *load.openings, edge_load(load, scaled_load.length_scale, effective_length(*database_, groups)),
      sinking_of(load, scaled_load, groups.opening_angle), radial_cracks_ == RadialCracks::kSplitWedge);
  capacity.vertical_force = found.force * scaled_load.force_scale;
  capacity.cusp_radius = found.distance * load.ice.thickness;
  return capacity;
}

BendingForecast FsiDatabaseModel::forecast(const BendingLoad& load) const {
  const ScaledLoad scaled_load = scaled(load);
  const WedgePush push = wedge_push_of(scaled_load, Feedback::kIgnored);
  // If the contact crushes through the thickness before it breaks, force and penetration depend on each other. The
  // force depends weakly on the penetration, so a few rounds find both.
  constexpr int kRounds = 20;
  BendingForecast forecast;
  WedgeGroups groups;
  DatabaseAnswer found;
  for (int round = 0; round < kRounds; ++round) {
    groups = looked_up_groups(scaled_load, forecast.penetration);
    found = database_->look_up(groups);
    const double depth = push_depth(push, found.force) * scaled_load.length_scale;
    const bool has_converged = std::abs(depth - forecast.penetration) <= 1e-12 * depth;
    forecast.penetration = depth;
    if (has_converged || !std::isfinite(depth)) break;
  }
  forecast.capacity = to_capacity(found, scaled_load, has_poisson_ratio_of(*database_, load));
  forecast.normal_force = forecast.capacity.vertical_force / load.vertical_to_crushing;
  forecast.time = load.mean_approach_speed > 0 ? forecast.penetration / load.mean_approach_speed
                                               : std::numeric_limits<double>::infinity();
  forecast.equivalent_softness = groups.softness;
  forecast.outside = database_->outside(groups);
  for (OutsideRange& range : forecast.outside)
    if (range.name == kGroupNames[static_cast<std::size_t>(Group::kSoftness)] &&
        groups.softness != scaled_load.groups.softness)
      range.name = "equivalent softness";
  const double table_poisson = database_->settings().poisson_ratio;
  if (!has_poisson_ratio_of(*database_, load))
    forecast.outside.push_back({"Poisson ratio", load.ice.poisson_ratio, table_poisson, table_poisson});
  return forecast;
}

}  // namespace polynya::fracture
