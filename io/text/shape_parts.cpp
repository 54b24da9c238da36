#include "io/text/shape_parts.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using JsonKind = JsonValue::Kind;

std::vector<const Ring*> rings_in(const Polygon& polygon) {
  std::vector<const Ring*> rings{&polygon.outer};
  for (const Ring& hole : polygon.holes) rings.push_back(&hole);
  return rings;
}

/// Finds stretches of a ring in the rings of another shape. Each vertex of that shape is used once.
class StretchFinder {
 public:
  explicit StretchFinder(const Polygon& parent) : rings_(rings_in(parent)) {
    for (const Ring* ring : rings_) {
      first_.push_back(points_.size());
      points_.insert(points_.end(), ring->begin(), ring->end());
    }
    is_taken_.resize(points_.size());
    same_hash_.resize(points_.size());
    by_hash_.resize(std::bit_ceil(points_.size() + 1), kNone);
    for (auto i = static_cast<std::uint32_t>(points_.size()); i-- > 0;)  // backwards, so that each list ascends
      same_hash_[i] = std::exchange(by_hash_[bucket_of(points_[i])], i);
  }

  /// Finds the longest stretch of unused vertices in the parent that equals the ring from its vertex `from` on, and
  /// marks it as used. Returns a part of 0 vertices if the parent has no such vertex left.
  ShapePart take(const Ring& ring, std::size_t from) {
    ShapePart best;
    for (std::uint32_t i = by_hash_[bucket_of(ring[from])]; i != kNone; i = same_hash_[i]) {
      if (!(points_[i] == ring[from])) continue;
      const ShapePart found = stretch(ring, from, i);
      if (found.count > best.count) best = found;
    }
    for (std::uint32_t k = 0; k < best.count; ++k) is_taken_[place(best, k)] = 1;
    return best;
  }

 private:
  static constexpr std::uint32_t kNone = UINT32_MAX;

  std::size_t bucket_of(Point p) const {
    // adding 0.0 makes +0 and −0 equal
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    const std::uint64_t mixed = (bits(p.x) * 0x9e3779b97f4a7c15U + bits(p.y)) * 0xbf58476d1ce4e5b9U;
    return (mixed ^ (mixed >> 32U)) >> 8U & (by_hash_.size() - 1);
  }

  std::size_t place(const ShapePart& part, std::size_t k) const {
    const auto ring = static_cast<std::size_t>(part.ring);
    return first_[ring] + (part.first + k) % rings_[ring]->size();
  }

  ShapePart stretch(const Ring& ring, std::size_t from, std::uint32_t vertex) const {
    const auto next = std::ranges::upper_bound(first_, vertex);  // a ring has at least one vertex
    const auto index = static_cast<std::size_t>(next - first_.begin()) - 1;
    ShapePart part{static_cast<std::int32_t>(index), static_cast<std::uint32_t>(vertex - first_[index]), 0};
    const std::size_t most = std::min(ring.size() - from, rings_[index]->size());
    std::size_t at = vertex;
    const std::size_t end = first_[index] + rings_[index]->size();
    while (part.count < most && is_taken_[at] == 0 && points_[at] == ring[from + part.count]) {
      ++part.count;
      if (++at == end) at = first_[index];
    }
    return part;
  }

  std::vector<const Ring*> rings_;
  std::vector<std::size_t> first_;  ///< index of each ring's first vertex in points_
  std::vector<Point> points_;       ///< vertices of all rings
  std::vector<std::uint8_t> is_taken_;
  std::vector<std::uint32_t> by_hash_;    ///< first index in points_ with this hash
  std::vector<std::uint32_t> same_hash_;  ///< next index with the same hash, for each of points_
};

void append_new(ShapeParts& shape, const Ring& ring, std::size_t from, std::size_t count) {
  shape.parts.push_back(
      {ShapePart::kNew, static_cast<std::uint32_t>(shape.vertices.size()), static_cast<std::uint32_t>(count)});
  const auto first = ring.begin() + static_cast<std::ptrdiff_t>(from);
  shape.vertices.insert(shape.vertices.end(), first, first + static_cast<std::ptrdiff_t>(count));
}

void close_ring(ShapeParts& shape) {
  shape.ring_ends.push_back(static_cast<std::uint32_t>(shape.parts.size()));
}

