#pragma once

#include <string>
#include <string_view>

#include "io/text/source_text.hpp"

namespace polynya::cosim {

/// Returns the folder that a URI of the scheme "file" names: file:///tmp/a%20b/resources is /tmp/a b/resources.
io::Result<std::string> folder_of(std::string_view uri);

}  // namespace polynya::cosim
