#include "python/module/recording.hpp"

#include "python/module/scene.hpp"

#include "io/scene/scene_file.hpp"

namespace polynya::python {
namespace {

constexpr double kBetweenCheckpoints = 60;         ///< wall time between checkpoints [s], as in `polynya run`
constexpr std::int64_t kStepsBetweenFlushes = 16;  ///< reading the clock at every step would slow small steps down

io::RunWriter writer_of(const std::filesystem::path& folder, bool overwrite, const io::LoadedScene& scene) {
  auto writer = io::RunWriter::create(folder, overwrite, scene);
  if (!writer) raise("FolderError", py::str(writer.error()));
  return std::move(*writer);
}

}  // namespace

Recording::Recording(const io::LoadedScene& scene, simulation::Simulation& simulation,
                     const std::filesystem::path& folder, bool overwrite)
    : scene_(std::make_unique<io::LoadedScene>(scene)),
      simulation_(simulation),
      writer_(writer_of(folder, overwrite, *scene_)),
      recorder_(simulation_, writer_, *scene_) {
  simulation::Simulation again(scene_->scene);  // the journal of the first simulation is no longer available
  recorder_.begin(again.journal());
}

void Recording::keep(const io::Result<>& result) {
  if (!result && !failure_) failure_ = result.error();
}

void Recording::take_step() {
  recorder_.record_step();
  if (simulation_.numerical_failure() || failure_) return;
  recorder_.frame_if_due();
  if (simulation_.steps() % kStepsBetweenFlushes != 0) return;
  writer_.flush_if_due();
  const bool is_due = recorder_.checkpoint_age() >= kBetweenCheckpoints;
  keep(is_due ? recorder_.checkpoint() : writer_.status());
}

void Recording::end(double until, const std::string& stopped_by) {
  std::unique_ptr<io::LoadedScene> ended;
  if (stopped_by.empty() && until != scene_->scene.time.until) {
    auto read =
        io::read_scene(scene_->resolved_text, scene_->scene.name, ".", {.until = until, .seed = {}, .assignments = {}});
    if (!read) raise("FolderError", py::str(to_string(read.error().front())));
    ended = std::make_unique<io::LoadedScene>(std::move(*read));
    keep(writer_.end_with(*ended));
  }
  if (!simulation_.numerical_failure() && simulation_.steps() > 0)
    keep(stopped_by.empty() ? recorder_.end() : recorder_.checkpoint());
  const bool has_floes = scene_->scene.floes.size() <= io::kMostFloesInFinal;
  const io::RunSummary summary = summarise(simulation_, writer_, failure_.value_or(stopped_by), recorder_.wall_time());
  keep(writer_.finish(summary, has_floes ? &simulation_ : nullptr));
  if (failure_) raise("FolderError", py::str(*failure_));
}

}  // namespace polynya::python
