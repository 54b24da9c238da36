#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_value.hpp"
#include "io/text/result.hpp"

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

/// Where the parser stopped in a text, and what surrounds that place.
struct ParserStop {
  struct Bracket {
    std::size_t offset = 0;
    bool is_list = false;
  };
  std::string_view text;
  std::string reason;                ///< the parser's own words
  std::size_t token = 0;             ///< where the first token begins that was not used
  std::size_t last_read = 0;         ///< the last byte the parser read
  std::size_t gap = 0;               ///< just behind the last token that was used
  std::vector<std::size_t> commas;   ///< between gap and token
  bool follows_value = false;        ///< the last token that was used completed a value
  std::optional<Bracket> open = {};  ///< the innermost object or list that is not closed
};

/// The same in words for people: a missing comma, one too many, a bracket that is not closed, else what was
/// found and what is allowed.
JsonFault fault_of(const ParserStop& stop);

/// "found '=', allowed: a colon", or the fault's own sentence.
std::string message_of(const JsonFault& fault);

/// JSON in which also NaN, Infinity and numbers beyond the doubles stand, as Python and others write them:
/// each of them becomes an empty text, which no number is. The error is "line:column: words".
Result<JsonValue> parse_lenient_json(const std::string& text);

/// The value that begins at an offset of a text that parse_lenient_json accepts, as it is written there but
/// without blanks and comments; what is not finite becomes null.
std::string compact_json(std::string_view text, std::size_t offset);

}  // namespace polynya::io
