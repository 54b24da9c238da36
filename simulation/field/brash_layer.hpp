#pragma once

#include <vector>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// Layer of loose brash ice in a channel. It is several pieces deep; a model in the plane carries it as an equivalent
/// single layer of pieces (docs/theory/brash.md).
struct BrashLayer {
  double width = 0;           ///< width of the channel [m]
  double thickness = 0;       ///< thickness H_M in the middle of the channel, pores included [m]
  double side_thickness = 0;  ///< thickness at the sides of the channel, pores included [m]
  double porosity = 0;        ///< fraction of the layer's volume that is water or air, not ice [-]

  /// Returns the thickness, pores included, at a distance [m] from the middle of the channel [m]. It changes linearly
  /// from the middle to the sides.
  double thickness_at(double distance) const;
  /// Returns the volume of ice per area in plan at a distance [m] from the middle of the channel [m].
  double ice_at(double distance) const { return (1 - porosity) * thickness_at(distance); }
  /// Returns the mean volume of ice per area in plan over the width [m].
  double mean_ice() const { return (1 - porosity) * 0.5 * (thickness + side_thickness); }
  /// Returns the thickness of the equivalent layer's pieces at a distance [m] from the middle of the channel, for a
  /// layer that covers the given fraction of the area [m]. The pieces hold as much ice per area as the brash.
  double piece_thickness(double distance, double cover) const { return ice_at(distance) / cover; }
};

/// Returns the density of a consolidated layer of the given thickness [m] that has, per area, the buoyancy of the
/// layer and of the brash below it [kg/m³]. It is negative where so thin a layer cannot carry the brash's buoyancy.
double consolidated_density(const BrashLayer& brash, double thickness, const fracture::Ice& ice,
                            const fracture::Water& water);

/// Returns the least distance of a point from a line of two or more points [m].
double distance_to_line(geometry::Point point, const std::vector<geometry::Point>& line);

}  // namespace polynya::simulation
