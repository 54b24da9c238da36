#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scene/scene_input.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using Kind = FieldKind;

void write_range(JsonWriter& json, const Range& range, const char* low, const char* high) {
  if (std::isfinite(range.low)) json.key(range.is_low_excluded ? "exclusiveMinimum" : low).value(range.low);
  if (std::isfinite(range.high)) json.key(range.is_high_excluded ? "exclusiveMaximum" : high).value(range.high);
}

void write_number(JsonWriter& json, const Field& field, const char* type) {
  json.key("type").value(type);
  write_range(json, field.range, "minimum", "maximum");
}

/// Writes the schema of a number, or of nested lists of numbers with these lengths.
void write_numbers(JsonWriter& json, const Field& field, std::span<const Length> lengths) {
  if (lengths.empty()) return write_number(json, field, "number");
  json.key("type").value("array");
  if (lengths.front().least > 0) json.key("minItems").value(lengths.front().least);
  if (lengths.front().most > 0) json.key("maxItems").value(lengths.front().most);
  json.key("items").object([&] { write_numbers(json, field, lengths.subspan(1)); });
}

void write_object(JsonWriter& json, const Object& object);

/// Returns the default as JSON in one line.
std::string default_text(const Field& field) {
  if (field.kind == Kind::kObject) return "{}";
  std::string text = to_json_text(field.default_value);
  text.pop_back();
  return text;
}

void write_type(JsonWriter& json, const Field& field) {
  switch (field.kind) {
    case Kind::kText:
    case Kind::kName:
      json.key("type").value("string");
      if (field.kind == Kind::kName) json.key("pattern").value("^[0-9A-Za-z][0-9A-Za-z ._-]{0,99}$");
      break;
    case Kind::kInteger:
      write_number(json, field, "integer");
      break;
    case Kind::kBoolean:
      json.key("type").value("boolean");
      break;
    case Kind::kChoice:
      json.key("enum").list(field.choices);
      break;
    case Kind::kNumberOrVector:
    case Kind::kNumberOrLaw:
      json.key("oneOf").open('[').object([&] { write_number(json, field, "number"); }).object([&] {
        field.object ? write_object(json, *field.object) : write_numbers(json, field, lengths_of(field.kind));
      });
      json.close(']');
      break;
    case Kind::kObject:
      write_object(json, *field.object);
      break;
    case Kind::kList:
      json.key("type").value("array").key("maxItems").value(static_cast<int>(field.range.high));
      json.key("items").object([&] { write_object(json, *field.object); });
      break;
    default:
      write_numbers(json, field, lengths_of(field.kind));
  }
}

void write_required(JsonWriter& json, const Object& object, std::string_view alternative) {
  json.key("required").open('[');
  for (const Field& field : object.fields) {
    if (field.alternative == alternative && field.presence == Presence::kRequired) json.value(field.key);
  }
  json.close(']');
}

void write_object(JsonWriter& json, const Object& object) {
  json.key("type").value("object").key("additionalProperties").value(false);
  write_required(json, object, "");
  if (!object.alternatives.empty()) {
    json.key("oneOf").objects(object.alternatives,
                              [&](std::string_view alternative) { write_required(json, object, alternative); });
  }
  json.key("properties").open('{');
  if (&object == &kSceneDescription) json.key("$schema").open('{').key("type").value("string").close('}');
  for (const Field& field : object.fields) {
    json.key(field.key).open('{');
    if (!field.meaning.empty())
      json.key("description")
          .value(field.unit.empty() ? std::string(field.meaning) : fmt::format("{} [{}]", field.meaning, field.unit));
    // A default that is computed ("ship-#", objects) cannot be stated in the schema.
    if (field.presence == Presence::kDefault && field.kind != Kind::kObject && field.kind != Kind::kName)
      json.key("default").json(default_text(field));
    write_type(json, field);
    json.close('}');
  }
  json.close('}');
}

