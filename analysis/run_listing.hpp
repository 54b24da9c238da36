#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/run/run_reader.hpp"

namespace polynya::analysis {

// What a run has, as `polynya inspect` lists it: for people, and as JSON (docs/inspect.md).

/// A floe's shape in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;  ///< [s]; none: the body frame
};
/// A feature with the floe's properties.
std::string to_geojson(const ShapeView& view);

/// A floe alive at some time.
struct FloeRow {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  double perimeter = 0;  ///< [m]
  std::size_t vertices = 0;
  std::size_t holes = 0;
  std::optional<double> speed;  ///< [m/s]; none between two frames
  std::string_view validity;    ///< "yes" or a defect's name
};
/// The floes at that time [s], in order of their numbers; they refer to the run.
std::vector<FloeRow> floe_rows(const io::Run& run, double time);
std::string floe_table(const std::vector<FloeRow>& rows);
std::string floes_json(const std::vector<FloeRow>& rows, double time);

/// The trunk from the scene's floe down to this one: each fracture with what decided it, and the pieces beside. As
/// JSON, of each the fracture that broke it, as in events.ndjson.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);
std::string lineage_json(const io::Run& run, simulation::FloeId floe);

/// Every event of the run in a line, as time goes: of ice, of ships that meet, of moorings that break.
std::string event_list(const io::Run& run);
std::string events_json(const io::Run& run);

}  // namespace polynya::analysis
