#pragma once

#include <filesystem>
#include <string>

#include <tl/expected.hpp>

namespace polynya::io {

/// Reads a run folder, finished or not, and draws its last frame into it: final.svg, and final.png where
/// there is a converter. Returns the name of the best picture; the error states the file and the reason.
tl::expected<std::string, std::string> draw_final_map(const std::filesystem::path& folder);

}  // namespace polynya::io
