#include <algorithm>
#include <cmath>

#include <polyclipping/clipper.hpp>

#include "bench/cut_cases.hpp"

// Clipper 6 computes in integers: a step of 2⁻²⁰ m.
namespace polynya::bench::clipper {
namespace {

constexpr double kScale = 1 << 20;

ClipperLib::Path to_clipper(const geometry::Ring& ring) {
  ClipperLib::Path path;
  path.reserve(ring.size());
  for (const geometry::Point p : ring) path.emplace_back(std::llround(p.x * kScale), std::llround(p.y * kScale));
  return path;
}

ClipperLib::Paths clip(ClipperLib::ClipType type, const ClipperLib::Path& subject, const ClipperLib::Path& tool) {
  ClipperLib::Clipper clipper;
  clipper.AddPath(subject, ClipperLib::ptSubject, true);
  clipper.AddPath(tool, ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  clipper.Execute(type, result);
  return result;
}

double area(const ClipperLib::Path& path) {
  return ClipperLib::Area(path) / (kScale * kScale);
}

}  // namespace

Result march(const March& march) {
  ClipperLib::Path plate = to_clipper(march.plate);
  for (const geometry::Ring& cusp : march.cusps) {
    ClipperLib::Paths left = clip(ClipperLib::ctDifference, plate, to_clipper(cusp));
    plate = *std::max_element(left.begin(), left.end(), [](auto& a, auto& b) { return a.size() < b.size(); });
  }
  return {area(plate), plate.size()};
}

Result split(const Split& split) {
  const ClipperLib::Path floe = to_clipper(split.floe);
  const ClipperLib::Path side = to_clipper(half_plane(split));
  Result result;
  for (const auto type : {ClipperLib::ctIntersection, ClipperLib::ctDifference}) {
    for (const ClipperLib::Path& path : clip(type, floe, side)) {
      result.area += area(path);
      result.vertices += path.size();
    }
  }
  return result;
}

}  // namespace polynya::bench::clipper
