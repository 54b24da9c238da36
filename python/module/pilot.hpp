#pragma once

#include <vector>

#include "python/module/scene.hpp"

#include "simulation/ship/pilot.hpp"

namespace polynya::python {

/// What a pilot in Python gets: a copy, which it may keep.
struct PilotView {
  explicit PilotView(const simulation::PilotView& seen) : values(seen), ships(seen.ships.begin(), seen.ships.end()) {
    values.ships = {};
  }
  simulation::PilotView values;  ///< without its ships
  std::vector<simulation::SeenShip> ships;
  const simulation::SeenShip& own() const { return ships[static_cast<std::size_t>(values.ship)]; }
};

/// Asks a Python pilot; the GIL is held. None from it keeps lever and steering where they are. What it raises
/// goes through.
simulation::Command ask(const py::object& pilot, const simulation::PilotView& view);

void bind_pilot(py::module_& module);

}  // namespace polynya::python
