#include "io/run/active_run.hpp"

#include <cmath>

#include <fmt/format.h>

#include "io/text/version.hpp"

namespace polynya::io {

using simulation::Simulation;

Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite) {
  Simulation simulation(scene.scene);
  auto writer = RunWriter::create(folder, overwrite, scene);
  if (!writer) return fail(writer.error());
  return ActiveRun{scene, std::move(simulation), std::move(*writer)};
}

std::int64_t last_step_of(const simulation::StepSettings& time) {
  return static_cast<std::int64_t>(std::ceil(time.until / time.step - 1e-9));
}

Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file) {
  auto checkpoint = read_checkpoint_file(file, scene.course_hash);
  if (!checkpoint) return fail(checkpoint.error());
  const simulation::StepSettings& time = scene.scene.time;
  if (checkpoint->steps > last_step_of(time))
    return fail(fmt::format("{}: at {:.6g} s, behind the end of the run at {:.6g} s", file.string(),
                            static_cast<double>(checkpoint->steps) * time.step, time.until));
  auto simulation = simulation_at(scene, *checkpoint);
  if (!simulation) return fail(fmt::format("{}: {}", file.string(), simulation.error()));
  const auto finished = finished_run(lock.folder());
  auto writer = RunWriter::resume(std::move(lock), scene, *checkpoint, file, *simulation);
  if (!writer) return fail(writer.error());
  return ActiveRun{scene, std::move(*simulation), std::move(*writer),
                   finished ? finished->wall_time : checkpoint->wall_time};
}

Result<Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint) {
  auto simulation = Simulation::resumed(scene.scene, checkpoint.state);
  if (!simulation) return fail("damaged: " + simulation.error());
  if (simulation->steps() != checkpoint.steps || simulation->state_hash() != checkpoint.state_hash)
    return fail("damaged: its state is not the one that was saved");
  return simulation;
}

Checkpoint checkpoint_of(const Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time) {
  return {.program_version = std::string(version()),
          .course_hash = scene.course_hash,
          .steps = simulation.steps(),
          .wall_time = wall_time,
          .progress = std::move(progress),
          .state = simulation.state(),
          .state_hash = simulation.state_hash(),
          .failure = ""};
}

}  // namespace polynya::io
