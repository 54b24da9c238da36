#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/floe_text.hpp"

namespace polynya::io {

// Polynya numbers floes by whole numbers from 0 to 9·10¹⁵ (some 2^53), in the property "floe_id". Other files may name
// floes by texts, fractions or larger numbers, state the id beside the properties, use a name twice, or leave floes
// without a name. Then Polynya numbers all floes of the file and stores the id of the file in another property.

/// Id of a floe in a file. Without both members, the floe has none.
struct GivenId {
  std::optional<std::int64_t> number;  ///< property "floe_id", if it is a whole number that Polynya can use
  /// Otherwise that property, or the "id" of the feature, which may be any value: JSON as written in the file.
  std::optional<std::string> other;

  bool is_given() const { return number || other; }
  /// Returns the id as JSON. The floe must have one.
  std::string as_json() const { return other ? *other : std::to_string(number.value_or(0)); }
};
GivenId given_id(const FloeEntry& entry);

/// Returns the reason in words why the ids of floes cannot be kept, for messages: "2 are text ("A1"), 1 floe has none".
/// Returns an empty text if they can be kept, or if no floe has an id, so that nothing is lost by numbering them.
std::string why_ids_are_replaced(const std::vector<GivenId>& ids);

/// Returns true if every floe has a GivenId::number and no two are equal. The ids are then kept; otherwise floes are
/// numbered.
bool are_usable(const std::vector<GivenId>& ids);

/// Returns the name of the property that stores the ids of the file: "source_id", followed by as many _ as make it
/// different from all properties of the file.
std::string source_id_key(const std::vector<FloeEntry>& entries);

/// Returns the message about ids that are replaced. `why` is from why_ids_are_replaced(), `key` from source_id_key().
std::string replaced_in_words(std::string_view why, std::string_view key);

}  // namespace polynya::io
