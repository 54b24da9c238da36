#pragma once

#include <string>
#include <vector>

#include "io/chart.hpp"
#include "io/picture.hpp"
#include "io/run_reader.hpp"

namespace polynya::io {

/// Figures of one run, or of several side by side, after Figs. 4–7 of [Sawamura2017] (docs/figures.md).

/// Which of forces.csv's loads is shown.
enum class LoadKind {
  kPeak,  ///< the paper's j/τ_c, the interval's largest by magnitude
  kMax,   ///< true force of one step, the interval's largest by magnitude
  kMean,  ///< true force, mean over the interval
};

/// Floes, hulls, tracks and channel of each run at each time [s].
PictureSheet map_figure(const std::vector<Run>& runs, const std::vector<double>& times);

/// Surge, sway and yaw load of each run's ships and structures against time, with the fractures of each
/// marked; one scale a load.
Chart load_figure(const std::vector<Run>& runs, LoadKind kind);

/// Speed, and heading and course over ground, of each run's ships and structures.
Chart motion_figure(const std::vector<Run>& runs);

/// How many floes, and how much ice, is in floes of at least a size, at the start and at the end.
Chart size_figure(const std::vector<Run>& runs);

/// Where each run's energy went, from summary.json's `energy`; empty where no run has it.
std::string energy_figure(const std::vector<Run>& runs);

}  // namespace polynya::io
