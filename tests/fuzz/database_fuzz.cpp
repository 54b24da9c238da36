// Icebreaking databases, from anybody; where a text has a last line for its hash, also with the hash that is
// right. What is read is written as a text that reads back as the same database and is written the same. At
// each point of its grid it answers what stands there; any other load, from nothing to infinity, it answers
// with numbers that lie among those of its entries, and says of no group within its grid that it is beyond.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "fracture/bending/database.hpp"

namespace {

using namespace polynya::fracture;

void require(bool holds) {
  if (!holds) std::abort();
}

std::string with_right_hash(std::string text) {
  const auto at = text.rfind("hash fnv1a64 ");
  if (at == std::string::npos) return text;
  text.resize(at);
  std::uint64_t hash = 14695981039346656037U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
  char line[64];
  std::snprintf(line, sizeof line, "hash fnv1a64 %016llx\n", static_cast<unsigned long long>(hash));
  return text + line;
}

double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

bool is_about(double x, double wanted) {
  return std::abs(x - wanted) <= 1e-12 * wanted;
}

/// Calls visit(groups) with every combination of the four lists, the last fastest; angles in degrees.
template <class Visit>
void for_each_load(const DatabaseGrid& loads, Visit visit) {
  for (const double angle : loads.opening_angles_deg) {
    for (const double mass_ratio : loads.mass_ratios) {
      for (const double softness : loads.softnesses) {
        for (const double froude : loads.froude_numbers)
          visit(WedgeGroups{radians(angle), mass_ratio, softness, froude});
      }
    }
  }
}

void require_entries_at_points(const BendingDatabase& database) {
  auto entry = database.entries().begin();
  for_each_load(database.grid(), [&](const WedgeGroups& groups) {
    const DatabaseAnswer answer = database.look_up(groups);
    require(answer.is_in_range() && is_about(answer.force, entry->force) &&
            is_about(answer.cusp_radius, entry->cusp_radius) && answer.crack_ratio == entry->crack_ratio);
    ++entry;
  });
  require(entry == database.entries().end());
}

/// Loads between an axis's points, below and beyond them.
std::vector<double> off_points(const std::vector<double>& axis) {
  return {0, std::midpoint(axis[0], axis[1]), axis.back() * 0.999, axis.back() * 1.001,
          std::numeric_limits<double>::infinity()};
}

/// Of all entries.
struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = 0;

  void take(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
  bool has(double x) const { return x >= least * (1 - 1e-9) && x <= most * (1 + 1e-9); }
};

void require_answers_among_entries(const BendingDatabase& database) {
  const DatabaseGrid& grid = database.grid();
  const std::array edges = {
      std::pair{radians(grid.opening_angles_deg.front()), radians(grid.opening_angles_deg.back())},
      std::pair{grid.mass_ratios.front(), grid.mass_ratios.back()},
      std::pair{grid.softnesses.front(), grid.softnesses.back()}, std::pair{0.0, grid.froude_numbers.back()}};
  Range force, radius, crack;  // the force per opening angle, which is what is interpolated
  for (std::size_t i = 0; i < database.entries().size(); ++i) {
    const DatabaseEntry& entry = database.entries()[i];
    const std::size_t angle = i / (grid.size() / grid.opening_angles_deg.size());
    force.take(entry.force / radians(grid.opening_angles_deg[angle]));
    radius.take(entry.cusp_radius);
    crack.take(entry.crack_ratio);
  }
  const DatabaseGrid loads{off_points(grid.opening_angles_deg), off_points(grid.mass_ratios),
                           off_points(grid.softnesses), off_points(grid.froude_numbers)};
  for_each_load(loads, [&](const WedgeGroups& groups) {
    const DatabaseAnswer answer = database.look_up(groups);
    const double angle = std::clamp(groups.opening_angle, edges[0].first, edges[0].second);
    require(force.has(answer.force / angle) && radius.has(answer.cusp_radius) && crack.has(answer.crack_ratio));
    const double x[] = {groups.opening_angle, groups.mass_ratio, groups.softness, groups.froude};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [least, most] = edges[i];
      const bool is_outside = answer.is_outside(static_cast<Group>(i));
      if (x[i] >= least && x[i] <= most) require(!is_outside);
      if (std::isinf(x[i])) require(is_outside);
    }
  });
}

void read(const std::string& text) {
  const auto database = parse_database(text);
  if (!database) return require(!database.error().message.empty());
  const std::string written = write_database(*database);
  const auto again = parse_database(written);
  require(again.has_value() && write_database(*again) == written);
  require(again->settings() == database->settings() && again->grid() == database->grid() &&
          again->entries() == database->entries());
  require_entries_at_points(*database);
  require_answers_among_entries(*database);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 50000) return 0;
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  read(with_right_hash(text));
  return 0;
}
