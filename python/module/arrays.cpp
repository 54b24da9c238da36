#include <array>
#include <string>
#include <vector>

#include "python/module/numpy_arrays.hpp"
#include "python/module/simulation.hpp"

#include "io/run/records.hpp"
#include "simulation/world/world.hpp"

namespace polynya::python {
namespace {

/// A copy of the floes' state, one array per quantity.
struct Floes {
  Integers ids, parents, generations;
  py::array_t<bool> is_under;
  Numbers poses, velocities;  ///< n × 3
  Numbers thickness, densities, flexural_strengths, compressive_strengths, tensile_strengths, fracture_toughnesses;
  Numbers areas, masses;
  Numbers vertices, world_vertices;  ///< m × 2
  Integers ring_offsets, floe_offsets;
};

/// A copy of a ship's state.
struct Ship {
  std::string name;
  Numbers position, velocity;
  double heading = 0, yaw_rate = 0, lever = 0, steering_angle = 0;
  py::dict forces;
};

Numbers pair_of(double x, double y) {
  const std::array<double, 2> values{x, y};
  return Numbers(2, values.data());
}

py::dict forces_of(const simulation::HullSample& sample) {
  py::dict forces;
  forces["t_s"] = sample.time;
  for (const io::ForceColumn& column : io::force_columns())
    forces[py::str(column.name.data(), column.name.size())] = column.read(sample);
  return forces;
}

py::object ships_of(const Simulation& python) {
  const simulation::Simulation& simulation = python.between_steps();
  const std::vector<simulation::HullState> states = simulation.ship_states();
  const std::vector<simulation::Helm>& helms = simulation.world().population.helms;
  py::list ships;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const simulation::HullState& state = states[i];
    const simulation::Helm helm = i < helms.size() ? helms[i] : simulation::Helm{};
    const geometry::Point at = state.world_from_ship.position;
    const auto& sample = python.last_sample(i);
    ships.append(Ship{hull_of(simulation.scene(), i).name, pair_of(at.x, at.y),
                      pair_of(state.velocity.x, state.velocity.y), state.heading, state.angular_velocity, helm.lever,
                      helm.steering_angle, sample ? forces_of(*sample) : py::dict()});
  }
  return py::module_::import("polynya.named").attr("Named")(ships);
}

template <class Value, class Read>
py::array_t<Value> column(const std::vector<simulation::FloeState>& states, Read read) {
  py::array_t<Value> values(static_cast<py::ssize_t>(states.size()));
  Value* at = values.mutable_data();
  for (const simulation::FloeState& state : states) *at++ = read(state);
  return values;
}

template <class Read>
Numbers rows_of_three(const std::vector<simulation::FloeState>& states, Read read) {
  std::vector<double> values;
  values.reserve(3 * states.size());
  for (const simulation::FloeState& state : states)
    for (const double value : read(state)) values.push_back(value);
  return table(std::move(values), 3);
}

Floes floes_of(const Simulation& python) {
  using State = simulation::FloeState;
  using Three = std::array<double, 3>;
  const simulation::Simulation& simulation = python.between_steps();
  const simulation::Population& population = simulation.world().population;
  const std::vector<State> states = simulation.floe_states(simulation::Living::kAll);
  PolygonTable in_body, in_world;
  for (const State& state : states) {
    in_body.add(*state.polygon_in_body, {});
    in_world.add(*state.polygon_in_body, state.world_from_body);
  }
  const auto integers = [&](auto read) { return column<std::int64_t>(states, read); };
  const auto numbers = [&](auto read) { return column<double>(states, read); };
  return {
      .ids = integers([](const State& s) { return s.floe; }),
      .parents = integers([](const State& s) { return s.parent; }),
      .generations = integers([](const State& s) { return static_cast<std::int64_t>(s.generation); }),
      .is_under = column<bool>(states, [&](const State& s) { return population.floes[s.floe].is_under; }),
      .poses = rows_of_three(states,
                             [](const State& s) {
                               const geometry::Point at = s.world_from_body.position;
                               return Three{at.x, at.y, s.angle};
                             }),
      .velocities = rows_of_three(states,
                                  [](const State& s) {
                                    return Three{s.velocity.x, s.velocity.y, s.angular_velocity};
                                  }),
      .thickness = numbers([](const State& s) { return s.ice->thickness; }),
      .densities = numbers([](const State& s) { return s.ice->density; }),
      .flexural_strengths = numbers([](const State& s) { return s.ice->flexural_strength; }),
      .compressive_strengths = numbers([](const State& s) { return s.ice->compressive_strength; }),
      .tensile_strengths = numbers([](const State& s) { return s.ice->tensile_strength; }),
      .fracture_toughnesses = numbers([](const State& s) { return s.ice->fracture_toughness; }),
      .areas = numbers([](const State& s) { return s.area; }),
      .masses = numbers([](const State& s) { return s.mass; }),
      .vertices = table(std::move(in_body.vertices), 2),
      .world_vertices = table(std::move(in_world.vertices), 2),
      .ring_offsets = column_of(std::move(in_body.ring_offsets)),
      .floe_offsets = column_of(std::move(in_body.polygon_offsets)),
  };
}

void bind_ship(py::module_& module) {
  py::class_<Ship>(module, "Ship", "State of a ship or structure between two steps, as a copy.")
      .def_readonly("name", &Ship::name, "Name in the scene.")
      .def_readonly("position", &Ship::position, "Position of the centre of gravity, x and y [m].")
      .def_readonly("heading", &Ship::heading, "Heading from the x axis, counter-clockwise [rad].")
      .def_readonly("velocity", &Ship::velocity, "Velocity over ground, x and y [m/s].")
      .def_readonly("yaw_rate", &Ship::yaw_rate, "Yaw rate, counter-clockwise [rad/s].")
      .def_readonly("lever", &Ship::lever, "Thrust lever from -1 (full astern) to 1 (full ahead).")
      .def_readonly("steering_angle", &Ship::steering_angle, "Angle of rudder or thrusters, positive to port [rad].")
      .def_readonly(
          "forces", &Ship::forces,
          "The last row of forces.csv as a dict by its columns (docs/run-folder.md). Forces are means over the\n"
          "recording interval that ends at t_s. Empty before the first interval has ended.")
      .def("__repr__", [](const Ship& s) {
        return py::str("polynya.Ship({!r}, position {}, heading {:.4f} rad)").format(s.name, s.position, s.heading);
      });
}

void bind_floes(py::module_& module) {
  py::class_<Floes>(
      module, "Floes",
      "State of the floes between two steps as numpy arrays in the order of their ids. The arrays are copies.\n\n"
      "Floe i has the rings floe_offsets[i] to floe_offsets[i + 1], the outer one first, holes after it;\n"
      "ring r has the vertices ring_offsets[r] to ring_offsets[r + 1], the first not repeated.")
      .def_readonly("ids", &Floes::ids, "Ids as in floes.ndjson and events; an id is never reused.")
      .def_readonly("parents", &Floes::parents, "Ids of the floes from which they broke; -1 for floes of the scene.")
      .def_readonly("generations", &Floes::generations, "Number of fractures since the floe of the scene.")
      .def_readonly("is_under", &Floes::is_under, "Whether the floe is under a hull, or under the ice behind it.")
      .def_readonly("poses", &Floes::poses,
                    "n x 3: origin of the body frame in the world, x and y [m], and its angle [rad].")
      .def_readonly("velocities", &Floes::velocities,
                    "n x 3: velocity of the centre of mass over ground, x and y [m/s]; angular velocity [rad/s].")
      .def_readonly("thickness", &Floes::thickness, "Thickness [m].")
      .def_readonly("densities", &Floes::densities, "Density [kg/m3].")
      .def_readonly("flexural_strengths", &Floes::flexural_strengths, "Flexural strength [Pa].")
      .def_readonly("compressive_strengths", &Floes::compressive_strengths, "Compressive strength [Pa].")
      .def_readonly("tensile_strengths", &Floes::tensile_strengths, "Tensile strength [Pa].")
      .def_readonly("fracture_toughnesses", &Floes::fracture_toughnesses, "Fracture toughness [Pa m^0.5].")
      .def_readonly("areas", &Floes::areas, "Area [m2].")
      .def_readonly("masses", &Floes::masses, "Mass [kg].")
      .def_readonly("vertices", &Floes::vertices,
                    "m x 2: vertices in the body frame, in which a floe's shape never changes [m].")
      .def_readonly("world_vertices", &Floes::world_vertices, "m x 2: the same vertices in the world [m].")
      .def_readonly("ring_offsets", &Floes::ring_offsets,
                    "Index of the first vertex of each ring; one more entry than rings.")
      .def_readonly("floe_offsets", &Floes::floe_offsets,
                    "Index of the first ring of each floe; one more entry than floes.")
      .def("__len__", [](const Floes& floes) { return floes.ids.size(); });
}

}  // namespace

void bind_arrays(py::module_& module, py::class_<Simulation>& simulation) {
  bind_ship(module);
  bind_floes(module);
  simulation
      .def_property_readonly(
          "ships", &ships_of,
          "Ships and structures in the scene's order: a list of Ship, which can also be accessed by name:\n"
          "ships[\"icebreaker\"].")
      .def_property_readonly("floes", &floes_of, "State of the floes as numpy arrays: Floes.");
}

}  // namespace polynya::python
