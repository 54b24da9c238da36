#pragma once

#include <cstdint>
#include <functional>
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
/// they are spread evenly. Corners are rounded doubles: neighbours' corners agree to rounding, not to the bit.
/// Only + − × ÷ and √ are used, so the cells are the same on every machine.
std::vector<Ring> power_diagram(const std::vector<Site>& sites, const Box& box);

inline constexpr std::uint32_t kNoSite = 0xffffffff;

/// A cell while it is visited.
struct PowerCell {
  std::size_t site = 0;
  const Ring& ring;                          ///< convex, counter-clockwise [m]; empty where outweighed
  const std::vector<std::uint32_t>& beyond;  ///< for each corner, the site across the edge that begins there;
                                             ///< kNoSite at the region's boundary
};

/// For each site, sites that are probably its neighbours: those of site i stand from first[i] to first[i + 1].
struct NeighbourGuess {
  std::vector<std::size_t> first;  ///< and the end; or empty for no guess
  std::vector<std::uint32_t> sites;
};

/// The cells of power_diagram() inside a convex counter-clockwise region, visited one after the other in the
/// order of their sites. Made for weights that differ much: sites are searched for in classes of weight, so
/// that a few heavy ones do not widen the search among the many light ones. A good guess, as of sites that
/// moved little since, halves the time. Only + − × ÷ and √ are used.
void visit_power_cells(const std::vector<Site>& sites, const Ring& region,
                       const std::function<void(const PowerCell&)>& visit, const NeighbourGuess& guess = {});

}  // namespace polynya::geometry
