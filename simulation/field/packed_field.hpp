#pragma once

#include "simulation/floe_field.hpp"

namespace polynya::simulation {

/// make_floe_field() for a field with a size law. Cells for the floes drawn, and for as many holes as the
/// packing asks for, tile the free area (tessellation.hpp); with an aspect and no orientation, cells of two
/// and more floes are cut across a random direction. Each floe's cell, its corners reduced or cut off, is
/// moved inwards by half the gap and then shrunk about its centroid to the floe's area; where that does not
/// fit, the others make up for it. Holes are drawn from the same law as floes, so that no size is favoured.
FloeFieldOutcome make_packed_field(const FloeField& field);

}  // namespace polynya::simulation
