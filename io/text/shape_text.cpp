#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "io/text/shape_parts.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using JsonKind = JsonValue::Kind;

constexpr std::string_view kRing = "ring_m";
constexpr std::string_view kHoles = "holes_m";
constexpr std::string_view kRingParts = "ring_parts_m";
constexpr std::string_view kHoleParts = "hole_parts_m";
constexpr double kMostVertices = 4e9;

/// Ends the reading of a shape.
struct NoShape : std::runtime_error {
  using std::runtime_error::runtime_error;
};

const JsonValue::Array& list(const JsonValue& value, std::string_view expected) {
  if (!value.is(JsonKind::kArray))
    throw NoShape(fmt::format("{} where {} is expected", name_of(value.kind()), expected));
  return value.items();
}

const JsonValue& member(const JsonValue& line, std::string_view key) {
  const JsonValue* found = line.find(key);
  if (!found) throw NoShape(fmt::format("\"{}\" is missing", key));
  return *found;
}

double number(const JsonValue& value, std::string_view expected) {
  if (!value.is(JsonKind::kNumber))
    throw NoShape(fmt::format("{} where {} is expected", name_of(value.kind()), expected));
  return value.number();
}

Point point(const JsonValue& value) {
  const JsonValue::Array& items = list(value, "[x, y]");
  if (items.size() != 2) throw NoShape(fmt::format("{} numbers where [x, y] is expected", items.size()));
  return {number(items[0], "a coordinate"), number(items[1], "a coordinate")};
}

std::uint32_t whole_number(const JsonValue& value) {
  constexpr std::string_view kExpected = "[ring, first vertex, vertices]";
  const double n = number(value, kExpected);
  if (!(n >= 0 && n < kMostVertices && n == std::floor(n)))
    throw NoShape(fmt::format("{} where {} is expected", n, kExpected));
  return static_cast<std::uint32_t>(n);
}

class ShapeReader {
 public:
  ShapeParts read(const JsonValue& line) {
    const bool has_parts = line.find(kRingParts) != nullptr;
    const auto read_ring = [&](const JsonValue& ring) { has_parts ? read_parts(ring) : read_points(ring); };
    read_ring(member(line, has_parts ? kRingParts : kRing));
    for (const JsonValue& hole : list(member(line, has_parts ? kHoleParts : kHoles), "a list of holes"))
      read_ring(hole);
    const std::vector<std::size_t> sizes = ring_sizes(shape_);
    for (std::size_t ring = 0; ring < sizes.size(); ++ring) {
      if (sizes[ring] < 3) throw NoShape(fmt::format("ring {} has {} vertices; it takes 3 or more", ring, sizes[ring]));
    }
    return std::move(shape_);
  }

 private:
  void read_points(const JsonValue& ring) {
    add_new(list(ring, "a ring, a list of [x, y]"));
    shape_.ring_ends.push_back(static_cast<std::uint32_t>(shape_.parts.size()));
  }

  void read_parts(const JsonValue& ring) {
    for (const JsonValue& part : list(ring, "a list of parts of a ring")) {
      const JsonValue::Array& items = list(part, "a part of a ring");
      if (items.empty()) throw NoShape("a part of a ring with nothing in it");
      if (items.front().is(JsonKind::kArray)) {
        add_new(items);
        continue;
      }
      if (items.size() != 3)
        throw NoShape(fmt::format("{} numbers where [ring, first vertex, vertices] is expected", items.size()));
      const std::uint32_t of = whole_number(items[0]);
      if (of > static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()))
        throw NoShape(fmt::format("ring {} of a parent", of));
      shape_.parts.push_back({static_cast<std::int32_t>(of), whole_number(items[1]), whole_number(items[2])});
    }
    shape_.ring_ends.push_back(static_cast<std::uint32_t>(shape_.parts.size()));
  }

  void add_new(const JsonValue::Array& points) {
    shape_.parts.push_back({ShapePart::kNew, static_cast<std::uint32_t>(shape_.vertices.size()),
                            static_cast<std::uint32_t>(points.size())});
    for (const JsonValue& item : points) shape_.vertices.push_back(point(item));
  }

  ShapeParts shape_;
};

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

Result<ShapeParts> read_shape(const JsonValue& line) {
  try {
    return ShapeReader().read(line);
  } catch (const NoShape& wrong) {
    return fail(std::string(wrong.what()));
  }
}

}  // namespace polynya::io
