#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/text/json_value.hpp"
#include "io/text/result.hpp"

namespace polynya::io {

/// JSON in which also NaN, Infinity and numbers beyond the doubles stand, as Python and others write them:
/// each of them becomes an empty text, which no number is. The error is "line:column: words".
Result<JsonValue> parse_lenient_json(const std::string& text);

/// The value that begins at an offset of a text that parse_lenient_json accepts, as it is written there but
/// without blanks and comments; what is not finite becomes null.
std::string compact_json(std::string_view text, std::size_t offset);

}  // namespace polynya::io
