#pragma once

#include <vector>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Which overlaps are cut off.
enum class CutWhen {
  kAlways,
  kParts,  ///< where two floes or more are left
};

/// What a floe loses to another body that is in it.
struct OverlapCut {
  BodyIndex a = 0;  ///< the pair
  BodyIndex b = 0;
  std::vector<geometry::Pose> a_from_b;  ///< of the two bodies' frames, where what they share is cut off
  geometry::Point middle;                ///< of the overlap, in the water frame [m]
  GrindCriterion criterion;              ///< the exact area is entered into it
  CutWhen when = CutWhen::kAlways;
};

/// Whether both bodies can still be cut: they are in the world, and geometry has not refused it.
bool can_cut(const Population& population, const Accounts& accounts, BodyIndex a, BodyIndex b);

/// Which of two bodies loses ice: the floe in a hull; of two floes the weaker, or the smaller.
BodyIndex ground_of(const Setup& setup, const Population& population, BodyIndex a, BodyIndex b);

/// Cuts what the two share from the floe that is ground, by the other's outline, and makes it brash: event
/// `grind`. Nothing where that is less than the criterion's least area, or leaves no two floes that it is to
/// leave: returns whether it was cut.
bool cut_overlap(const Setup& setup, const Clock& clock, const OverlapCut& overlap, Population& population,
                 Accounts& accounts, Journal& journal);

}  // namespace polynya::simulation
