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

/// The underwater hull, as ice under it meets it.
struct Underwater {
  dynamics::HullForm form;
  dynamics::SubmersionPath path;
  bool can_take_ice = false;  ///< true if the hull has a draught
};

/// Limits of breaking that depend on the ice's material alone.
struct IceLimits {
  double breakable_size = 0;         ///< κ l: floes with a smaller √area do not break [m]
  double least_splitting_force = 0;  ///< force of a crack that is as long and wide as the ice is thick [N]
  bool breaks_beams = false;         ///< true if κ l ≤ l: slender floes that are smaller break across as beams
};

/// The settings of a run, and what follows from them alone. Const from the first step to the last.
struct Setup {
  explicit Setup(Scene scene, Shortcuts shortcuts = {});

  Scene scene;
  Shortcuts shortcuts;
  std::unique_ptr<const fracture::BendingModel> bending;
  dynamics::ShearCurrent current;      ///< in the water frame
  dynamics::ContactRule contact_rule;  ///< how contacts are found
  dynamics::SolverSettings solver;     ///< without the number of threads
  std::vector<Underwater> underwater;  ///< per hull
  std::vector<Waterline> waterlines;   ///< per hull
  std::vector<Sailing> sailing;        ///< per ship
  std::vector<IceLimits> ice_limits;   ///< of the scene's ice, then of each own_ice
  double longest_step_by_walls = 0;    ///< infinite in scenes without walls that press [s]
  bool has_flooding_decks = false;     ///< cusps that a hull presses down carry no water yet, which loads the hull
};

/// Returns the longest step of a scene with walls that press [s]: kStepUnderPressure (parts.hpp), or the time in which
/// the load of a wall accelerates it to its closing speed. Infinite without such walls.
double longest_step_by_walls(const Scene& scene);

/// Returns a hull's underwater form by its waterline, stem angle and draught. The entrance angle is the mean one of
/// the bow: tan α = ½ B / (distance from the stem to where the waterline is widest).
Underwater underwater_of(const Hull& hull);

/// Returns the scene's sheared current in the form that the water drag takes.
dynamics::ShearCurrent current_of(const ShearSettings& shear);

/// Returns the displacement of the water frame over ground from the start to a time [s] [m].
geometry::Vector drift_at(const Setup& setup, double time);

/// Returns the instant of a time [s].
inline Instant instant_at(const Setup& setup, double time) {
  return {time, drift_at(setup, time)};
}

}  // namespace polynya::simulation
