#include "python/module/pilot.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace polynya::python {
namespace {

/// Returns a number of a command. Raises an exception if it is not finite.
double number_of(const py::handle& value, const char* name) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  if (!std::isfinite(number)) throw py::value_error(fmt::format("the pilot's {} is {}", name, number));
  return number;
}

py::tuple pair_of(geometry::Point p) {
  return py::make_tuple(p.x, p.y);
}
py::tuple pair_of(geometry::Vector v) {
  return py::make_tuple(v.x, v.y);
}
py::tuple three_of(const dynamics::Planar& p) {
  return py::make_tuple(p.surge, p.sway, p.yaw);
}

void bind_seen_ship(py::module_& module) {
  using simulation::SeenHull;
  py::class_<SeenHull>(module, "SeenShip", "A ship or structure as pilots see it.")
      .def_property_readonly(
          "position", [](const SeenHull& s) { return pair_of(s.position_in_world); },
          "Position of the centre of gravity, x and y [m].")
      .def_readonly("heading", &SeenHull::heading, "Heading [rad].")
      .def_property_readonly(
          "velocity", [](const SeenHull& s) { return pair_of(s.velocity); }, "Velocity over ground, x and y [m/s].")
      .def_readonly("length", &SeenHull::length, "Length of the waterline [m].");
}

/// Reads a number of the view.
template <auto Member>
double read(const PilotView& view) {
  return view.values.*Member;
}

}  // namespace

simulation::Command ask(const py::object& pilot, const simulation::PilotView& view) {
  const py::object command = pilot(PilotView(view));
  if (command.is_none()) return {view.lever, view.steering_angle};
  if (!py::isinstance<py::sequence>(command) || py::len(command) != 2)
    throw py::type_error(fmt::format("the pilot returned {}, allowed: (lever, steering angle [rad]) or None",
                                     py::repr(command).cast<std::string>()));
  return {number_of(command[py::int_(0)], "lever"), number_of(command[py::int_(1)], "steering angle")};
}

void bind_pilot(py::module_& module) {
  using V = simulation::PilotView;
  bind_seen_ship(module);
  py::class_<PilotView>(module, "PilotView",
                        "State of a ship and its surroundings that a pilot sees in a step, as a copy.")
      .def_property_readonly("time", &read<&V::time>, "Simulated time [s].")
      .def_property_readonly("step", &read<&V::step>, "Time until the next command [s].")
      .def_property_readonly(
          "ship", [](const PilotView& v) { return v.values.ship; }, "Index of the pilot's own ship in ships.")
      .def_readonly("ships", &PilotView::hulls, "All ships and structures, as SeenShip.")
      .def_property_readonly(
          "position", [](const PilotView& v) { return pair_of(v.own().position_in_world); },
          "Position of the centre of gravity, x and y [m].")
      .def_property_readonly(
          "heading", [](const PilotView& v) { return v.own().heading; }, "Heading [rad].")
      .def_property_readonly(
          "velocity", [](const PilotView& v) { return pair_of(v.own().velocity); },
          "Velocity over ground, x and y [m/s].")
      .def_property_readonly(
          "through_water", [](const PilotView& v) { return three_of(v.values.through_water); },
          "Velocity through the water ahead and to port [m/s], yaw rate [rad/s].")
      .def_property_readonly("speed_over_ground", &read<&V::speed_over_ground>, "Speed over ground, ahead [m/s].")
      .def_property_readonly("lever", &read<&V::lever>, "Present thrust lever, from -1 to 1.")
      .def_property_readonly("steering_angle", &read<&V::steering_angle>,
                             "Present steering angle, positive to port [rad].")
      .def_property_readonly("steering_most", &read<&V::steering_most>, "Largest steering angle to either side [rad].")
      .def_property_readonly(
          "ice_force", [](const PilotView& v) { return three_of(v.values.ice_force); },
          "Force of the ice on the ship in the previous step: ahead and to port [N], moment [N m].")
      .def_property_readonly("mass", &read<&V::mass>, "Mass of the ship with the added mass ahead [kg].");
}

}  // namespace polynya::python
