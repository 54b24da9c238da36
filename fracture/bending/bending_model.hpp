#pragma once

#include <optional>

#include "fracture/bending/edge_sections.hpp"
#include "fracture/materials.hpp"

namespace polynya::fracture {

/// A wedge of floating ice under the hull's growing edge load.
struct BendingLoad {
  Ice ice;
  Water water;
  double front_half_angle = 0.7854;  ///< θ_wf, from the inward normal to one ice edge [rad]
  double back_half_angle = 0.7854;   ///< θ_wb, from the inward normal to the other [rad]
  double hull_angle = 0.7854;        ///< θ_s, the hull's inclination from the vertical [rad]
  double mean_approach_speed = 0;    ///< mean v_n since first contact [m/s]
  double penetration = 0;            ///< ξ, crushed so far along the plan normal [m]
  double vertical_to_crushing = 1;   ///< c_V = V / F_n (docs/theory/bending.md) [-]
  /// 2α as measured, if the edges lie beyond the largest half-angles [rad]; 0: the sum of the half-angles. A hull that
  /// has broken its way in touches the ice at the bottom of a notch, 2α > π. Of the models, only FsiDatabaseModel uses
  /// this member and those below.
  double opening_angle = 0;
  /// V of the contact at that penetration [N]; 0 if it is not known: V then follows from the wedge's angles, Eq. (2).
  double vertical_force = 0;
  double thrust = 0;  ///< H / V of the contact, inwards over down [-]
  /// Place of the load between the first touch (0) and ξ (1) [-]: 2/3 if the ice ends in a corner, 1/3 at a corner of
  /// the hull.
  double load_place = 2.0 / 3;
  /// True outline of the edge; nullopt: an infinite wedge of 2α.
  std::optional<EdgeOpenings> openings;
};

/// The force that the wedge carries before its cusp breaks off, and the size of the cusp.
struct BendingCapacity {
  double vertical_force = 0;  ///< V_b [N]
  double cusp_radius = 0;     ///< R [m]
  /// False if the load is outside of the model's table, or of the range for which a published form is used. Runs count
  /// breaks out of range and do not otherwise change them.
  bool is_in_range = true;
  /// True if a radial crack opens before the cusp breaks. Only the tabulated model finds it, whatever its RadialCracks.
  bool radial_crack_first = false;
};

/// The effect of the radial crack that opens in the bottom fibre, along the bisector, before the cusp breaks off.
enum class RadialCracks {
  kIgnored,     ///< none: the edge breaks as if it were whole
  kSplitWedge,  ///< it runs through: a wedge splits, and the sections of an edge carry as cracked ones
                ///< (docs/theory/bow.md)
};

/// The description of the ice's outline that decides where it breaks.
enum class EdgeOutline {
  kSections,  ///< width of the ice at each distance from the first touch
  kWedge,     ///< wedge that the ice forms within 0.3 l
};

/// Computes when a plate breaks by bending, and how large the cusp is. Models keep no state of a run.
class BendingModel {
 public:
  virtual ~BendingModel() = default;
  virtual BendingCapacity capacity(const BendingLoad& load) const = 0;
};

}  // namespace polynya::fracture