void append_table(std::string& text, const Object& object, const std::string& path) {
  const std::string title = path.empty() ? "The scene" : fmt::format("`{}`", path);
  text += fmt::format("### {}\n\n", title);
  if (!object.alternatives.empty())
    text += fmt::format("Exactly one of: {}.\nThe fields marked so belong to it, and are given with it.\n\n",
                        fmt::join(object.alternatives, ", "));
  text += "| key | allowed | default | meaning |\n|---|---|---|---|\n";
  for (const Field& field : object.fields) {
    const std::string if_not_given = field.presence == Presence::kLeftOut   ? "left out"
                                     : field.presence == Presence::kChosen  ? "chosen"
                                     : field.presence == Presence::kDefault ? fmt::format("`{}`", default_text(field))
                                     : field.alternative.empty()            ? "must be given"
                                                                            : "—";
    const std::string mark = field.alternative.empty() ? "" : fmt::format("*{}*: ", field.alternative);
    text += fmt::format("| `{}` | {} | {} | {}{} |\n", field.key, describe_allowed(field), if_not_given, mark,
                        field.meaning);
  }
  text += '\n';
  const auto law = std::ranges::find(object.fields, Kind::kNumberOrLaw, &Field::kind);
  if (law != object.fields.end()) append_table(text, *law->object, key_path(path, "*"));
  for (const Field& field : object.fields) {
    if (field.object == nullptr || field.kind == Kind::kNumberOrLaw) continue;
    append_table(text, *field.object, key_path(path, field.key) + (field.kind == Kind::kList ? "[]" : ""));
  }
}

constexpr auto kExampleShips = R"(  "ships": [
    {
      "name": "icebreaker",
      // the waterline by its main dimensions; or point by point with "waterline_m"
      "hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30, "draught_m": 6},
      "mass_kg": 1e7,
      "moment_of_inertia_kg_m2": 5e9,
      "position_m": [-61, 0],  // of amidships: the stem is 1 m from the ice
      "heading_deg": 0,
      // Only ice acts on the ship: under {"thrust_N": 5e5} nothing else would brake it in open water.
      "propulsion": {"constant_speed_m_per_s": 1.5}
    }
  ],
)";
constexpr auto kExampleFloes = R"(  "floes": [
    {"rectangle": {"corner_m": [0, -60], "size_m": [100, 120]}},
    // each floe stands in the middle of its cell
    {"lattice": {"origin_m": [100, -60], "columns": 5, "rows": 6, "pitch_m": 20, "size_m": 15}},
    {"polygon": {"outer_m": [[210, -20], [240, -25], [250, 10], [225, 30]]}}
    // {"file": "floes.geojson"}  polygons from a file beside this one
    // {"field": {"corner_m": [250, -60], "extent_m": [200, 120], "floe_size_m": 15, "concentration": 0.5}}
  ]
)";

void append_settings(std::string& text, const Object& object, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  for (const Field& field : object.fields) {
    if (field.kind == Kind::kList || field.presence == Presence::kLeftOut || field.presence == Presence::kChosen)
      continue;
    const bool is_last = &field == &object.fields.back();
    if (field.kind == Kind::kObject) {
      text += fmt::format("{}\"{}\": {{\n", indent, field.key);
      append_settings(text, *field.object, depth + 1);
      text += fmt::format("{}}}{}\n", indent, is_last ? "" : ",");
      continue;
    }
    std::string allowed = field.kind == Kind::kText || field.kind == Kind::kName ? "" : "; " + describe_allowed(field);
    text += fmt::format("{0}// {1}{2}\n{0}\"{3}\": {4}{5}\n", indent, field.meaning, allowed, field.key,
                        default_text(field), is_last ? "" : ",");
  }
}

}  // namespace

std::string scene_schema() {
  const auto write = [](JsonWriter& json) {
    json.key("$schema").value("https://json-schema.org/draft/2020-12/schema").key("title").value("Polynya scene");
    write_object(json, kSceneDescription);
  };
  return json_object(write, JsonWriter::Layout::kIndented);
}

std::string scene_tables() {
  std::string text;
  append_table(text, kSceneDescription, "");
  text.pop_back();
  return text;
}

std::string commented_scene() {
  std::string text =
      "// A scene for polynya. What stands here are the defaults; delete what you do not change.\n"
      "// Everything a scene may hold: docs/scene.md, or `polynya schema`.\n{\n";
  append_settings(text, kSceneDescription, 1);
  text += kExampleShips;
  text += kExampleFloes;
  text += "}\n";
  // The scene's own defaults would name every scene alike and run for the time of the paper.
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"("name": "scene")", R"("name": "my-scene")");
  replace(R"("until_s": 550)", R"("until_s": 120)");
  // For a ship with a draught, such as this one, these values are the defaults.
  replace(R"("cusp_fate": "submerge")", R"("cusp_fate": "under_hull")");
  for (int i = 0; i < 2; ++i) replace(R"("enabled": false)", R"("enabled": true)");
  return text;
}

}  // namespace polynya::io
