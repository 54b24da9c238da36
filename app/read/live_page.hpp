#pragma once

#include <string_view>

#include "io/text/source_text.hpp"

namespace polynya::app {

/// Returns the page that contains the simulator (docs/browser.md), with a scene in it. The page is installed with the
/// program, or is in the build folder `browser` beside the program's own. POLYNYA_LIVE_PAGE names another place.
io::Result<std::string> live_page(std::string_view scene);

}  // namespace polynya::app
