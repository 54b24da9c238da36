// Runs a scene as docs/architecture.md shows it, and cuts a floe: every room of the installed library links.
#include <cmath>
#include <cstdio>

#include "fracture/characteristic_length.hpp"
#include "geometry/cut/cut.hpp"
#include "io/run/run_loop.hpp"
#include "io/scene/scene_file.hpp"

namespace {

// docs/architecture.md shows these lines (tests/docs/check_docs.py compares them).
// begin
using namespace polynya;
io::Result<io::RunResult> simulate(const char* scene_file, const char* folder, double until) {
  const auto scene = io::read_scene_file(scene_file);
  if (!scene) return io::fail(to_string(scene.error().front()));
  auto run = io::start_run(folder, *scene, /*overwrite=*/true);
  if (!run) return io::fail(run.error());
  const auto show = [](const io::RunStatus& at) { std::printf("%g s\n", at.time); };
  const auto stop = [&]() -> std::optional<std::string> {
    if (run->simulation.time() < until) return {};
    return "enough";
  };
  return run_to_end(*run, {.progress = show, .stop = stop});
}
// end

}  // namespace

int main(int count, char** words) {
  if (count < 3) return 2;
  const auto stopped = simulate(words[1], words[2], 1);
  if (!stopped || stopped->end != io::RunEnd::kStopped || stopped->reason != "enough") return 1;
  const auto finished = simulate(words[1], words[2], INFINITY);
  if (!finished || finished->end != io::RunEnd::kFinished || !finished->summary.finished) return 1;
  if (simulate("no-such-scene.json", words[2], 1)) return 1;
  const auto loaded = io::read_scene_file(words[1]);
  const geometry::Polygon square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
  const auto cut = geometry::cut_along({square}, {{5, -1}, {5, 11}});
  const double length = fracture::characteristic_length(loaded->scene.ice, loaded->scene.water.water);
  std::printf("%zu pieces, l = %.3f m\n", cut ? cut->pieces.size() : 0, length);
  return cut && cut->pieces.size() == 2 && std::isfinite(length) ? 0 : 1;
}
