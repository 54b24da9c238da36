#pragma once

#include <array>
#include <string>
#include <string_view>

#include "io/scene/scene_reader.hpp"
#include "views/player/player_data.hpp"

namespace polynya::views {

/// The pages of views/player with their style sheets and scripts, made by cmake/PolynyaPlayerPage.cmake. What
/// is of a run is put in for {{title}}, {{info}} and {{columns}}.
extern const std::string_view kPlayerTemplate;
extern const std::string_view kPairTemplate;

/// One HTML file that shows a run and needs nothing else (docs/view.md); with `options` a scene (scene_page.cpp).
std::string player_page(const io::Run& run, const PlayerData& data, const std::string& options = "{}");

/// A run of a page of two.
struct ShownRun {
  PlayerData data;
  std::string label;
};

/// One HTML file that shows two runs side by side, with one clock (docs/view.md).
std::string pair_page(const std::array<ShownRun, 2>& runs);

}  // namespace polynya::views
