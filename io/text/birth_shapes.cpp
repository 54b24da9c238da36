#include "io/text/birth_shapes.hpp"

#include <cmath>

#include <fmt/format.h>

#include "io/text/shape_parts.hpp"

namespace polynya::io {
namespace {

/// Of one text: short lines can name a long boundary again and again.
constexpr std::size_t kMostAssembled = 20'000'000;  ///< vertices, 320 MB

}  // namespace

std::optional<std::int64_t> floe_id_in(const JsonValue& object, std::string_view key) {
  const JsonValue* id = object.find(key, JsonValue::Kind::kNumber);
  if (!id) return {};
  const double number = id->number();
  if (!(number >= 0 && number < 9e15 && number == std::floor(number))) return {};
  return static_cast<std::int64_t>(number);
}

Result<geometry::Polygon> BirthShapes::assemble(const JsonValue& line) {
  const auto shape = read_shape(line);
  if (!shape) return fail(shape.error());
  const auto id = floe_id_in(line, "parent_id");
  if (!id) return fail("parts of a parent's shape, without a \"parent_id\"");
  const auto found = entry_of_.find(*id);
  if (found == entry_of_.end())
    return fail(
        fmt::format("parts of the shape of floe {}, of which no line stands before (`polynya inspect RUN "
                    "--floe ID` prints a floe's shape whole)",
                    *id));
  const geometry::Polygon& parent = floes_.entries[found->second].polygon;
  if (const auto checked = check_parts(*shape, ring_sizes(parent)); !checked) return fail(checked.error());
  assembled_ += vertex_count(parent);
  if (assembled_ > kMostAssembled)
    return fail(fmt::format("more than {} vertices in the shapes of parents", kMostAssembled));
  return assembled(*shape, parent);
}

}  // namespace polynya::io
