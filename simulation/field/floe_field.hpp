#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "simulation/field/size_law.hpp"

namespace polynya::simulation {

/// A random field of convex floes, as a scene asks for it. The size of a floe is √area.
struct FloeField {
  geometry::Ring region;                      ///< counter-clockwise [m]
  bool is_rectangle = true;                   ///< the region is a rectangle along the axes
  std::vector<geometry::Ring> parts;          ///< of the region, filled one after the other; empty: all at once
  std::optional<SizeLaw> law;                 ///< then floe_size and size_spread do not count
  double aspect = 1;                          ///< of a law: mean length over width; no less than cells' own [-]
  std::optional<double> orientation;          ///< of a law: of the floes' length, from the x axis; none: any [rad]
  int least_corners = 3;                      ///< of a law
  double packing = 0;                         ///< of a law: concentration before holes are left [-]
  double floe_size = 15;                      ///< mean of √area [m]
  double size_spread = 0.25;                  ///< standard deviation of √area / its mean [-]
  double concentration = 0.5;                 ///< ice-covered share of the region [-]
  double gap = 0.05;                          ///< least distance between floes [m]
  int most_corners = 8;                       ///< of a floe
  std::uint64_t seed = 0;                     ///< of the scene and of the field together
  std::vector<geometry::Polygon> kept_clear;  ///< no floe comes nearer to these than the gap [m]
};

/// The field that was made, and its measures.
struct FloeFieldOutcome {
  std::vector<geometry::Polygon> floes;       ///< valid and at least the gap apart [m]
  int count = 0;                              ///< of the floes
  double region_area = 0;                     ///< of a law: less what is kept clear [m²]
  double floe_area = 0;                       ///< [m²]
  double mean_size = 0;                       ///< of √area [m]
  double size_spread = 0;                     ///< of √area [-]
  int left_out = 0;                           ///< floes that would be in what is kept clear, or across the outline
  double reachable_concentration = 1;         ///< with every cell filled up to the gap; less than asked: refused [-]
  double reachable_without_gap = 1;           ///< of a law [-]
  std::optional<FieldStatistics> statistics;  ///< of a law

  double concentration() const { return region_area > 0 ? floe_area / region_area : 0; }
};

/// How many floes a field has before some are left out: concentration · area / mean floe area, over the
/// region's bounding box.
double floe_count(const FloeField& field);

/// Fills the region with floes. Cells tile it, by the field's law or its mean and spread;
/// each is shrunk about its centroid to its floe's area, or to where the gap is reached, and the others then
/// make up for it. Floes are at least the gap apart by construction, at any concentration up to what the gap
/// leaves. The same numbers on every machine.
FloeFieldOutcome make_floe_field(const FloeField& field);

}  // namespace polynya::simulation
