#pragma once

#include <cstdint>
#include <unordered_map>

#include "io/text/floe_text.hpp"
#include "io/text/result.hpp"

namespace polynya::io {

/// The lines of a run's floes.ndjson among the entries of a text, which may hold only some of them: what is
/// parts of a parent's shape is assembled from the entries before it.
class BirthShapes {
 public:
  explicit BirthShapes(const FloeText& floes) : floes_(floes) {}

  /// The next entry is this floe's.
  void add_next(std::int64_t floe) { entry_of_[floe] = floes_.entries.size(); }

  /// The shape of a line that has parts of its parent's. The error is what is wrong with it or missing.
  Result<geometry::Polygon> assemble(const JsonValue& line);

 private:
  const FloeText& floes_;
  std::unordered_map<std::int64_t, std::size_t> entry_of_;  ///< by floe id
  std::size_t assembled_ = 0;                               ///< vertices
};

/// The number of a floe in a member of an object; nothing where that is no such number.
std::optional<std::int64_t> floe_id_in(const JsonValue& object, std::string_view key);

}  // namespace polynya::io
