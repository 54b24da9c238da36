#include "simulation/memory_estimate.hpp"

#include <algorithm>

#include "geometry/contact/boundary.hpp"
#include "simulation/world.hpp"

namespace polynya::simulation {
namespace {

using geometry::Polygon;
using geometry::Ring;

/// Size of a heap block [bytes].
double block(double bytes) {
  constexpr double kHeader = 8;
  return bytes > 0 ? bytes + kHeader : 0;
}

double vertices_of(const Polygon& polygon) {
  auto count = static_cast<double>(polygon.outer.size());
  for (const Ring& hole : polygon.holes) count += static_cast<double>(hole.size());
  return count;
}

/// Of a polygon's rings [bytes].
double heap_of(const Polygon& polygon) {
  return block(sizeof(geometry::Point) * vertices_of(polygon)) +
         block(sizeof(Ring) * static_cast<double>(polygon.holes.size()));
}

double length_of(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) sum += distance(ring[i], ring[(i + 1) % ring.size()]);
  return sum;
}

/// A body's share of the columns of dynamics::Bodies.
constexpr double kColumns =
    16 * sizeof(double) + 2 * sizeof(geometry::Vector) + sizeof(dynamics::DragSpan) + 3;

/// A floe as the scene, its copy in the world, the floe, its birth in the journal and its outline.
double at_rest(const FloeSpec& floe) {
  const Polygon& polygon = floe.polygon_in_world;
  const double vertices = vertices_of(polygon);
  const double copies = 2 * sizeof(FloeSpec) + sizeof(Floe) + sizeof(Birth) + 4 * heap_of(polygon);
  const double outline = block(sizeof(geometry::Boundary)) + block(sizeof(geometry::Point) * vertices) +
                         2 * block(sizeof(std::uint32_t) * vertices);
  return copies + outline + kColumns;
}

/// Its pieces, one for each contact circle, with their covers and the tree over them.
double contact_circles(const Polygon& polygon, const ContactSettings& contact) {
  constexpr double kPiece =
      sizeof(geometry::BoundaryPiece) + sizeof(geometry::BoundingCircle) + sizeof(geometry::CircleNode);
  const double own = contact.normal == ContactNormal::kCircleCentres ? sizeof(geometry::ContactCircle) : 0;
  double length = length_of(polygon.outer);
  for (const Ring& hole : polygon.holes) length += length_of(hole);
  return (kPiece + own) * std::max(1.0, length / contact.circle_radius);
}

/// Factor for pairs, contacts and the heap's unused part: measured on drifting lattices
/// (tests/app/memory_test.cpp).
constexpr double kBesides = 1.8;

}  // namespace

MemoryEstimate estimate_memory(const Scene& scene) {
  MemoryEstimate estimate;
  const double drag = block(sizeof(dynamics::DragShape));
  const double own_ice = 2 * sizeof(fracture::Ice) * static_cast<double>(scene.own_ice.size());
  estimate.at_start = estimate.all_moving = own_ice;
  for (const FloeSpec& floe : scene.floes) {
    const bool is_moving =
        floe.velocity != geometry::Vector{} || floe.angular_velocity != 0 || scene.water.shear.rate != 0;
    const double rest = at_rest(floe);
    estimate.at_start += rest + (is_moving ? drag : 0);
    estimate.all_moving += kBesides * (rest + drag + contact_circles(floe.polygon_in_world, scene.contact));
  }
  return estimate;
}

}  // namespace polynya::simulation
