#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

std::vector<std::string> run_for(const std::string& until, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"run", scene_path("level-plate"), "--until", until};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Lines of a text file; every one must be whole.
std::size_t whole_lines(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  EXPECT_TRUE(text.empty() || text.back() == '\n') << path;
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// Waits until a running run has put rows behind the header on disk. False where it ended before.
bool has_rows(pid_t child, const std::filesystem::path& forces) {
  while (true) {
    std::error_code not_there_yet;
    const auto size = std::filesystem::file_size(forces, not_there_yet);
    if (!not_there_yet && size > 2000) return true;
    siginfo_t ended{};
    if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        ended.si_pid == child)
      return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

TEST(RunCommand, WritesAFolderAndTellsTheResult) {
  const TemporaryFolder folder;
  const Outcome outcome = polynya(run_for("10"), {folder.path()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words :
       {"simulated   10 s", "real time", "cusps broken by bending", "splits", "imbalance", "ice force",
        "run folder  runs/level-plate", "picture     runs/level-plate/final."}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << "\n" << outcome.out;
  }
  const auto run = io::read_run(folder / "runs/level-plate");
  ASSERT_TRUE(run.has_value()) << run.error();
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
    const std::string scene =
        R"({"time": {"until_s": 20}, "fracture": {"splitting": {"model": ")" + model + R"("}},
        "ships": [{"name": "ship", "hull": {"length_m": 120, "beam_m": 24, "entrance_angle_deg": 27}, "mass_kg": 1e7,
          "moment_of_inertia_kg_m2": 5e9, "position_m": [-62, 0], "propulsion": {"constant_speed_m_per_s": 1}}],
        "floes": [{"rectangle": {"corner_m": [0, -75], "size_m": [300, 150]}}]})";
    write_file(folder / "scene.json", scene);
    const Outcome outcome = polynya({"run", "scene.json", "--out", model}, {folder.path()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto run = io::read_run(folder / model);
    ASSERT_TRUE(run.has_value()) << run.error();
    double mean = 0, step = 0;
    for (const simulation::ShipSample& sample : run->samples) {
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
  write_file(folder / "scene.json", R"({"time": {"step_s": 0.1, "until_s": 60}, "floes": [], "ships": [
    {"name": "tanker", "hull": {"length_m": 100, "beam_m": 20, "entrance_angle_deg": 30}, "mass_kg": 1e7,
     "moment_of_inertia_kg_m2": 8e9, "position_m": [5, 0], "propulsion": {"thrust_N": 2e5},
     "mooring": {"surge_stiffness_N_per_m": 1e4, "surge_damping_N_s_per_m": 1e5, "sway_stiffness_N_per_m": 1e4,
                 "break_load_N": 1e5}}]})");
  const Outcome outcome = polynya({"run", "scene.json", "--out", "run"}, {folder.path()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(line_with(outcome.err, "mooring of tanker broke at").find("events.ndjson"), std::string::npos);
  const auto run = io::read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  ASSERT_EQ(run->events.size(), 1U);
  const auto& broken = std::get<simulation::MooringBreak>(run->events[0].what);
  EXPECT_GT(broken.force, 1e5);
  EXPECT_NEAR(broken.offset_in_moored_place.x, run->events[0].point_in_world.x - 5, 1e-9);
  const std::string line = read_file(folder / "run/events.ndjson");
  for (const char* key : {R"("kind":"mooring_break")", R"("ship":"tanker")", "force_N",
                          "break_load_N\":1e+05", "offset_m", "point_m", "t_s"})
    EXPECT_NE(line.find(key), std::string::npos) << key << " in " << line;
  const Outcome events = polynya({"inspect", "run", "--events"}, {folder.path()});
  EXPECT_NE(events.out.find("mooring_break of tanker at ("), std::string::npos) << events.out;
  EXPECT_NE(events.out.find("breaks above 1e+05 N"), std::string::npos) << events.out;
  EXPECT_EQ(std::ranges::count(events.out, '\n'), 1);
  const Outcome json = polynya({"inspect", "run", "--events", "--json"}, {folder.path()});
  EXPECT_NE(json.out.find(line.substr(0, line.size() - 1)), std::string::npos) << json.out;
}

TEST(RunCommand, ShipsThatMeetAreReportedAndNoIceLoad) {
  const TemporaryFolder folder;
  const std::string ship =
      R"("hull": {"length_m": 100, "beam_m": 20, "entrance_angle_deg": 30}, "mass_kg": 1e7,
    "moment_of_inertia_kg_m2": 8e9, )";
  write_file(folder / "scene.json",
             R"({"time": {"until_s": 30}, "ships": [
      {"name": "leader", )" +
                 ship + R"("position_m": [0, 0], "propulsion": {"constant_speed_m_per_s": 1}},
      {"name": "follower", )" +
                 ship +
                 R"("position_m": [-110, 0], "speed_m_per_s": 2, "propulsion": {"thrust_N": 0}}],
    "structures": [{"name": "pier", "radius_m": 5, "position_m": [70, 0]}], "floes": []})");
  const Outcome outcome = polynya({"run", "scene.json", "--out", "run"}, {folder.path()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string met = line_with(outcome.err, "leader and follower came into contact");
  EXPECT_NE(met.find("closing at 1 m/s"), std::string::npos) << outcome.err;
  EXPECT_NE(met.find("_from_ships"), std::string::npos) << outcome.err;
  const std::string through = line_with(outcome.err, "leader and pier came into contact");
  EXPECT_NE(through.find("pass through each other"), std::string::npos) << outcome.err;
  EXPECT_NE(line_with(outcome.out, "ship force  leader").find("surge"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("ship force  follower: surge -"), std::string::npos) << outcome.out;
  const auto run = io::read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_EQ(run->summary.find("warnings")->items().size(), 2U);
  ASSERT_EQ(run->events.size(), 2U);
  EXPECT_NEAR(run->events[0].time, 10, 0.02);
  EXPECT_NEAR(run->events[1].time, 15, 0.02);
  EXPECT_TRUE(std::get<simulation::ShipContact>(run->events[1].what).is_prescribed);
  double most = 0;
  for (const simulation::ShipSample& sample : run->samples) {
    EXPECT_EQ(sample.from_ice.surge, 0);
    EXPECT_EQ(sample.from_ice_largest.surge, 0);
    most = std::max(most, sample.from_ships_largest.surge);
    if (sample.ship == 0) {
      EXPECT_EQ(sample.thrust, -sample.from_ships.surge);
    }
  }
  EXPECT_GT(most, 1e6);
}

TEST(RunCommand, TheSameSceneGivesTheSameBytesRunAfterRun) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya(run_for("20", {"--out", "a"}), {folder.path()}).code, 0);
  ASSERT_EQ(
      polynya(run_for("20", {"--out", "b", "--threads", "2", "--progress", "json"}), {folder.path()}).code,
      0);
  for (const auto name : {io::run_file::kForces, io::run_file::kEvents, io::run_file::kFloes,
                          io::run_file::kFrames, io::run_file::kContacts}) {
    const std::string a = read_file(folder.path() / "a" / name);
    EXPECT_FALSE(a.empty());
    EXPECT_TRUE(a == read_file(folder.path() / "b" / name)) << name;
  }
}

TEST(RunCommand, AnExistingRunIsKeptUnlessTold) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya(run_for("2"), {folder.path()}).code, 0);
  const std::string kept = read_file(folder / "runs/level-plate/forces.csv");
  const Outcome refused = polynya(run_for("3"), {folder.path()});
  EXPECT_EQ(refused.code, 5);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(read_file(folder / "runs/level-plate/forces.csv"), kept);
  EXPECT_EQ(polynya(run_for("3", {"--overwrite"}), {folder.path()}).code, 0);
  EXPECT_NE(read_file(folder / "runs/level-plate/forces.csv"), kept);
}

/// The signal comes when the run has written something; then the folder must be whole and say that it is not
/// finished.
TEST(RunCommand, ASignalLeavesAWholeFolder) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TemporaryFolder folder;
    // Two floes that never stop: the run lasts until it is stopped.
    const Start start{folder.path()};
    const pid_t child =
        start_polynya({"run", scene_path("sawamura2017-fig4c"), "--until", "1e6", "--out", "run"}, start);
    ASSERT_TRUE(has_rows(child, folder / "run/forces.csv")) << wait_for(child, start).err;
    kill(child, signal);
    const Outcome outcome = wait_for(child, start);
    EXPECT_EQ(outcome.code, 75) << outcome.err;
    EXPECT_NE(outcome.err.find(signal == SIGINT ? "SIGINT" : "SIGTERM"), std::string::npos);
    const auto run = io::read_run(folder / "run");
    ASSERT_TRUE(run.has_value()) << run.error();
    EXPECT_FALSE(run->summary.find("finished")->boolean());
    EXPECT_EQ(whole_lines(folder / "run/forces.csv"), run->samples.size() + 1);
    whole_lines(folder / "run/events.ndjson");
    EXPECT_TRUE(std::filesystem::exists(folder / "run/final.svg"));
  }
}

