#include "io/import/floe_import.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"
#include "io/import/join.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::io {
namespace {

using geometry::Polygon;

/// Polygons whose areas are summed exactly.
using Sum = std::vector<const Polygon*>;

double area_of(const Sum& polygons) {
  return geometry::exact_balance(polygons, {}, {});
}
double change_of(const Polygon& after, const Polygon& before) {
  return geometry::exact_balance(Sum{&after}, Sum{&before}, {});
}
Sum sum_of(const std::vector<Polygon>& polygons) {
  Sum sum;
  for (const Polygon& polygon : polygons) sum.push_back(&polygon);
  return sum;
}

/// Carries out the import of the floes of one file.
class FloeImport {
 public:
  FloeImport(const std::vector<SourceFloe>& floes, const ImportSettings& settings)
      : sources_(floes), settings_(settings) {}

  ImportOutcome run(PlaneReport plane) {
    outcome_.plane = std::move(plane);
    outcome_.totals.read = sources_.size();
    drawn_.reserve(sources_.size());
    for (const SourceFloe& floe : sources_) drawn_.push_back(geometry::normalised(floe.polygon));
    if (settings_.join > 0) join_parts();
    for (std::size_t i = 0; i < sources_.size(); ++i) take(i);
    if (settings_.simplify > 0) simplify();
    trim();
    sum_up();
    return std::move(outcome_);
  }

 private:
  ImportItem& item(std::size_t source) {
    ImportItem& one = items_[source];
    one.source = source;
    return one;
  }

  /// Numbers groups of floes that may be parts of one: polygons of a feature, and floes at longitude 180 with equal
  /// properties.
  std::vector<std::size_t> groups() const {
    std::vector<std::size_t> groups(sources_.size());
    std::map<std::size_t, std::size_t> of_feature;
    for (std::size_t i = 0; i < sources_.size(); ++i)
      groups[i] = sources_[i].feature ? of_feature.emplace(*sources_[i].feature, i).first->second : i;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      const auto is_part_of = [&](std::size_t k) {
        return sources_[k].is_at_180 && sources_[k].properties == sources_[i].properties;
      };
      if (!sources_[i].is_at_180 || groups[i] != i) continue;
      for (std::size_t k = 0; k < i; ++k) {
        if (!is_part_of(k)) continue;
        const std::size_t mine = groups[i];
        for (std::size_t& group : groups)
          if (group == mine) group = groups[k];
        break;
      }
    }
    return groups;
  }

  void join_parts() {
    std::vector<Polygon> parts = drawn_;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (!sources_[i].refused.empty()) parts[i] = {};
    Sum before, after;
    joined_ = join(parts, groups(), settings_.join);
    for (const Joined& one : joined_) {
      const std::size_t first = one.members.front();
      Sum before_one;
      for (const std::size_t member : one.members) {
        before_one.push_back(&drawn_[member]);
        joined_to_[member] = &one;
        if (member == first) continue;
        item(member).joined_to = first;
        item(first).joined.push_back(member);
        ++outcome_.totals.joined;
      }
      item(first).is_closed = one.members.size() == 1;
      item(first).joined_area = geometry::exact_balance(sum_of(one.polygons), before_one, {});
      for (const Polygon& polygon : one.polygons) after.push_back(&polygon);
      before.insert(before.end(), before_one.begin(), before_one.end());
    }
    outcome_.totals.area_joined = geometry::exact_balance(after, before, {});
  }

  void take(std::size_t i) {
    const Polygon& polygon = drawn_[i];
    if (!sources_[i].refused.empty()) return refuse(i, sources_[i].refused);
    if (const auto joined = joined_to_.find(i); joined != joined_to_.end()) {
      read_.push_back(i);
      if (joined->second->members.front() != i) return;
      for (const Polygon& whole : joined->second->polygons) outcome_.floes.push_back({whole, i});
      return;
    }
    const auto defect = geometry::find_defect(polygon);
    if (!defect) {
      read_.push_back(i);
      outcome_.floes.push_back({polygon, i});
      return;
    }
    std::string words = fmt::format("{}{}", name_of(defect->defect), places_in_words(defect->places, 3));
    if (!settings_.repair) {
      item(i).is_outline_refused = true;
      return refuse(i, words);
    }
    auto repaired = geometry::repair(rings_of(polygon), *settings_.repair);
    if (!repaired) return refuse(i, words + ": " + repaired.error().detail);
    read_.push_back(i);
    Sum after;
    for (geometry::Shape& shape : repaired->shapes) outcome_.floes.push_back({std::move(shape.polygon), i});
    for (std::size_t k = outcome_.floes.size() - repaired->shapes.size(); k < outcome_.floes.size(); ++k)
      after.push_back(&outcome_.floes[k].polygon);
    ImportItem& note = item(i);
    note.defect = std::move(words);
    note.repaired = geometry::exact_balance(after, Sum{&polygon}, {});
    ++outcome_.totals.repaired;
  }

