#pragma once

#include <vector>

#include "python/module/scene.hpp"

#include "simulation/ship/pilot.hpp"

namespace polynya::python {

/// View of a pilot in Python. It is a copy, so that the pilot may keep it.
struct PilotView {
  explicit PilotView(const simulation::PilotView& seen) : values(seen), hulls(seen.hulls.begin(), seen.hulls.end()) {
    values.hulls = {};
  }
  simulation::PilotView values;  ///< the view without its list of hulls
  std::vector<simulation::SeenHull> hulls;
  const simulation::SeenHull& own() const { return hulls[static_cast<std::size_t>(values.ship)]; }
};

/// Asks a Python pilot for a command. The GIL must be held. If the pilot returns None, lever and steering stay as they
/// are. Its exceptions are passed on.
simulation::Command ask(const py::object& pilot, const simulation::PilotView& view);

void bind_pilot(py::module_& module);

}  // namespace polynya::python