/// SIGKILL allows no last words: what is there must be readable all the same.
TEST(RunCommand, AKilledRunLeavesAUsableFolder) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  const pid_t child =
      start_polynya({"run", scene_path("sawamura2017-fig4c"), "--until", "1e6", "--out", "run"}, start);
  ASSERT_TRUE(has_rows(child, folder / "run/forces.csv")) << wait_for(child, start).err;
  kill(child, SIGKILL);
  EXPECT_EQ(wait_for(child, start).code, -SIGKILL);
  const auto run = io::read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_FALSE(run->summary.find("finished")->boolean());
  EXPECT_GT(run->samples.size(), 0U);
  EXPECT_EQ(whole_lines(folder / "run/forces.csv"), run->samples.size() + 1);
}

/// A size limit stands for a full disk.
TEST(RunCommand, AFullDiskIsFiveAndLeavesAUsableFolder) {
  const TemporaryFolder folder;
  const Start start{folder.path(), 20'000};
  const Outcome outcome = polynya(run_for("200", {"--out", "run"}), start);
  EXPECT_EQ(outcome.code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("File too large"), std::string::npos) << outcome.err;
  const auto run = io::read_run(folder / "run");
  ASSERT_TRUE(run.has_value()) << run.error();
  EXPECT_FALSE(run->summary.find("finished")->boolean());
  whole_lines(folder / "run/forces.csv");
  whole_lines(folder / "run/floes.ndjson");
}

TEST(RunCommand, AFolderThatCannotBeMadeIsFive) {
  const TemporaryFolder folder;
  write_file(folder / "file", "x");
  EXPECT_EQ(polynya(run_for("1", {"--out", "file/run"}), {folder.path()}).code, 5);
  EXPECT_EQ(polynya(run_for("1", {"--out", "file"}), {folder.path()}).code, 5);
}

TEST(RunCommand, JsonProgressIsOneObjectALine) {
  const TemporaryFolder folder;
  const Outcome outcome = polynya(run_for("5", {"--progress", "json"}), {folder.path()});
  ASSERT_EQ(outcome.code, 0);
  const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
  const auto document = io::parse_json(line);
  EXPECT_TRUE(document.faults.empty()) << line;
  for (const char* key :
       {"sim_time_s", "until_s", "wall_time_s", "real_time_factor", "time_left_s", "fractures"}) {
    EXPECT_NE(document.root.find(key), nullptr) << key;
  }
  const Outcome quiet = polynya(run_for("5", {"--progress", "none", "--out", "quiet"}), {folder.path()});
  EXPECT_EQ(quiet.err.find('%'), std::string::npos);
}

}  // namespace
}  // namespace polynya::tests
