#include "io/run/floe_shapes.hpp"

#include <utility>

#include <fmt/format.h>

namespace polynya::io {

using geometry::Polygon;
using simulation::FloeId;

namespace {
constexpr std::size_t kMostKept = std::size_t{4} << 20;  ///< vertices of assembled shapes, 64 MB
}  // namespace

Result<> FloeShapes::add(ShapeParts shape, FloeId parent) {
  Floe floe;
  floe.ring_sizes = ring_sizes(shape);
  if (shape.has_parent()) {
    if (parent < 0 || static_cast<std::size_t>(parent) >= floes_.size())
      return fail("parts of a parent that is not on a line before");
    if (auto checked = check_parts(shape, floes_[static_cast<std::size_t>(parent)].ring_sizes); !checked)
      return checked;
    floe.parent = parent;
    floe.parts = std::move(shape);
  } else {
    floe.whole = std::make_shared<const Polygon>(assembled(shape, {}));
  }
  floes_.push_back(std::move(floe));
  return {};
}

const ShapeParts* FloeShapes::parts_of(FloeId id) const {
  return floe(id).whole ? nullptr : &floe(id).parts;
}

std::shared_ptr<const Polygon> FloeShapes::find(FloeId id) const {
  if (floe(id).whole) return floe(id).whole;
  const auto found = kept_.find(id);
  return found != kept_.end() ? found->second : nullptr;
}

void FloeShapes::keep(FloeId id, std::shared_ptr<const Polygon> shape) const {
  kept_vertices_ += vertex_count(*shape);
  kept_[id] = std::move(shape);
  oldest_kept_.push_back(id);
  while (kept_vertices_ > kMostKept && oldest_kept_.size() > 1) {
    const auto oldest = kept_.find(oldest_kept_.front());
    kept_vertices_ -= vertex_count(*oldest->second);
    kept_.erase(oldest);
    oldest_kept_.pop_front();
  }
}

std::shared_ptr<const Polygon> FloeShapes::of(FloeId id) const {
  std::vector<FloeId> missing;
  std::shared_ptr<const Polygon> shape = find(id);
  for (FloeId at = id; !shape; shape = find(at)) {
    missing.push_back(at);
    at = floe(at).parent;
  }
  for (auto next = missing.rbegin(); next != missing.rend(); ++next) {
    shape = std::make_shared<const Polygon>(assembled(floe(*next).parts, *shape));
    keep(*next, shape);
  }
  return shape;
}

}  // namespace polynya::io
