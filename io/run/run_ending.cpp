// The end of a run folder: its last files, on the disk, and then of its checkpoints only that of the end.

#include "io/run/checkpoint.hpp"
#include "io/run/records.hpp"
#include "io/run/run_writer.hpp"
#include "io/text/geojson_layer.hpp"

namespace polynya::io {

namespace {

/// final.geojson in parts: of a million floes it is a gigabyte.
void write_floes(const simulation::Simulation& simulation, const WritePart& write) {
  constexpr std::size_t kPart = std::size_t{256} << 10;  // [bytes]
  GeojsonLayer layer(simulation.time());
  simulation.for_each_floe([&](const simulation::FloeState& floe) {
    append_floe(layer, floe);
    if (layer.size() > kPart) write(layer.take());
  });
  write(layer.finish());
}

}  // namespace

Result<> RunWriter::finish(const RunSummary& summary, const simulation::Simulation* simulation) {
  Result<> written = sync_files();
  if (is_displaced_) return written;  // whatever is there now is not this run's
  const auto write = [&](std::string_view name, const std::string& text) {
    auto done = write_whole_file(folder() / name, text, Durability::kSynced);
    if (written) written = std::move(done);
  };
  const auto write_ice = [&] {
    if (!simulation) return;
    auto done = write_whole_file_in_parts(
        folder() / run_file::kFinalGeojson, [&](const WritePart& part) { write_floes(*simulation, part); },
        Durability::kSynced);
    if (written) written = std::move(done);
  };
  // A summary with "finished": true comes last, when all is there, and on the disk. Of a run that stopped it
  // comes first: where space is short it matters more than the ice.
  if (summary.finished) write_ice();
  if (written || !summary.finished) write(run_file::kSummary, to_json_text(summary, *scene_));
  if (!summary.finished) write_ice();
  if (summary.finished && written) written = remove_checkpoints(folder(), 1);
  return written;
}

}  // namespace polynya::io
