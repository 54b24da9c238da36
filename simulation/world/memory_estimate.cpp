#include "simulation/world/memory_estimate.hpp"

#include <algorithm>

#include "geometry/contact/boundary.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {
namespace {

using geometry::Polygon;
using geometry::Ring;

/// Size of a heap block [bytes].
double block(double bytes) {
  constexpr double kHeader = 8;  // of glibc's allocator
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

/// A body's share of the columns of dynamics::Bodies.
constexpr double kColumns = 16 * sizeof(double) + 2 * sizeof(geometry::Vector) + sizeof(dynamics::DragSpan) + 3;

/// A floe in the scene and in the world's copy of it, whose polygon becomes the floe's, the floe, its birth
/// in the journal and its outline.
double at_rest(const FloeSpec& floe) {
  const Polygon& polygon = floe.polygon_in_world;
  const double vertices = vertices_of(polygon);
  const double copies = 2 * sizeof(FloeSpec) + sizeof(Floe) + sizeof(Birth) + 3 * heap_of(polygon);
  const double outline = block(sizeof(geometry::Boundary)) + block(sizeof(geometry::Point) * vertices) +
                         2 * block(sizeof(std::uint32_t) * vertices);
  return copies + outline + kColumns;
}

/// What a floe that moves has beside: its drag, and half of the pairs with its neighbours, of which each
/// knows some edges that are near each other.
double moving() {
  constexpr double kPairs = 4;      // half of a floe's eight neighbours
  constexpr double kNearEdges = 4;  // of a pair that touches
  constexpr double kEnds = 8 * sizeof(double);
  const double near =
      block(sizeof(dynamics::NearParts)) + block(kNearEdges * sizeof(geometry::NearPair)) + block(kNearEdges * kEnds);
  return block(sizeof(dynamics::DragShape)) + kPairs * (sizeof(dynamics::Pair) + near);
}

/// The covers of boundaries that are kept, one piece for each contact circle. Floes of few edges have none;
/// that those beside a plate of many have one is left out.
class KeptCovers {
 public:
  explicit KeptCovers(const ContactSettings& contact)
      : radius_(contact.circle_radius), has_circles_(contact.normal == ContactNormal::kCircleCentres) {}

  void add(const Polygon& polygon) {
    if (!has_circles_ && vertices_of(polygon) <= geometry::kFewEdges / 2.0) return;
    const double pieces = std::max(1.0, geometry::perimeter(polygon) / radius_);
    (pieces > dynamics::kManyPieces || has_circles_ ? always_ : others_) += pieces;
  }

  double bytes() const {
    constexpr double kNodes = 0.8;  // of the tree, a piece
    constexpr double kPiece =
        sizeof(geometry::PieceEdges) + sizeof(geometry::BoundingCircle) + kNodes * sizeof(geometry::CircleNode);
    const double room = std::max(0.0, dynamics::ContactRule{}.most_kept_pieces - always_);
    return (kPiece + (has_circles_ ? sizeof(geometry::ContactCircle) : 0)) * (always_ + std::min(others_, room));
  }

 private:
  double radius_;
  bool has_circles_;
  double always_ = 0, others_ = 0;  ///< pieces
};

/// Factor for pairs, contacts and the heap's unused part: measured on drifting lattices
/// (tests/app/run_command_test.cpp).
constexpr double kBesides = 1.2;

}  // namespace

MemoryEstimate estimate_memory(const Scene& scene) {
  MemoryEstimate estimate;
  const double drag = block(sizeof(dynamics::DragShape));
  const double own_ice = 2 * sizeof(fracture::Ice) * static_cast<double>(scene.own_ice.size());
  estimate.at_start = estimate.all_moving = own_ice;
  KeptCovers covers(scene.contact);
  for (const FloeSpec& floe : scene.floes) {
    const bool is_moving =
        floe.velocity != geometry::Vector{} || floe.angular_velocity != 0 || scene.water.shear.rate != 0;
    const double rest = at_rest(floe);
    estimate.at_start += rest + (is_moving ? drag : 0);
    estimate.all_moving += kBesides * (rest + moving());
    covers.add(floe.polygon_in_world);
  }
  estimate.all_moving += covers.bytes();
  return estimate;
}

}  // namespace polynya::simulation
