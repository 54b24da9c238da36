#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/run/event_fields.hpp"
#include "io/text/json_value.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/result.hpp"
#include "simulation/world/event.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {
/// Appends a line of events.ndjson. `parent` is the parent of the floe that it happened to.
void append_event(std::string& text, const simulation::Event& event, const simulation::Scene& scene,
                  simulation::FloeId parent = simulation::kNoFloe);

/// The same object with the fields that the player shows.
void write_shown_event(JsonWriter& json, const simulation::Event& event, const simulation::Scene& scene);

/// What decided it and what became of the ice, as people read it: the fields that have labels.
std::string words_of(const simulation::Event& event, const simulation::Scene& scene);

/// The line read back. Throws ReadError.
simulation::Event event_of(const JsonValue& line, const simulation::Scene& scene);

/// A field as lists of them have it.
struct EventField {
  std::string_view key;
  FieldMeaning meaning;
  bool is_of_criterion = false;
  std::vector<std::string_view> kinds;  ///< that have it
};
/// Those of all kinds, in the order of lines.
std::vector<EventField> event_fields();

/// At most this many of a run are written; events.ndjson has all.
inline constexpr std::int64_t kMostRejectedCuts = 100;

/// Writes a cut that geometry refused into a run folder as `polynya cut` reads it (docs/cut.md):
///   polynya cut rejected-cuts/000001.geojson --ops rejected-cuts/000001-ops.json
/// The files are on the disk then, whatever happens to the machine.
Result<> write_rejected_cut(const std::filesystem::path& run_folder, double time, const simulation::RejectedCut& cut);

/// Removes the files that write_rejected_cut() wrote, and their folder if nothing else is in it.
Result<> remove_rejected_cuts(const std::filesystem::path& run_folder);

}  // namespace polynya::io
