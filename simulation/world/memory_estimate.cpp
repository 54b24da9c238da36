#include "simulation/world/memory_estimate.hpp"

#include <algorithm>
#include <memory>

#include "geometry/contact/near_boundaries.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {
namespace {

using geometry::Polygon;
using geometry::Ring;

/// Returns the size of a heap block for a number of bytes [bytes]: with the allocator's header, and 0 for none.
double block(double bytes) {
  constexpr double kHeader = 8;  // header that glibc's allocator adds to a block [bytes]
  return bytes > 0 ? bytes + kHeader : 0;
}

/// Returns the number of vertices of a polygon, holes included.
double vertices_of(const Polygon& polygon) {
  auto count = static_cast<double>(polygon.outer.size());
  for (const Ring& hole : polygon.holes) count += static_cast<double>(hole.size());
  return count;
}

/// Returns the heap memory of a polygon's rings [bytes].
double heap_of(const Polygon& polygon) {
  return block(sizeof(geometry::Point) * vertices_of(polygon)) +
         block(sizeof(Ring) * static_cast<double>(polygon.holes.size()));
}

/// Memory of one body in the columns of dynamics::Bodies [bytes]: 12 single numbers, 4 pairs of numbers (position,
/// centroid, velocity and rotation), of which two are written as numbers here, the drag span, 3 values of one byte, and
/// the pointers to its boundary and its drag shape. If a column is added there, this sum must be changed too; no
/// assertion compares them.
constexpr double kColumns = 16 * sizeof(double) + 2 * sizeof(geometry::Vector) + sizeof(dynamics::DragSpan) + 3 +
                            2 * sizeof(std::shared_ptr<geometry::Boundary>);

/// Returns the memory of a floe at rest [bytes]: the floe's specification in the caller's scene and in the world's
/// copy, the floe itself, its birth in the journal, its body and its outline for the contact search. Three polygons
/// count: those of the caller's specification, of the birth, and of the floe, which takes over the polygon of the
/// world's copy. The outline has its points and two lists of one 32-bit integer for each vertex.
double at_rest(const FloeSpec& floe) {
  const Polygon& polygon = floe.polygon_in_world;
  const double vertices = vertices_of(polygon);
  const double copies = 2 * sizeof(FloeSpec) + sizeof(Floe) + sizeof(Birth) + 3 * heap_of(polygon);
  const double outline = block(sizeof(geometry::Boundary)) + block(sizeof(geometry::Point) * vertices) +
                         2 * block(sizeof(std::uint32_t) * vertices);
  return copies + outline + kColumns;
}

/// Returns the additional memory of a floe that moves [bytes]: its drag shape and its pairs with neighbours. Each pair
/// stores edges that are near each other, and belongs half to either floe.
double moving() {
  constexpr double kPairs = 4;                  // pairs per floe: half of eight neighbours, an assumption
  constexpr double kNearEdges = 4;              // number of near edges of a pair that touches
  constexpr double kEnds = 8 * sizeof(double);  // coordinates of the ends of two near edges [bytes]
  const double near =
      block(sizeof(dynamics::NearParts)) + block(kNearEdges * sizeof(geometry::NearPair)) + block(kNearEdges * kEnds);
  return block(sizeof(dynamics::DragShape)) + kPairs * (sizeof(dynamics::Pair) + near);
}

/// Memory of the covers of boundaries, which the contact search keeps from one step to the next. A cover divides a
/// boundary into pieces; their number is estimated as one for each circle radius of the perimeter, as the contact
/// search does when it decides which covers to keep (pieces_of in geometry/contact/boundary.hpp). Covers of edges
/// longer than 128 radii have fewer pieces unless they have contact circles, so the estimate is then too large. Two
/// floes with at most kFewEdges edges together need no cover unless the scene uses contact circles. The estimate
/// therefore leaves out floes with at most half of that, also where they lie beside a plate with many edges and get a
/// cover. Covers with many pieces, and all covers of scenes with contact circles, are always kept; others up to
/// ContactRule::most_kept_pieces in total.
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
    constexpr double kNodes = 0.8;  // approximate number of nodes of a cover's search tree per piece
    constexpr double kPiece =
        sizeof(geometry::PieceEdges) + sizeof(geometry::BoundingCircle) + kNodes * sizeof(geometry::CircleNode);
    const double room = std::max(0.0, dynamics::ContactRule{}.most_kept_pieces - always_);
    return (kPiece + (has_circles_ ? sizeof(geometry::ContactCircle) : 0)) * (always_ + std::min(others_, room));
  }

 private:
  double radius_;
  bool has_circles_;
  /// Numbers of pieces: in covers that are always kept, and in others, which are kept up to most_kept_pieces.
  double always_ = 0, others_ = 0;
};

/// Factor for further pairs, contacts and unused heap memory in MemoryEstimate::all_moving [-], measured with drifting
/// lattices of floes (tests/app/run_command_test.cpp). With a larger value, a note warns of runs that would fit; with a
/// smaller one, some runs that do not fit begin without a note. MemoryEstimate::at_start has no such factor: it must be
/// a lower bound, because a run that exceeds it is refused.
constexpr double kOverheadFactor = 1.2;

}  // namespace

// In at_start, only floes that move at the start have a drag shape. Floes that wind sets in motion later are left out,
// so at_start remains a lower bound. Covers and pairs count only in all_moving. Both leave out hulls and all other data
// that do not grow with the floes.
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
    estimate.all_moving += kOverheadFactor * (rest + moving());
    covers.add(floe.polygon_in_world);
  }
  estimate.all_moving += covers.bytes();
  return estimate;
}

}  // namespace polynya::simulation
