#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "dynamics/contact/contact_solver.hpp"
#include "dynamics/water/submerged_ice.hpp"
#include "dynamics/water/water_drag.hpp"
#include "fracture/bending/bending_model.hpp"
#include "simulation/ship/sailing.hpp"
#include "simulation/ship/waterline.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// What ice under a ship's hull meets.
struct Underwater {
  dynamics::HullForm form;
  dynamics::SubmersionPath path;
  bool can_take_ice = false;  ///< it has a draught
};

/// Floes are put to rest once in this time [s]. A plate that a ship breaks is still and untouched between
/// most of its contacts: at rest in each of them, it would lose its pairs with all the brash around, and find
/// them again. Rigid impulses put to rest in every step, as the replicas of the paper have it.
inline constexpr double kRestInterval = 1;

/// What ice breaks under, where that depends on its material alone.
struct IceLimits {
  double breakable_size = 0;         ///< κ l: no smaller floe breaks [m]
  double least_splitting_force = 0;  ///< of the shortest crack, as long and wide as the ice is thick [N]
  bool breaks_beams = false;         ///< κ l is not above l: slender floes below it break across as beams
};

/// What a run is computed with, the same from its first step to its last but for the step's length.
struct Setup {
  explicit Setup(Scene scene, Shortcuts shortcuts = {});

  Scene scene;
  Shortcuts shortcuts;
  double step = 0;  ///< Δt of the step at hand: a tick, Scene::time.step, a part of it or several [s]
  std::unique_ptr<const fracture::BendingModel> bending;
  dynamics::ShearCurrent current;                          ///< in the water frame
  dynamics::ResponseLaw law;                               ///< of contacts
  dynamics::SolverSettings solver;                         ///< but for its threads
  std::optional<dynamics::SeparationSettings> separation;  ///< of a law that leaves overlap to be separated
  std::vector<Underwater> underwater;                      ///< per hull
  std::vector<Waterline> waterlines;                       ///< per hull
  std::vector<Sailing> sailing;                            ///< per ship
  std::vector<IceLimits> ice_limits;                       ///< of the scene's ice, then of each own_ice
  int levels = 0;                                          ///< Scene::time.levels; 0 where contacts give rigid impulses
  std::int64_t steps_per_sample = 1;
  std::int64_t steps_per_frame = 1;
  std::int64_t steps_per_rest = 1;  ///< between two ticks that put floes to rest
};

/// Whether contacts answer by the law of crushing ice.
inline bool is_crush_law(const Setup& setup) {
  return std::holds_alternative<dynamics::CrushLaw>(setup.law);
}

/// Whether hulls bear the water that is missing on the decks of cusps which they press down.
inline bool has_flooding_decks(const Setup& setup) {
  return is_crush_law(setup) && setup.scene.fracture.floods_decks &&
         setup.scene.fracture.cusp_fate == CuspFate::kUnderHull;
}

/// A hull's underwater form by its waterline, stem angle and draught. Its entrance angle is the mean one of
/// the bow: tan α = ½ B / (distance from the stem to where the waterline is widest).
Underwater underwater_of(const Hull& hull);

/// The scene's sheared current, as the water drag takes it.
dynamics::ShearCurrent current_of(const ShearSettings& shear);

/// How far a run has come.
struct Clock {
  std::int64_t steps = 0;        ///< whole ticks
  int part = 0;                  ///< of the tick at hand
  int parts = 1;                 ///< that it has
  int finer = 1;                 ///< by how many times more parts, for the bends of the ticks before (levels.hpp)
  double bends = 0;              ///< in a step, the mean of the ticks before
  int ticks_in_step = 1;         ///< of the step at hand, where it is no part of one
  std::int64_t next_levels = 0;  ///< the tick from which bodies may take steps of several again (components.hpp)
  double tick = 0;               ///< [s]
  double step = 0;               ///< Δt of the step at hand: a tick, part of one or several [s]
  geometry::Vector water_drift;  ///< velocity of the water frame over ground, its mean over the step at hand [m/s]
  std::shared_ptr<const WaterSettings> changing = {};  ///< of a drift that changes

  double ticks() const { return static_cast<double>(steps) + static_cast<double>(part) / parts; }
  bool is_at_tick() const { return part == 0; }
  double time() const { return ticks() * tick; }               ///< [s]
  geometry::Vector drift() const { return drift_at(time()); }  ///< of the water frame over ground [m]
  geometry::Vector drift_at(double at) const { return changing ? changing->drift_path(at) : at * water_drift; }
};

/// Has the next step take so many ticks, or one in so many equal parts.
void take_step(Setup& setup, Clock& clock, int ticks, int parts);

/// To the end of the step.
void advance(Clock& clock);

}  // namespace polynya::simulation
