#include "io/run/thinned_frames.hpp"

#include <map>

namespace polynya::io {

std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection) {
  if (selection.is_all()) return run.frames;
  std::map<simulation::FloeId, RecordedMotion> skipped;  // since the last frame that stayed
  std::vector<Frame> frames;
  std::size_t last = 0;  // one past the last selected frame
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (selection.has(run.frames[i].time)) last = i + 1;
  }
  int selected = 0;
  for (std::size_t i = 0; i < last; ++i) {
    const Frame& frame = run.frames[i];
    for (const FloeMotion& floe : frame.floes) skipped[floe.floe] = {frame.time, floe.motion};
    if (!selection.has(frame.time)) continue;
    if (selected++ % selection.every != 0 && i + 1 != last) continue;
    Frame kept{.time = frame.time, .ships = frame.ships, .floes = {}};
    for (const auto& [floe, at] : skipped) {
      if (run.is_alive(floe, frame.time) || run.is_under(floe, frame.time))
        kept.floes.push_back({floe, carried_on(at.motion, frame.time - at.time)});
    }
    skipped.clear();
    frames.push_back(std::move(kept));
  }
  return frames;
}

}  // namespace polynya::io
