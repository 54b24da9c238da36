#include "io/import/import_report.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/angle.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

constexpr std::size_t kMostYields = 3;  ///< floes named in a message

/// The floes' own ids where every one has one of its own, else their numbers; further pieces of a floe are
/// numbered on.
std::vector<std::int64_t> ids_of(const ImportOutcome& imported, const std::vector<SourceFloe>& sources) {
  std::set<std::int64_t> own;
  std::set<std::size_t> used;
  for (const ImportedFloe& floe : imported.floes) {
    if (!used.insert(floe.source).second) continue;
    if (const auto id = sources[floe.source].properties.floe_id) own.insert(*id);
  }
  const bool are_own = own.size() == used.size();
  std::int64_t next = are_own && !own.empty() ? *own.rbegin() + 1 : std::ssize(used);
  std::vector<std::int64_t> ids;
  std::int64_t number = 0;
  used.clear();
  for (const ImportedFloe& floe : imported.floes) {
    if (!used.insert(floe.source).second)
      ids.push_back(next++);
    else
      ids.push_back(are_own ? *sources[floe.source].properties.floe_id : number++);
  }
  return ids;
}

/// A feature's other properties, as members of JSON.
std::string others_of(const FloeEntry& entry) {
  if (!entry.properties) return "";
  const std::string text = "{" + *entry.properties + "}";
  const JsonDocument document = parse_json(text);
  std::string others;
  if (!document.root.is(JsonValue::Kind::kObject)) return others;
  for (const JsonMember& member : document.root.members()) {
    const auto is_it = [&](const FloeProperty& property) { return property.key == member.key; };
    if (std::ranges::any_of(floe_properties(), is_it) || member.key == "born_s") continue;
    if (!others.empty()) others += ',';
    append_text(others, member.key);
    others += ':' + compact_json(text, member.value.offset);
  }
  return others;
}

void write_plane(JsonWriter& json, const PlaneReport& plane) {
  if (plane.origin) {
    json.key("origin").open('{').key("latitude_deg").value(geometry::kDegreesPerRadian * plane.origin->latitude);
    json.key("longitude_deg").value(geometry::kDegreesPerRadian * plane.origin->longitude);
    json.key("heading_deg").value(geometry::kDegreesPerRadian * plane.origin->heading).close('}');
  }
  if (plane.shift != geometry::Vector{}) json.key("shift_m").value(plane.shift);
}

void write_properties(JsonWriter& json, const FloeProperties& properties) {
  for (const FloeProperty& property : floe_properties()) {
    if (const auto& value = properties.*property.member) json.key(property.key).value(*value);
  }
}

void write_item(JsonWriter& json, const ImportItem& item, const std::vector<FloeEntry>& entries) {
  const FloeEntry& entry = entries[item.source];
  json.key("feature").value(entry.feature).key("polygon").value(entry.member).key("line").value(entry.line);
  json.key("area_before_m2").value(item.area_before).key("area_after_m2").value(item.area_after);
  json.key("pieces").value(item.pieces);
  if (!item.refused.empty()) json.key("refused").value(item.refused);
  if (!item.defect.empty())
    json.key("repaired").open('{').key("defect").value(item.defect).key("area_m2").value(item.repaired).close('}');
  if (item.vertices_after != item.vertices_before) {
    json.key("simplified").open('{').key("vertices_before").value(item.vertices_before);
    json.key("vertices_after").value(item.vertices_after).key("area_m2").value(item.simplified).close('}');
  }
  if (!item.yields.empty()) {
    json.key("trimmed").open('{').key("area_m2").value(-item.trimmed).key("features").open('[');
    for (const std::size_t other : item.yields) json.value(entries[other].feature);
    json.close(']').close('}');
  }
  if (item.dropped_pieces > 0) {
    json.key("dropped").open('{').key("pieces").value(item.dropped_pieces);
    json.key("area_m2").value(-item.dropped).close('}');
  }
}

void write_totals(JsonWriter& json, const ImportTotals& totals) {
  json.key("floes").open('{').key("read").value(totals.read).key("refused").value(totals.refused);
  json.key("repaired").value(totals.repaired).key("simplified").value(totals.simplified);
  json.key("trimmed").value(totals.trimmed).key("dropped").value(totals.dropped);
  json.key("written").value(totals.written).key("with_thickness").value(totals.with_thickness).close('}');
  json.key("area_m2").open('{').key("read").value(totals.area_read);
  json.key("repaired").value(totals.area_repaired).key("simplified").value(totals.area_simplified);
  json.key("trimmed").value(-totals.area_trimmed).key("dropped").value(-totals.area_dropped);
  json.key("written").value(totals.area_written).key("change").value(totals.area_change).close('}');
}

/// " + 0.5 repaired", where there is any.
std::string term(double area, const char* what) {
  if (area == 0) return "";
  return fmt::format(" {} {:.9g} {}", area < 0 ? "-" : "+", std::abs(area), what);
}

}  // namespace

