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

/// The underwater part of a hull, for ice that goes under it.
struct Underwater {
  dynamics::HullForm form;
  dynamics::SubmersionPath path;
  bool can_take_ice = false;  ///< true if the hull has a draught
};

/// Limits of breaking that depend on the ice's material alone.
struct IceLimits {
  double breakable_size = 0;  ///< κ l: floes with a smaller √area neither bend nor split [m]
  /// Opening capacity of a crack that is as long and as wide as the ice is thick; smaller forces split no floe, so
  /// that no crack is searched for them [N].
  double least_splitting_force = 0;
  /// True if κ l does not exceed the characteristic length (D/ρ_w g)^¼. Slender floes with a smaller √area than κ l
  /// then break across as beams.
  bool breaks_beams = false;
};

/// The settings of a run, and all data that follow from them alone. It is constant during the run.
struct Setup {
  /// Derives the data from the scene. Only tests and benchmarks switch shortcuts off.
  explicit Setup(Scene scene, Shortcuts shortcuts = {});

  Scene scene;
  Shortcuts shortcuts;
  /// Model of the bending capacity of ice edges.
  std::unique_ptr<const fracture::BendingModel> bending;
  dynamics::ShearCurrent current;      ///< sheared current, in the water frame
  dynamics::ContactRule contact_rule;  ///< how contacts are found
  dynamics::SolverSettings solver;     ///< settings of the contact solver, without the number of threads
  std::vector<Underwater> underwater;  ///< underwater part of each hull
  std::vector<Waterline> waterlines;   ///< waterline of each hull
  std::vector<Sailing> sailing;        ///< data of the motion of each ship through the water
  std::vector<IceLimits> ice_limits;   ///< limits for the scene's ice, then for each own_ice
  /// Longest step that walls allow (longest_step_by_walls); infinite without walls that press [s].
  double longest_step_by_walls = 0;
  /// True if the scene computes the water on the decks of turning cusps. Until water has flowed onto a deck, the hull
  /// carries the missing water pressure.
  bool has_flooding_decks = false;
};

/// Returns the longest step of a scene with walls that press [s]: the smaller of kStepUnderPressure (parts.hpp) and the
/// time in which the load of a wall accelerates it to its closing speed. Returns infinity without such walls.
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
