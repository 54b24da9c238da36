// The end of a run folder: its last files, on the disk, and then no checkpoint any more.

#include "io/run/checkpoint.hpp"
#include "io/run/records.hpp"
#include "io/run/run_writer.hpp"

namespace polynya::io {

Result<> RunWriter::finish(const RunSummary& summary, const simulation::Simulation& simulation) {
  Result<> written = sync_files();
  if (is_displaced_) return written;  // whatever is there now is not this run's
  const auto write = [&](std::string_view name, const std::string& text) {
    auto done = write_whole_file(folder() / name, text, Durability::kSynced);
    if (written) written = std::move(done);
  };
  const auto write_ice = [&] {
    write(run_file::kFinalGeojson, to_geojson(simulation.floe_states(), simulation.time()));
  };
  // A summary with "finished": true comes last, when all is there, and on the disk. Of a run that stopped it
  // comes first: where space is short it matters more than the ice.
  if (summary.finished) write_ice();
  if (written || !summary.finished) write(run_file::kSummary, to_json_text(summary, *scene_));
  if (!summary.finished) write_ice();
  if (summary.finished && written) written = remove_checkpoints(folder());
  return written;
}

Result<> RunWriter::cut_off(const RunSummary& summary) {
  for (OutputFile& file : files_) file.drop_unkept();
  Result<> synced = sync_files();
  if (is_displaced_) return synced;
  auto written =
      write_whole_file(folder() / run_file::kSummary, to_json_text(summary, *scene_), Durability::kSynced);
  return synced ? written : synced;
}

}  // namespace polynya::io
