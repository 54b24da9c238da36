#pragma once

#include <optional>
#include <string>

#include "app/geometry_commands.hpp"
#include "io/run_check.hpp"
#include "io/run_reader.hpp"

namespace polynya::app {

/// What `polynya inspect` prints, made of a run.

/// A floe's shape in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::Birth& birth;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;  ///< [s]; none: the body frame
};
/// WKT, a GeoJSON Feature, or SVG in metres with y up.
std::string to_text(const ShapeView& view, ShapeFormat format);

/// The trunk from the scene's floe down to this one: each fracture with what decided it, and the pieces
/// beside.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);

/// Floes by size (√area, as the fracture criteria have it) in classes of 1, 2, 5 × 10ⁿ m.
std::string size_distribution(const io::Run& run, double time);

/// What check_run found, in words.
std::string check_text(const io::RunCheck& check);

}  // namespace polynya::app
