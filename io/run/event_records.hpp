#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"
#include "simulation/state/archive.hpp"
#include "simulation/world/event.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

// The fields of events.ndjson. Each is defined once, in the order of the lines. Four classes in event_records.cpp
// write, read, show and list events. An object of one of them is the `line` of the templates below. The templates call
// it for each field with its key, the member of the event that holds its value, and its meaning: line(key, value,
// about). They call line.object(about, list) for the object "criterion"; `list` then passes the fields within. A line
// that reads also has line.has(key). A new field is added in one place here, and described in docs/run-folder.md.

using simulation::Is;

/// Meaning and properties of a field.
struct FieldMeaning {
  /// Unit for people; empty for words, counts and ids. The player does not show a number in m² that is 0.
  std::string_view unit;
  std::string_view meaning;     ///< description in docs/run-folder.md; a test compares the page with it
  std::string_view label = {};  ///< name in the player and in `polynya inspect`; empty: they do not show the field
  /// Smallest number that the reader accepts, in the unit of the field. It also refuses NaN.
  double least = -std::numeric_limits<double>::infinity();
  /// Set for a field that a line may lack because it does not apply or because an older version did not write it. True:
  /// this event has the field, and it is written. Without a value the field is always written, and a line without it is
  /// refused.
  std::optional<bool> is_there = {};
  bool is_derived = false;  ///< true for a field that is computed from others, so that the reader skips it
};
/// Marks a field as one that a line may lack. It is written only if `is_there`.
constexpr FieldMeaning optional(bool is_there, FieldMeaning about) {
  about.is_there = is_there;
  return about;
}
/// Marks a field as computed from others.
constexpr FieldMeaning derived(FieldMeaning about) {
  about.is_derived = true;
  return about;
}

/// Value of a field for a ship, structure or wall, which is recorded by its name.
template <class Index>
struct ShipName {
  Index& index;              ///< number of the hull in the scene; −1 for none, which is recorded as an empty name
  bool may_be_none = false;  ///< true: the reader accepts an empty name
};
template <class Index>  // Clang 14, which compiles the fuzz tests, does not deduce these for aggregates.
ShipName(Index&)->ShipName<Index>;
template <class Index>
ShipName(Index&, bool) -> ShipName<Index>;

/// Value of the field for the parent of the event's floe. The event does not store the parent, so append_event()
/// receives it.
struct Parent {};

/// Meaning of the field "kind" of every criterion. It tells which condition of the criterion was met.
inline constexpr FieldMeaning kRule = derived({"", "the rule in words"});

// criterion() passes the fields of a criterion. The meaning of its last parameter depends on the criterion.

/// The criterion by which ice goes under a hull. Without a least deflection nothing was compared: a cusp went under as
/// it broke off, or the scene put the floe under the hull at the start. Both have the words of the cusp.
template <class Line>
void criterion(Line& line, Is<simulation::TiltCriterion> auto& c, bool) {
  const bool tilts = c.least_deflection != 0;
  line("kind",
       std::string_view(!tilts                              ? "a cusp broken off at the hull"
                        : c.deflection < c.least_deflection ? "covered share > 1/2"
                                                            : "edge deflection >= least deflection"),
       kRule);
  line("deflection_m", c.deflection, optional(tilts, {"m", "deflection of the floe's edge", "deflection"}));
  line("least_deflection_m", c.least_deflection,
       optional(tilts, {"m", "deflection at which the floe goes under", "goes under from", 0}));
  line("vertical_force_N", c.vertical_force,
       optional(tilts, {"N", "vertical force on the edge in the step", "vertical force"}));
  line("tilting_capacity_N", c.capacity,
       optional(tilts, {"N", "vertical force at which the floe tilts over", "tilting capacity", 0}));
  line("covered_share", c.covered_share,
       optional(
           tilts,
           {"", "fraction of the floe that the hull covers; a floe that is covered by more than half also goes under",
            "covered", 0}));
}

