#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// Columns of numbers one after the other, each at a multiple of 8 bytes, as the player reads them. `table`
/// tells of each: name, type ("f64", "i32", "u8"), first byte, how many numbers.
class ColumnWriter {
 public:
  struct Column {
    std::string name;
    const char* type = "u8";
    std::size_t offset = 0;  ///< [bytes]
    std::size_t count = 0;
  };
  void add(const std::string& name, const std::vector<double>& values);
  void add(const std::string& name, const std::vector<std::int32_t>& values);
  void add(const std::string& name, std::string_view bytes);
  const std::vector<Column>& table() const { return table_; }
  const std::string& bytes() const { return bytes_; }

 private:
  void add_raw(const std::string& name, const char* type, const void* data, std::size_t count,
               std::size_t size);
  std::vector<Column> table_;
  std::string bytes_;
};

/// Every floe of the run: parent, generation, born_s, died_s, area_m2, mass_kg, centroid_m, and its shape:
/// the ends of its rings, counted from its first vertex, and its vertices, or of one that is parts of its
/// parent's the parts, its new vertices and its farthest vertex from its centroid.
void add_floes(ColumnWriter& columns, const io::Run& run);

}  // namespace polynya::views
