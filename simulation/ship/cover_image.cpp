#include "simulation/ship/cover_image.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "elementary/elementary.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

double ImageFrame::radius() const {
  return 0.5 * cell * elementary::hypot(static_cast<double>(rows), static_cast<double>(columns));
}

CoverImage::CoverImage(const ImageFrame& frame) : frame_(frame), steps_(frame.rows * (frame.columns + 1)) {}

/// Adds a crossing of a line and an edge at x cells from the left. From x on, the line is covered or not covered any
/// more: the cell of the crossing changes by a part of `share`, all cells after it by `share`.
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

/// Adds the crossings of an edge with all lines from its upper end to its lower end, without the last one, so that each
/// ring crosses each line an even number of times. Line k lies at k + 1/2 lines from the top. The ice is to the right
/// of an edge that runs down.
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

/// Converts each vertex into columns from the left edge and lines from the top, and adds the edges.
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

void add_floes(const World& world, const geometry::Pose& world_from_ship, const ImageFrame& frame, CoverImage& image) {
  const Population& population = world.population;
  const dynamics::Bodies& bodies = population.bodies;
  const geometry::Vector drift = drift_at(world.setup, world.clock.time());
  const geometry::Point middle = transform(world_from_ship, {frame.ahead, 0}) - drift;  // water frame
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    const auto body = static_cast<std::size_t>(population.body_of(id));
    if (!population.is_floating(id)) continue;
    const geometry::Vector away = bodies.position[body] - middle;
    if (elementary::hypot(away.x, away.y) > frame.radius() + bodies.bounding_radius[body]) continue;
    geometry::Pose world_from_body = dynamics::water_from_body(bodies, population.body_of(id));
    world_from_body.position += drift;
    image.add(population.floes[static_cast<std::size_t>(id)].shape.polygon,
              relative_pose(world_from_ship, world_from_body));
  }
}

double cover_ahead(const World& world, int ship) {
  const geometry::Box hull = bounding_box(hull_of(world.setup.scene, static_cast<std::size_t>(ship)).hull.waterline);
  const double length = hull.high.x - hull.low.x, beam = hull.high.y - hull.low.y;
  constexpr double kAcross = 8;  ///< number of cells across the beam; each line of a cell is exact, so few are enough
  ImageFrame frame;
  frame.cell = beam / kAcross;
  frame.columns = static_cast<std::size_t>(kAcross);
  frame.rows = static_cast<std::size_t>(std::max(1.0, std::round(length / frame.cell)));
  frame.ahead = hull.high.x + 0.5 * frame.cell * static_cast<double>(frame.rows);
  CoverImage image(frame);
  geometry::Pose world_from_ship = dynamics::water_from_body(world.population.bodies, ship);
  world_from_ship.position += drift_at(world.setup, world.clock.time());
  add_floes(world, world_from_ship, frame, image);
  std::vector<float> cells(frame.rows * frame.columns);
  image.write(cells.data());
  double sum = 0;
  for (const float cell : cells) sum += cell;
  return sum / static_cast<double>(cells.size());
}

}  // namespace polynya::simulation
