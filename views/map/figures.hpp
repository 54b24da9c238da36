#pragma once

#include <string>
#include <vector>

#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"
#include "io/run/shown_loads.hpp"
#include "views/map/chart.hpp"
#include "views/map/picture.hpp"

namespace polynya::views {

/// Figures of one run, or of several side by side, each under its label, after Figs. 4–7 of [Sawamura2017]
/// (docs/figures.md).

/// A run's floes, hulls, tracks and fractures at a time [s].
Picture picture_at(const io::Run& run, const io::MotionIndex& motions, double time);

/// Draws the last frame of a run, finished or not, into its folder: final.svg, and final.png where there is a
/// converter. Returns the name of the better one; the error names the file that could not be written.
io::Result<std::string> draw_final_map(const io::Run& run);

/// Floes, hulls, tracks and channel of each run at each time [s].
PictureSheet map_figure(const std::vector<io::Run>& runs, const std::vector<double>& times);

/// The loads of a scene that `--load` names: "true" is the true force of ice, mean and single step. None
/// where the scene has none of that kind.
std::vector<io::ShownLoad> chosen_loads(const simulation::Scene& scene, std::string_view option);

/// Surge, sway and yaw of each run's ships and structures against time, by chosen_loads, with the fractures
/// of each marked; one scale for each of the three.
Chart load_figure(const std::vector<io::Run>& runs, std::string_view option, const PageStyle& page = {});

/// Speed, and heading and course over ground, of each run's ships and structures.
Chart motion_figure(const std::vector<io::Run>& runs);

/// How many floes, and how much ice, is in floes of at least a size, at the start and at the end.
Chart size_figure(const std::vector<io::Run>& runs);

/// Where each run's energy came from and where it went, from summary.json's `energy`; empty where no run has
/// it.
std::string energy_figure(const std::vector<io::Run>& runs, const PageStyle& page = {});

}  // namespace polynya::views
