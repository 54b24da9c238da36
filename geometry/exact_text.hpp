#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "geometry/shape.hpp"

namespace polynya::geometry {

/// The rationals of a shape that is kept exact, as text: "x y x y …;x y …", one ring between semicolons, the
/// outer one first. Empty where the shape's doubles are its coordinates.
std::string exact_text(const Shape& shape);

/// Reads exact_text back for a shape whose nearest doubles are `polygon`. An empty text gives null. The error
/// says why the text is none of that polygon.
tl::expected<std::shared_ptr<const exact::Polygon>, std::string> read_exact_text(std::string_view text,
                                                                                 const Polygon& polygon);

}  // namespace polynya::geometry
