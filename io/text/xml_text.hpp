#pragma once

#include <string>

namespace polynya::io {

/// Text as it may stand in XML (SVG): &, < and > escaped.
std::string escaped(const std::string& text);

}  // namespace polynya::io
