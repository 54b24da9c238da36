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
  std::string out;            ///< folder; empty: the first run's
  std::vector<double> at;     ///< moments for the maps [s]; empty: chosen
  std::string load = "peak";  ///< or "max", "mean"
};
int figures(const FiguresOptions& options);

}  // namespace polynya::app
