#pragma once

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

namespace polynya::io {

/// Takes the first field off a row.
inline std::string_view csv_field(std::string_view& row) {
  const std::string_view field = row.substr(0, row.find(','));
  row.remove_prefix(std::min(row.size(), field.size() + 1));
  return field;
}

/// A field as a number, "null" as not a number; nothing where it is neither.
inline std::optional<double> csv_number(std::string_view field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (field == "null") return std::numeric_limits<double>::quiet_NaN();
  if (error != std::errc{} || end != field.data() + field.size()) return {};
  return value;
}

}  // namespace polynya::io
