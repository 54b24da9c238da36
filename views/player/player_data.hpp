#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "geometry/shape/point.hpp"
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

/// What the player's page holds of a run (docs/view.md): words and lists as JSON, numbers as columns.
struct PlayerData {
  std::string info;  ///< JSON
  ColumnWriter columns;
  std::size_t frames = 0;
  std::size_t floes = 0;
  std::size_t floe_bytes = 0;   ///< of `columns`: shapes and particulars
  std::size_t frame_bytes = 0;  ///< of `columns`: where everything is over time
  double start = 0;             ///< of the frames [s]
  double end = 0;
};

/// Which part of a run a page holds.
struct PlayerSelection {
  io::FrameSelection frames;
  std::optional<geometry::Box> area;  ///< only floes that come within it, and their families
};

PlayerData player_data(const io::Run& run, const PlayerSelection& selection);

/// Of each floe of a run how far a box has to grow on all sides for the floe, or one of its family (all that
/// broke from one floe of the scene), to come within it at one of these frames [m]; 0 where one does as it
/// is. By the floes' circles and the boxes of their ways from record to record.
std::vector<double> family_distances(const io::Run& run, const geometry::Box& box,
                                     const std::vector<io::Frame>& frames);

}  // namespace polynya::views
