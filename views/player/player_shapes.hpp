#pragma once

#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// Columns of numbers one after the other, each at a multiple of 8 bytes, as the player reads them. `table`
/// has of each: name, type ("f64", "i32", "u8"), first byte, how many numbers.
class ColumnWriter {
 public:
  struct Column {
    std::string name;
    const char* type = "u8";
    std::size_t offset = 0;  ///< [bytes]
    std::size_t count = 0;
  };
  void add(const std::string& name, const std::vector<double>& values);
  void add(const std::string& name, const std::vector<std::int32_t>& values);
  void add(const std::string& name, std::string_view bytes);
  /// A number of each item: a double, or anything else as a 32-bit integer.
  template <class Items, class Read>
  void add(const std::string& name, const Items& items, Read read) {
    using Found = std::remove_cvref_t<std::invoke_result_t<Read, const typename Items::value_type&>>;
    std::vector<std::conditional_t<std::is_same_v<Found, double>, double, std::int32_t>> values;
    values.reserve(items.size());
    for (const auto& item : items)
      values.push_back(static_cast<typename decltype(values)::value_type>(std::invoke(read, item)));
    add(name, values);
  }
  const std::vector<Column>& table() const { return table_; }
  const std::string& bytes() const { return bytes_; }

 private:
  void add_raw(const std::string& name, const char* type, const void* data, std::size_t count, std::size_t size);
  std::vector<Column> table_;
  std::string bytes_;
};

/// The floes of a run that a page holds.
class HeldFloes {
 public:
  /// All of so many.
  explicit HeldFloes(std::size_t count) : ids_(count) { std::iota(ids_.begin(), ids_.end(), 0); }
  /// Those whose distance is 0.
  explicit HeldFloes(const std::vector<double>& distances) : is_held_(distances.size()) {
    for (std::size_t i = 0; i < distances.size(); ++i) {
      is_held_[i] = distances[i] <= 0;
      if (is_held_[i]) ids_.push_back(static_cast<simulation::FloeId>(i));
    }
  }
  bool are_all() const { return is_held_.empty(); }
  /// Also of what is no floe.
  bool has(simulation::FloeId id) const { return id < 0 || are_all() || is_held_[static_cast<std::size_t>(id)]; }
  const std::vector<simulation::FloeId>& ids() const { return ids_; }

 private:
  std::vector<simulation::FloeId> ids_;
  std::vector<bool> is_held_;  ///< by floe; empty where all are
};

/// Of every floe held its floe_id where not all are; parent, generation, born_s, died_s, went_under_s,
/// came_up, area_m2, mass_kg, thickness_m, flexural_strength_Pa, centroid, reach_m (of its farthest vertex
/// from its centroid), and its shape: the ends of its rings, counted from its first vertex, and its vertices,
/// or of one that is parts of its parent's the parts and its new vertices.
void add_floes(ColumnWriter& columns, const io::Run& run, const HeldFloes& held);

}  // namespace polynya::views
