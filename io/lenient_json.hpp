#pragma once

#include <string>

#include <tl/expected.hpp>

#include "io/json_value.hpp"

namespace polynya::io {

/// JSON in which also NaN, Infinity and numbers beyond the doubles stand, as Python and others write them:
/// each of them becomes an empty text, which no number is. The error is "line:column: words".
tl::expected<JsonValue, std::string> parse_lenient_json(std::string text);

}  // namespace polynya::io
