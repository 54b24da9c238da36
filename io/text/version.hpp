#pragma once

#include <string_view>

namespace polynya::io {

/// Polynya's version, as in every summary.json.
std::string_view version();

}  // namespace polynya::io