  void refuse(std::size_t i, std::string why) {
    item(i).refused = std::move(why);
    ++outcome_.totals.refused;
  }

  void simplify() {
    std::vector<Polygon> befores;
    Sum after;
    befores.reserve(outcome_.floes.size());
    for (ImportedFloe& floe : outcome_.floes) {
      Polygon fewer = geometry::simplified(floe.polygon, settings_.simplify);
      if (vertex_count(fewer) == vertex_count(floe.polygon) || geometry::find_defect(fewer)) continue;
      ImportItem& note = item(floe.source);
      if (note.vertices_before == 0) ++outcome_.totals.simplified;
      note.vertices_before += vertex_count(floe.polygon);
      note.vertices_after += vertex_count(fewer);
      note.simplified += change_of(fewer, floe.polygon);
      befores.push_back(std::exchange(floe.polygon, std::move(fewer)));
      after.push_back(&floe.polygon);
    }
    outcome_.totals.area_simplified = geometry::exact_balance(after, sum_of(befores), {});
  }

  void trim() {
    std::vector<Polygon> whole;
    std::vector<std::size_t> source;
    whole.reserve(outcome_.floes.size());
    for (ImportedFloe& floe : outcome_.floes) {
      whole.push_back(std::move(floe.polygon));
      source.push_back(floe.source);
    }
    outcome_.floes.clear();
    std::vector<geometry::Trimmed> trimmed = geometry::make_disjoint(whole, settings_.gap);
    Sum before, after;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (trimmed[i].yields.empty() && !trimmed[i].error) continue;
      before.push_back(&whole[i]);
      for (const Polygon& piece : trimmed[i].pieces) after.push_back(&piece);
      note_trim(source[i], whole[i], trimmed[i], source);
    }
    outcome_.totals.area_trimmed = geometry::exact_balance(before, after, {});
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (Polygon& piece : trimmed[i].pieces) keep_or_drop(source[i], std::move(piece));
    outcome_.totals.area_dropped = area_of(sum_of(dropped_));
  }

  void note_trim(std::size_t source, const Polygon& whole, const geometry::Trimmed& trimmed,
                 const std::vector<std::size_t>& sources) {
    ImportItem& note = item(source);
    if (trimmed.error && note.refused.empty()) {
      note.refused = "its overlap was not cut off: " + trimmed.error->detail;
      ++outcome_.totals.refused;
    }
    if (note.yields.empty() && !trimmed.yields.empty() && !trimmed.error) ++outcome_.totals.trimmed;
    for (const std::size_t other : trimmed.yields) note.yields.push_back(sources[other]);
    note.trimmed += geometry::exact_balance(Sum{&whole}, sum_of(trimmed.pieces), {});
  }

  void keep_or_drop(std::size_t source, Polygon piece) {
    const geometry::Measures measures = geometry::measure(piece);
    if (measures.area >= settings_.least_area && simulation::can_be_floe(measures)) {
      outcome_.floes.push_back({std::move(piece), source});
      return;
    }
    ImportItem& note = item(source);
    note.dropped += measures.area;
    ++note.dropped_pieces;
    dropped_.push_back(std::move(piece));
  }

  /// Sums the areas of the items and of all floes, and counts floes of which nothing is left.
  void sum_up() {
    ImportTotals& totals = outcome_.totals;
    Sum read, written;
    for (const std::size_t i : read_) read.push_back(&drawn_[i]);
    std::vector<std::size_t> pieces(sources_.size());
    for (const ImportedFloe& floe : outcome_.floes) {
      written.push_back(&floe.polygon);
      ++pieces[floe.source];
      if (sources_[floe.source].properties.thickness) ++totals.with_thickness;
      if (const auto found = items_.find(floe.source); found != items_.end())
        found->second.area_after += geometry::measure(floe.polygon).area;
    }
    for (const std::size_t i : read_) {
      if (const auto found = items_.find(i); found != items_.end())
        found->second.area_before = geometry::exact_area(drawn_[i]);
      if (pieces[i] == 0 && items_[i].refused.empty() && !items_[i].joined_to) ++totals.dropped;
    }
    totals.written = outcome_.floes.size();
    totals.area_read = area_of(read);
    totals.area_written = area_of(written);
    totals.area_change = geometry::exact_balance(written, read, {});
    for (auto& [source, note] : items_) {
      note.pieces = pieces[source];
      totals.area_repaired += note.repaired;
      outcome_.items.push_back(std::move(note));
    }
  }

  const std::vector<SourceFloe>& sources_;
  const ImportSettings& settings_;
  std::vector<Polygon> drawn_;     ///< floes as read, in the plane and in house notation
  std::vector<std::size_t> read_;  ///< floes that are not refused
  std::vector<Joined> joined_;
  std::map<std::size_t, const Joined*> joined_to_;  ///< by source
  std::vector<Polygon> dropped_;
  std::map<std::size_t, ImportItem> items_;
  ImportOutcome outcome_;
};

}  // namespace

