#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/run/run_reader.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/problem.hpp"

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
  void add(const std::string& name, const std::vector<double>& values) { add_raw(name, "f64", values); }
  void add(const std::string& name, const std::vector<std::int32_t>& values) { add_raw(name, "i32", values); }
  void add(const std::string& name, std::string_view bytes) { add_raw(name, "u8", bytes); }
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
  template <class Values>
  void add_raw(const std::string& name, const char* type, const Values& values) {
    bytes_.resize((bytes_.size() + 7) / 8 * 8);
    table_.push_back({name, type, bytes_.size(), values.size()});
    const auto bytes = std::as_bytes(std::span(values));
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
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

/// The pages of views/player with their style sheets and scripts, made by cmake/PolynyaPlayerPage.cmake. What
/// is of a run is put in for {{title}}, {{info}} and {{columns}}.
extern const std::string_view kPlayerTemplate;
extern const std::string_view kPairTemplate;

/// One HTML file that shows a run and needs nothing else (docs/view.md); with `options` a scene (scene_page()).
std::string player_page(const io::Run& run, const PlayerData& data, const std::string& options = "{}");

/// A run of a page of two.
struct ShownRun {
  PlayerData data;
  std::string label;
};

/// One HTML file that shows two runs side by side, with one clock (docs/view.md).
std::string pair_page(const std::array<ShownRun, 2>& runs);

/// What a page of a scene that has not run shows beside ice and hulls, as its options: routes of ships, wind, and the
/// warnings of `polynya validate`.
std::string scene_plan(const io::LoadedScene& scene, const std::string& stamp, const std::string& stamp_file);

/// One HTML file that shows a scene that has not run (docs/view.md). `stamp` is of this page: the script `stamp_file`
/// beside it, where one is named, has that of the newest (`--watch`).
io::Result<std::string> scene_page(const io::LoadedScene& scene, const std::string& stamp,
                                   const std::string& stamp_file);

}  // namespace polynya::views
