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

/// Returns the cells of the sites' power diagram (a Voronoi diagram with weights) inside a box, one for each site,
/// convex and counter-clockwise. Cell i contains the points x with |x − p_i|² − w_i ≤ |x − p_j|² − w_j for all j. A
/// cell is empty if other sites outweigh its site everywhere. [Aurenhammer1987]. The time is nearly linear in the
/// number of sites if they are spread evenly. Corners are rounded doubles: corners of neighbours agree except for
/// rounding. Only + − × ÷ and √ are used, so the cells are the same on every machine.
std::vector<Ring> power_diagram(const std::vector<Site>& sites, const Box& box);

inline constexpr std::uint32_t kNoSite = 0xffffffff;

/// A cell while it is visited.
struct PowerCell {
  std::size_t site = 0;
  const Ring& ring;                          ///< convex, counter-clockwise [m]; empty if its site is outweighed
  const std::vector<std::uint32_t>& beyond;  ///< for each corner, the site across the edge that begins there;
                                             ///< kNoSite at the region's boundary
};

/// Probable neighbours of each site: the ones of site i are stored from first[i] to first[i + 1].
struct NeighbourGuess {
  std::vector<std::size_t> first;  ///< with the end; empty: no guess
  std::vector<std::uint32_t> sites;
};

/// Visits the cells of power_diagram() inside a convex counter-clockwise region, in the order of their sites. Made for
/// weights that differ much: sites are searched in classes of weight, so that a few heavy ones do not widen the search
/// among many light ones. A good guess, for example from sites that have moved little since, halves the time. Only + −
/// × ÷ and √ are used.
void visit_power_cells(const std::vector<Site>& sites, const Ring& region,
                       const std::function<void(const PowerCell&)>& visit, const NeighbourGuess& guess = {});

}  // namespace polynya::geometry
