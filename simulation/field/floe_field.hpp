#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/size_law.hpp"

namespace polynya::simulation {

/// Settings of a random field of convex floes. The size of a floe is √area.
struct FloeField {
  geometry::Ring region;     ///< region that the field fills, counter-clockwise [m]
  bool is_rectangle = true;  ///< true if the region is a rectangle along the axes
  /// Parts of the region that are filled one after the other; empty: the region is filled at once.
  std::vector<geometry::Ring> parts;
  std::optional<SizeLaw> law;  ///< distribution of the sizes; if there is one, floe_size and size_spread are not used
  double aspect = 1;           ///< with a law: mean length over width; cells have about 1.27 at least [-]
  /// With a law: direction of the floes' lengths from the x axis; none: random directions [rad].
  std::optional<double> orientation;
  int least_corners = 3;  ///< with a law: smallest number of corners of a floe
  double packing = 0;     ///< with a law: concentration of the packing from which floes are then left out as holes [-]
  double floe_size = 15;  ///< mean of √area [m]
  double size_spread = 0.25;                  ///< standard deviation of √area / its mean [-]
  double concentration = 0.5;                 ///< fraction of the region that ice covers [-]
  double gap = 0.05;                          ///< smallest distance between floes [m]
  int most_corners = 8;                       ///< largest number of corners of a floe
  std::uint64_t seed = 0;                     ///< seed, which combines those of the scene and of the field
  std::vector<geometry::Polygon> kept_clear;  ///< areas to which no floe comes nearer than the gap [m]
};

/// A field of floes and its measures.
struct FloeFieldOutcome {
  std::vector<geometry::Polygon> floes;  ///< floes: valid polygons that are at least the gap apart [m]
  int count = 0;                         ///< number of floes
  double region_area = 0;                ///< area of the region; with a law without the areas that are kept clear [m²]
  double floe_area = 0;                  ///< total area of the floes [m²]
  double mean_size = 0;                  ///< mean of √area [m]
  double size_spread = 0;                ///< standard deviation of √area / its mean [-]
  int left_out = 0;  ///< number of floes that were left out because of areas kept clear or of the outline
  /// Concentration with every cell filled up to the gap; a smaller one than asked for is refused [-].
  double reachable_concentration = 1;
  double reachable_without_gap = 1;           ///< with a law: the same without the gap [-]
  std::optional<FieldStatistics> statistics;  ///< with a law: statistics of the sizes

  double concentration() const { return region_area > 0 ? floe_area / region_area : 0; }
};

/// Returns the number of floes of a field before any are left out: concentration × area / mean floe area, with the area
/// of the region, or of its bounding box without a law.
double floe_count(const FloeField& field);

/// Fills a region with floes. Cells tile the region; their areas follow the field's law, or its mean and spread. Each
/// cell is shrunk about its centroid to the area of its floe, or to the place where the gap is reached; the other floes
/// then grow to keep the concentration. Floes are always at least the gap apart, at any concentration that the gap
/// allows. The same settings give the same numbers on every machine.
FloeFieldOutcome make_floe_field(const FloeField& field);

}  // namespace polynya::simulation
