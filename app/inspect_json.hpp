#pragma once

#include <string>
#include <vector>

#include "app/inspect_views.hpp"

namespace polynya::app {

/// The reports of `polynya inspect` as JSON: one object each.

std::string floes_json(const std::vector<FloeRow>& rows, double time);

std::string size_json(const SizeDistribution& sizes);

/// The floes from the scene's down to this one; of each the fracture that broke it, as in events.ndjson.
std::string lineage_json(const io::Run& run, simulation::FloeId floe);

std::string check_json(const analysis::RunCheck& check);

}  // namespace polynya::app