template <class Use>
void for_parts(const ShapeParts& shape, Use use) {
  std::size_t part = 0;
  for (std::size_t ring = 0; ring < shape.ring_ends.size(); ++ring) {
    for (; part < shape.ring_ends[ring]; ++part) use(ring, shape.parts[part]);
  }
}

}  // namespace

bool ShapeParts::has_parent() const {
  return std::ranges::any_of(parts, [](const ShapePart& part) { return part.ring != ShapePart::kNew; });
}

ShapeParts whole(const Polygon& polygon) {
  ShapeParts shape;
  for (const Ring* ring : rings_in(polygon)) {
    append_new(shape, *ring, 0, ring->size());
    close_ring(shape);
  }
  return shape;
}

ShapeParts parts_of(const Polygon& polygon, const Polygon& parent) {
  StretchFinder finder(parent);
  ShapeParts shape;
  std::size_t stretches = 0;
  for (const Ring* ring : rings_in(polygon)) {
    std::size_t fresh = 0;  // number of new vertices before `at` that are not yet written
    for (std::size_t at = 0; at < ring->size();) {
      const ShapePart found = finder.take(*ring, at);
      if (found.count == 0) {
        ++fresh;
        ++at;
        continue;
      }
      if (fresh > 0) append_new(shape, *ring, at - fresh, fresh);
      fresh = 0;
      shape.parts.push_back(found);
      ++stretches;
      at += found.count;
    }
    if (fresh > 0) append_new(shape, *ring, ring->size() - fresh, fresh);
    close_ring(shape);
  }
  const bool is_shorter = stretches + shape.vertices.size() < vertex_count(polygon);
  return is_shorter ? shape : whole(polygon);
}

std::vector<std::size_t> ring_sizes(const ShapeParts& shape) {
  std::vector<std::size_t> sizes(shape.ring_ends.size());
  for_parts(shape, [&](std::size_t ring, const ShapePart& part) { sizes[ring] += part.count; });
  return sizes;
}

std::vector<std::size_t> ring_sizes(const geometry::Polygon& polygon) {
  std::vector<std::size_t> sizes{polygon.outer.size()};
  for (const geometry::Ring& hole : polygon.holes) sizes.push_back(hole.size());
  return sizes;
}

void check_parts(const ShapeParts& shape, const std::vector<std::size_t>& parent_ring_sizes) {
  const std::size_t most = std::accumulate(parent_ring_sizes.begin(), parent_ring_sizes.end(), std::size_t{0});
  std::size_t taken = 0;
  for (const ShapePart& part : shape.parts) {
    if (part.ring == ShapePart::kNew) continue;
    const auto ring = static_cast<std::size_t>(part.ring);
    if (ring >= parent_ring_sizes.size())
      throw ReadError(fmt::format("ring {} of a parent that has {}", ring, parent_ring_sizes.size()));
    const std::size_t size = parent_ring_sizes[ring];
    if (part.first >= size || part.count > size)
      throw ReadError(fmt::format("{} vertices from vertex {} of the parent's ring {}, which has {}", part.count,
                                  part.first, ring, size));
    taken += part.count;
  }
  if (taken > most) throw ReadError(fmt::format("{} vertices of a parent that has {}", taken, most));
}

Polygon assembled(const ShapeParts& shape, const Polygon& parent) {
  const std::vector<const Ring*> from = rings_in(parent);
  const std::vector<std::size_t> sizes = ring_sizes(shape);
  Polygon polygon;
  polygon.holes.resize(sizes.size() - 1);
  for_parts(shape, [&](std::size_t ring, const ShapePart& part) {
    Ring& to = ring == 0 ? polygon.outer : polygon.holes[ring - 1];
    if (to.empty()) to.reserve(sizes[ring]);
    const Ring& of = part.ring == ShapePart::kNew ? shape.vertices : *from[static_cast<std::size_t>(part.ring)];
    const auto first = of.begin() + part.first;
    const auto before_end = std::min<std::ptrdiff_t>(part.count, of.end() - first);
    to.insert(to.end(), first, first + before_end);
    to.insert(to.end(), of.begin(), of.begin() + (part.count - before_end));
  });
  return polygon;
}

