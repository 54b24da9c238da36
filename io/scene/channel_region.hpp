#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// A strip along a line.
struct ChannelRegion {
  geometry::Ring outline;             ///< counter-clockwise [m]
  std::vector<geometry::Ring> parts;  ///< one for each leg, mitred at the bends, counter-clockwise [m]
  int too_sharp = -1;                 ///< point of the line at which a bend leaves a leg no room; −1: none
};

/// `width` across [m]. The line has two points or more, none of them twice in a row.
ChannelRegion channel_region(const std::vector<geometry::Point>& line, double width);

}  // namespace polynya::io