/// `comes_up`: the piece surfaced. Otherwise it stays under the ice, after its longest wait, or without a wait if the
/// scene lets no ice surface (ResurfaceSettings::is_enabled).
template <class Line>
void criterion(Line& line, Is<simulation::ResurfaceCriterion> auto& c, bool comes_up) {
  line("kind",
       std::string_view(comes_up                    ? c.path < 0 ? "the ship backed off it" : "path >= least path"
                        : c.waited < c.longest_wait ? "no piece surfaces in this scene"
                                                    : "waited >= longest wait"),
       kRule);
  line("path_m", c.path,
       {"m", "distance that the ship has moved over the piece since it went under", "ship came over it"});
  line("least_path_m", c.least_path, {"m", "distance from which on a piece may surface", {}, 0});
  line("waited_s", c.waited, {"s", "time that the piece has waited for room", "waited for room", 0});
  line("longest_wait_s", c.longest_wait, {"s", "waiting time after which the piece stays under the ice", {}, 0});
}

/// The criterion by which an overlap is ground. With a least width, it was cut off because no contact can part the
/// bodies. Without one, ice was crushed, a hull pierced the floe, or a hull of prescribed motion carved a channel; all
/// three have the words for crushed overlaps, and no widths.
template <class Line>
void criterion(Line& line, Is<simulation::GrindCriterion> auto& c, bool) {
  const bool is_inseparable = c.least_width > 0;
  line("kind", std::string_view(is_inseparable ? "overlap width < least width" : "crushed overlap >= least area"),
       kRule);
  line("width_m", c.width,
       optional(is_inseparable, {"m", "decrease of the overlap's area per metre by which the bodies are moved apart"}));
  line("least_width_m", c.least_width,
       optional(is_inseparable,
                {"m", "width above which a contact can part the overlap; left out if the overlap was crushed", {}, 0}));
  line("overlap_area_m2", c.overlap_area, {"m²", "exact area of the overlap", "overlap ground", 0});
  line("least_area_m2", c.least_area, {"m²", "area below which an overlap is kept", {}, 0});
}

/// The rule by which ice bends or splits, and the loads and capacities of all rules that were compared. `is_split`: the
/// ice split, or a split was refused. Otherwise it is a bend, for which the loads of the crack have no label. j is the
/// impulse of the collision and τ_c its assumed contact time. Fields with optional(true) are always written; old lines
/// lack them.
template <class Line>
void criterion(Line& line, Is<fracture::FailureCriteria> auto& c, bool is_split) {
  const simulation::DecidingLoad by = simulation::deciding_load(c, is_split);
  line("kind", by, kRule);
  line("load_N", by.load, derived({"N", "load of the rule that applied", "load"}));
  line("capacity_N", by.capacity, derived({"N", "capacity that this load reached", "capacity"}));
  const auto of_crack = [&](std::string_view label) { return is_split ? label : std::string_view(); };
  line("floe_size_m", c.floe_size, {"m", "size √area of the floe", {}, 0});
  line("breakable_size_m", c.breakable_size, {"m", "κ l, size above which floes break", {}, 0});
  line("collision_force_N", c.collision_force, {"N", "j/τ_c"});
  line("splitting_force_N", c.splitting_force,
       {"N", "F_s, force above which j/τ_c splits the floe; 0 with lefm", {}, 0});
  line("crack_length_m", c.crack_length, {"m", "length L of the crack in the ice", of_crack("crack length"), 0});
  line("crack_width_m", c.crack_width,
       optional(true,
                {"m", "W, twice the width of the ice on the narrower side of the crack", of_crack("crack width"), 0}));
  line("contact_force_N", c.contact_force,
       optional(true, {"N", "true force of the contact in the step", of_crack("contact force")}));
  const bool opens = c.opening_capacity > 0;
  line("opening_force_N", c.opening_force,
       optional(
           opens,
           {"N",
            "F that opens the crack, by the true forces: the smaller one of its two flanks. For a bend by lefm, this "
            "field and the next four belong to the crack nearest to running; they are left out if no crack opens",
            of_crack("opening force")}));
  line("opening_capacity_N", c.opening_capacity,
       optional(opens, {"N", "F_max, opening force at which the crack runs", of_crack("opening capacity"), 0}));
  line("left_flank_force_N", c.flank_forces[0],
       optional(opens, {"N", "force that pushes the ice on the left of the crack aside", of_crack("left flank")}));
  line("right_flank_force_N", c.flank_forces[1],
       optional(opens, {"N", "force that pushes the ice on the right of the crack aside", of_crack("right flank")}));
  line("fracture_toughness_Pa_sqrt_m", c.fracture_toughness,
       optional(opens, {"Pa √m", "fracture toughness K_IC of the floe", of_crack("K_IC"), 0}));
  line("vertical_force_N", c.vertical_force, {"N", "vertical force V of the contact, downwards on the ice"});
  line("bending_capacity_N", c.bending_capacity, {"N", "V_b, vertical force at which a cusp breaks off", {}, 0});
  line("flexural_strength_Pa", c.flexural_strength,
       optional(c.flexural_strength > 0, {"Pa", "flexural strength σ_f that was used for V_b or the beam", {}, 0}));
  line("section_stress_Pa", c.section_stress,
       optional(c.section_stress > 0, {"Pa", "stress σ at the section where a floe below κ l breaks across as a beam",
                                       "stress of the section", 0}));
}

