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

/// Packs columns of numbers one after the other, each at a multiple of 8 bytes, as the player's typed arrays need.
/// `table` lists name, type ("f64", "i32", "u8"), first byte and number of values of each column.
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
  /// Adds a column with one value of each item. Doubles remain doubles; all other types become 32-bit integers.
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

/// Data of a run for the player's page (docs/view.md): words and lists as JSON, numbers as columns.
struct PlayerData {
  std::string info;  ///< JSON
  ColumnWriter columns;
  std::size_t frames = 0;
  std::size_t floes = 0;
  std::size_t floe_bytes = 0;   ///< bytes in `columns` for shapes and properties of floes; for advice on large pages
  std::size_t frame_bytes = 0;  ///< bytes in `columns` for positions over time; for advice on large pages
  double start = 0;             ///< time of the first frame [s]
  double end = 0;               ///< time of the last frame [s]
};

/// Selects the part of a run that a page contains.
struct PlayerSelection {
  io::FrameSelection frames;  ///< the part of the run in time, and which of its frames
  /// Only floes that come within this box at some frame, and their families (floes from one floe of the scene).
  std::optional<geometry::Box> area;
};

/// Collects the data of the selected part of a run.
PlayerData player_data(const io::Run& run, const PlayerSelection& selection);

/// The pages of views/player with their style sheets and scripts, which cmake/PolynyaPlayerPage.cmake assembles. Marks
/// in double braces, such as {{title}}, {{info}} and {{columns}}, are replaced by data of a run.
extern const std::string_view kPlayerTemplate;
extern const std::string_view kPairTemplate;

/// Returns one HTML file that shows a run and needs no other file (docs/view.md). `options` is JSON for pages of scenes
/// (scene_page()).
std::string player_page(const io::Run& run, const PlayerData& data, const std::string& options = "{}");

/// One of the two runs on a page.
struct ShownRun {
  PlayerData data;
  std::string label;
};

/// Returns one HTML file that shows two runs side by side with a common clock (docs/view.md).
std::string pair_page(const std::array<ShownRun, 2>& runs);

/// Returns the options of the page of a scene that has not run, as JSON: the routes of ships, the wind at the start,
/// and the warnings and hints of `polynya validate`. scene_page() explains `stamp` and `stamp_file`.
std::string scene_plan(const io::LoadedScene& scene, const std::string& stamp, const std::string& stamp_file);

/// Returns one HTML file that shows a scene that has not run (docs/view.md). For `--watch`, `stamp` identifies this
/// version of the page, and the script `stamp_file` beside it, if one is named, sets the stamp of the newest version.
io::Result<std::string> scene_page(const io::LoadedScene& scene, const std::string& stamp,
                                   const std::string& stamp_file);

}  // namespace polynya::views
