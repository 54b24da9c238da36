#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"

namespace polynya::io {

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

}  // namespace polynya::io
