#pragma once

#include <memory>
#include <vector>

#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/database.hpp"
#include "fracture/bending/wedge_solver.hpp"

namespace polynya::fracture {

/// A physical load as the dimensionless problem of the wedge solver, with the scales of the result. With l = (D / ρ_w
/// g)^¼ and t0 = √(l/g):
///   2α = θ_wf + θ_wb or the load's own, m̂ = ρ_i h / (ρ_w l), Fr = v_n / √(g l), Π = σ_f h² / (κ l²)
///   κ = σ_c c_V T / (2 sin θ_s), T = tan θ_wf + tan θ_wb: V = κ [ξ² − ⟨ξ − h tan θ_s⟩²], Eqs. (1), (2) of
///   [Sawamura2017]
/// Edges of unequal angles crush as they are, through T, and bend as the symmetric wedge of the same opening 2α.
struct ScaledLoad {
  WedgeGroups groups;       ///< softness is infinite if the hull cannot press the ice down: c_V ≤ 0 or θ_s = 0
  double full_depth = 0;    ///< h tan θ_s / l
  double feedback = 0;      ///< χ = σ_f h² tan θ_s / (ρ_w g l³)
  double length_scale = 0;  ///< l [m]
  double force_scale = 0;   ///< σ_f h² [N]
  double time_scale = 0;    ///< t0 [s]
};

ScaledLoad scaled(const BendingLoad& load);

/// Returns the motion and stiffness of a load from first contact on, for the wedge solver. `feedback` states whether
/// the deflection of the ice slows the penetration.
enum class Feedback { kIgnored, kCoupled };
WedgePush wedge_push_of(const ScaledLoad& load, Feedback feedback);

/// A complete push at constant speed, from first contact to the break.
struct BendingForecast {
  BendingCapacity capacity;
  double normal_force = 0;  ///< F_n = V_b / c_V on the crushed facet at the break [N]
  double penetration = 0;   ///< ξ_b [m]
  double time = 0;          ///< from first contact to the break [s]; infinite at rest
  /// Π of the push κ ξ² that has the same force at the same penetration: the load's own softness, unless the contact
  /// crushes through the thickness before the break.
  double equivalent_softness = 0;
  std::vector<OutsideRange> outside;  ///< groups of the load outside of the table; empty if all are in range
};

/// The paper's bending model: the icebreaking database of a fluid–structure solution, looked up with the dimensionless
/// groups of the load [Sawamura2017, "Plate Ice Breaking"]. The table covers contacts that have not crushed through the
/// thickness, V = κ ξ². If the load's penetration is deeper than h tan θ_s, the Π of the push κ ξ² with the same force
/// at the same penetration is used instead; the same holds if the contact's own force is given. Deviation: none known,
/// since the paper does not print its database. The speed is the mean v_n since first contact. If the load has the
/// openings of the true outline, V_b and R follow from its weakest section. The table then gives the effect of inertia
/// on V_b and R, the range, and whether a radial crack opens first.
class FsiDatabaseModel final : public BendingModel {
 public:
  /// Uses the shipped database.
  explicit FsiDatabaseModel(RadialCracks radial_cracks = RadialCracks::kIgnored);
  /// Uses another database, and ignores radial cracks.
  explicit FsiDatabaseModel(std::shared_ptr<const BendingDatabase> database);

  BendingCapacity capacity(const BendingLoad& load) const override;

  /// Returns the break of a push from first contact at the load's speed. The load's penetration and radial cracks are
  /// not used.
  BendingForecast forecast(const BendingLoad& load) const;

  const BendingDatabase& database() const { return *database_; }

 private:
  std::shared_ptr<const BendingDatabase> database_;
  RadialCracks radial_cracks_ = RadialCracks::kIgnored;
};

}  // namespace polynya::fracture
