#pragma once

#include <string>
#include <string_view>

#include "views/player/player_data.hpp"

namespace polynya::views {

/// The page of io/player with its style sheets and scripts, made by cmake/PolynyaPlayerPage.cmake. What is of
/// a run is put in for {{title}}, {{info}} and {{columns}}.
extern const std::string_view kPlayerTemplate;

/// One HTML file that shows a run and needs nothing else (docs/view.md).
std::string player_page(const io::Run& run, const PlayerData& data);

}  // namespace polynya::views
