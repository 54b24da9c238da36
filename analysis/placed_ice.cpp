#include "analysis/placed_ice.hpp"

#include <utility>

#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::analysis {

using geometry::Polygon;

tl::expected<void, std::string> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth,
                                        Polygon polygon_in_world) {
  if (!find_defect(polygon_in_world)) {
    const geometry::Box box = bounding_box(polygon_in_world.outer);
    ice.push_back({birth, std::move(polygon_in_world), box});
    return {};
  }
  const auto repaired = geometry::repair(rings_of(polygon_in_world), geometry::FillRule::kNonZero);
  if (!repaired && repaired.error().reason == geometry::CutFailure::kMisses) return {};
  if (!repaired)
    return tl::unexpected(fmt::format("a placed floe is not a polygon: {}: {}", name_of(repaired.error().reason),
                                      repaired.error().detail));
  for (const geometry::Shape& shape : repaired->shapes)
    ice.push_back({birth, shape.polygon, bounding_box(shape.polygon.outer)});
  return {};
}

std::vector<Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box) {
  std::vector<Polygon> found;
  for (const PlacedIce& floe : ice) {
    if (overlaps(floe.box, box)) found.push_back(floe.polygon);
  }
  return found;
}

tl::expected<Parted, std::string> part(const Polygon& polygon, const std::vector<Polygon>& by) {
  if (by.empty()) return Parted{{}, {polygon}, 0};
  auto cut = geometry::cut_by_polygons({polygon}, by);
  if (!cut && cut.error().reason == geometry::CutFailure::kMisses) return Parted{{}, {polygon}, 0};
  if (!cut)
    return tl::unexpected(fmt::format("a cut was refused: {}: {}", name_of(cut.error().reason), cut.error().detail));
  Parted parted;
  parted.inside_area = cut->ledger.area_inside;
  for (geometry::Piece& piece : cut->pieces)
    (piece.part == geometry::Part::kInside ? parted.inside : parted.outside).push_back(std::move(piece.shape.polygon));
  return parted;
}

}  // namespace polynya::analysis
