#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// A strip along a line, which ends square at the ends of the line. If a bend is too sharp, the rings are not valid
/// polygons.
struct ChannelRegion {
  geometry::Ring outline;             ///< counter-clockwise [m]
  std::vector<geometry::Ring> parts;  ///< one for each leg, mitred at the bends, counter-clockwise [m]
  int too_sharp = -1;  ///< point of the line, from 0, at which a bend is too sharp for the width; −1: none
};

/// Returns the strip of the given whole width [m] along a line [m]. The line has two points or more, none twice in a
/// row.
ChannelRegion channel_region(const std::vector<geometry::Point>& line, double width);

/// Returns the two strips between the sides of a channel and the sides of a wider channel along the same line: the one
/// to port and the one to starboard, counter-clockwise [m]. Their inner edges are exactly the sides of
/// channel_region(). Before calling this, check with channel_region() that no bend is too sharp for the wider channel.
std::vector<geometry::Ring> strips_beside(const std::vector<geometry::Point>& line, double width, double wider);

}  // namespace polynya::io
