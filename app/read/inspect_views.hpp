#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/floe_sizes.hpp"
#include "analysis/run_check.hpp"
#include "io/run/run_reader.hpp"

namespace polynya::app {

/// What `polynya inspect` prints, made of a run.

enum class ShapeFormat { kWkt, kGeojson, kSvg };

/// A floe's shape in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;  ///< [s]; none: the body frame
};
/// WKT, a GeoJSON Feature, or SVG in metres with y up.
std::string to_text(const ShapeView& view, ShapeFormat format);

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
std::vector<FloeRow> floe_rows(const io::Run& run, double time);
std::string floe_table(const std::vector<FloeRow>& rows);

/// Every event of the run in a line, as time goes: of ice, of ships that meet, of moorings that break.
std::string event_list(const io::Run& run);

/// The trunk from the scene's floe down to this one: each fracture with what decided it, and the pieces
/// beside.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);

std::string size_text(const analysis::SizeDistribution& sizes);

/// What check_run found, in words.
std::string check_text(const analysis::RunCheck& check, const simulation::Scene& scene);

/// The same reports as JSON: one object each.
std::string floes_json(const std::vector<FloeRow>& rows, double time);
std::string size_json(const analysis::SizeDistribution& sizes);
/// The floes from the scene's down to this one; of each the fracture that broke it, as in events.ndjson.
std::string lineage_json(const io::Run& run, simulation::FloeId floe);
/// The lines of events.ndjson as time goes.
std::string events_json(const io::Run& run);
std::string check_json(const analysis::RunCheck& check, const simulation::Scene& scene);

}  // namespace polynya::app
