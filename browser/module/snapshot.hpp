#pragma once

#include <string>
#include <vector>

#include "simulation/simulation.hpp"
#include "views/player/player_page.hpp"

namespace polynya::browser {

/// Collects what a running simulation must show between two pictures of the page: new floes, loads on hulls and events
/// since the last picture, and all positions at the time of the picture.
class SnapshotMaker {
 public:
  /// Takes the additions of a step from the journal, before the journal is written and emptied.
  void gather(const simulation::Journal& journal, const simulation::Scene& scene);

  /// Returns the columns of the picture and empties the collection.
  views::ColumnWriter take(const simulation::Simulation& simulation);

 private:
  void add_births(views::ColumnWriter& columns);
  void add_places(views::ColumnWriter& columns, const simulation::Simulation& simulation);
  void add_samples(views::ColumnWriter& columns, const simulation::Scene& scene);

  std::vector<simulation::Birth> births_;
  std::vector<simulation::HullSample> samples_;
  std::string events_;                      ///< one JSON object per line
  std::vector<geometry::Point> centroids_;  ///< by floe id, in the body frame [m]
};

}  // namespace polynya::browser
