#pragma once

#include <cstdint>
#include <limits>

#include "geometry/shape/point.hpp"
#include "simulation/world/event.hpp"

namespace polynya::simulation {

/// What ended a peak of a contact's force: its ice bent or split, it tilted under the hull, or none of these: the two
/// slid or moved apart.
enum class PeakEnd : std::uint8_t { kNone, kBend, kSplit, kSlip, kTilt };

/// Two bodies that touch, in one step.
struct ContactState {
  static constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  struct Body {  ///< a ship or a floe
    int ship = -1;
    FloeId floe = kNoFloe;
    friend bool operator==(Body, Body) = default;
  };
  Body on;
  Body by;
  geometry::Point point_in_world;     ///< that the force acts at, where it was when the step began [m]
  geometry::Vector force;             ///< by `by` on `on`, over ground, mean of the step: impulse / time [N]
  double depth = 0;                   ///< of the overlap along the normal [m]
  bool is_crushing = false;           ///< it presses with all that crushing ice carries
  double arc = kNowhere;              ///< of that point on the waterline of `on`, from its stem, to port [m]
  double station = kNowhere;          ///< the same along its length, from the stem aft [m]
  double width = 0;                   ///< of the contact line [m]
  double height = 0;                  ///< of ice against the hull [m]; 0 of steel
  double pressure = 0;                ///< nominal: normal force by width and height [Pa]; 0 of steel
  double thickness = 0;               ///< of the ice, of two floes the thinner [m]; 0 of steel
  PeakEnd ended_by = PeakEnd::kNone;  ///< of a peak; in the contacts of a frame none
};

/// The largest force of a contact between two times at which it was below half of it.
struct LoadPeak {
  double time = 0;  ///< [s]
  ContactState state;
};

}  // namespace polynya::simulation
