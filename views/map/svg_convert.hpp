#pragma once

#include <filesystem>

namespace polynya::views {

/// Makes a PNG (240 dots per inch) or a PDF of an SVG file, by the suffix of `target`, where rsvg-convert is
/// installed. False where it is not or fails.
bool convert_svg(const std::filesystem::path& svg, const std::filesystem::path& target);

}  // namespace polynya::views
