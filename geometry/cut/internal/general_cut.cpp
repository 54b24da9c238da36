#include "geometry/cut/internal/general_cut.hpp"

#include <algorithm>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/guarded.hpp"
#include "geometry/cut/internal/rounded_pieces.hpp"

namespace polynya::geometry {
namespace {

using exact::Winding;

CutOutcome round_regions(const exact::Polygon& shape, std::vector<exact::Region> regions) {
  std::vector<exact::ExactPiece> pieces;
  pieces.reserve(regions.size());
  for (exact::Region& region : regions) {
    pieces.push_back({std::move(region.polygon), region.label == 1 ? Part::kInside : Part::kOutside});
  }
  return exact::rounded_pieces(exact::area(shape), pieces);
}

}  // namespace

CutOutcome cut_by_polygons_generally(const exact::Polygon& shape, const std::vector<Polygon>& tools_in_body) {
  return guarded([&]() -> CutOutcome {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, shape, 0);
    for (const Polygon& tool : tools_in_body) append_segments(segments, exact::exactly(tool), 1);
    const auto classify = [](Winding w) { return w.shape <= 0 ? -1 : (w.tool > 0 ? 1 : 0); };
    exact::Overlay overlay = exact::overlay(segments, classify, exact::Seams::kDissolve);
    if (std::ranges::none_of(overlay.regions, [](auto& r) { return r.label == 1; }))
      return refuse(CutFailure::kMisses, "the polygon does not meet the shape's interior");
    return round_regions(shape, std::move(overlay.regions));
  });
}

CutOutcome cut_along_generally(const exact::Polygon& shape, const std::vector<Point>& polyline_in_body) {
  return guarded([&]() -> CutOutcome {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, shape, 0);
    for (std::size_t i = 1; i < polyline_in_body.size(); ++i) {
      const Point from = polyline_in_body[i - 1];
      const Point to = polyline_in_body[i];
      if (from != to) segments.push_back({exact::exactly(from), exact::exactly(to), 1});
    }
    const auto classify = [](Winding w) { return w.shape <= 0 ? -1 : 0; };
    exact::Overlay overlay = exact::overlay(segments, classify, exact::Seams::kKeep);
    if (!overlay.tool_meets_interior)
      return refuse(CutFailure::kMisses, "the crack does not meet the shape's interior");
    if (overlay.regions.size() < 2) {
      return tl::unexpected(CutError{CutFailure::kDoesNotSeparate,
                                     "the crack ends inside the ice or only bridges its holes",
                                     overlay.dangling_length});
    }
    CutOutcome outcome = round_regions(shape, std::move(overlay.regions));
    if (outcome) outcome->ledger.dangling_length = overlay.dangling_length;
    return outcome;
  });
}

}  // namespace polynya::geometry
