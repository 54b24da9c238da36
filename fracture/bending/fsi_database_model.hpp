#pragma once

#include <memory>
#include <vector>

#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/database.hpp"
#include "fracture/bending/scaled_load.hpp"

namespace polynya::fracture {

/// A whole push at constant speed, from first contact to the break.
struct BendingForecast {
  BendingCapacity capacity;
  double normal_force = 0;  ///< F_n = V_b / c_V on the crushed facet at the break [N]
  double penetration = 0;   ///< ξ_b [m]
  double time = 0;          ///< from first contact to the break [s]; infinite at rest
  /// Π of the push κ ξ² that has the force of this one at its penetration: the load's own softness unless the
  /// contact crushes through the thickness before the break.
  double equivalent_softness = 0;
  std::vector<OutsideRange> outside;  ///< what of the load lies outside the table; empty in range
};

/// The paper's bending model: the icebreaking database of a fluid–structure solution, looked up with the
/// load's dimensionless groups. [Sawamura2017, "Plate Ice Breaking"] The table covers contacts that have not
/// crushed through the thickness, V = κ ξ². Where the load's penetration is deeper than h tan θ_s, the Π of
/// the κ ξ² push with the same force at the same penetration is taken instead; so it is where the contact's
/// own force is given. Deviation: none known; the paper does not print its database. Its speed is the mean
/// v_n since first contact.
class FsiDatabaseModel final : public BendingModel {
 public:
  /// The shipped database.
  explicit FsiDatabaseModel(RadialCracks radial_cracks = RadialCracks::kIgnored);
  explicit FsiDatabaseModel(std::shared_ptr<const BendingDatabase> database);

  BendingCapacity capacity(const BendingLoad& load) const override;

  /// The break of a push at the load's speed from first contact; the load's penetration is not used,
  /// nor are radial cracks.
  BendingForecast forecast(const BendingLoad& load) const;

  const BendingDatabase& database() const { return *database_; }

 private:
  std::shared_ptr<const BendingDatabase> database_;
  RadialCracks radial_cracks_ = RadialCracks::kIgnored;
};

}  // namespace polynya::fracture
