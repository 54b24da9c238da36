#pragma once

#include <string>
#include <vector>

#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "views/map/chart.hpp"

namespace polynya::app {

struct NamedChart {
  std::string file;  ///< such as "speed.svg"
  views::Chart chart;
};

/// Slices of a database through one load: force and radius against speed, opening angle and thickness, each
/// for the load itself and its neighbours in another of the three, beside Nevel's and Kashtelyan's forms.
std::vector<NamedChart> database_charts(const fracture::FsiDatabaseModel& model, const std::string& title,
                                        const fracture::BendingLoad& load);

}  // namespace polynya::app
