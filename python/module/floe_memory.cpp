#include <memory>
#include <span>
#include <vector>

#include "python/module/simulation.hpp"
#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "simulation/world/world.hpp"

namespace polynya::python {

/// The simulation's own memory of its floes as numpy arrays, without a copy (docs/python.md, "Without a copy"). The
/// simulation refuses to step as long as one of the arrays exists.
class FloeMemory {
 public:
  explicit FloeMemory(py::object simulation)
      : owner_(std::move(simulation)), simulation_(owner_.cast<const Simulation&>()) {}
  const py::object& owner() const { return owner_; }
  const Simulation& simulation() const { return simulation_; }

 private:
  py::object owner_;  ///< keeps the simulation alive
  const Simulation& simulation_;
};

namespace {

using dynamics::Bodies;
using geometry::Point;
using simulation::Floe;

// x and y are adjacent, so a vector of points is an array of n × 2.
static_assert(sizeof(Point) == 2 * sizeof(double) && sizeof(geometry::Vector) == 2 * sizeof(double));
static_assert(sizeof(bool) == 1);

const simulation::Population& population_of(const FloeMemory& memory) {
  return memory.simulation().at_rest().world().population;
}

/// Counts a view of a simulation's memory as long as it exists, and keeps the simulation alive.
struct Hold {
  explicit Hold(const FloeMemory& memory) : simulation(memory.owner()), views(memory.simulation().views()) { ++*views; }
  ~Hold() { --*views; }
  Hold(const Hold&) = delete;
  Hold& operator=(const Hold&) = delete;

