#pragma once

#include <string>

#include "fracture/bending/fsi_database_model.hpp"

namespace polynya::analysis {

/// Bending of one load by the database, and by the published formulas to which it can be compared.
struct SlicePoint {
  fracture::BendingForecast database;
  fracture::BendingCapacity nevel;  ///< Nevel's formula at the penetration of the database
  fracture::BendingCapacity kashtelyan;
};

/// Computes one load by all models.
SlicePoint compare_models(const fracture::FsiDatabaseModel& model, const fracture::BendingLoad& load);

/// Returns slices of a database through one load as JSON, which polynya.figures.database draws: force and cusp radius
/// over speed, opening angle and thickness, each for the load itself and for neighbouring values of another of the
/// three, and for comparison the formulas of Nevel and Kashtelyan. Keys have units. `description` describes the load in
/// words.
std::string database_slices(const fracture::FsiDatabaseModel& model, const std::string& title,
                            const fracture::BendingLoad& load, const std::string& description);

}  // namespace polynya::analysis
