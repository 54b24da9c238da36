#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "io/run/run_reader.hpp"
#include "io/run/summary.hpp"

namespace polynya::analysis {

// Listings of `polynya inspect`, for people and as JSON (docs/inspect.md), and the output of `polynya run`. A floe
// exists at a time from its birth until it breaks or goes under a hull. A text for people ends with a line break, and
// has a header or a line that says that there is nothing, even if there is nothing to list.

/// Shape of a floe in its body frame, or in the world at a time.
struct ShapeView {
  const simulation::BirthRecord& birth;
  const fracture::Ice& ice;             ///< properties of the floe's ice
  geometry::Polygon polygon;            ///< in the frame that time_in_world states [m]
  std::optional<double> time_in_world;  ///< time at which the polygon is placed in the world [s]; nullopt: body frame
  /// Place of the world on the Earth, if it is known. It is written only for a polygon in the world.
  std::optional<simulation::GeographicOrigin> origin = {};
};
/// Returns the shape as a GeoJSON feature with the floe's properties. Coordinates are in metres, unlike the degrees
/// that GeoJSON prescribes.
std::string to_geojson(const ShapeView& view);

/// Return the floes that exist at a time [s], one per line in the order of their ids: lineage, size, ice, speed and
/// whether the polygon is valid. The speed is unknown ("-", null in JSON) for a floe that existed only between two
/// frames.
std::string floe_table(const io::Run& run, double time);
std::string floes_json(const io::Run& run, double time);

/// Return the lineage of a floe from the floe of the scene down to it: each fracture with the rule that decided it, and
/// the other pieces; at last how the floe itself ended. In JSON each fracture is the event of events.ndjson, null for a
/// floe that lives to the end. The floe must exist in the run at some time; that is not checked.
std::string lineage_tree(const io::Run& run, simulation::FloeId floe);
std::string lineage_json(const io::Run& run, simulation::FloeId floe);

/// Return all events of the run, one per line, in order of time: events of ice, contacts of ships, moorings that break.
/// Events of the same time keep their order in events.ndjson. Without events the text is "no events".
std::string event_list(const io::Run& run);
std::string events_json(const io::Run& run);

/// A class of floe sizes, from `from` (included) to `below` (excluded). Size is √area, as in the fracture criteria.
struct SizeClass {
  double from = 0, below = 0;  ///< [m]
  std::size_t count = 0;       ///< number of floes in it
  double area = 0;             ///< sum of SizedFloe::area of its floes [m²]
  std::size_t from_on = 0;     ///< number of floes in it and in all larger classes
};

/// A floe to be counted in a class.
struct SizedFloe {
  double size = 0;  ///< √ of its whole area, which decides its class [m]
  double area = 0;  ///< area that is added to its class: the whole area, or the part of it in a channel [m²]
};
/// Returns classes with limits 1, 2, 5 × 10ⁿ m, from the class of the smallest floe to the class of the largest,
/// with empty classes between them; none without floes. The floes must be in ascending order of size, and all sizes
/// positive. `polynya channel` counts pieces of brash by the same classes.
std::vector<SizeClass> size_classes(const std::vector<SizedFloe>& floes);

/// Return the number, area, extremes, median and classes of the sizes of the floes that exist at a time [s]. Of an even
/// number of floes, the median is the larger one of the two in the middle. Floes whose recorded area is not a positive
/// number are left out and counted. Without floes the text has no extremes and classes, and they are 0 in the JSON.
std::string size_table(const io::Run& run, double time);
std::string sizes_json(const io::Run& run, double time);

/// Return the balances of summary.json: ice, energy, moorings and momentum, with units in their keys, and whether the
/// balances close. A run that has not finished has none: the text says so, and the JSON is an empty object. Balances
/// that the summary lacks are left out.
std::string account_table(const io::Run& run);
std::string accounts_json(const io::Run& run);

/// Returns the text that `polynya run` prints at its end: speed of the computation, fractures, balances of area, mass
/// and energy, and the largest loads on each ship and structure.
std::string result_text(const io::RunSummary& summary, const simulation::Scene& scene);

}  // namespace polynya::analysis
