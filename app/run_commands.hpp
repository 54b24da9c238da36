#pragma once

#include <optional>
#include <string>
#include <vector>

namespace polynya::app {

/// The subcommands that take on a run that was made. As in commands.hpp.

struct ChannelOptions {
  std::string run;
  std::string out;           ///< folder for channel.csv and channel.geojson; empty: the run's
  std::string ship;          ///< empty: the first one
  std::optional<double> at;  ///< [s]
  double spacing = 0;        ///< [m]; 0: the beam
  double reach = 0;          ///< [m]; 0: four beams
  std::string format = "table";
};
int channel(const ChannelOptions& options);

struct FiguresOptions {
  std::vector<std::string> runs;
  std::string out;                   ///< folder; empty: the first run's
  std::vector<double> at;            ///< moments for the maps [s]; empty: chosen
  std::string load = "true";         ///< views/map/figures.hpp, chosen_loads
  std::optional<std::string> title;  ///< instead of the figures' own; empty: none
  std::vector<std::string> labels;   ///< of the runs, instead of their scenes' names
  double width = 170;                ///< of a figure on paper [mm]
  std::vector<double> window;        ///< of the maps: x0, y0, x1, y1; empty: all of it [m]
};
int figures(const FiguresOptions& options);

struct ExportOptions {
  std::string run;
  std::string vtk;            ///< folder; empty: none
  std::string geojson;        ///< folder; empty: none
  std::optional<double> at;   ///< moment of the GeoJSON [s]; the end if not given
  int every = 1;              ///< of VTK: each so many-th frame
  bool is_in_metres = false;  ///< GeoJSON in the scene's plane though it has an origin
};
int export_run(const ExportOptions& options);

}  // namespace polynya::app
