#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// A stretch of a ring: vertices that follow each other, around a ring of the parent or of the new ones.
struct ShapePart {
  static constexpr std::int32_t kNew = -1;
  std::int32_t ring = kNew;  ///< of the parent, 0 the outer one, then its holes; kNew: of ShapeParts::vertices
  std::uint32_t first = 0;   ///< vertex
  std::uint32_t count = 0;   ///< of vertices; around a ring they continue from its last to its first
};

/// A floe's shape as floes.ndjson has it (docs/run-folder.md): what it has of the floe that it broke from,
/// and what is new. A fracture adds a few vertices to a boundary of any length.
struct ShapeParts {
  std::vector<ShapePart> parts;          ///< of the outer ring, then of each hole
  std::vector<std::uint32_t> ring_ends;  ///< one past the last part of each ring
  geometry::Ring vertices;               ///< the new ones [m]

  /// Whether anything in it is of a parent.
  bool has_parent() const;
};

ShapeParts whole(const geometry::Polygon& shape);

/// The shape by its parent's vertices, none of them twice: whole where that takes no more entries. Vertices
/// are the same where their coordinates are.
ShapeParts parts_of(const geometry::Polygon& shape, const geometry::Polygon& parent);

/// How many vertices each ring has.
std::vector<std::size_t> ring_sizes(const ShapeParts& shape);
std::vector<std::size_t> ring_sizes(const geometry::Polygon& polygon);

/// Throws ReadError where parts cannot be of a parent with rings of these sizes.
void check_parts(const ShapeParts& shape, const std::vector<std::size_t>& parent_ring_sizes);

/// The shape itself, to the bit. `parent` is not used by parts that are all new. Needs parts without fault.
geometry::Polygon assembled(const ShapeParts& shape, const geometry::Polygon& parent);

/// Adds the members of a line of floes.ndjson that hold the shape.
void append_shape(JsonWriter& json, const ShapeParts& shape);

/// A point of a JSON line, [x, y], and the shape of a line of floes.ndjson. Throw ReadError where it is none.
geometry::Point point_of(const JsonValue& value);
ShapeParts read_shape(const JsonValue& line);

}  // namespace polynya::io
