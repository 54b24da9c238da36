#pragma once

#include "simulation/world/scene.hpp"

namespace polynya::tests {

/// The scene of the checkpoints in checkpoint_fuzz_corpus: a ship, a plate it breaks, ice under it, a small
/// floe, one under way.
inline simulation::Scene checkpoint_scene() {
  simulation::Scene scene;
  scene.time.step = 0.02;
  scene.fracture.bending = simulation::BendingModelKind::kNevel;
  scene.fracture.cusp_fate = simulation::CuspFate::kUnderHull;
  scene.fracture.going_under.is_enabled = true;
  scene.fracture.resurface.is_enabled = true;
  simulation::Ship ship;
  ship.name = "ship";
  ship.hull.waterline = simulation::wedge_bow_waterline(30, 8, 0.5);
  ship.hull.draught = 3;
  ship.mass = 1e6;
  ship.moment_of_inertia = 1e8;
  ship.position_in_world = {-15.5, 0};
  ship.propulsion = simulation::ConstantSpeed{2};
  scene.ships = {ship};
  scene.floes = {{{{{0, -20}, {30, -20}, {30, 20}, {0, 20}}, {}}, {}, 0},
                 {{{{31, -5}, {36, -5}, {36, 5}, {31, 5}}, {}}, {}, 0},
                 {{{{80, 0}, {90, 0}, {90, 9}}, {}}, {0.1, 0}, 0}};
  return scene;
}

}  // namespace polynya::tests
