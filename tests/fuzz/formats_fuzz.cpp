// Every text that Polynya reads from people: floes (GeoJSON, NDJSON, WKT), lists of cuts, scenes; and the
// shapes of floes.ndjson. The first byte says which; whatever the rest is, the answer is a value or a value
// that says why not.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geometry/exact/validity.hpp"
#include "io/run/run_reader.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/cut.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void read_floes(const std::string& text) {
  const auto floes = polynya::io::read_floe_text(text);
  if (!floes) return require(!floes.error().empty());
  for (const auto& entry : floes->entries) {
    require(entry.refusal.empty() || entry.polygon.outer.empty());
    if (entry.refusal.empty() && entry.polygon.outer.size() < 200) (void)polynya::geometry::find_defect(entry.polygon);
  }
}

void read_births(const std::string& text) {
  polynya::io::FloeShapes shapes;
  try {
    polynya::io::for_pieces(text, '\n', [&](std::string_view words, std::size_t) {
      const auto line = polynya::io::parse_json(words);
      const auto parent = polynya::io::floe_id_in(line.root, "parent_id");
      shapes.add(polynya::io::read_shape(line.root), parent.value_or(-1));
      const auto polygon = shapes.of(static_cast<std::int64_t>(shapes.size()) - 1);
      require(polygon->outer.size() >= 3 && vertex_count(*polygon) < text.size());
    });
  } catch (const polynya::io::ReadError& error) {
    require(error.what()[0] != '\0');
  }
}

void read_scene(const std::string& text) {
  const auto scene = polynya::io::read_scene(text, "fuzzed", "/nonexistent");
  if (!scene) return require(!scene.error().empty());
  require(std::isfinite(scene->scene.time.step) && scene->scene.time.step > 0);
  require(polynya::io::read_scene(scene->resolved_text, "resolved", "/nonexistent").has_value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 20000) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0:
      read_floes(text);
      break;
    case 1:
      read_births(text);
      break;
    case 2:
      (void)polynya::io::read_cut_ops(text, {});
      break;
    default:
      read_scene(text);
  }
  return 0;
}
