#pragma once

#include <vector>

#include "simulation/field/floe_field.hpp"

namespace polynya::simulation {

// The two ways to place a field's floes, as stages of make_floe_field(): each gives cells that floes grow in.

/// A floe in the making.
struct Candidate {
  geometry::Ring ring;  ///< of its cell, its corners reduced, counter-clockwise [m]
  geometry::Point centroid;
  double area = 0;               ///< of the ring [m²]
  double wanted = 0;             ///< before all floes grow or shrink alike [m²]
  double room = 0;               ///< the most it can have [m²]
  bool may_be_forbidden = true;  ///< the scaled ring may reach into what is kept clear, or across the outline
};

/// Cells, and what they were made for.
struct FieldLayout {
  std::vector<Candidate> candidates;
  double tiled_area = 0;   ///< that the cells tile, and of which the floes cover the concentration [m²]
  double region_area = 0;  ///< of it in the region and not kept clear [m²]
  double cell_area = 0;    ///< of the candidates, before the gap is taken off [m²]
  int left_out = 0;        ///< floes whose cells found no room
};

/// Of a field without a size law. Sizes are drawn from a lognormal distribution (cut off at 2.5 deviations of
/// the logarithm); a power diagram of as many sites, relaxed so that each cell's area goes with its floe's
/// [Balzer2009, deGoes2012], tiles the region's box. Sites without a cell are lost: none in 1000 up to a
/// spread of 0.3, 4 in 100 at 0.5, where the smallest floes are smaller than drawn.
FieldLayout lattice_cells(const FloeField& field);

/// Of a field with a size law. Cells for the floes drawn, and for as many holes as the packing asks for, tile
/// the free area (tessellation.hpp); with an aspect and no orientation, cells of two and more floes are cut
/// across a random direction. Each floe's cell, its corners reduced or cut off, is moved inwards by half the
/// gap. Holes are drawn from the same law as floes, so that no size is favoured.
FieldLayout packed_cells(const FloeField& field);

}  // namespace polynya::simulation
