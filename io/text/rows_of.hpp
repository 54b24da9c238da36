#pragma once

#include <cstddef>

namespace polynya::io {

/// Entries set row by row, an equal number a row: where the one at a place goes, and how many rows they fill.
constexpr std::size_t row_of(std::size_t place, std::size_t columns) {
  return place / columns;
}
constexpr std::size_t rows_of(std::size_t count, std::size_t columns) {
  return (count + columns - 1) / columns;
}

}  // namespace polynya::io
