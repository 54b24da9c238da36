#include <chrono>
#include <csignal>
#include <thread>

#include "../io/scene_text.hpp"
#include "interrupted_run.hpp"
#include <gtest/gtest.h>

#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

/// Lines of a text file; every one must be whole.
std::size_t whole_lines(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  EXPECT_TRUE(text.empty() || text.back() == '\n') << path;
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// Waits until a running run has put rows behind the header on disk. False where it ended before.
bool has_rows(pid_t child, const std::filesystem::path& forces) {
  while (!has_ended(child)) {
    std::error_code not_there_yet;
    const auto size = std::filesystem::file_size(forces, not_there_yet);
    if (!not_there_yet && size > 2000) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

TEST(RunCommand, WritesAFolderAndTellsTheResult) {
  const TemporaryFolder folder;
  const Outcome outcome = polynya("run scenes/level-plate.json --until 10", folder);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(outcome.out, "simulated   10 s", "real time", "cusps broken by bending", "splits", "imbalance",
             "ice force", "run folder  runs/level-plate", "picture     runs/level-plate/final.");
  const auto run = checked(io::read_run(folder / "runs/level-plate"));
  EXPECT_TRUE(run->summary.find("finished")->boolean());
  EXPECT_EQ(run->samples.size(), 100U);
  EXPECT_NEAR(run->end_time(), 10, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/level-plate/final.svg"));
  EXPECT_GT(run->summary.find("counts")->find("bends")->number(), 0);
}

/// The line of a text that has some words; empty where none has.
std::string line_with(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', at) + 1;
  return text.substr(start, text.find('\n', at) - start);
}

/// "-565.3 kN" after "surge" in such a line [N].
double surge_in(const std::string& line) {
  double value = 0;
  char unit[4] = "";
  EXPECT_EQ(std::sscanf(line.c_str() + line.find("surge"), "surge %lf %3s", &value, unit), 2) << line;
  return value * (unit[0] == 'M' ? 1e6 : unit[0] == 'k' ? 1e3 : 1);
}

TEST(RunCommand, LeadsWithTheTrueForce) {
  const TemporaryFolder folder;
  for (const std::string model : {"michel", "lefm"}) {
    write_file(folder / "scene.json",
               scene({R"("time": {"until_s": 20}, "fracture": {"splitting": {"model": ")" + model + "\"}}",
                      list("ships", {ship(R"("position_m": [-62, 0], "propulsion": {"constant_speed_m_per_s": 1})")}),
                      list("floes", {R"({"rectangle": {"corner_m": [0, -75], "size_m": [300, 150]}})"})}));
    const Outcome outcome = polynya({"run", "scene.json", "--out", model}, folder);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto run = checked(io::read_run(folder / model));
    double mean = 0, step = 0;
    for (const simulation::HullSample& sample : run->samples) {
      mean = std::min(mean, sample.from_ice.surge);
      step = std::min(step, sample.from_ice_largest.surge);
    }
    const std::size_t first = outcome.out.find("ice force"), last = outcome.out.find("j/τ_c");
    EXPECT_NEAR(surge_in(line_with(outcome.out, "largest mean over 0.1 s")) / mean, 1, 1e-3) << outcome.out;
    EXPECT_NEAR(surge_in(line_with(outcome.out, "largest single step of 0.005 s")) / step, 1, 1e-3);
    const io::JsonValue& peaks = run->summary.find("peaks")->items()[0];
    EXPECT_EQ(peaks.find("surge_N")->find("value")->number(), mean);
    EXPECT_EQ(peaks.find("surge_max_N")->find("value")->number(), step);
    EXPECT_EQ(run->summary.find("forces_interval_s")->number(), 0.1);
    // j/τ_c where it decides, and then behind the true force.
    EXPECT_EQ(last != std::string::npos, model == "michel") << outcome.out;
    EXPECT_EQ(peaks.find("surge_j_over_tau_c_N") != nullptr, model == "michel");
    if (last != std::string::npos) {
      EXPECT_LT(first, last);
    }
  }
}

TEST(RunCommand, AMooringThatBreaksIsAnEventOfEveryView) {
  const TemporaryFolder folder;
  write_file(folder / "scene.json",
             scene({R"("time": {"step_s": 0.1, "until_s": 60}, "floes": [])",
                    list("ships", {ship(R"("name": "tanker", "hull": {"length_m": 100}, "position_m": [5, 0], )"
                                        R"("propulsion": {"thrust_N": 2e5},
      "mooring": {"surge_stiffness_N_per_m": 1e4, "surge_damping_N_s_per_m": 1e5, "sway_stiffness_N_per_m": 1e4,
                  "break_load_N": 1e5})")})}));
  const Outcome outcome = polynya("run scene.json --out run", folder);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_HAS(line_with(outcome.err, "mooring of tanker broke at"), "events.ndjson");
  const auto run = checked(io::read_run(folder / "run"));
  ASSERT_EQ(run->events.size(), 1U);
  const auto& broken = std::get<simulation::MooringBreak>(run->events[0].what);
  EXPECT_GT(broken.force, 1e5);
  EXPECT_NEAR(broken.offset_in_moored_place.x, run->events[0].point_in_world.x - 5, 1e-9);
  const std::string line = read_file(folder / "run/events.ndjson");
  EXPECT_HAS(line, R"("kind":"mooring_break")", R"("ship":"tanker")", "force_N", "break_load_N\":1e+05", "offset_m",
             "point_m", "t_s");
  const Outcome events = polynya("inspect run --events", folder);
  EXPECT_HAS(events.out, "mooring_break of tanker at (");
  EXPECT_HAS(events.out, "breaks above 1e+05 N");
  EXPECT_EQ(std::ranges::count(events.out, '\n'), 1);
  const Outcome json = polynya("inspect run --events --json", folder);
  EXPECT_HAS(json.out, line.substr(0, line.size() - 1));
}

TEST(RunCommand, ShipsThatMeetAreReportedAndNoIceLoad) {
  const TemporaryFolder folder;
  const std::string hull = R"("hull": {"length_m": 100, "beam_m": 20}, "propulsion": )";
  write_file(
      folder / "scene.json",
      scene({R"("time": {"until_s": 30}, "floes": [])",
             R"("structures": [{"name": "pier", "radius_m": 5, "position_m": [70, 0]}])",
             list("ships", {ship(hull + R"({"constant_speed_m_per_s": 1}, "name": "leader", "position_m": [0, 0])"),
                            ship(hull + R"({"thrust_N": 0}, "name": "follower", "position_m": [-110, 0],
                                     "speed_m_per_s": 2)")})}));
  const Outcome outcome = polynya("run scene.json --out run", folder);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string met = line_with(outcome.err, "leader and follower came into contact");
  EXPECT_HAS(met, "closing at 1 m/s") << outcome.err;
  EXPECT_HAS(met, "_from_ships") << outcome.err;
  const std::string through = line_with(outcome.err, "leader and pier came into contact");
  EXPECT_HAS(through, "pass through each other") << outcome.err;
  EXPECT_HAS(line_with(outcome.out, "ship force  leader"), "surge") << outcome.out;
  EXPECT_HAS(outcome.out, "ship force  follower: surge -");
  const auto run = checked(io::read_run(folder / "run"));
  EXPECT_EQ(run->summary.find("warnings")->items().size(), 2U);
  ASSERT_EQ(run->events.size(), 2U);
  EXPECT_NEAR(run->events[0].time, 10, 0.02);
  EXPECT_NEAR(run->events[1].time, 15, 0.02);
  EXPECT_TRUE(std::get<simulation::ShipContact>(run->events[1].what).is_prescribed);
  double most = 0;
  for (const simulation::HullSample& sample : run->samples) {
    EXPECT_EQ(sample.from_ice.surge, 0);
    EXPECT_EQ(sample.from_ice_largest.surge, 0);
    most = std::max(most, sample.from_ships_largest.surge);
    if (sample.ship == 0) {
      EXPECT_EQ(sample.thrust, -sample.from_ships.surge);
    }
  }
  EXPECT_GT(most, 1e6);
}

TEST(RunCommand, AnExistingRunIsKeptUnlessTold) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya("run scenes/level-plate.json --until 2", folder).code, 0);
  const std::string kept = read_file(folder / "runs/level-plate/forces.csv");
  const Outcome refused = polynya("run scenes/level-plate.json --until 3", folder);
  EXPECT_EQ(refused.code, 5);
  EXPECT_HAS(refused.err, "--overwrite");
  EXPECT_EQ(read_file(folder / "runs/level-plate/forces.csv"), kept);
  EXPECT_EQ(polynya("run scenes/level-plate.json --until 3 --overwrite", folder).code, 0);
  EXPECT_NE(read_file(folder / "runs/level-plate/forces.csv"), kept);
}

/// The signal comes when the run has written something; then the folder must be whole and say that it is not
/// finished. SIGKILL allows no last words: what is there must be readable all the same.
TEST(RunCommand, ASignalLeavesAUsableFolder) {
  for (const auto& [signal, code, words] :
       {std::tuple{SIGINT, 75, "SIGINT"}, {SIGTERM, 75, "SIGTERM"}, {SIGKILL, -SIGKILL, ""}}) {
    const TemporaryFolder folder;
    const Start start{folder.path()};
    const pid_t child = start_polynya("run scenes/sawamura2017-fig4c.json --until 1e6 --out run", start);
    ASSERT_TRUE(has_rows(child, folder / "run/forces.csv")) << wait_for(child, start).err;
    kill(child, signal);
    const Outcome outcome = wait_for(child, start);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_HAS(outcome.err, words);
    const auto run = checked(io::read_run(folder / "run"));
    EXPECT_FALSE(run->summary.find("finished")->boolean());
    EXPECT_GT(run->samples.size(), 0U);
    EXPECT_EQ(whole_lines(folder / "run/forces.csv"), run->samples.size() + 1);
    if (signal == SIGKILL) continue;
    whole_lines(folder / "run/events.ndjson");
    EXPECT_TRUE(std::filesystem::exists(folder / "run/final.svg"));
  }
}

TEST(RunCommand, JsonProgressIsOneObjectALine) {
  const TemporaryFolder folder;
  const Outcome outcome = polynya("run scenes/level-plate.json --until 5 --progress json", folder);
  ASSERT_EQ(outcome.code, 0);
  const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
  const auto document = io::parse_json(line);
  EXPECT_TRUE(document.faults.empty()) << line;
  for (const char* key : {"sim_time_s", "until_s", "wall_time_s", "real_time_factor", "time_left_s", "fractures"}) {
    EXPECT_NE(document.root.find(key), nullptr) << key;
  }
  const Outcome quiet = polynya("run scenes/level-plate.json --until 5 --progress none --out quiet", folder);
  EXPECT_LACKS(quiet.err, "%");
}

}  // namespace
}  // namespace polynya::tests
