#include "python/module/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "python/module/simulation.hpp"
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "simulation/world/world.hpp"

namespace polynya::python {

double ImageFrame::radius() const {
  return 0.5 * cell * std::hypot(static_cast<double>(rows), static_cast<double>(columns));
}

CoverImage::CoverImage(const ImageFrame& frame) : frame_(frame), steps_(frame.rows * (frame.columns + 1)) {}

/// From a crossing on, the line is covered or no longer covered: by a share of its cell, and all after it.
void CoverImage::add_crossing(std::size_t row, double x, double share) {
  const auto columns = static_cast<double>(frame_.columns);
  if (!(x < columns)) return;
  x = std::max(x, 0.0);
  const auto cell = static_cast<std::size_t>(x);
  const double before = share * (x - static_cast<double>(cell));
  double* const steps = steps_.data() + row * (frame_.columns + 1) + cell;
  steps[0] += share - before;
  steps[1] += before;
}

/// An edge has the lines from its upper end to its lower one, without the last: each ring crosses each line
/// an even number of times. Line k lies at k + 1/2, in lines from the top; the ice is to the right of an edge
/// down.
void CoverImage::add_edge(geometry::Point a, geometry::Point b) {
  const auto lines = static_cast<double>(frame_.rows * kLines);
  const auto line_from = [lines](double y) { return static_cast<std::size_t>(std::clamp(y + 0.5, 0.0, lines)); };
  std::size_t from = line_from(a.y), to = line_from(b.y);
  if (from == to) return;
  double share = 1.0 / kLines;
  if (from > to) {
    std::swap(from, to);
    share = -share;
  }
  const double slope = (b.x - a.x) / (b.y - a.y);
  for (std::size_t line = from; line < to; ++line)
    add_crossing(line / kLines, a.x + slope * (static_cast<double>(line) + 0.5 - a.y), share);
}

/// Columns from the left edge and lines from the top of each vertex.
void CoverImage::add_ring(const geometry::Ring& ring, const geometry::Pose& ship_from_body) {
  const double columns = 1 / frame_.cell, lines = kLines / frame_.cell;
  const double left = 0.5 * static_cast<double>(frame_.columns);
  const double top = 0.5 * static_cast<double>(frame_.rows * kLines) + lines * frame_.ahead;
  const auto placed = [&](geometry::Point in_body) {
    const geometry::Point p = transform(ship_from_body, in_body);
    return geometry::Point{left - columns * p.y, top - lines * p.x};
  };
  geometry::Point before = placed(ring.back());
  for (const geometry::Point p : ring) {
    const geometry::Point at = placed(p);
    add_edge(before, at);
    before = at;
  }
}

void CoverImage::add(const geometry::Polygon& polygon, const geometry::Pose& ship_from_body) {
  add_ring(polygon.outer, ship_from_body);
  for (const geometry::Ring& hole : polygon.holes) add_ring(hole, ship_from_body);
}

void CoverImage::write(float* cells) const {
  const double* step = steps_.data();
  for (std::size_t row = 0; row < frame_.rows; ++row, ++step) {
    double share = 0;
    for (std::size_t column = 0; column < frame_.columns; ++column, ++cells, ++step) {
      share += *step;
      *cells = static_cast<float>(std::clamp(share, 0.0, 1.0));
    }
  }
}

namespace {

constexpr int kMostCells = 4096;  ///< on a side

ImageFrame checked_frame(std::pair<int, int> shape, double cell, double ahead) {
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

/// Floes whose circle meets the image's; those under hulls are not in the way.
void add_floes(const simulation::Simulation& simulation, const geometry::Pose& world_from_ship, CoverImage& image,
               const ImageFrame& frame) {
  const simulation::Population& population = simulation.world().population;
  const dynamics::Bodies& bodies = population.bodies;
  const geometry::Vector drift = drift_at(simulation.world().setup, simulation.time());
  const geometry::Point middle = transform(world_from_ship, {frame.ahead, 0}) - drift;  // water frame
  for (simulation::FloeId id = 0; id < population.floe_count(); ++id) {
    const auto body = static_cast<std::size_t>(population.body_of(id));
    if (!population.is_floating(id)) continue;
    const geometry::Vector away = bodies.position[body] - middle;
    if (std::hypot(away.x, away.y) > frame.radius() + bodies.bounding_radius[body]) continue;
    geometry::Pose world_from_body = dynamics::water_from_body(bodies, population.body_of(id));
    world_from_body.position += drift;
    image.add(population.floes[static_cast<std::size_t>(id)].shape.polygon,
              relative_pose(world_from_ship, world_from_body));
  }
}

py::array_t<float> occupancy(const Simulation& python, const py::object& ship, std::pair<int, int> shape, double cell,
                             double ahead) {
  const simulation::Simulation& simulation = python.between_steps();
  const ImageFrame frame = checked_frame(shape, cell, ahead);
  const std::size_t own = python.index_of(ship, "occupancy");
  const std::vector<simulation::HullState> ships = simulation.ship_states();
  const geometry::Pose world_from_ship = ships[own].world_from_ship;
  CoverImage ice(frame), others(frame);
  add_floes(simulation, world_from_ship, ice, frame);
  for (std::size_t i = 0; i < ships.size(); ++i) {
    if (i == own) continue;
    others.add({hull_of(simulation.scene(), i).hull.waterline, {}},
               relative_pose(world_from_ship, ships[i].world_from_ship));
  }
  const auto rows = static_cast<py::ssize_t>(frame.rows), columns = static_cast<py::ssize_t>(frame.columns);
  py::array_t<float> cells({py::ssize_t{2}, rows, columns});
  ice.write(cells.mutable_data(0, 0, 0));
  others.write(cells.mutable_data(1, 0, 0));
  return cells;
}

constexpr auto kOccupancyDoc =
    "occupancy(ship=0, shape=(96, 96), cell_m=4.0, ahead_m=0.0)\n\n"
    "An image from above around a ship, in its frame: an array of 2 x rows x columns, the share of each "
    "cell\n"
    "that floating ice covers, and that other ships and structures cover. The first row is the farthest\n"
    "ahead, the first column to port; the middle is ahead_m ahead of the ship's centre of gravity.";

}  // namespace

void bind_occupancy(py::class_<Simulation>& simulation) {
  simulation.def("occupancy", &occupancy, py::arg("ship") = 0, py::arg("shape") = std::pair(96, 96),
                 py::arg("cell_m") = 4.0, py::arg("ahead_m") = 0.0, kOccupancyDoc);
}

}  // namespace polynya::python
