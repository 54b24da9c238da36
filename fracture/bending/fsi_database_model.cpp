#include "fracture/bending/fsi_database_model.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "fracture/bending/database_text.hpp"

namespace polynya::fracture {
namespace {

/// The softness of the push κ ξ² that has the true push's force at this penetration.
double equivalent_softness(const ScaledLoad& load, double penetration) {
  if (load.full_depth <= 0 || penetration <= load.full_depth) return load.groups.softness;
  const double share = 1 - load.full_depth / penetration;
  return load.groups.softness / (1 - share * share);
}

BendingCapacity to_capacity(const DatabaseAnswer& answer, const ScaledLoad& load, bool has_table_poisson) {
  BendingCapacity capacity;
  capacity.vertical_force = answer.force * load.force_scale;
  capacity.cusp_radius = answer.cusp_radius * load.length_scale;
  capacity.is_in_range = answer.is_in_range() && has_table_poisson;
  capacity.radial_crack_first = answer.crack_ratio >= 1;
  return capacity;
}

constexpr double kPoissonTolerance = 1e-9;

}  // namespace

FsiDatabaseModel::FsiDatabaseModel()
    // The shipped database lives as long as the program: nothing to delete.
    : database_(std::shared_ptr<const BendingDatabase>(), &default_database()) {}

FsiDatabaseModel::FsiDatabaseModel(std::shared_ptr<const BendingDatabase> database)
    : database_(std::move(database)) {
  assert(database_ != nullptr);
}

DatabaseAnswer FsiDatabaseModel::answer(const BendingLoad& load, const ScaledLoad& scaled_load) const {
  WedgeGroups groups = scaled_load.groups;
  groups.softness = equivalent_softness(scaled_load, load.penetration / scaled_load.length_scale);
  return database_->look_up(groups);
}

BendingCapacity FsiDatabaseModel::capacity(const BendingLoad& load) const {
  const ScaledLoad scaled_load = scaled(load);
  return to_capacity(
      answer(load, scaled_load), scaled_load,
      std::abs(load.ice.poisson_ratio - database_->settings().poisson_ratio) <= kPoissonTolerance);
}

BendingForecast FsiDatabaseModel::forecast(const BendingLoad& load) const {
  const ScaledLoad scaled_load = scaled(load);
  const WedgePush push = push_of(scaled_load, Feedback::kIgnored);
  // Where the contact crushes through the thickness before it breaks, force and penetration decide each
  // other; the force depends weakly on the penetration, so that a few rounds settle both.
  constexpr int kRounds = 20;
  BendingLoad at_break = load;
  at_break.penetration = 0;
  DatabaseAnswer found;
  for (int round = 0; round < kRounds; ++round) {
    found = answer(at_break, scaled_load);
    const double depth = push_depth(push, found.force) * scaled_load.length_scale;
    const bool is_settled = std::abs(depth - at_break.penetration) <= 1e-12 * depth;
    at_break.penetration = depth;
    if (is_settled || !std::isfinite(depth)) break;
  }
  BendingForecast forecast;
  const bool has_table_poisson =
      std::abs(load.ice.poisson_ratio - database_->settings().poisson_ratio) <= kPoissonTolerance;
  forecast.capacity = to_capacity(found, scaled_load, has_table_poisson);
  forecast.normal_force = forecast.capacity.vertical_force / load.vertical_to_crushing;
  forecast.penetration = at_break.penetration;
  forecast.time = load.mean_approach_speed > 0 ? at_break.penetration / load.mean_approach_speed
                                               : std::numeric_limits<double>::infinity();
  forecast.outside = outside_names(found);
  if (!has_table_poisson) forecast.outside += forecast.outside.empty() ? "Poisson ratio" : ", Poisson ratio";
  return forecast;
}

}  // namespace polynya::fracture