/// Passes the criterion of an event of a kind. A rejected cut is a bend if it has a cusp, and else a split or a ground
/// overlap; a line of a ground overlap is recognised by the field least_area_m2.
template <class Line, class Kind>
void criterion_of(Line& line, Kind& e) {
  using namespace simulation;
  if constexpr (Is<Kind, RejectedCut>) {  // a rejected cut has the fields of the event that it would have been
    if constexpr (requires { line.has("least_area_m2"); })
      if (line.has("least_area_m2")) e.criterion = GrindCriterion{};
    std::visit([&](auto& c) { criterion(line, c, e.cusp_radius == 0); }, e.criterion);
  } else {
    criterion(line, e.criterion, Is<Kind, Split> || Is<Kind, Resurface>);
  }
}

// kind_fields() passes the fields of one kind of event. `event` is the event, and `e` its alternative in Event::what.

/// Fields of events of the ice. Members that only some kinds have are fields of these kinds only.
template <class Line, class Kind>
requires std::derived_from<Kind, simulation::IceEvent>
void kind_fields(Line& line, auto& event, Kind& e) {
  line("ship", ShipName{event.ship, true}, {"", "ship or structure that caused it; empty if a floe did", "ship"});
  line("by_floe", e.by_floe,
       optional(e.by_floe != simulation::kNoFloe, {"", "floe that caused it, if no ship did", "by floe"}));
  line("floe", e.floe, {"", "floe that broke, was ground, went under or surfaced", "floe"});
  line("parent", Parent{}, derived({"", "parent of that floe; null for a floe of the scene"}));
  line("children", e.children, {"", "floes that it became", "pieces"});
  line("point_m", event.point_in_world, {"m", "position in the world", "at"});
  line("normal", e.normal_in_world, {"", "unit normal from the hull into the ice; [0, 0] if nothing pressed"});
  line.object({"", "criterion: the rule that applied, and both sides of the comparison"},
              [&] { criterion_of(line, e); });
  line("penetration_m", e.penetration,
       {"m",
        "depth ξ of the contact: its crushed part for a bend or a split by Michel's rule; else the depth of the "
        "overlap, or 0"});
  if constexpr (requires { e.cusp_radius; })
    line("cusp_radius_m", e.cusp_radius, optional(e.cusp_radius > 0, {"m", "radius R of the cusp of a bend", {}, 0}));
  line("submerged_area_m2", e.submerged_area, {"m²", "area removed under the ship permanently", "submerged", 0});
  line("brash_area_m2", e.brash_area, {"m²", "area of pieces below the size limit, slivers and rims", "brash", 0});
  if constexpr (requires { e.under_hull_area; })
    line(
        "under_hull_area_m2", e.under_hull_area,
        optional(e.under_hull_area > 0, {"m²", "area that went under the hull and will surface", "under the hull", 0}));
  if constexpr (requires { e.under_ice_area; })
    line("under_ice_area_m2", e.under_ice_area,
         optional(e.under_ice_area > 0, {"m²", "area that stays under the ice", "under the ice", 0}));
  line("rounding_defect_m2", e.rounding_defect, {"m²", "area that rounding added (+) or removed (−)"});
  if constexpr (requires { e.reason; })
    line("reason", e.reason, optional(!e.reason.empty(), {"", "reason why geometry refused the cut", "reason"}));
}

