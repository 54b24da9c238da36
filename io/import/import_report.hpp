#pragma once

#include <string>
#include <vector>

#include "io/import/floe_import.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::io {

/// The imported floes as GeoJSON in metres, with the properties of the features they are of: `entries` are
/// those of the file, one for each of its floes.
std::string to_geojson(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                       const std::vector<FloeEntry>& entries);

/// The report of an import as JSON: totals, how the coordinates came to the plane, and each floe that did not
/// stay as it was (docs/import.md).
std::string to_json_text(const ImportOutcome& imported, const std::string& file, const std::vector<FloeEntry>& entries,
                         const std::vector<NearMiss>& near_misses);

/// "812 floes read, 3 repaired, 12 trimmed, 2 dropped, 1 refused; 809 written"
std::string counts_in_words(const ImportTotals& totals);

/// "2 of 3 floes have a thickness of their own"
std::string thickness_in_words(std::size_t with_thickness, std::size_t floes);

/// "123.4 m² read + 0.5 repaired − 3 trimmed − 1 dropped = 119.9 m² written"
std::string areas_in_words(const ImportTotals& totals);

/// How the coordinates came to the plane: "WGS 84, projected about 78.2, 15.6"
std::string plane_in_words(const PlaneReport& plane);

/// What happened to a floe: "self-crossing at (0, 0), repaired, +3 m²; trimmed, −2 m² to feature 3"
std::string item_in_words(const ImportItem& item, const std::vector<FloeEntry>& entries);

}  // namespace polynya::io
