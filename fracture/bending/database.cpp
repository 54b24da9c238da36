#include "fracture/bending/database.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace polynya::fracture {
namespace {

std::vector<double> mapped(std::vector<double> values, double (*map)(double)) {
  std::transform(values.begin(), values.end(), values.begin(), map);
  return values;
}

double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}
double natural_log(double x) {
  return std::log(x);
}

/// An interval of one axis and where in it a coordinate lies, 0..1.
struct Cell {
  std::size_t lower;
  double fraction;
};

Cell cell_at(const std::vector<double>& axis, double x) {
  const auto after = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
  const auto upper = static_cast<std::size_t>(after - axis.begin());
  return {upper - 1, std::clamp((x - axis[upper - 1]) / (axis[upper] - axis[upper - 1]), 0.0, 1.0)};
}

/// Rounding at the edge of an axis is not "outside".
constexpr double kEdgeTolerance = 1e-9;

}  // namespace

bool is_grid_axis(const std::vector<double>& values) {
  if (values.size() < 2 || !(values.front() >= 1e-12) || !(values.back() <= 1e12)) return false;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1] * (1 + kEdgeTolerance))) return false;
  return true;
}

DatabaseGrid default_grid() {
  return {{20, 25, 30, 35, 40, 45, 50, 60, 75, 90, 105, 120, 135, 150, 165, 180},
          {0.02, 0.05, 0.1},
          {3e-5, 5.5e-5, 1e-4, 3e-4, 7e-4, 1.5e-3, 3e-3, 6e-3, 1.3e-2, 3e-2, 4.1e-2, 5.5e-2, 7.5e-2, 1e-1},
          {5e-4, 1e-3, 2e-3,   3.5e-3, 6e-3, 1e-2,   1.6e-2, 2.5e-2, 4e-2, 6e-2,
           8e-2, 1e-1, 1.3e-1, 1.6e-1, 2e-1, 2.5e-1, 4e-1,   7e-1,   1,    1.5}};
}

BendingDatabase::BendingDatabase(SolverSettings settings, DatabaseGrid grid,
                                 std::vector<DatabaseEntry> entries)
    : settings_(settings), grid_(std::move(grid)), entries_(std::move(entries)) {
  assert(entries_.size() == grid_.size());
  assert(is_grid_axis(grid_.opening_angles_deg) && is_grid_axis(grid_.mass_ratios) &&
         is_grid_axis(grid_.softnesses) && is_grid_axis(grid_.froude_numbers));
  coordinates_ = {mapped(grid_.opening_angles_deg, radians), grid_.mass_ratios,
                  mapped(grid_.softnesses, natural_log), mapped(grid_.froude_numbers, natural_log)};
  strides_[3] = 1;
  for (std::size_t axis = 3; axis > 0; --axis)
    strides_[axis - 1] = strides_[axis] * coordinates_[axis].size();
  stored_.reserve(entries_.size());
  for (const DatabaseEntry& e : entries_) {
    assert(e.force > 0 && e.cusp_radius > 0);
    stored_.push_back({std::log(e.force), std::log(e.cusp_radius), e.crack_ratio});
  }
}

DatabaseAnswer BendingDatabase::look_up(const WedgeGroups& groups) const {
  const std::array<double, 4> x = {groups.opening_angle, groups.mass_ratio, std::log(groups.softness),
                                   std::log(groups.froude)};
  DatabaseAnswer answer;
  std::array<double, 4> fraction{};
  std::size_t corner = 0;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const bool may_be_below =
        axis == static_cast<std::size_t>(Group::kFroude);  // slower is only more at rest
    const bool is_inside = x[axis] <= coordinates_[axis].back() + kEdgeTolerance &&
                           (x[axis] >= coordinates_[axis].front() - kEdgeTolerance || may_be_below);
    if (!is_inside) answer.outside = static_cast<std::uint8_t>(answer.outside | (1U << axis));
    const Cell cell = cell_at(coordinates_[axis], x[axis]);
    fraction[axis] = cell.fraction;
    corner += cell.lower * strides_[axis];
  }
  double log_force = 0, log_radius = 0;
  for (unsigned vertex = 0; vertex < 16; ++vertex) {  // the corners of the cell
    double weight = 1;
    std::size_t index = corner;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const bool upper = ((vertex >> axis) & 1U) != 0;
      weight *= upper ? fraction[axis] : 1 - fraction[axis];
      index += upper ? strides_[axis] : 0;
    }
    const DatabaseEntry& e = stored_[index];
    log_force += weight * e.force;
    log_radius += weight * e.cusp_radius;
    answer.crack_ratio += weight * e.crack_ratio;
  }
  answer.force = std::exp(log_force);
  answer.cusp_radius = std::exp(log_radius);
  return answer;
}

std::string outside_names(const DatabaseAnswer& answer) {
  std::string names;
  for (std::size_t axis = 0; axis < kGroupNames.size(); ++axis) {
    if (!answer.is_outside(static_cast<Group>(axis))) continue;
    if (!names.empty()) names += ", ";
    names += kGroupNames[axis];
  }
  return names;
}

}  // namespace polynya::fracture
