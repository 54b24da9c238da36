#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/channel.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::views {

/// From the scene's plane about a place to longitude and latitude [°]. Fails where PROJ cannot be loaded.
io::Result<io::Project> degrees_about(const simulation::GeographicOrigin& origin);

/// The layers of a run at a time as GeoJSON FeatureCollections: floes, fractures up to then, and for each
/// ship its track and its hull; metres in the scene's plane unless a projection is given. Names of files with
/// their text.
std::vector<std::pair<std::string, std::string>> geojson_layers(const io::Run& run, double time,
                                                                const io::Project& project);

}  // namespace polynya::views