template <class Line>
void kind_fields(Line& line, auto& event, Is<simulation::HullContact> auto& e) {
  line("ship", ShipName{event.ship}, {"", "one of the two bodies", "ship"});
  line("by_ship", ShipName{e.other}, {"", "the other body: a ship, a structure or a wall", "other ship"});
  line("point_m", event.point_in_world, {"m", "position in the world", "at"});
  line("closing_speed_m_per_s", e.closing_speed,
       {"m/s", "closing speed along the contact's normal before the contact acts", "closing at"});
  line("relative_speed_m_per_s", e.relative_speed,
       {"m/s", "relative speed of the two bodies at that point before the contact acts", {}, 0});
  line("is_prescribed", e.is_prescribed,
       {"", "true if the scene prescribes the motion of both: they pass through each other, and no force is computed"});
}

template <class Line>
void kind_fields(Line& line, auto& event, Is<simulation::MooringBreak> auto& e) {
  line("ship", ShipName{event.ship}, {"", "ship that is adrift from then on", "ship"});
  line("point_m", event.point_in_world, {"m", "its centre of gravity in the world", "at"});
  line("force_N", e.force, {"N", "horizontal force of the mooring", "force", 0});
  line("break_load_N", e.break_load, {"N", "breaking load, which that force exceeds", "breaks above", 0});
  line("offset_m", e.offset_in_moored_place,
       {"m", "offset of the ship from the moored position, along and across the moored heading", "off its place"});
}

/// All fields of a line. When a line is read, `event` already holds an event of the right kind.
template <class Line>
void fields(Line& line, Is<simulation::Event> auto& event) {
  line("t_s", event.time, {"s", "time of the event", "time"});
  line("kind", simulation::name_of(event), derived({"", "kind of the event", "event"}));
  std::visit([&](auto& kind) { kind_fields(line, event, kind); }, event.what);
}

/// Appends a line of events.ndjson with its line break. `parent` is the parent of the event's floe; kNoFloe, also for
/// events of hulls, is written as null.
void append_event(std::string& text, const simulation::Event& event, const simulation::Scene& scene,
                  simulation::FloeId parent = simulation::kNoFloe);

/// Writes the event as an object like that of events.ndjson, but only with the fields that have labels, for the player.
/// Areas of 0 are left out.
void write_shown_event(JsonWriter& json, const simulation::Event& event, const simulation::Scene& scene);

/// Describes an event for `polynya inspect`: the rule, then "label value unit" of the fields that have labels,
/// separated by "; ". Numbers that are 0 are left out, and so are the time, the kind, the place, the ids and the
/// causing ship.
std::string words_of(const simulation::Event& event, const simulation::Scene& scene);

/// Reads a line of events.ndjson. Throws ReadError with the key if a field is missing, has a wrong type or a value
/// below the smallest one, or names a ship that the scene does not have, and if the kind of the event is unknown.
simulation::Event event_of(const JsonValue& line, const simulation::Scene& scene);

/// A field of events.ndjson, for the documentation and the player.
struct EventField {
  std::string_view key;
  FieldMeaning meaning;
  bool is_of_criterion = false;         ///< true: the field is a member of the object "criterion"
  std::vector<std::string_view> kinds;  ///< names of the kinds of events that have it
};
/// Returns the fields of all kinds of events in the order of the lines. A key that has different meanings in different
/// kinds is listed once for each meaning.
std::vector<EventField> event_fields();

/// Largest number of refused cuts of a run that are written as files. It limits the size of the folder if a run has
/// many; events.ndjson has all of them, without the shapes.
inline constexpr std::int64_t kMostRejectedCuts = 100;

/// Writes a cut that geometry refused at a time [s] into a run folder, in the format that `polynya cut` reads
/// (docs/cut.md):
///   polynya cut rejected-cuts/000001.geojson --ops rejected-cuts/000001-ops.json
/// The name is the number of the cut, CutInput::number; nothing is written if it is above kMostRejectedCuts. The
/// function returns after the disk has stored the files, so that they survive a failure of the machine. It fails if the
/// folder rejected-cuts is a link or cannot be written to.
Result<> write_rejected_cut(const std::filesystem::path& run_folder, double time, const simulation::RejectedCut& cut);

/// Removes the files that write_rejected_cut() wrote, and their folder if nothing else is in it. It fails if the folder
/// is a link or a file cannot be removed.
Result<> remove_rejected_cuts(const std::filesystem::path& run_folder);

}  // namespace polynya::io
