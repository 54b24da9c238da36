#include "geometry/cut/internal/weld.hpp"

namespace polynya::geometry {
namespace {

Ring welded(const Ring& ring) {
  Ring kept;
  kept.reserve(ring.size());
  for (const Point p : ring) {
    if (!kept.empty() && kept.back() == p) continue;
    if (kept.size() > 1 && kept[kept.size() - 2] == p) {
      kept.pop_back();
      continue;
    }
    kept.push_back(p);
  }
  for (bool changed = true; changed && kept.size() > 1;) {
    changed = false;
    if (kept.front() == kept.back() || kept[kept.size() - 2] == kept.front()) {
      kept.pop_back();
      changed = true;
    } else if (kept[1] == kept.back()) {
      kept.erase(kept.begin());
      changed = true;
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

}  // namespace

Polygon welded(const Polygon& polygon) {
  Polygon result{welded(polygon.outer), {}};
  for (const Ring& hole : polygon.holes) {
    if (Ring kept = welded(hole); !kept.empty()) result.holes.push_back(std::move(kept));
  }
  return result;
}

}  // namespace polynya::geometry
