#include "io/rejected_cut.hpp"

#include <fmt/format.h>

#include "io/json_writer.hpp"
#include "io/output_file.hpp"
#include "io/run_folder.hpp"

namespace polynya::io {
namespace {

void append_ring(JsonWriter& json, geometry::Ring ring) {
  ring.push_back(ring.front());
  json.value(ring);
}

void append_geometry(JsonWriter& json, const geometry::Polygon& polygon) {
  json.open('{').key("type").value("Polygon").key("coordinates").open('[');
  append_ring(json, polygon.outer);
  for (const geometry::Ring& hole : polygon.holes) append_ring(json, hole);
  json.close(']').close('}');
}

std::string floe_text(const simulation::RejectedCut& cut) {
  std::string text;
  JsonWriter json(text);
  json.open('{').key("type").value("Feature").key("properties").open('{').key("floe_id").value(cut.floe);
  json.key("t_s").value(cut.time).key("reason").value(std::string_view(cut.reason));
  if (!cut.is_exact) json.key("is_exact").value(false);
  json.close('}').key("geometry");
  append_geometry(json, cut.polygon_in_body);
  json.close('}');
  return text + "\n";
}

std::string ops_text(const simulation::RejectedCut& cut) {
  std::string text;
  JsonWriter json(text);
  json.open('[').open('{');
  if (cut.cusp_in_body.empty()) {
    json.key("line").open('[').value(cut.crack_in_body[0].x).value(cut.crack_in_body[0].y);
    json.value(cut.crack_in_body[1].x).value(cut.crack_in_body[1].y).close(']');
  } else {
    json.key("polygon");
    append_geometry(json, {cut.cusp_in_body, {}});
    json.key("keep").value("both");
  }
  json.key("must_cut").value(true).close('}').close(']');
  return text + "\n";
}

}  // namespace

std::string write_rejected_cut(const std::filesystem::path& run_folder, const simulation::RejectedCut& cut) {
  if (cut.number > kMostRejectedCuts) return "";
  const std::filesystem::path folder = run_folder / run_file::kRejectedCuts;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fmt::format("{}: {}", folder.string(), error.message());
  const std::string wrong =
      write_whole_file(folder / fmt::format("{:06}.geojson", cut.number), floe_text(cut));
  return wrong.empty() ? write_whole_file(folder / fmt::format("{:06}-ops.json", cut.number), ops_text(cut))
                       : wrong;
}

}  // namespace polynya::io
