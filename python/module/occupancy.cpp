#include <algorithm>
#include <cmath>
#include <utility>

#include "python/module/simulation.hpp"
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "simulation/ship/cover_image.hpp"
#include "simulation/world/world.hpp"

namespace polynya::python {

namespace {

constexpr int kMostCells = 4096;  ///< largest number of cells along one side

simulation::ImageFrame checked_frame(std::pair<int, int> shape, double cell, double ahead) {
  const auto [rows, columns] = shape;
  if (std::min(rows, columns) < 1 || std::max(rows, columns) > kMostCells)
    throw py::value_error(
        fmt::format("occupancy: shape is ({}, {}), allowed: 1 to {} cells", rows, columns, kMostCells));
  if (!(cell > 0 && std::isfinite(cell)))
    throw py::value_error(fmt::format("occupancy: cell_m is {}, allowed: > 0", cell));
  if (!std::isfinite(ahead))
    throw py::value_error(fmt::format("occupancy: ahead_m is {}, allowed: a finite number", ahead));
  return {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns), cell, ahead};
}

/// Draws the contents of each cell: floating ice, and hulls other than the ship's own.
void draw(const simulation::Simulation& simulation, std::size_t own, const simulation::ImageFrame& frame, float* ice,
          float* others) {
  const std::vector<simulation::HullState> ships = simulation.ship_states();
  const geometry::Pose world_from_ship = ships[own].world_from_ship;
  simulation::CoverImage of_ice(frame), of_others(frame);
  add_floes(simulation.world(), world_from_ship, frame, of_ice);
  for (std::size_t i = 0; i < ships.size(); ++i) {
    if (i == own) continue;
    of_others.add({hull_of(simulation.scene(), i).hull.waterline, {}},
                  relative_pose(world_from_ship, ships[i].world_from_ship));
  }
  of_ice.write(ice);
  of_others.write(others);
}

py::array_t<float> occupancy(const Simulation& python, const py::object& ship, std::pair<int, int> shape, double cell,
                             double ahead) {
  const simulation::Simulation& simulation = python.between_steps();
  const simulation::ImageFrame frame = checked_frame(shape, cell, ahead);
  const std::size_t own = python.index_of(ship, "occupancy");
  const auto rows = static_cast<py::ssize_t>(frame.rows), columns = static_cast<py::ssize_t>(frame.columns);
  py::array_t<float> cells({py::ssize_t{2}, rows, columns});
  float* const ice = cells.mutable_data(0, 0, 0);
  float* const others = cells.mutable_data(1, 0, 0);
  const Simulation::Reading reading(python);
  const py::gil_scoped_release release;
  draw(simulation, own, frame, ice, others);
  return cells;
}

constexpr auto kOccupancyDoc =
    "occupancy(ship=0, shape=(96, 96), cell_m=4.0, ahead_m=0.0)\n"
    "\n"
    "An image of the surroundings of a ship from above, in its frame: an array of 2 x rows x columns with the "
    "fractions\n"
    "of each cell that floating ice, and that other ships and structures, cover. The first row is the farthest ahead, "
    "the\n"
    "first column the farthest to port; the centre is ahead_m ahead of the ship's centre of gravity.";

}  // namespace

void bind_occupancy(py::class_<Simulation>& simulation) {
  simulation.def("occupancy", &occupancy, py::arg("ship") = 0, py::arg("shape") = std::pair(96, 96),
                 py::arg("cell_m") = 4.0, py::arg("ahead_m") = 0.0, kOccupancyDoc);
}

}  // namespace polynya::python
