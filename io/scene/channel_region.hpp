#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// A strip along a line, which ends square at the ends of the line. If a bend is too sharp, the rings may cross
/// themselves, so callers refuse the scene.
struct ChannelRegion {
  geometry::Ring outline;             ///< counter-clockwise [m]
  std::vector<geometry::Ring> parts;  ///< one for each leg, mitred at the bends, counter-clockwise [m]
  /// Index of the first point of the line, from 0, at which the legs are too short or the bend is too sharp for the
  /// width: a part is not convex there. −1: none.
  int too_sharp = -1;
};

/// Returns the strip of the given whole width [m] along a line [m]. The line has two points or more, none twice in a
/// row.
ChannelRegion channel_region(const std::vector<geometry::Point>& line, double width);

/// Returns the two strips between the sides of a channel of the whole width `width` [m] and those of one of the whole
/// width `wider` [m] along the same line: first the strip to port, then the one to starboard, counter-clockwise [m].
/// Their inner edges are exactly the sides of channel_region(). Before calling this, check with channel_region() that
/// no bend is too sharp for the wider channel; otherwise the strips may cross themselves.
std::vector<geometry::Ring> strips_beside(const std::vector<geometry::Point>& line, double width, double wider);

}  // namespace polynya::io
