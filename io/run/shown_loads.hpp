#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/run/force_columns.hpp"
#include "simulation/scene.hpp"

namespace polynya::io {

/// A measure of the load on a ship, as every view shows it: terminal, summary.json, figures and player
/// (docs/theory.md, "Which force").
struct ShownLoad {
  std::string option;   ///< of `polynya figures --load`: "mean", "max", "ships" (two), "j-over-tau-c"
  std::string measure;  ///< "mean over 0.1 s"
  bool is_by_ice = true;
  std::array<const ForceColumn*, 3> columns{};  ///< surge, sway, yaw

  std::string_view source() const { return is_by_ice ? "ice" : "other ships and structures"; }
};

/// The measures that a scene's views show, in their order: the true force as the mean over the recording
/// interval and as the largest single step; the same of contact with other ships and structures where there
/// are any; last the paper's j/τ_c where it decides splits.
std::vector<ShownLoad> shown_loads(const simulation::Scene& scene);

}  // namespace polynya::io
