#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/run_check.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::app {

/// What `polynya inspect` prints, made of a run.

enum class ShapeFormat { kWkt, kGeojson, kSvg };

/// A floe's shape in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;  ///< [s]; none: the body frame
};
/// WKT, a GeoJSON Feature, or SVG in metres with y up.
std::string to_text(const ShapeView& view, ShapeFormat format);

/// A floe alive at some time.
struct FloeRow {
  const simulation::BirthRecord& birth;
  double perimeter = 0;  ///< [m]
  std::size_t vertices = 0;
  std::size_t holes = 0;
  std::optional<double> speed;  ///< [m/s]; none between two frames
  std::string_view validity;    ///< "yes" or a defect's name
};
std::vector<FloeRow> floe_rows(const io::Run& run, double time);
std::string floe_table(const std::vector<FloeRow>& rows);

/// The trunk from the scene's floe down to this one: each fracture with what decided it, and the pieces
/// beside.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);

/// Floes by size (√area, as the fracture criteria have it) in classes of 1, 2, 5 × 10ⁿ m.
struct SizeDistribution {
  struct Class {
    double from = 0, below = 0;  ///< [m]
    std::size_t count = 0;
    double area = 0;          ///< [m²]
    std::size_t from_on = 0;  ///< how many are in it or in larger classes
  };
  double time = 0;  ///< [s]
  std::size_t count = 0;
  std::size_t without_size = 0;               ///< left out: their recorded area is not a positive number
  double area = 0;                            ///< of all [m²]
  double least = 0, median = 0, largest = 0;  ///< [m]
  std::vector<Class> classes;
};
SizeDistribution size_distribution(const io::Run& run, double time);
std::string size_text(const SizeDistribution& sizes);

/// What check_run found, in words.
std::string check_text(const analysis::RunCheck& check);

}  // namespace polynya::app
