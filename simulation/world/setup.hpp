#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "dynamics/contact/contact_solver.hpp"
#include "dynamics/contact/narrow_phase.hpp"
#include "dynamics/water/submerged_ice.hpp"
#include "dynamics/water/water_drag.hpp"
#include "fracture/bending/bending_model.hpp"
#include "simulation/ship/sailing.hpp"
#include "simulation/ship/waterline.hpp"
#include "simulation/world/clock.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// What ice under a ship's hull meets.
struct Underwater {
  dynamics::HullForm form;
  dynamics::SubmersionPath path;
  bool can_take_ice = false;  ///< it has a draught
};

/// What ice breaks under, where that depends on its material alone.
struct IceLimits {
  double breakable_size = 0;         ///< κ l: no smaller floe breaks [m]
  double least_splitting_force = 0;  ///< of the shortest crack, as long and wide as the ice is thick [N]
  bool breaks_beams = false;         ///< κ l is not above l: slender floes below it break across as beams
};

/// What a run is computed with; const from its first step to its last.
struct Setup {
  explicit Setup(Scene scene, Shortcuts shortcuts = {});

  Scene scene;
  Shortcuts shortcuts;
  std::unique_ptr<const fracture::BendingModel> bending;
  dynamics::ShearCurrent current;                          ///< in the water frame
  dynamics::ContactRule contact_rule;                      ///< how contacts are found
  dynamics::SolverSettings solver;                         ///< without the number of threads
  std::optional<dynamics::SeparationSettings> separation;  ///< of a law that leaves overlap to be separated
  std::vector<Underwater> underwater;                      ///< per hull
  std::vector<Waterline> waterlines;                       ///< per hull
  std::vector<Sailing> sailing;                            ///< per ship
  std::vector<IceLimits> ice_limits;                       ///< of the scene's ice, then of each own_ice
  double longest_step_by_walls = 0;                        ///< of walls that press; infinite without any [s]
  bool has_flooding_decks = false;  ///< hulls bear the water that is missing on the decks of cusps that they press down
};

/// Δt that keeps a wall's step within kStepUnderPressure (parts.hpp) and within the time in which its load takes it to
/// its closing speed [s].
double longest_step_by_walls(const Scene& scene);

/// A hull's underwater form by its waterline, stem angle and draught. Its entrance angle is the mean one of
/// the bow: tan α = ½ B / (distance from the stem to where the waterline is widest).
Underwater underwater_of(const Hull& hull);

/// The scene's sheared current, as the water drag takes it.
dynamics::ShearCurrent current_of(const ShearSettings& shear);

/// Displacement of the water frame over ground since the start [m].
geometry::Vector drift_at(const Setup& setup, double time);

/// An instant of the run with that displacement.
inline Instant instant_at(const Setup& setup, double time) {
  return {time, drift_at(setup, time)};
}

}  // namespace polynya::simulation
