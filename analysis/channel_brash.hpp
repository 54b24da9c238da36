#pragma once

#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "analysis/channel.hpp"
#include "analysis/placed_ice.hpp"

namespace polynya::analysis {

/// How much of each floe that reaches into polygons lies in them, the largest floe first. Fails with words
/// where geometry refuses.
tl::expected<std::vector<ChannelFloe>, std::string> floes_in(const std::vector<geometry::Polygon>& polygons,
                                                             const std::vector<PlacedIce>& ice);

/// Measures the brash in a channel from ice to ice, in the cells of its stations and piece by piece. Fails
/// with words where geometry refuses.
tl::expected<void, std::string> measure_brash(Channel& channel, const std::vector<geometry::Polygon>& cells,
                                              const std::vector<PlacedIce>& brash);

}  // namespace polynya::analysis
