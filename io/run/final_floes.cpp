#include "io/run/final_floes.hpp"

#include <fmt/format.h>

#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/shape_parts.hpp"

namespace polynya::io {
namespace {

constexpr std::string_view kEndOfCollection = "]}";

/// Returns the time [s] in the first line, {"type":"FeatureCollection","t_s":550,"features":[
double instant_of(std::string_view first_line) {
  std::string whole(trimmed(first_line));
  if (whole.ends_with('['))
    whole += kEndOfCollection;
  else if (!whole.ends_with("[]}"))
    throw ReadError("the file is not written as a run writes it, with each floe on a line of its own");
  return json_member(json_of(whole), "t_s", JsonValue::Kind::kNumber).number();
}

/// Returns the feature in a line, without the comma between features and without the end of the collection.
std::string_view feature_in(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with(',')) line.remove_prefix(1);
  if (line.ends_with(',')) line.remove_suffix(1);
  if (line.ends_with("}]}")) line.remove_suffix(kEndOfCollection.size());
  return line == kEndOfCollection ? std::string_view() : line;
}

/// Returns a ring without its last point, which in GeoJSON repeats the first one.
geometry::Ring open_ring_of(const JsonValue& value) {
  if (!value.is(JsonValue::Kind::kArray)) throw ReadError("a ring is not a list of [x, y]");
  geometry::Ring ring;
  for (const JsonValue& point : value.items()) ring.push_back(point_of(point));
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

FinalFloe floe_in(std::string_view feature) {
  const JsonValue json = json_of(feature);
  FinalFloe floe;
  floe.floe = floe_id(json_member(json_member(json, "properties"), "floe_id", JsonValue::Kind::kNumber));
  const auto& rings = json_member(json_member(json, "geometry"), "coordinates", JsonValue::Kind::kArray).items();
  if (rings.empty()) throw ReadError("a floe has no ring");
  floe.polygon_in_world.outer = open_ring_of(rings.front());
  for (std::size_t i = 1; i < rings.size(); ++i) floe.polygon_in_world.holes.push_back(open_ring_of(rings[i]));
  return floe;
}

}  // namespace

Result<std::optional<FinalFloes>> FinalFloes::read(const std::filesystem::path& run_folder) {
  const std::filesystem::path file = run_folder / run_file::kFinalGeojson;
  if (std::error_code error; run_folder.empty() || !std::filesystem::exists(file, error)) return std::nullopt;
  auto text = read_text_file(file, kLongestRunFile);
  if (!text) return fail(fmt::format("{}: {}", file.string(), text.error()));
  FinalFloes floes(file.string(), std::move(*text));
  try {
    floes.time_ = instant_of(std::string_view(floes.text_).substr(0, floes.text_.find('\n')));
  } catch (const ReadError& error) {
    return fail(fmt::format("{}:1: {}", floes.name_, error.what()));
  }
  return floes;
}

Result<> FinalFloes::for_each(const std::function<void(const FinalFloe&)>& use) const {
  int line_number = 0;
  try {
    for_pieces(text_, '\n', [&](std::string_view line, std::size_t) {
      if (++line_number == 1) return;
      if (const std::string_view feature = feature_in(line); !feature.empty()) use(floe_in(feature));
    });
  } catch (const ReadError& error) {
    return fail(fmt::format("{}:{}: {}", name_, line_number, error.what()));
  }
  return {};
}

}  // namespace polynya::io
