#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/run/force_columns.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// A measure of the load on a ship, as the end of a run prints it (docs/theory.md, "Which force").
struct ShownLoad {
  std::string measure;  ///< "mean over 0.1 s"
  bool is_by_ice = true;
  std::array<const ForceColumn*, 2> columns{};  ///< surge, sway
};

/// The measures of a scene that are shown, in their order: the true force as the mean over the recording
/// interval and as the largest single step; the same of contact with other ships and structures where there
/// are any; last the paper's j/τ_c where it decides splits.
std::vector<ShownLoad> shown_loads(const simulation::Scene& scene);

}  // namespace polynya::io
