#pragma once

#include <string>
#include <string_view>

namespace polynya::io {
/// Text as it may stand in XML (SVG): &, < and > escaped.
std::string escaped(const std::string& text);

/// Bytes as base64 text (RFC 4648, with padding, no line breaks).
std::string to_base64(std::string_view bytes);

}  // namespace polynya::io
