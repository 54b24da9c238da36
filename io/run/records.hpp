#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/run/csv_columns.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::io {

/// A floe's number where there is such a floe; records have null where there is none.
inline std::optional<simulation::FloeId> id_or_none(simulation::FloeId floe) {
  return floe == simulation::kNoFloe ? std::nullopt : std::optional(floe);
}

/// The name of a ship or structure, by its index; empty where there is none.
std::string_view hull_name(const simulation::Scene& scene, int ship);

/// The lines of a run's text files (docs/run-folder.md). Each appends whole lines to a buffer.

/// forces.csv's first line: the names of its columns, with their units.
std::string forces_header();
void append_forces_row(std::string& text, const simulation::HullSample& sample, const simulation::Scene& scene);

/// contacts.csv: who touched whom at a frame, and how hard at the peaks of a contact's force.
std::string contacts_header();
void append_contact(std::string& text, double time, const simulation::ContactState& contact,
                    const simulation::Scene& scene);

/// panels.csv: what ice did to a panel of a hull in an interval.
std::string panels_header();
void append_panel(std::string& text, const simulation::PanelSample& sample, const simulation::Scene& scene);

/// crushed.csv: the overlap of two bodies at a frame that their contacts have pressed, as it is booked. Pairs below
/// this share of the smaller body are left out.
inline constexpr double kLeastCrushedShare = 1e-3;
std::string crushed_header();
void append_crushed(std::string& text, double time, const simulation::CrushedOverlap& overlap,
                    const simulation::Scene& scene);

/// states.csv: a hash of everything at each frame.
std::string_view states_header();
void append_state(std::string& text, double time, std::int64_t steps, std::uint64_t hash);

/// `parent` is the shape of the floe that it broke from; null where it is of the scene. With a scene also the
/// ice that is the floe's own, and the id that it has in the file it is from.
void append_birth(std::string& text, const simulation::Birth& birth, const geometry::Polygon* parent,
                  const simulation::Scene* scene = nullptr);

/// All floes as a GeoJSON FeatureCollection in world coordinates [m].
std::string to_geojson(const std::vector<simulation::FloeState>& floes, double time);
class GeojsonLayer;
/// One floe of them.
void append_floe(GeojsonLayer& layer, const simulation::FloeState& floe);

// The lines that records.hpp writes, read back. Each throws ReadError where a line is not what it should be.

JsonValue json_of(std::string_view text);
simulation::FloeId floe_id(const JsonValue& value);

simulation::BirthRecord birth_of(const JsonValue& line);
simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene);
/// `run` has its scene and its floes.
RunCrushed crushed_of(std::string_view line, const Run& run);
RunContact contact_of(std::string_view line, const Run& run);

}  // namespace polynya::io
