#pragma once

#include <string_view>

#include "io/text/source_text.hpp"

namespace polynya::app {

/// The page that holds the simulator (docs/browser.md), with a scene in it. It is found beside an installed program, or
/// in the build folder `browser` beside the program's own; POLYNYA_LIVE_PAGE names another place.
io::Result<std::string> live_page(std::string_view scene);

}  // namespace polynya::app
