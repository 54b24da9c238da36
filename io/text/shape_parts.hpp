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
  static constexpr std::int32_t kNew = -1;  ///< value of `ring` for new vertices; not written to files
  /// Ring of the parent, 0 for the outer one, then its holes; kNew: the vertices are in ShapeParts::vertices.
  std::int32_t ring = kNew;
  std::uint32_t first = 0;  ///< index of the first vertex in that ring or in ShapeParts::vertices
  /// Number of vertices. In a ring of the parent they may continue from its last vertex to its first one.
  std::uint32_t count = 0;
};

/// Shape of a floe as floes.ndjson stores it (docs/run-folder.md): references to vertices of the floe from which it
/// broke, and new vertices. This keeps the file small, since a fracture adds only a few vertices to a boundary of any
/// length.
struct ShapeParts {
  std::vector<ShapePart> parts;          ///< parts of the outer ring, then of each hole, in the order of their vertices
  std::vector<std::uint32_t> ring_ends;  ///< index in `parts` one past the last part of each ring, the outer one first
  geometry::Ring vertices;               ///< new vertices of all rings, in the floe's body frame [m]

  /// Returns true if any part refers to a parent, so that assembled() needs its shape.
  bool has_parent() const;
};

/// Returns the shape with all vertices stored as new ones, as for a floe without a parent.
ShapeParts whole(const geometry::Polygon& shape);

/// Returns the shape with references to vertices of the parent, each used at most once. Both shapes are in the same
/// body frame. A vertex is taken from the parent if their coordinates are equal (+0 and −0 are); a vertex that a cut
/// moved by any rounding is stored as new. If references would take as many entries in the file as the whole shape,
/// whole() is returned.
ShapeParts parts_of(const geometry::Polygon& shape, const geometry::Polygon& parent);

// Return the number of vertices of each ring, the outer one first.
std::vector<std::size_t> ring_sizes(const ShapeParts& shape);
std::vector<std::size_t> ring_sizes(const geometry::Polygon& polygon);

/// Checks parts that were read from a file. Throws ReadError if they cannot refer to a parent with rings of these
/// sizes, or if they use more vertices than it has, because a wrong file could then make shapes of any size. New
/// vertices are not checked: they are in the file itself.
void check_parts(const ShapeParts& shape, const std::vector<std::size_t>& parent_ring_sizes);

/// Returns the shape that was given to whole() or parts_of(), with exactly equal coordinates. `parent` is the parent's
/// shape; it is not used if all vertices are new. Needs parts that check_parts() accepts, because it does not check
/// indices. Whether the result is a valid polygon is not checked either.
geometry::Polygon assembled(const ShapeParts& shape, const geometry::Polygon& parent);

/// Writes the shape as members of a line of floes.ndjson: ring_m and holes_m if all vertices are new, otherwise
/// ring_parts_m and hole_parts_m. The object of the line must be open.
void append_shape(JsonWriter& json, const ShapeParts& shape);

/// Returns a point [x, y] of a JSON line, in the frame and unit of that line. Throws ReadError if the value is not a
/// list of two numbers.
geometry::Point point_of(const JsonValue& value);
/// Returns the shape in a line of floes.ndjson, which append_shape() wrote. Throws ReadError if there is none, or if a
/// ring has fewer than 3 vertices. If the line has both forms, ring_parts_m is read. Whether the shape fits its parent
/// is not checked (check_parts).
ShapeParts read_shape(const JsonValue& line);

}  // namespace polynya::io
