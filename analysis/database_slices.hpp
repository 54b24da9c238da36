#pragma once

#include <string>

#include "fracture/bending/fsi_database_model.hpp"

namespace polynya::analysis {

/// One load by the database and by the published forms it can be compared with.
struct SlicePoint {
  fracture::BendingForecast database;
  fracture::BendingCapacity nevel;  ///< at the database's penetration
  fracture::BendingCapacity kashtelyan;
};

SlicePoint compare_models(const fracture::FsiDatabaseModel& model, const fracture::BendingLoad& load);

/// Slices of a database through one load as JSON, which polynya.figures.database draws: force and radius
/// against speed, opening angle and thickness, each for the load itself and its neighbours in another of the
/// three, beside Nevel's and Kashtelyan's forms. Units in the keys. `description` is the load in words.
std::string database_slices(const fracture::FsiDatabaseModel& model, const std::string& title,
                            const fracture::BendingLoad& load, const std::string& description);

}  // namespace polynya::analysis
