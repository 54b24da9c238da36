#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/run/run_reader.hpp"
#include "io/run/summary.hpp"

namespace polynya::analysis {

// Listings of `polynya inspect`, for people and as JSON (docs/inspect.md), and the output of `polynya run`.

/// Shape of a floe in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;
  geometry::Polygon polygon;
  std::optional<double> time_in_world;                      ///< [s]; none: the body frame
  std::optional<simulation::GeographicOrigin> origin = {};  ///< place of the world on the Earth, if it is known
};
/// Returns the shape as a GeoJSON feature with the floe's properties.
std::string to_geojson(const ShapeView& view);

/// Return the floes at a time [s] in the order of their ids.
std::string floe_table(const io::Run& run, double time);
std::string floes_json(const io::Run& run, double time);

/// Return the lineage of a floe from the floe of the scene down to it: each fracture with its rule, and the other
/// pieces. In JSON each fracture is as in events.ndjson.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);
std::string lineage_json(const io::Run& run, simulation::FloeId floe);

/// Return all events of the run, one per line, in order of time: events of ice, contacts of ships, moorings that break.
std::string event_list(const io::Run& run);
std::string events_json(const io::Run& run);

/// A class of floe sizes, from `from` to less than `below`. Size is √area, as in the fracture criteria.
struct SizeClass {
  double from = 0, below = 0;  ///< [m]
  std::size_t count = 0;
  double area = 0;          ///< total area of its floes [m²]
  std::size_t from_on = 0;  ///< number of floes in it and in all larger classes
};

struct SizedFloe {
  double size = 0;  ///< [m]
  double area = 0;  ///< area that is added to its class [m²]
};
/// Returns classes with limits 1, 2, 5 × 10ⁿ m from the smallest to the largest floe. Needs the floes in ascending
/// order of size.
std::vector<SizeClass> size_classes(const std::vector<SizedFloe>& floes);

/// Return the sizes of the floes that exist at a time [s].
std::string size_table(const io::Run& run, double time);
std::string sizes_json(const io::Run& run, double time);

/// Return the balances of a run's summary: ice, energy, moorings and momentum, with units in their keys.
std::string account_table(const io::Run& run);
std::string accounts_json(const io::Run& run);

/// Returns the text that `polynya run` prints at its end: speed of the computation, fractures, balances of area, mass
/// and energy, and the largest loads on each ship and structure.
std::string result_text(const io::RunSummary& summary, const simulation::Scene& scene);

}  // namespace polynya::analysis
