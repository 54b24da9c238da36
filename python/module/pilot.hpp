#pragma once

#include <vector>

#include "python/module/scene.hpp"

#include "simulation/ship/pilot.hpp"

namespace polynya::python {

/// What a pilot in Python gets: a copy, which it may keep.
struct PilotView {
  explicit PilotView(const simulation::PilotView& seen) : values(seen), hulls(seen.hulls.begin(), seen.hulls.end()) {
    values.hulls = {};
  }
  simulation::PilotView values;  ///< without its ships
  std::vector<simulation::SeenHull> hulls;
  const simulation::SeenHull& own() const { return hulls[static_cast<std::size_t>(values.ship)]; }
};

/// Asks a Python pilot; the GIL is held. None from it keeps lever and steering where they are. What it raises
/// goes through.
simulation::Command ask(const py::object& pilot, const simulation::PilotView& view);

void bind_pilot(py::module_& module);

}  // namespace polynya::python
