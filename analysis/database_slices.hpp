#pragma once

#include <string>

#include "fracture/bending/fsi_database_model.hpp"

namespace polynya::analysis {

/// Bending of one load by the database, and by the published formulas to which it can be compared. Each has the
/// vertical force at which the ice breaks [N], the radius of the cusp [m], and whether its model covers the load
/// (`is_in_range`).
struct SlicePoint {
  fracture::BendingForecast database;    ///< with the penetration at which the ice breaks
  fracture::BendingCapacity nevel;       ///< Nevel's formula at the penetration at which the database breaks the ice
  fracture::BendingCapacity kashtelyan;  ///< Kashtelyan's formula at the same penetration
};

/// Computes one load by the database and by both formulas. The penetration of `load` itself is not used for the
/// formulas, because they then would belong to another instant than the database.
SlicePoint compare_models(const fracture::FsiDatabaseModel& model, const fracture::BendingLoad& load);

/// Returns slices of a database through one load as JSON, which polynya.figures.database draws. There are three
/// figures: vertical breaking force [N] and cusp radius [m] over the approach speed, over the opening angle of the
/// wedge and over the ice thickness. Each has a curve for the load itself, curves for a few other wedge angles (in the
/// figure over the angle: other speeds), and for the load itself the formulas of Nevel and Kashtelyan. Each point says
/// whether its model covers it; points that are not covered have values too and are drawn faintly. `title` names the
/// database and `description` describes the load, both for people.
std::string database_slices(const fracture::FsiDatabaseModel& model, const std::string& title,
                            const fracture::BendingLoad& load, const std::string& description);

}  // namespace polynya::analysis
