#pragma once

#include <initializer_list>
#include <string>

#include "expect_text.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"

/// Scenes as texts, made of a base and the changes of a test.
namespace polynya::tests {

/// Merges the members of a change into a base. Objects are merged except for kinds of propulsion, and null removes a
/// member.
inline void merge(io::JsonValue& base, const io::JsonValue& change) {
  for (const io::JsonMember& member : change.members()) {
    io::JsonValue* old = base.find(member.key);
    const bool is_merged = old && old->is(io::JsonValue::Kind::kObject) && member.key != "propulsion";
    if (is_merged && member.value.is(io::JsonValue::Kind::kObject))
      merge(*old, member.value);
    else if (member.value.is_null())
      std::erase_if(base.members(), [&](const io::JsonMember& one) { return one.key == member.key; });
    else if (old)
      *old = member.value;
    else
      base.members().push_back(member);
  }
}

/// Returns the text of an object with the given members ("\"a\": 1, \"b\": {…}").
inline std::string with(const std::string& object, const std::string& members) {
  io::JsonValue base = io::parse_json(object).root;
  const io::JsonDocument change = io::parse_json("{" + members + "}");
  EXPECT_TRUE(change.faults.empty()) << members;
  merge(base, change.root);
  return to_json_text(base);
}

/// A ship 120 m long with its stem in the origin, under a thrust of 20 kN.
inline std::string ship(const std::string& members = "") {
  return with(R"({"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7,
    "moment_of_inertia_kg_m2": 5e9, "position_m": [-60, 0], "propulsion": {"thrust_N": 2e4}})",
              members);
}

/// Returns a ship with an engine and a form whose displacement gives its mass.
inline std::string sailing_ship(const std::string& members = "") {
  return with(ship(R"("mass_kg": null, "moment_of_inertia_kg_m2": null, "position_m": null,
    "hull": {"draught_m": 6, "block_coefficient": 0.58},
    "propulsion": {"engine": {"bollard_pull_kN": 1000, "open_water_speed_m_per_s": 8}})"),
              members);
}

inline std::string square(double x, double y, double side, const std::string& members = "") {
  return with(fmt::format(R"({{"rectangle": {{"corner_m": [{}, {}], "size_m": {}}}}})", x, y, side), members);
}

inline std::string list(const char* key, std::initializer_list<std::string> items) {
  return fmt::format("\"{}\": [{}]", key, fmt::join(items, ", "));
}

inline std::string scene(std::initializer_list<std::string> members) {
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}
inline std::string scene_of_ship(const std::string& one) {
  return scene({list("ships", {one})});
}

inline io::SceneOutcome read(const std::string& text) {
  return io::read_scene(text, "scene.json", ".");
}

inline std::string in_words(const std::vector<io::Problem>& problems) {
  std::string text;
  for (const io::Problem& problem : problems) text += to_string(problem) + "\n";
  return text;
}

/// A scene that is sound.
inline io::LoadedScene load(const std::string& text, const std::filesystem::path& folder = ".",
                            const std::string& name = "scene.json") {
  auto loaded = io::read_scene(text, name, folder);
  if (loaded) return std::move(*loaded);
  ADD_FAILURE() << in_words(loaded.error()) << text;
  return {};
}

/// The resolved text of a scene is a scene, and the same one.
inline void expect_reads_back(const io::LoadedScene& loaded) {
  const io::LoadedScene again = load(loaded.resolved_text, "/nowhere");
  EXPECT_EQ(again.resolved_text, loaded.resolved_text);
  EXPECT_EQ(again.hash, loaded.hash);
  EXPECT_TRUE(again.scene == loaded.scene);
}

/// A scene with one fault, the place of its first problem, and the expected parts of its message.
struct WrongScene {
  std::string text, path, message;
  std::size_t problems = 1;
};

inline void expect_problems(const std::vector<WrongScene>& rows) {
  for (const WrongScene& row : rows) {
    SCOPED_TRACE(row.text);
    const std::vector<io::Problem> problems = refused(read(row.text));
    const io::Problem& problem = problems.front();
    EXPECT_EQ(problem.path, row.path) << in_words(problems);
    EXPECT_HAS(message_of(problem), row.message);
    EXPECT_EQ(problems.size(), row.problems) << in_words(problems);
    EXPECT_GT(problem.line, 0);
    EXPECT_GT(problem.column, 0);
  }
}

}  // namespace polynya::tests
