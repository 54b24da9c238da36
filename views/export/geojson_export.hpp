#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/channel.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::views {

/// The layers of a run at a time as GeoJSON FeatureCollections: floes, fractures up to then, and for each
/// ship its track and its hull. Longitude and latitude in degrees where an origin is given, else metres in
/// the scene's plane. Names of files with their text.
std::vector<std::pair<std::string, std::string>> geojson_layers(
    const io::Run& run, double time, const std::optional<simulation::GeographicOrigin>& origin);

}  // namespace polynya::views
