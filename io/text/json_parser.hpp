#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_value.hpp"

namespace polynya::io {

inline constexpr int kDeepestNesting = 64;
inline constexpr std::size_t kLongestText = std::size_t{256} << 20;  ///< [bytes]

/// Something wrong in a JSON text, before its meaning is read.
struct JsonFault {
  std::uint32_t offset = 0;  ///< byte in the text
  std::string path;          ///< of the member, for a key that stands twice; else empty
  std::string found;
  std::string allowed;
  std::string sentence = {};  ///< a plain sentence in place of found and allowed, or empty
};

struct JsonDocument {
  JsonValue root;
  std::vector<JsonFault> faults;  ///< empty where the text is sound
};

/// Reads JSON with // and /* */ comments. A syntax error ends the reading (the root is then what was read so
/// far); keys that stand twice are faults and the first one counts. Nesting and length are bounded.
JsonDocument parse_json(std::string_view text);

}  // namespace polynya::io
