#pragma once

#include <string>
#include <string_view>

namespace polynya::cosim {

/// Returns what a unit is in powers of SI base units, as attributes of a BaseUnit of the standard: kg="1" m="-1" …
/// with its factor. Empty for a unit that is not known.
std::string base_unit(std::string_view unit);

}  // namespace polynya::cosim
