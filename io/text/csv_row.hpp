#pragma once

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/json_writer.hpp"

namespace polynya::io {

/// Adds numbers to a row, each behind a comma.
inline void append_csv(std::string& row, std::initializer_list<double> values) {
  for (const double value : values) append_number(row += ',', value);
}

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