std::string to_geojson(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                       const std::vector<FloeEntry>& entries) {
  return json_object([&](JsonWriter& json) {
    json.key("type").value("FeatureCollection");
    if (!imported.plane.target.empty() && imported.plane.shift == geometry::Vector{}) {
      json.key("crs").open('{').key("type").value("name").key("properties").open('{');
      json.key("name").value(imported.plane.target).close('}').close('}');
    }
    write_plane(json, imported.plane);
    json.key("features").open('[');
    const std::vector<std::int64_t> ids = ids_of(imported, floes);
    for (std::size_t i = 0; i < imported.floes.size(); ++i) {
      const ImportedFloe& floe = imported.floes[i];
      json.start_line();
      json.open('{').key("type").value("Feature").key("properties").open('{').key("floe_id").value(ids[i]);
      json.key("area_m2").value(geometry::measure(floe.polygon).area);
      write_properties(json, floes[floe.source].properties);
      if (const std::string others = others_of(entries[floe.source]); !others.empty()) json.json(others);
      json.close('}').key("geometry").polygon(floe.polygon).close('}');
    }
    json.close(']');
  });
}

std::string to_json_text(const ImportOutcome& imported, const std::string& file, const std::vector<FloeEntry>& entries,
                         const std::vector<NearMiss>& near_misses) {
  return json_object([&](JsonWriter& json) {
    json.key("file").value(file);
    json.key("system").value(imported.plane.system);
    if (!imported.plane.target.empty()) json.key("plane").value(imported.plane.target);
    write_plane(json, imported.plane);
    json.start_line();
    write_totals(json, imported.totals);
    json.start_line();
    json.key("near_misses").objects(near_misses, [&](const NearMiss& miss) {
      json.key("property").value(miss.key).key("meant").value(miss.meant);
      json.key("factor").value(miss.factor).key("floes").value(miss.floes);
    });
    json.start_line();
    json.key("changed").object_lines(imported.items, [&](const ImportItem& item) { write_item(json, item, entries); });
  });
}

std::string counts_in_words(const ImportTotals& totals) {
  std::string words = counted(totals.read, "floe") + " read";
  for (const auto& [count, what] : {std::pair{totals.repaired, "repaired"},
                                    {totals.simplified, "simplified"},
                                    {totals.trimmed, "trimmed"},
                                    {totals.dropped, "dropped"},
                                    {totals.refused, "refused"}}) {
    if (count > 0) words += fmt::format(", {} {}", count, what);
  }
  return words + fmt::format("; {} written", totals.written);
}

std::string thickness_in_words(std::size_t with_thickness, std::size_t floes) {
  if (floes == 1)
    return with_thickness == 1 ? "the floe has a thickness of its own" : "the floe has no thickness of its own";
  if (with_thickness == 0) return fmt::format("none of {} floes has a thickness of its own", floes);
  if (with_thickness == floes) return fmt::format("all {} floes have a thickness of their own", floes);
  return fmt::format("{} of {} floes {} a thickness of {} own", with_thickness, floes,
                     with_thickness == 1 ? "has" : "have", with_thickness == 1 ? "its" : "their");
}

std::string areas_in_words(const ImportTotals& totals) {
  return fmt::format("{:.12g} m2 read{}{}{}{} = {:.12g} m2 written", totals.area_read,
                     term(totals.area_repaired, "repaired"), term(totals.area_simplified, "simplified"),
                     term(-totals.area_trimmed, "trimmed"), term(-totals.area_dropped, "dropped"), totals.area_written);
}

std::string plane_in_words(const PlaneReport& plane) {
  std::string words = plane.system.empty() ? "metres of the plane" : plane.system;
  if (plane.origin && !plane.system.empty()) {
    words += fmt::format(", projected about {:.9g}, {:.9g}", geometry::kDegreesPerRadian * plane.origin->latitude,
                         geometry::kDegreesPerRadian * plane.origin->longitude);
    if (plane.is_origin_chosen) words += " (the floes' middle: give it as the scene's origin)";
  } else if (!plane.target.empty()) {
    words += fmt::format(", in the plane of {}", plane.target);
  }
  if (plane.shift != geometry::Vector{})
    words += fmt::format(", shifted by ({:.12g}, {:.12g}) m", plane.shift.x, plane.shift.y);
  return words;
}

std::string item_in_words(const ImportItem& item, const std::vector<FloeEntry>& entries) {
  if (!item.refused.empty()) return "refused: " + item.refused;
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() ? "" : "; ") + more; };
  if (!item.defect.empty()) add(fmt::format("{}, repaired, {:+.9g} m2", item.defect, item.repaired));
  if (!item.yields.empty()) {
    std::string others;
    for (std::size_t i = 0; i < std::min(item.yields.size(), kMostYields); ++i)
      others += fmt::format("{}{}", i > 0 ? ", " : "", entries[item.yields[i]].feature);
    if (item.yields.size() > kMostYields) others += ", ...";
    add(fmt::format("trimmed, {:.9g} m2 to feature {}{}", item.trimmed, others,
                    item.pieces > 1 ? fmt::format(", now {} floes", item.pieces) : ""));
  }
  if (item.dropped_pieces > 0) add(fmt::format("dropped, {:.9g} m2", item.dropped));
  if (item.pieces == 0) add("nothing is left of it");
  return words;
}

}  // namespace polynya::io
