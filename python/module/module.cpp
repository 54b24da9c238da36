#include "python/module/pilot.hpp"
#include "python/module/simulation.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of polynya. Import its names from polynya.";
  polynya::python::bind_scene(module);
  polynya::python::bind_pilot(module);
  polynya::python::bind_simulation(module);
  polynya::python::bind_cut(module);
}
