#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// A site of a power diagram.
struct Site {
  Point point;        ///< [m]
  double weight = 0;  ///< [m²]
};

/// The cells of the sites' power diagram (Voronoi's with weights) inside a box, one for each site, convex and
/// counter-clockwise: cell i holds the points x with |x − p_i|² − w_i ≤ |x − p_j|² − w_j for all j. A cell is
/// empty where other sites outweigh its own everywhere. [Aurenhammer1987]. Near linear in the sites where
/// they are spread evenly. Corners are rounded doubles: neighbours' corners agree to rounding, not to the
/// bit. Only
/// + − × ÷ and √ are used, so the cells are the same on every machine.
std::vector<Ring> power_diagram(const std::vector<Site>& sites, const Box& box);

}  // namespace polynya::geometry
