#include "python/module/simulation.hpp"
#include <fmt/format.h>
#include <pybind11/stl.h>

namespace polynya::python {
namespace {

/// Gives the garbage collector access to the pilots, which often refer to their simulation.
Simulation* initialised(PyObject* self) {
  auto value = reinterpret_cast<py::detail::instance*>(self)->get_value_and_holder();
  return value.holder_constructed() ? value.value_ptr<Simulation>() : nullptr;
}
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (Simulation* simulation = initialised(self))
    for (const py::object& pilot : simulation->pilots()) Py_VISIT(pilot.ptr());
  return 0;
}
int clear(PyObject* self) {
  if (Simulation* simulation = initialised(self))
    for (py::object& pilot : simulation->pilots()) pilot = py::none();
  return 0;
}
void collect_cycles(PyHeapTypeObject* heap_type) {
  PyTypeObject& type = heap_type->ht_type;
  type.tp_flags |= Py_TPFLAGS_HAVE_GC;
  type.tp_traverse = traverse;
  type.tp_clear = clear;
}

std::shared_ptr<Scene> scene_of(const py::object& given) {
  if (py::isinstance<Scene>(given)) return given.cast<std::shared_ptr<Scene>>();
  return std::make_shared<Scene>(given);
}

constexpr auto kSimulationDoc =
    "Simulation(scene, threads=1)\n"
    "\n"
    "A simulation of a scene. `scene` is a Scene, or anything from which one is made. A wrong scene raises "
    "SceneError,\n"
    "which lists its problems. Results do not depend on `threads`; they are those of `polynya run`, bit for bit.\n"
    "\n"
    "Steps release the GIL, so simulations in several threads run at the same time. One simulation can be stepped by\n"
    "one thread at a time; other threads get a RuntimeError.";
constexpr auto kRunDoc =
    "run(until=None, progress=None)\n"
    "\n"
    "Takes ticks up to a time [s], or to the end of the scene, rounded up to a whole tick. Several calls, or repeated\n"
    "step(1), give the same bytes as one call. `progress` is called with the time [s] about 20 times per second and "
    "at\n"
    "the end. Its exceptions end the run between two ticks, and so does Ctrl-C.\n"
    "Raises SimulationError if the run cannot continue.";
constexpr auto kPilotDoc =
    "set_pilot(ship, pilot)\n"
    "\n"
    "Lets a callable steer a ship with an engine (an index or a name) instead of the scene's pilot; None restores "
    "that\n"
    "pilot. It is called at the start of every time step, also of each part of a tick, with a PilotView. It returns\n"
    "(lever from -1 to 1, steering angle to port [rad]), or None to keep both; values beyond the stops are limited. "
    "It\n"
    "may read the simulation (ships, floes), but not step or save it. step() or run() raises its exceptions after "
    "that\n"
    "tick is complete. save() does not contain the state of the callable.";
constexpr auto kEventsDoc =
    "events()\n"
    "\n"
    "Events since the last call, in their order, as dicts with the members of events.ndjson (docs/run-folder.md). "
    "They\n"
    "are kept until this is called.";

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Simulation> type(module, "Simulation", kSimulationDoc, py::custom_type_setup(collect_cycles));
  type.def(py::init([](const py::object& scene, int threads) {
             return std::make_unique<Simulation>(scene_of(scene), threads);
           }),
           py::arg("scene"), py::arg("threads") = 1)
      .def_static(
          "resume",
          [](const py::object& scene, const py::bytes& saved, int threads) {
            return Simulation::resume(scene_of(scene), saved, threads);
          },
          py::arg("scene"), py::arg("saved"), py::arg("threads") = 1,
          "resume(scene, saved, threads=1)\n\n"
          "Continues from the bytes of save(), of the same scene: bit for bit as if it had not "
          "stopped.\nRaises ValueError where the bytes are damaged, or of another scene or version.")
      .def("step", &Simulation::step, py::arg("n") = 1,
           "step(n=1)\n\nTakes n ticks (time.step_s), as run() does. Raises SimulationError if the run cannot\n"
           "continue.")
      .def("run", &Simulation::run, py::arg("until") = py::none(), py::arg("progress") = py::none(), kRunDoc)
      .def("events", &Simulation::events, kEventsDoc)
      .def("set_command", &Simulation::set_command, py::arg("ship"), py::arg("lever"), py::arg("steering"),
           "Gives a ship, by index or name, a command that it follows from now on instead of its pilot's: the lever, "
           "and the\nsteering angle as a fraction of the largest, positive to port. set_pilot(ship, None) ends it.")
      .def("set_pilot", &Simulation::set_pilot, py::arg("ship"), py::arg("pilot"), kPilotDoc)
      .def("_record", &Simulation::record, py::arg("folder"), py::arg("overwrite"))
      .def("_end_recording", &Simulation::end_recording, py::arg("stopped_by"))
      .def("save", &Simulation::save, "save()\n\nComplete state of the run as bytes for resume(), with a checksum.")
      .def_property_readonly("scene", &Simulation::given_scene, "The Scene of the simulation.")
      .def_property_readonly(
          "time", [](const Simulation& s) { return s.between_steps().time(); }, "Simulated time [s].")
      .def_property_readonly(
          "steps", [](const Simulation& s) { return s.between_steps().steps(); }, "Number of ticks taken.")
      .def_property_readonly(
          "state_hash", [](const Simulation& s) { return fmt::format("{:016x}", s.between_steps().state_hash()); },
          "Hash of the whole state: 16 hexadecimal digits, as in the run folder's states.csv.");
  bind_arrays(module, type);
  bind_floe_memory(module, type);
  bind_occupancy(type);
  bind_nearest_floes(type);
}

}  // namespace polynya::python
