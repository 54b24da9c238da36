// Every text that Polynya reads from people: floes (GeoJSON, NDJSON, WKT), lists of cuts, scenes. The first byte says
// which; whatever the rest is, the answer is a value or a value that says why not.

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geometry/validity.hpp"
#include "io/cut_ops.hpp"
#include "io/floe_text.hpp"
#include "io/scene_reader.hpp"

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
    case 1:
      read_floes(text);
      break;
    case 2:
      (void)polynya::io::read_cut_ops(text, {});
      break;
    default:
      read_scene(text);
  }
  return 0;
}
