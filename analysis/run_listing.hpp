#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/run/run_reader.hpp"
#include "io/run/summary.hpp"

namespace polynya::analysis {

// What a run has, as `polynya inspect` lists it: for people, and as JSON (docs/inspect.md); and what `polynya run`
// prints.

/// A floe's shape in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;  ///< [s]; none: the body frame
  std::optional<simulation::GeographicOrigin> origin = {};  ///< of the world, where that is known
};
/// A feature with the floe's properties.
std::string to_geojson(const ShapeView& view);

/// The floes at that time [s], in order of their numbers.
std::string floe_table(const io::Run& run, double time);
std::string floes_json(const io::Run& run, double time);

/// The trunk from the scene's floe down to this one: each fracture with what decided it, and the pieces beside. As
/// JSON, of each the fracture that broke it, as in events.ndjson.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);
std::string lineage_json(const io::Run& run, simulation::FloeId floe);

/// Every event of the run in a line, as time goes: of ice, of ships that meet, of moorings that break.
std::string event_list(const io::Run& run);
std::string events_json(const io::Run& run);

/// Floes of sizes (√area, as the fracture criteria have it) from `from` to below `below`.
struct SizeClass {
  double from = 0, below = 0;  ///< [m]
  std::size_t count = 0;
  double area = 0;          ///< of those floes [m²]
  std::size_t from_on = 0;  ///< how many are in it or in larger classes
};

struct SizedFloe {
  double size = 0;  ///< [m]
  double area = 0;  ///< what its class adds up [m²]
};
/// Classes of 1, 2, 5 × 10ⁿ m from the least floe's to the largest's; the floes ascend by size.
std::vector<SizeClass> size_classes(const std::vector<SizedFloe>& floes);

/// The sizes of the floes alive at a time [s].
std::string size_table(const io::Run& run, double time);
std::string sizes_json(const io::Run& run, double time);

/// The accounts of a run's summary: where ice and energy went, what moorings store, and momentum; with units in their
/// keys.
std::string account_table(const io::Run& run);
std::string accounts_json(const io::Run& run);

/// What `polynya run` prints at its end: how fast it was, what broke, the ledgers of area, mass and energy, and the
/// largest loads of each ship and structure.
std::string result_text(const io::RunSummary& summary, const simulation::Scene& scene);

}  // namespace polynya::analysis
