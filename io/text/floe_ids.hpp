#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/floe_text.hpp"

namespace polynya::io {

// Polynya numbers floes by whole numbers from 0 to 9·10¹⁵ (some 2^53, up to which a double has every whole number), in
// the property "floe_id". Other files may name floes by texts, fractions or larger numbers, state the id beside the
// properties, use a name twice, or leave floes without a name. If this holds for a single floe, Polynya numbers all
// floes of the file and stores the ids of the file in another property. A message says so (replaced_in_words), unless
// no floe had an id.

/// Id of a floe in a file. Without both members, the floe has none.
struct GivenId {
  std::optional<std::int64_t> number;  ///< property "floe_id", if it is a whole number that Polynya can use
  /// Otherwise that property, or without it the "id" of the feature. It may be any value: JSON as written in the file.
  std::optional<std::string> other;

  bool is_given() const { return number || other; }
  /// Returns the id as JSON. The floe must have one; without one the result is "0".
  std::string as_json() const { return other ? *other : std::to_string(number.value_or(0)); }
};
/// Returns the id of a floe that was read from a file.
GivenId given_id(const FloeEntry& entry);

/// Returns the reason in words why the ids of floes cannot be kept, for messages: "2 are text ("A1"), 1 floe has none".
/// Each kind of reason has the number of its floes and its first id. Returns an empty text if the ids can be kept, or
/// if no floe has an id, so that nothing is lost by numbering them.
std::string why_ids_are_replaced(const std::vector<GivenId>& ids);

/// Returns true if every floe has a GivenId::number and no two are equal. The ids are then kept; otherwise all floes
/// are numbered, also those whose own id would be usable.
bool are_usable(const std::vector<GivenId>& ids);

/// Returns the name of the property that stores the ids of the file: "source_id", followed by as many _ as make it
/// different from all properties of the file.
std::string source_id_key(const std::vector<FloeEntry>& entries);

/// Returns the message about ids that are replaced. `why` is from why_ids_are_replaced() and must not be empty, `key`
/// is from source_id_key().
std::string replaced_in_words(std::string_view why, std::string_view key);

}  // namespace polynya::io
