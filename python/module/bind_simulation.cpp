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
    "Simulation(scene, threads=1)\n\n"
    "A scene, stepped. `scene` is a Scene or what makes one; SceneError carries what is wrong with it.\n"
    "Results do not depend on `threads`, and are those of `polynya run`, bit for bit.\n\n"
    "Steps release the GIL: simulations in several threads run at once. One simulation is stepped by one\n"
    "thread at a time; the others get a RuntimeError.";
constexpr auto kRunDoc =
    "run(until=None, progress=None)\n\n"
    "Takes ticks to a time [s], or to the scene's own end, rounded up to a whole tick. run() in pieces and\n"
    "step(1) repeated give the same bytes as one call. `progress` is called with the time [s] about 20 times\n"
    "a second and at the end; what it raises ends the run between two ticks, and so does Ctrl-C.\n"
    "Raises SimulationError where the run cannot continue.";
constexpr auto kPilotDoc =
    "set_pilot(ship, pilot)\n\n"
    "Lets a callable steer a ship that has an engine (an index or a name), in the place of the scene's\n"
    "pilot; None gives it back. It is called at the start of every time step, also of each part of a tick,\n"
    "with a PilotView, and returns (lever -1 to 1, steering angle to port [rad]), or None to keep both;\n"
    "beyond their stops they are limited. It may read the simulation (ships, floes), not step or save it.\n"
    "What it raises comes out of step() or run() after that tick is whole. save() does not hold what it\n"
    "remembers.";
constexpr auto kEventsDoc =
    "events()\n\n"
    "What happened since the last call: dicts as the lines of events.ndjson (docs/run-folder.md), in their\n"
    "order. Kept until they are fetched.";

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
           "step(n=1)\n\nTakes n ticks (time.step_s), as run() does. Raises SimulationError where the run cannot\n"
           "continue.")
      .def("run", &Simulation::run, py::arg("until") = py::none(), py::arg("progress") = py::none(), kRunDoc)
      .def("events", &Simulation::events, kEventsDoc)
      .def("set_command", &Simulation::set_command, py::arg("ship"), py::arg("lever"), py::arg("steering"),
           "Gives a ship, by index or name, a command that it follows from now on in place of its pilot's: the lever, "
           "and the\nsteering angle as a share of the largest, to port positive. set_pilot(ship, None) ends it.")
      .def("set_pilot", &Simulation::set_pilot, py::arg("ship"), py::arg("pilot"), kPilotDoc)
      .def("_record", &Simulation::record, py::arg("folder"), py::arg("overwrite"))
      .def("_end_recording", &Simulation::end_recording, py::arg("stopped_by"))
      .def("save", &Simulation::save,
           "save()\n\nAll that decides how the run continues, as bytes for resume(); with a checksum.")
      .def_property_readonly("scene", &Simulation::given_scene, "The Scene that it is of.")
      .def_property_readonly(
          "time", [](const Simulation& s) { return s.between_steps().time(); }, "Simulated time [s].")
      .def_property_readonly(
          "steps", [](const Simulation& s) { return s.between_steps().steps(); }, "Time steps taken.")
      .def_property_readonly(
          "state_hash", [](const Simulation& s) { return fmt::format("{:016x}", s.between_steps().state_hash()); },
          "A hash of all the state: 16 hexadecimal digits, as in the run folder's states.csv.");
  bind_arrays(module, type);
  bind_floe_memory(module, type);
  bind_occupancy(type);
  bind_nearest_floes(type);
}

}  // namespace polynya::python
