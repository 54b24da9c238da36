#pragma once

#include <string>

#include "analysis/channel.hpp"

namespace polynya::analysis {

/// A channel for people: stations, widths, what is left in the band, with units in the heads.
std::string to_table(const Channel& channel);
/// One row a station.
std::string to_csv(const Channel& channel);
/// Everything but the shapes, one object.
std::string to_json_text(const Channel& channel);
/// Open water, swept band, track and stations as a FeatureCollection in metres of the scene's plane.
std::string to_geojson(const Channel& channel);

}  // namespace polynya::analysis