namespace {

constexpr std::string_view kRing = "ring_m";
constexpr std::string_view kHoles = "holes_m";
constexpr std::string_view kRingParts = "ring_parts_m";
constexpr std::string_view kHoleParts = "hole_parts_m";
constexpr double kMostVertices = 4e9;  ///< larger numbers of vertices are refused, since they do not fit into 32 bits

const JsonValue::Array& list(const JsonValue& value, std::string_view expected) {
  if (!value.is(JsonKind::kArray))
    throw ReadError(fmt::format("{} where {} is expected", name_of(value.kind()), expected));
  return value.items();
}

double number_of(const JsonValue& value, std::string_view expected) {
  if (!value.is(JsonKind::kNumber))
    throw ReadError(fmt::format("{} where {} is expected", name_of(value.kind()), expected));
  return value.number();
}

std::uint32_t whole_number(const JsonValue& value) {
  constexpr std::string_view kExpected = "[ring, first vertex, vertices]";
  const double n = number_of(value, kExpected);
  if (!(n >= 0 && n < kMostVertices && n == std::floor(n)))
    throw ReadError(fmt::format("{} where {} is expected", n, kExpected));
  return static_cast<std::uint32_t>(n);
}

/// Appends new vertices to the current ring.
void add_points(ShapeParts& shape, const JsonValue::Array& points) {
  Ring ring;
  for (const JsonValue& item : points) ring.push_back(point_of(item));
  append_new(shape, ring, 0, ring.size());
}

/// Appends stretches of the parent's ring and the new vertices between them.
void add_parts(ShapeParts& shape, const JsonValue::Array& parts) {
  for (const JsonValue& part : parts) {
    const JsonValue::Array& items = list(part, "a part of a ring");
    if (items.empty()) throw ReadError("a part of a ring with nothing in it");
    if (items.front().is(JsonKind::kArray)) {
      add_points(shape, items);
      continue;
    }
    if (items.size() != 3)
      throw ReadError(fmt::format("{} numbers where [ring, first vertex, vertices] is expected", items.size()));
    const std::uint32_t of = whole_number(items[0]);
    if (of > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()))
      throw ReadError(fmt::format("ring {} of a parent", of));
    shape.parts.push_back({static_cast<std::int32_t>(of), whole_number(items[1]), whole_number(items[2])});
  }
}

void append_part(JsonWriter& json, const ShapeParts& shape, const ShapePart& part, bool is_listed) {
  if (part.ring != ShapePart::kNew) {
    json.open('[').value(part.ring).value(part.first).value(part.count).close(']');
    return;
  }
  if (is_listed) json.open('[');
  for (std::uint32_t k = 0; k < part.count; ++k) json.value(shape.vertices[part.first + k]);
  if (is_listed) json.close(']');
}

}  // namespace

void append_shape(JsonWriter& json, const ShapeParts& shape) {
  const bool has_parts = shape.has_parent();
  json.key(has_parts ? kRingParts : kRing);
  std::size_t part = 0;
  for (std::size_t ring = 0; ring < shape.ring_ends.size(); ++ring) {
    if (ring == 1) json.key(has_parts ? kHoleParts : kHoles).open('[');
    json.open('[');
    for (; part < shape.ring_ends[ring]; ++part) append_part(json, shape, shape.parts[part], has_parts);
    json.close(']');
  }
  if (shape.ring_ends.size() < 2) json.key(has_parts ? kHoleParts : kHoles).open('[');
  json.close(']');
}

Point point_of(const JsonValue& value) {
  const JsonValue::Array& items = list(value, "[x, y]");
  if (items.size() != 2) throw ReadError(fmt::format("{} numbers where [x, y] is expected", items.size()));
  return {number_of(items[0], "a coordinate"), number_of(items[1], "a coordinate")};
}

ShapeParts read_shape(const JsonValue& line) {
  const bool has_parts = line.find(kRingParts) != nullptr;
  ShapeParts shape;
  const auto read_ring = [&](const JsonValue& ring) {
    if (has_parts)
      add_parts(shape, list(ring, "a list of parts of a ring"));
    else
      add_points(shape, list(ring, "a ring, a list of [x, y]"));
    close_ring(shape);
  };
  read_ring(json_member(line, has_parts ? kRingParts : kRing));
  for (const JsonValue& hole : list(json_member(line, has_parts ? kHoleParts : kHoles), "a list of holes"))
    read_ring(hole);
  const std::vector<std::size_t> sizes = ring_sizes(shape);
  for (std::size_t ring = 0; ring < sizes.size(); ++ring)
    if (sizes[ring] < 3) throw ReadError(fmt::format("ring {} has {} vertices; it takes 3 or more", ring, sizes[ring]));
  return shape;
}

}  // namespace polynya::io
