#include "io/text/floe_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/text/birth_shapes.hpp"
#include "io/text/geojson_layer.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/text_kind.hpp"
#include "io/text/wkt.hpp"

namespace polynya::io {
namespace {

/// Where lines start, so that many places in a long text are found quickly.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text) {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
      ends_.push_back(at);
  }
  std::size_t line_of(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(std::ranges::lower_bound(ends_, offset) - ends_.begin());
  }

 private:
  std::vector<std::size_t> ends_;
};

/// Blanks for comments that begin a line with '#', which JSON's parser refuses.
void blank_hash_comments(std::string& text) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::size_t first = text.find_first_not_of(kBlanks, start);
    if (first < end && text[first] == '#') std::fill(&text[first], &text[end], ' ');
    start = end + 1;
  }
}

/// Without the line of a place in a text of one line.
std::string without_line(const std::string& words) {
  return words.starts_with("1:") ? "column " + words.substr(2) : words;
}

FloeText read_ndjson(const std::string& text) {
  FloeText floes;
  floes.format = FloeFormat::kNdjson;
  BirthShapes births(floes);
  std::size_t feature = 0;
  for_lines(text, [&](std::string_view line, std::size_t offset) {
    const std::size_t before = floes.entries.size();
    if (const auto value = parse_lenient_json(std::string(line))) {
      read_geojson_entries(*value, line, feature, floes, births);
    } else {
      FloeEntry& entry = floes.entries.emplace_back();
      entry.feature = feature;
      entry.refusal = "syntax";
      entry.detail = without_line(value.error());
    }
    for (std::size_t i = before; i < floes.entries.size(); ++i) floes.entries[i].line = offset;
    feature = floes.entries.size() > before ? floes.entries.back().feature + 1 : feature + 1;
  });
  return floes;
}

FloeText read_wkt_floes(std::string_view text) {
  FloeText floes;
  floes.format = FloeFormat::kWkt;
  std::vector<WktGeometry> geometries = read_wkt(text);
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    WktGeometry& geometry = geometries[i];
    floes.has_more_coordinates = floes.has_more_coordinates || geometry.has_more_coordinates;
    floes.has_srid = floes.has_srid || geometry.has_srid;
    const auto add = [&]() -> FloeEntry& {
      FloeEntry& entry = floes.entries.emplace_back();
      entry.feature = i;
      entry.line = geometry.offset;
      return entry;
    };
    std::size_t member = 0;
    for (geometry::Polygon& polygon : geometry.polygons) {
      FloeEntry& entry = add();
      entry.member = member++;
      entry.polygon = std::move(polygon);
    }
    if (geometry.refusal.empty()) continue;
    FloeEntry& entry = add();
    entry.member = member;
    entry.refusal = geometry.refusal;
    entry.detail = geometry.detail;
  }
  return floes;
}

std::string unknown_text(std::string_view first_line) {
  constexpr std::size_t kMost = 30;  // bytes of it in the message
  std::string begin(first_line.substr(0, kMost));
  std::ranges::replace_if(
      begin, [](char c) { return static_cast<unsigned char>(c) < 0x20 || (c & 0x80) != 0; }, '?');
  return fmt::format(
      "neither GeoJSON, nor NDJSON (a GeoJSON object a line), nor WKT: it begins with '{}'{}; other formats: "
      "ogr2ogr -f GeoJSON floes.geojson FILE",
      begin, first_line.size() > kMost ? " …" : "");
}

/// Decides by the lines what the text is, and reads it.
Result<FloeText> read_kind(std::string& text) {
  const LineCounts lines = count_lines(text);
  FloeText floes;
  floes.format = FloeFormat::kWkt;
  if (lines.lines == 0) return floes;
  if (lines.are_all_objects()) return read_ndjson(text);
  std::string wrong;
  if (!lines.is_wkt_first) {
    blank_hash_comments(text);
    if (const auto value = parse_lenient_json(text)) {
      floes.format = FloeFormat::kGeojson;
      BirthShapes births(floes);
      read_geojson_entries(*value, text, 0, floes, births);
      return floes;
    } else {
      wrong = value.error();
    }
  }
  if (lines.are_mostly_objects()) return read_ndjson(text);
  if (std::string_view("{[/").find(lines.first_line.front()) != std::string_view::npos)
    return fail(wrong + " (read as GeoJSON)");
  if (lines.wkt > 0) return read_wkt_floes(text);
  return fail("1:1: " + unknown_text(lines.first_line));
}

}  // namespace

FloeText read_floe_json(const JsonValue& geojson) {
  FloeText floes;
  BirthShapes births(floes);
  read_geojson_entries(geojson, "", 0, floes, births);
  return floes;
}

Result<FloeText> read_floe_text(std::string text) {
  if (text.size() > kLongestFloeText)
    return fail(fmt::format("1:1: {} bytes, more than the {} allowed", text.size(), kLongestFloeText));
  if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
  std::ranges::replace(text, '\x1E', ' ');  // GeoJSON text sequences [RFC8142] start each record with one
  const LineIndex lines(text);
  auto floes = read_kind(text);
  if (!floes) return floes;
  for (FloeEntry& entry : floes->entries) entry.line = lines.line_of(entry.line);
  return floes;
}

}  // namespace polynya::io
