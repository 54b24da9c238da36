#pragma once

#include <string>
#include <vector>

#include "simulation/simulation.hpp"
#include "views/player/player_page.hpp"

namespace polynya::browser {

/// Gathers what a running simulation shows between two pictures of the page: floes that were made, loads on hulls and
/// events since the last picture, and where everything is at the time of the picture.
class SnapshotMaker {
 public:
  /// Takes over what a step added to the journal, before the journal is written and cleared.
  void gather(const simulation::Journal& journal, const simulation::Scene& scene);

  /// Returns the columns of the picture, and forgets what was gathered.
  views::ColumnWriter take(const simulation::Simulation& simulation);

 private:
  void add_births(views::ColumnWriter& columns);
  void add_places(views::ColumnWriter& columns, const simulation::Simulation& simulation);
  void add_samples(views::ColumnWriter& columns, const simulation::Scene& scene);

  std::vector<simulation::Birth> births_;
  std::vector<simulation::HullSample> samples_;
  std::string events_;                      ///< one JSON object a line
  std::vector<geometry::Point> centroids_;  ///< by floe id, in the body frame [m]
};

}  // namespace polynya::browser
