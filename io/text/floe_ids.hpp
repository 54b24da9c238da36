#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/floe_text.hpp"

namespace polynya::io {

// Polynya numbers floes by whole numbers from 0 to 2^53. Other files may name floes by texts, fractions or larger
// numbers, use a name twice, or leave floes without a name. Then Polynya numbers the floes of the file and stores the
// id of the file in another property.

/// Id of a floe in a file.
struct GivenId {
  std::optional<std::int64_t> number;  ///< the id, if it is a whole number
  std::optional<std::string> other;    ///< the id as JSON, as written in the file, if it is not a whole number

  bool is_given() const { return number || other; }
  std::string as_json() const { return other ? *other : std::to_string(number.value_or(0)); }  ///< needs an id
};
GivenId given_id(const FloeEntry& entry);

/// Says in words why the ids of floes cannot be kept: "2 are text ("A1"), 1 floe has none". Returns an empty text if
/// they can be kept, or if no floe has an id.
std::string why_ids_are_replaced(const std::vector<GivenId>& ids);

/// Returns true if every floe has a whole number as its id and no two ids are equal.
bool are_usable(const std::vector<GivenId>& ids);

/// Name of the property that stores the ids of the file: "source_id", followed by as many _ as make it different from
/// all properties of the file.
std::string source_id_key(const std::vector<FloeEntry>& entries);

/// Says in words what is done about ids that cannot be kept.
std::string replaced_in_words(std::string_view why, std::string_view key);

}  // namespace polynya::io
