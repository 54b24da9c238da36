#include "io/import/floe_import.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/angle.hpp"
#include "geometry/shape/outline.hpp"
#include "io/text/child_process.hpp"
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

/// The floes of one file on their way.
class FloeImport {
 public:
  FloeImport(const std::vector<SourceFloe>& floes, const ImportSettings& settings)
      : sources_(floes), settings_(settings) {}

  ImportOutcome run(PlaneReport plane) {
    outcome_.plane = std::move(plane);
    outcome_.totals.read = sources_.size();
    drawn_.reserve(sources_.size());
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

  void take(std::size_t i) {
    drawn_.push_back(geometry::normalised(sources_[i].polygon));
    const Polygon& polygon = drawn_.back();
    if (!sources_[i].refused.empty()) return refuse(i, sources_[i].refused);
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
    if (note.yields.empty()) ++outcome_.totals.trimmed;
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

  /// Areas of the items and of all, and how many floes left nothing.
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
      if (pieces[i] == 0 && items_[i].refused.empty()) ++totals.dropped;
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
  std::vector<Polygon> drawn_;     ///< as read, in the plane and in house notation
  std::vector<std::size_t> read_;  ///< those not refused
  std::vector<Polygon> dropped_;
  std::map<std::size_t, ImportItem> items_;
  ImportOutcome outcome_;
};

constexpr const char* kConverter = "ogr2ogr";

/// GDAL's reason among its warnings: the first line that is one, without the list of drivers it tried.
std::string reason_in(std::string_view text) {
  std::string_view reason = text.substr(0, text.find('\n'));
  bool is_found = false;
  for_pieces(text, '\n', [&](std::string_view line, std::size_t) {
    if (is_found || !(line.starts_with("ERROR") || line.starts_with("Unable"))) return;
    reason = line.substr(0, line.find(" with the following"));
    is_found = true;
  });
  return std::string(reason);
}

Result<ChildOutput> convert(const std::filesystem::path& file, std::string_view format, const std::string& layer,
                            bool to_degrees, std::size_t longest) {
  std::vector<std::string> words{kConverter, "-f", "GeoJSON", "-lco", "RFC7946=NO", "-lco", "COORDINATE_PRECISION=15",
                                 "-dim",     "XY"};
  if (to_degrees) words.insert(words.end(), {"-t_srs", "OGC:CRS84"});
  words.insert(words.end(), {"/vsistdout/", std::filesystem::absolute(file).string()});
  if (!layer.empty()) words.push_back(layer);
  auto output = run_child(words, longest);
  if (output) return output;
  if (output.error().starts_with(std::string(kConverter) + " wrote")) return output;
  return fail(
      fmt::format("a {} is read by GDAL's ogr2ogr, which is not there ({}): apt-get install gdal-bin, "
                  "or convert the file to GeoJSON elsewhere",
                  format, output.error()));
}

/// The format of a file by how it begins; empty where it is none of these, or cannot be read.
std::string_view foreign_format(const std::filesystem::path& file) {
  std::array<char, 16> bytes{};
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};  // opening a pipe would wait for its writer
  std::FILE* const stream = std::fopen(file.c_str(), "rb");
  if (!stream) return {};
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), stream);
  std::fclose(stream);
  const std::string_view begin(bytes.data(), count);
  using namespace std::string_view_literals;
  if (begin.starts_with("\x00\x00\x27\x0a"sv)) return "shapefile";
  if (begin.starts_with("SQLite format 3"sv)) return "GeoPackage";
  if (begin.starts_with("fgb\x03"sv)) return "FlatGeobuf file";
  return {};
}

}  // namespace

std::optional<Result<std::string>> read_foreign_file(const std::filesystem::path& file, const std::string& layer,
                                                     std::size_t longest) {
  const std::string_view format = foreign_format(file);
  if (format.empty()) return {};
  auto output = convert(file, format, layer, false, longest);
  if (!output) return fail(output.error());
  if (output->code != 0 || output->out.empty()) {
    const std::string reason = reason_in(output->err);
    return fail(fmt::format("ogr2ogr could not read it: {}",
                            reason.empty() ? fmt::format("it ended with code {}", output->code) : reason));
  }
  // ogr2ogr writes no system that has no code, and of a GeoPackage not WGS 84 either: where the layer has
  // one, it can convert from it. Without one it fails.
  const std::string_view head = std::string_view(output->out).substr(0, output->out.find("\"features\":"));
  if (head.find("\"crs\":") != std::string_view::npos) return std::move(output->out);
  auto in_degrees = convert(file, format, layer, true, longest);
  if (!in_degrees || in_degrees->code != 0 || in_degrees->out.empty()) return std::move(output->out);
  std::string& text = in_degrees->out;
  if (text.substr(0, text.find("\"features\":")).find("\"crs\":") == std::string::npos)
    text.insert(text.find('{') + 1, R"("crs": {"type": "name", "properties": {"name": "OGC:CRS84"}},)");
  return std::move(text);
}

FloesOfText floes_of(const FloeText& text, const PropertyNames& names) {
  FloesOfText read;
  NearMisses near_misses(names);
  bool are_of_run = text.time.has_value();
  for (const FloeEntry& entry : text.entries) {
    SourceFloe& floe = read.floes.emplace_back();
    floe.polygon = entry.polygon;
    if (!entry.refusal.empty()) {
      floe.refused = entry.refusal + (entry.detail.empty() ? "" : ": " + entry.detail);
      continue;
    }
    bool was_born = false;
    if (entry.properties) {
      const JsonValue properties = parse_json("{" + *entry.properties + "}").root;
      floe.properties = read_floe_properties(properties, names, floe.refused);
      near_misses.add(properties, floe.properties);
      was_born = properties.find("born_s") != nullptr;
    }
    if (entry.floe_id) floe.properties.floe_id = entry.floe_id;
    are_of_run = are_of_run && entry.floe_id && was_born;
  }
  read.near_misses = near_misses.found();
  if (are_of_run) read.run_time = text.time;
  return read;
}

tl::expected<ImportOutcome, PlaneError> import_floes(std::vector<SourceFloe>& floes, const std::string& crs,
                                                     const ImportSettings& settings) {
  auto plane = bring_to_plane(floes, crs, settings.plane);
  if (!plane) return tl::unexpected(std::move(plane.error()));
  return FloeImport(floes, settings).run(std::move(*plane));
}

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
