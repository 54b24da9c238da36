#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/floe_text.hpp"

namespace polynya::io {

// Floes go by whole numbers from 0 to 2^53. Files of others name them by texts, fractions or larger numbers, use a name
// twice, or name some of them only. Then floes are numbered, and each keeps what the file calls it as another property.

/// What a file calls a floe.
struct GivenId {
  std::optional<std::int64_t> number;  ///< a whole number
  std::optional<std::string> other;    ///< a value of JSON, as written, that is none

  bool is_given() const { return number || other; }
  std::string as_json() const { return other ? *other : std::to_string(number.value_or(0)); }  ///< of one that is given
};
GivenId given_id(const FloeEntry& entry);

/// Why the ids of floes cannot be kept, in words for people: "2 are text ("A1"), 1 floe has none". Empty where they can
/// be kept, or where no floe has one.
std::string why_ids_are_replaced(const std::vector<GivenId>& ids);

/// Whether every floe has an id that is a whole number and that no other floe has.
bool are_usable(const std::vector<GivenId>& ids);

/// The property under which a floe keeps what the file calls it: "source_id", unless the file has that property.
std::string source_id_key(const std::vector<FloeEntry>& entries);

/// What is done about ids that cannot be kept, in words.
std::string replaced_in_words(std::string_view why, std::string_view key);

}  // namespace polynya::io