  py::object simulation;
  std::shared_ptr<std::int64_t> views;
};

py::array view(const FloeMemory& memory, const py::dtype& type, std::vector<py::ssize_t> shape,
               std::vector<py::ssize_t> strides, const void* first) {
  if (first == nullptr) return py::array(type, std::move(shape));  // there are no floes
  auto hold = std::make_unique<Hold>(memory);
  const py::capsule base(hold.get(), [](void* p) { delete static_cast<Hold*>(p); });
  static_cast<void>(hold.release());  // the capsule owns it now
  py::array array(type, std::move(shape), std::move(strides), first, base);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

py::array points(const FloeMemory& memory, const double* first, std::size_t count) {
  constexpr py::ssize_t kNumber = sizeof(double);
  return view(memory, py::dtype::of<double>(), {static_cast<py::ssize_t>(count), 2}, {2 * kNumber, kNumber}, first);
}

/// Array of a quantity of bodies, starting at the first floe.
template <auto Member>
py::array of_bodies(const FloeMemory& memory) {
  const simulation::Population& population = population_of(memory);
  const auto& all = population.bodies.*Member;
  const auto rows = std::span(all).subspan(static_cast<std::size_t>(population.hull_count));
  using Value = typename decltype(rows)::value_type;
  if constexpr (sizeof(Value) == 2 * sizeof(double)) {
    return points(memory, rows.empty() ? nullptr : &rows.front().x, rows.size());
  } else {
    const auto type = sizeof(Value) == 1 ? py::dtype("?") : py::dtype::of<double>();
    return view(memory, type, {static_cast<py::ssize_t>(rows.size())}, {static_cast<py::ssize_t>(sizeof(Value))},
                rows.empty() ? nullptr : &rows.front());
  }
}

/// Array of a quantity in the floes' cold data. Other data lies between its values, so it has strides.
template <auto Member>
py::array of_floes(const FloeMemory& memory) {
  const std::vector<Floe>& floes = population_of(memory).floes;
  using Value = std::remove_cvref_t<decltype(floes.front().*Member)>;
  const auto type = std::is_same_v<Value, bool> ? py::dtype("?") : py::dtype::of<Value>();
  return view(memory, type, {static_cast<py::ssize_t>(floes.size())}, {static_cast<py::ssize_t>(sizeof(Floe))},
              floes.empty() ? nullptr : &(floes.front().*Member));
}

py::list shape_of(const FloeMemory& memory, std::int64_t id) {
  const simulation::Population& population = population_of(memory);
  if (id < 0 || id >= population.floe_count())
    throw py::index_error(fmt::format("floe {}: ids go from 0 to {}", id, population.floe_count() - 1));
  if (!population.is_alive(id)) throw py::value_error(fmt::format("floe {} has broken", id));
  const geometry::Polygon& polygon = population.floes[static_cast<std::size_t>(id)].shape.polygon;
  py::list rings;
  rings.append(points(memory, &polygon.outer.front().x, polygon.outer.size()));
  for (const geometry::Ring& hole : polygon.holes) rings.append(points(memory, &hole.front().x, hole.size()));
  return rings;
}

py::tuple pair_of(geometry::Vector v) {
  return py::make_tuple(v.x, v.y);
}

constexpr auto kMemoryDoc =
    "The simulation's own memory of its floes, without a copy: read-only numpy arrays with one row for each floe that\n"
    "ever existed, by its id. is_alive marks floes that have not broken; rows of broken floes have their last state.\n"
    "\n"
    "While one of the arrays, or a part of one, exists, step() and run() raise a BufferError: delete it, or copy the\n"
    "values that you need after a step. An array keeps its simulation alive.\n"
    "\n"
    "Positions and velocities are those of centres of mass in the water's frame. Add water_shift and water_velocity "
    "for\n"
    "those over ground.";

void bind_bodies(py::class_<FloeMemory>& type) {
  type.def_property_readonly("is_alive", &of_bodies<&Bodies::is_alive>, "True if the floe has not broken.")
      .def_property_readonly("centres", &of_bodies<&Bodies::position>,
                             "n x 2: centres of mass in the water's frame [m].")
      .def_property_readonly("angles", &of_bodies<&Bodies::angle>, "Angles of the body frames [rad].")
      .def_property_readonly("velocities", &of_bodies<&Bodies::velocity>,
                             "n x 2: velocities of the centres of mass relative to the water [m/s].")
      .def_property_readonly("turning", &of_bodies<&Bodies::angular_velocity>,
                             "Angular velocities, counter-clockwise [rad/s].")
      .def_property_readonly("masses", &of_bodies<&Bodies::mass>, "Masses [kg].")
      .def_property_readonly("thickness", &of_bodies<&Bodies::thickness>, "Thicknesses [m].")
      .def_property_readonly("radii", &of_bodies<&Bodies::bounding_radius>,
                             "Radii of the circles about the centres of mass that contain the floes [m].")
      .def_property_readonly("centroids", &of_bodies<&Bodies::centroid>,
                             "n x 2: centres of mass in the body frames [m].");
}

}  // namespace

void bind_floe_memory(py::module_& module, py::class_<Simulation>& simulation) {
  py::class_<FloeMemory> type(module, "FloeMemory", kMemoryDoc);
  bind_bodies(type);
  type.def_property_readonly("parents", &of_floes<&Floe::parent>,
                             "Ids of the floes from which they broke; -1 for floes of the scene.")
      .def_property_readonly("generations", &of_floes<&Floe::generation>,
                             "Number of fractures since the floe of the scene.")
      .def_property_readonly("areas", &of_floes<&Floe::area>, "Areas [m2].")
      .def_property_readonly("is_under", &of_floes<&Floe::is_under>,
                             "Whether the floe is under a hull, or under the ice behind it.")
      .def("shape", &shape_of, py::arg("id"),
           "shape(id)\n\nThe rings of a floe that has not broken, n x 2 each, in its body's frame [m]: the "
           "outer one,\nthen its holes.")
      .def_property_readonly(
          "water_shift",
          [](const FloeMemory& m) {
            const simulation::Simulation& s = m.simulation().at_rest();
            return pair_of(drift_at(s.world().setup, s.time()));
          },
          "Displacement of the water over ground, x and y [m].")
      .def_property_readonly(
          "water_velocity",
          [](const FloeMemory& m) { return pair_of(m.simulation().at_rest().world().population.water_velocity); },
          "Velocity over ground, x and y [m/s].")
      .def("__len__", [](const FloeMemory& m) { return population_of(m).floe_count(); });
  simulation.def_property_readonly(
      "floe_memory", [](py::object self) { return FloeMemory(std::move(self)); },
      "State of the floes as arrays on the simulation's own memory: FloeMemory.");
}

}  // namespace polynya::python
