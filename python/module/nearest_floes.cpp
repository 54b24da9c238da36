#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "python/module/simulation.hpp"
#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "simulation/world/world.hpp"

namespace polynya::python {
namespace {

constexpr py::ssize_t kColumns = 7;
constexpr int kMostFloes = 100'000;  ///< largest number of floes per call

/// Returns the floes whose circles are nearest to a point of the water frame [m], nearest first, at most `count`.
std::vector<simulation::FloeId> nearest(const simulation::Population& population, geometry::Point point,
                                        std::size_t count) {
  std::vector<std::pair<double, simulation::FloeId>> all;
  const dynamics::Bodies& bodies = population.bodies;
  for (simulation::FloeId id = 0; id < population.floe_count(); ++id) {
    if (!population.is_floating(id)) continue;
    const auto body = static_cast<std::size_t>(population.body_of(id));
    all.emplace_back(length(bodies.position[body] - point) - bodies.bounding_radius[body], id);
  }
  count = std::min(count, all.size());
  std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(count));
  std::vector<simulation::FloeId> floes;
  for (std::size_t i = 0; i < count; ++i) floes.push_back(all[i].second);
  return floes;
}

/// Writes a row for each floe, in the ship's frame.
void write_rows(const simulation::World& world, int ship, py::ssize_t count, float* rows) {
  const simulation::Population& population = world.population;
  const dynamics::Bodies& bodies = population.bodies;
  const auto own = static_cast<std::size_t>(ship);
  std::fill(rows, rows + count * kColumns, 0.0F);
  for (const simulation::FloeId id : nearest(population, bodies.position[own], static_cast<std::size_t>(count))) {
    const auto body = static_cast<std::size_t>(population.body_of(id));
    const geometry::Vector place = rotate_back(bodies.rotation[own], bodies.position[body] - bodies.position[own]);
    const geometry::Vector velocity = rotate_back(bodies.rotation[own], bodies.velocity[body] - bodies.velocity[own]);
    for (const double value : {place.x, place.y, velocity.x, velocity.y, bodies.bounding_radius[body],
                               population.floes[static_cast<std::size_t>(id)].area, bodies.thickness[body]})
      *rows++ = static_cast<float>(value);
  }
}

py::array_t<float> nearest_floes(const Simulation& python, const py::object& ship, int count) {
  const simulation::Simulation& simulation = python.between_steps();
  if (count < 1 || count > kMostFloes)
    throw py::value_error(fmt::format("nearest_floes: count is {}, allowed: 1 to {}", count, kMostFloes));
  const auto own = static_cast<int>(python.index_of(ship, "nearest_floes"));
  py::array_t<float> rows({static_cast<py::ssize_t>(count), kColumns});
  float* const first = rows.mutable_data(0, 0);
  const Simulation::Reading reading(python);
  const py::gil_scoped_release release;
  write_rows(simulation.world(), own, count, first);
  return rows;
}

constexpr auto kNearestFloesDoc =
    "nearest_floes(ship=0, count=32)\n"
    "\n"
    "The floating floes whose circles are nearest to a ship's centre of gravity, nearest first: an array of count x 7 "
    "in\n"
    "the ship's frame. Columns: position ahead and to port [m], velocity relative to the ship ahead and to port "
    "[m/s],\n"
    "radius of the circle about the centre of mass that contains the floe [m], area [m2], thickness [m]. If there are\n"
    "fewer floes, the other rows are 0.";

}  // namespace

void bind_nearest_floes(py::class_<Simulation>& simulation) {
  simulation.def("nearest_floes", &nearest_floes, py::arg("ship") = 0, py::arg("count") = 32, kNearestFloesDoc);
}

}  // namespace polynya::python
