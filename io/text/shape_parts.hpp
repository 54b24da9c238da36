#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// Consecutive vertices of a ring, taken from a ring of the parent or from the new vertices.
struct ShapePart {
  static constexpr std::int32_t kNew = -1;
  /// Ring of the parent, 0 for the outer one, then its holes; kNew: the vertices are in ShapeParts::vertices.
  std::int32_t ring = kNew;
  std::uint32_t first = 0;  ///< index of the first vertex
  /// Number of vertices; in a ring of the parent they may continue from the last one to the first.
  std::uint32_t count = 0;
};

/// Shape of a floe as floes.ndjson stores it (docs/run-folder.md): references to vertices of the floe from which it
/// broke, and new vertices. This keeps the file small, since a fracture adds only a few vertices to a boundary of any
/// length.
struct ShapeParts {
  std::vector<ShapePart> parts;          ///< parts of the outer ring, then of each hole
  std::vector<std::uint32_t> ring_ends;  ///< index one past the last part of each ring
  geometry::Ring vertices;               ///< new vertices [m]

  /// Returns true if any part refers to a parent.
  bool has_parent() const;
};

/// Returns the shape with all vertices stored as new ones.
ShapeParts whole(const geometry::Polygon& shape);

/// Returns the shape with references to the parent's vertices, each used at most once. Vertices are equal if their
/// coordinates are. If that would take as many entries as the whole shape, the whole shape is returned.
ShapeParts parts_of(const geometry::Polygon& shape, const geometry::Polygon& parent);

/// Return the number of vertices of each ring.
std::vector<std::size_t> ring_sizes(const ShapeParts& shape);
std::vector<std::size_t> ring_sizes(const geometry::Polygon& polygon);

/// Throws ReadError if the parts cannot refer to a parent with rings of these sizes.
void check_parts(const ShapeParts& shape, const std::vector<std::size_t>& parent_ring_sizes);

/// Returns the shape, with the same bits. `parent` is not used if all vertices are new. Needs parts that check_parts
/// accepts.
geometry::Polygon assembled(const ShapeParts& shape, const geometry::Polygon& parent);

/// Writes the shape as members of a line of floes.ndjson.
void append_shape(JsonWriter& json, const ShapeParts& shape);

/// Read a point [x, y] of a JSON line, and the shape in a line of floes.ndjson. They throw ReadError if there is none.
geometry::Point point_of(const JsonValue& value);
ShapeParts read_shape(const JsonValue& line);

}  // namespace polynya::io