FloesOfText floes_of(const FloeText& text, const PropertyRules& rules) {
  FloesOfText read;
  PropertyReader reader(rules);
  NearMisses near_misses(rules.names);
  bool are_of_run = text.time.has_value();
  for (const FloeEntry& entry : text.entries) {
    SourceFloe& floe = read.floes.emplace_back();
    floe.polygon = entry.polygon;
    floe.feature = entry.feature;
    if (!entry.refusal.empty()) {
      floe.refused = entry.refusal + (entry.detail.empty() ? "" : ": " + entry.detail);
      continue;
    }
    bool was_born = false;
    if (entry.properties) {
      const JsonValue properties = parse_json("{" + *entry.properties + "}").root;
      floe.properties = reader.read(properties, floe.refused);
      near_misses.add(properties, floe.properties);
      was_born = properties.find("born_s") != nullptr;
    }
    if (entry.floe_id && !rules.names.contains("floe_id")) floe.properties.floe_id = entry.floe_id;
    are_of_run = are_of_run && entry.floe_id && was_born;
  }
  read.near_misses = near_misses.found();
  read.notes = reader.notes();
  if (are_of_run) read.run_time = text.time;
  return read;
}

tl::expected<ImportOutcome, PlaneError> import_floes(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const ImportSettings& settings) {
  PlaneSettings of_plane = settings.plane;
  of_plane.marks_180 = settings.join > 0;
  auto plane = bring_to_plane(floes, place, of_plane);
  if (!plane) return tl::unexpected(std::move(plane.error()));
  return FloeImport(floes, settings).run(std::move(*plane));
}

namespace {

constexpr std::size_t kMostYields = 3;  ///< number of floes that a message names

/// Returns the properties of a feature that are not Polynya's own, as members of JSON.
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

StatedPlace place_of(const PlaneReport& plane) {
  return {.origin = plane.origin,
          .shifted_crs = plane.origin || plane.shift == geometry::Vector{} ? "" : plane.target,
          .shift = plane.shift,
          .wrong = {}};
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
  if (item.joined_to) json.key("joined_to_feature").value(entries[*item.joined_to].feature);
  if (!item.joined.empty() || item.is_closed)
    json.key("joined")
        .open('{')
        .key("polygons")
        .value(1 + item.joined.size())
        .key("area_m2")
        .value(item.joined_area)
        .close('}');
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
  json.key("joined").value(totals.joined);
  json.key("repaired").value(totals.repaired).key("simplified").value(totals.simplified);
  json.key("trimmed").value(totals.trimmed).key("dropped").value(totals.dropped);
  json.key("written").value(totals.written).key("with_thickness").value(totals.with_thickness).close('}');
  json.key("area_m2").open('{').key("read").value(totals.area_read);
  json.key("joined").value(totals.area_joined);
  json.key("repaired").value(totals.area_repaired).key("simplified").value(totals.area_simplified);
  json.key("trimmed").value(-totals.area_trimmed).key("dropped").value(-totals.area_dropped);
  json.key("written").value(totals.area_written).key("change").value(totals.area_change).close('}');
}

/// Returns a term of the sum such as " + 0.5 repaired", or an empty text if the area is 0.
std::string term(double area, const char* what) {
  if (area == 0) return "";
  return fmt::format(" {} {:.9g} {}", area < 0 ? "-" : "+", std::abs(area), what);
}

}  // namespace

ImportedIds ids_of(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                   const std::vector<FloeEntry>& entries) {
  std::vector<GivenId> given;
  const auto id_of = [&](std::size_t source) {
    GivenId id{floes[source].properties.floe_id, entries[source].other_id};
    if (id.number) id.other = {};
    return id;
  };
  std::vector<bool> is_first;
  std::set<std::size_t> used;
  for (const ImportedFloe& floe : imported.floes) {
    is_first.push_back(used.insert(floe.source).second);
    if (is_first.back()) given.push_back(id_of(floe.source));
  }
  ImportedIds result{.ids = {}, .other = {}, .key = source_id_key(entries), .note = {}};
  const bool are_own = are_usable(given);
  if (const std::string why = why_ids_are_replaced(given); !why.empty())
    result.note = replaced_in_words(why, result.key);
  std::int64_t next = std::ssize(used), number = 0;
  for (const GivenId& id : given)
    if (are_own) next = std::max(next, *id.number + 1);
  for (std::size_t i = 0; i < imported.floes.size(); ++i) {
    const GivenId id = id_of(imported.floes[i].source);
    const bool keeps = are_own && is_first[i];
    result.ids.push_back(keeps ? *id.number : is_first[i] ? number++ : next++);
    result.other.push_back(keeps || !id.is_given() ? std::nullopt : std::optional(id.as_json()));
  }
  return result;
}

