#pragma once

#include <string>

#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/fsi_database_model.hpp"

namespace polynya::app {

/// Slices of a database through one load as JSON, which polynya.figures.database draws: force and radius
/// against speed, opening angle and thickness, each for the load itself and its neighbours in another of the
/// three, beside Nevel's and Kashtelyan's forms. Units in the keys.
std::string database_slices(const fracture::FsiDatabaseModel& model, const std::string& title,
                            const fracture::BendingLoad& load);

}  // namespace polynya::app
