#pragma once

#include <string_view>

#include "io/text/floe_text.hpp"

namespace polynya::io {

class BirthShapes;

/// Adds everything in a GeoJSON value to the floes, as one feature after the other from `feature` on. Lines
/// are left as offsets in `text`, in which the value stands; properties and crs are taken from there as they
/// are written (none are kept where the text is empty). `births` has the floes of a run that stand before in
/// the same text.
void read_geojson_entries(const JsonValue& value, std::string_view text, std::size_t feature, FloeText& floes,
                          BirthShapes& births);

}  // namespace polynya::io
