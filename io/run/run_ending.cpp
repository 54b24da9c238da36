// The end of a run folder: its last files, on the disk, and then no checkpoint any more.

#include "io/run/checkpoint.hpp"
#include "io/run/records.hpp"
#include "io/run/run_writer.hpp"

namespace polynya::io {

std::string RunWriter::finish(const RunSummary& summary, const simulation::Simulation& simulation) {
  sync();
  if (is_displaced_) return failure_;  // whatever is there now is not this run's
  std::string problem = failure();
  const auto write = [&](std::string_view name, const std::string& text) {
    const std::string wrong = write_whole_file(folder() / name, text, Durability::kSynced);
    if (problem.empty()) problem = wrong;
  };
  // A summary that says "finished" comes last, when all is there, and on the disk. Of a run that stopped it
  // comes first: where space is short it matters more than the ice.
  const auto write_ice = [&] {
    write(run_file::kFinalGeojson, to_geojson(simulation.floe_states(), simulation.time()));
  };
  if (summary.finished) write_ice();
  if (problem.empty() || !summary.finished) write(run_file::kSummary, to_json_text(summary, *scene_));
  if (!summary.finished) write_ice();
  if (summary.finished && problem.empty()) problem = remove_checkpoints(folder());
  return problem;
}

std::string RunWriter::cut_off(const RunSummary& summary) {
  for (OutputFile& file : files_) file.drop_unkept();
  sync_files();
  if (is_displaced_) return failure_;
  const std::string problem =
      write_whole_file(folder() / run_file::kSummary, to_json_text(summary, *scene_), Durability::kSynced);
  return failure().empty() ? problem : failure();
}

}  // namespace polynya::io
