#pragma once

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"

#include "io/run/checkpoint.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_writer.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"

namespace polynya::tests {

/// A ship under thrust in a random field and into a plate. Within a third of a second there are bends, splits, ice that
/// tilts, goes under and surfaces, brash, and sleeping and waking floes. The scene has about 130 floes.
inline std::string crash_scene(const std::string& until) {
  return R"({"name": "crash", "time": {"step_s": 0.02, "until_s": )" + until +
         R"(},
    "record": {"frames_interval_s": 1, "contacts": "all"}, "fracture": {"smallest_floe_m2": 2, )"
         R"("resurface": {"retry_s": 0.5, "give_up_s": 5}},
    "ships": [{"hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27, "stem_angle_deg": 30, "draught_m": 6},
      "mass_kg": 1e7, "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 100], "speed_m_per_s": 3,
      "propulsion": {"thrust_N": 2e6}}],
    "floes": [{"field": {"corner_m": [0, 0], "extent_m": [220, 200], "floe_size_m": 15, "size_spread": 0.25,
      "concentration": 0.7}}, {"rectangle": {"corner_m": [222, 40], "size_m": [60, 120]}}]})";
}

/// The files whose bytes an interruption must not change, and one file that it may only write again.
inline constexpr std::array kComparedFiles{io::run_file::kScene,   io::run_file::kForces, io::run_file::kEvents,
                                           io::run_file::kFloes,   io::run_file::kFrames, io::run_file::kContacts,
                                           io::run_file::kCrushed, io::run_file::kStates, io::run_file::kFinalGeojson};

/// A summary.json without the lines that record how long the run took by the clock.
inline std::string without_wall_time(const std::string& summary) {
  std::istringstream lines(summary);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (line.find("wall_time_s") == std::string::npos && line.find("real_time_factor") == std::string::npos)
      kept += line + '\n';
  return kept;
}

/// Returns the first file in which two run folders differ, or an empty text if none differs.
inline std::string first_difference(const std::filesystem::path& a, const std::filesystem::path& b) {
  for (const auto name : kComparedFiles) {
    const bool are_there = std::filesystem::exists(a / name) && std::filesystem::exists(b / name);
    if (!are_there || read_file(a / name) != read_file(b / name)) return std::string(name);
  }
  const auto summary = [](const auto& run) { return without_wall_time(read_file(run / io::run_file::kSummary)); };
  return summary(a) == summary(b) ? "" : std::string(io::run_file::kSummary);
}

inline bool has_ended(pid_t child) {
  siginfo_t ended{};
  return waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid == child;
}

/// Kills a run, or waits until it has ended by itself. Returns whether it was killed.
inline bool kill_after(pid_t child, const Start& start, std::chrono::microseconds delay) {
  std::this_thread::sleep_for(delay);
  kill(child, SIGKILL);
  return wait_for(child, start).code == -SIGKILL;
}

/// Starts polynya and kills it when the run folder has the given number of checkpoints. Returns false if the run ended
/// before.
inline bool kill_at_checkpoints(const Words& words, const Start& start, const std::filesystem::path& run,
                                std::size_t count) {
  const pid_t child = start_polynya(words, start);
  while (!has_ended(child) && io::checkpoints_in(run).size() < count)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return kill_after(child, start, {});
}

/// Leaves a run folder in the state in which a kill after `end` steps leaves it. Checkpoints are written at the given
/// steps, after `change`.
inline void leave_run(
    const std::filesystem::path& scene_file, const std::filesystem::path& run, std::int64_t end,
    const std::vector<std::int64_t>& checkpoints, std::int64_t frame_every,
    const std::function<void(simulation::Simulation&)>& change = [](simulation::Simulation&) {}) {
  const auto scene = checked(io::read_scene_file(scene_file));
  simulation::Simulation simulation(scene->scene);
  auto writer = checked(io::RunWriter::create(run, false, *scene));
  for (std::int64_t step = 0;; ++step) {
    writer->record(simulation.journal());
    if (step % frame_every == 0) writer->frame(simulation);
    if (std::ranges::find(checkpoints, step) != checkpoints.end()) {
      change(simulation);
      io::Checkpoint checkpoint;
      checkpoint.course_hash = scene->course_hash;
      checkpoint.steps = step;
      checkpoint.progress = writer->sync().value();
      checkpoint.state = simulation.state();
      checkpoint.state_hash = simulation.state_hash();
      ASSERT_TRUE(io::write_checkpoint(run, checkpoint).has_value());
    }
    if (step == end) return;
    simulation.step();
  }
}

}  // namespace polynya::tests