std::string to_geojson(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                       const std::vector<FloeEntry>& entries, const ImportedIds& ids) {
  return json_object([&](JsonWriter& json) {
    json.key("type").value("FeatureCollection");
    if (!imported.plane.target.empty() && imported.plane.shift == geometry::Vector{}) {
      json.key("crs").open('{').key("type").value("name").key("properties").open('{');
      json.key("name").value(imported.plane.target).close('}').close('}');
    }
    write_place(json, place_of(imported.plane));
    json.key("features").open('[');
    for (std::size_t i = 0; i < imported.floes.size(); ++i) {
      const ImportedFloe& floe = imported.floes[i];
      json.start_line();
      json.open('{').key("type").value("Feature").key("properties").open('{').key("floe_id").value(ids.ids[i]);
      json.key("area_m2").value(geometry::measure(floe.polygon).area);
      if (ids.other[i]) json.key(ids.key).json(*ids.other[i]);
      write_properties(json, floes[floe.source].properties);
      if (const std::string others = others_of(entries[floe.source]); !others.empty()) json.json(others);
      json.close('}').key("geometry").polygon(floe.polygon).close('}');
    }
    json.close(']');
  });
}

std::string to_json_text(const ImportOutcome& imported, const std::string& file, const std::vector<FloeEntry>& entries,
                         const FloesOfText& read, const std::vector<std::string>& notes) {
  return json_object([&](JsonWriter& json) {
    json.key("file").value(file);
    json.key("system").value(imported.plane.system);
    if (!imported.plane.target.empty()) json.key("plane").value(imported.plane.target);
    if (imported.plane.added_points > 0) json.key("points_added_to_edges").value(imported.plane.added_points);
    write_place(json, place_of(imported.plane));
    json.start_line();
    write_totals(json, imported.totals);
    json.start_line();
    json.key("notes").open('[');
    for (const std::string& note : notes) json.value(note);
    json.close(']');
    json.start_line();
    json.key("near_misses").objects(read.near_misses, [&](const NearMiss& miss) {
      json.key("property").value(miss.key).key("meant").value(miss.meant);
      json.key("factor").value(miss.factor).key("floes").value(miss.floes);
    });
    json.start_line();
    json.key("changed").object_lines(imported.items, [&](const ImportItem& item) { write_item(json, item, entries); });
  });
}

std::string counts_in_words(const ImportTotals& totals) {
  std::string words = counted(totals.read, "floe") + " read";
  for (const auto& [count, what] : {std::pair{totals.joined, "joined to others"},
                                    {totals.repaired, "repaired"},
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
  return fmt::format("{:.12g} m2 read{}{}{}{}{} = {:.12g} m2 written", totals.area_read,
                     term(totals.area_joined, "joined"), term(totals.area_repaired, "repaired"),
                     term(totals.area_simplified, "simplified"), term(-totals.area_trimmed, "trimmed"),
                     term(-totals.area_dropped, "dropped"), totals.area_written);
}

std::string plane_in_words(const PlaneReport& plane) {
  std::string words = plane.system.empty() ? "metres of the plane" : plane.system;
  if (plane.origin && !plane.system.empty()) {
    words += fmt::format(", projected about {:.9g}, {:.9g}", degrees_in_file(plane.origin->latitude),
                         degrees_in_file(plane.origin->longitude));
    if (plane.is_origin_chosen) words += " (the floes' middle: give it as the scene's origin)";
  } else if (plane.origin) {
    words += fmt::format(" about {:.9g}, {:.9g}", degrees_in_file(plane.origin->latitude),
                         degrees_in_file(plane.origin->longitude));
  } else if (!plane.target.empty()) {
    words += fmt::format(", in the plane of {}", plane.target);
  }
  if (plane.shift != geometry::Vector{})
    words += fmt::format(", shifted by ({:.12g}, {:.12g}) m", plane.shift.x, plane.shift.y);
  if (plane.added_points > 0) words += fmt::format("; {} added to edges", counted(plane.added_points, "point"));
  return words;
}

std::string item_in_words(const ImportItem& item, const std::vector<FloeEntry>& entries) {
  if (!item.refused.empty()) return "refused: " + item.refused;
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() ? "" : "; ") + more; };
  if (item.joined_to) return fmt::format("joined to feature {}", entries[*item.joined_to].feature);
  if (!item.joined.empty())
    add(fmt::format("joined with {}, {:+.3g} m2", counted(item.joined.size(), "polygon"), item.joined_area));
  if (item.is_closed) add(fmt::format("a slit in it was closed, {:+.3g} m2", item.joined_area));
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
