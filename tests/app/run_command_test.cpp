#include "../io/scene_text.hpp"
#include "interrupted_run.hpp"
#include "program.hpp"
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "app/run/load_scene.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/scene/scene_file.hpp"
#include "io/text/json_parser.hpp"
#include "simulation/world/memory_estimate.hpp"

namespace polynya::tests {
namespace {

class RunCommand : public InFolder {
 protected:
  /// Runs a scene in folder/run.
  Outcome run_scene(const std::string& text) const {
    write("scene.json", text);
    return done("run scene.json --out run --overwrite");
  }
  io::Run read_run(const std::string& name = "run") const { return std::move(*checked(io::read_run(folder / name))); }
};

TEST_F(RunCommand, WritesAFolderAndTellsTheResult) {
  EXPECT_HAS(done("run scenes/level-plate.json --until 10").out, "simulated   10 s", "real time",
             "cusps broken by bending", "splits", "imbalance", "ice force", "run folder  runs/level-plate",
             "picture     runs/level-plate/final.");
  const io::Run run = read_run("runs/level-plate");
  EXPECT_TRUE(run.summary.find("finished")->boolean());
  EXPECT_EQ(run.samples.size(), 100U);
  EXPECT_NEAR(run.end_time(), 10, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(folder / "runs/level-plate/final.svg"));
  EXPECT_GT(run.summary.find("counts")->find("bends")->number(), 0);
}

/// Returns the line of a text that contains the given words, or an empty text if there is none.
std::string line_with(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  if (at == std::string::npos) return "";
  const std::size_t start = text.rfind('\n', at) + 1;
  return text.substr(start, text.find('\n', at) - start);
}

/// Returns the number after "surge" in a line such as "… surge -565.3 kN" [N].
double surge_in(const std::string& line) {
  double value = 0;
  char unit[4] = "";
  EXPECT_EQ(std::sscanf(line.c_str() + line.find("surge"), "surge %lf %3s", &value, unit), 2) << line;
  return value * (unit[0] == 'M' ? 1e6 : unit[0] == 'k' ? 1e3 : 1);
}

TEST_F(RunCommand, LeadsWithTheTrueForce) {
  for (const std::string model : {"michel", "lefm"}) {
    const Outcome outcome = run_scene(
        scene({R"("time": {"until_s": 20}, "fracture": {"splitting": {"model": ")" + model + "\"}}",
               list("ships", {ship(R"("position_m": [-62, 0], "propulsion": {"constant_speed_m_per_s": 1})")}),
               list("floes", {R"({"rectangle": {"corner_m": [0, -75], "size_m": [300, 150]}})"})}));
    const io::Run run = read_run();
    double mean = 0, step = 0;
    for (const simulation::HullSample& sample : run.samples) {
      mean = std::min(mean, sample.from_ice.surge);
      step = std::min(step, sample.from_ice_largest.surge);
    }
    const std::size_t first = outcome.out.find("ice force"), last = outcome.out.find("j/τ_c");
    EXPECT_NEAR(surge_in(line_with(outcome.out, "largest mean over 0.1 s")) / mean, 1, 1e-3) << outcome.out;
    EXPECT_NEAR(surge_in(line_with(outcome.out, "largest single step; depends on the step")) / step, 1, 1e-3);
    const std::size_t peak = outcome.out.find("ice peak"), single = outcome.out.find("largest single step");
    EXPECT_LT(peak, single) << outcome.out;
    EXPECT_HAS(line_with(outcome.out, "ice peak"), "largest of one contact, by a gauge of 0.02 s");
    const io::JsonValue& peaks = run.summary.find("peaks")->items()[0];
    EXPECT_EQ(peaks.find("surge_N")->find("value")->number(), mean);
    EXPECT_EQ(peaks.find("surge_max_N")->find("value")->number(), step);
    double of_contact = 0;
    for (const io::RunContact& contact : run.peaks) of_contact = std::max(of_contact, contact.state.normal_force());
    EXPECT_EQ(peaks.find("contact_peak_N")->find("value")->number(), of_contact);
    EXPECT_EQ(run.summary.find("forces_interval_s")->number(), 0.1);
    // The output has j/τ_c only if it decides splits, and then after the true force.
    EXPECT_EQ(last != std::string::npos, model == "michel") << outcome.out;
    EXPECT_EQ(peaks.find("surge_j_over_tau_c_N") != nullptr, model == "michel");
    if (last != std::string::npos) {
      EXPECT_LT(first, last);
    }
  }
}

TEST_F(RunCommand, AMooringThatBreaksIsAnEventOfEveryView) {
  const Outcome outcome =
      run_scene(scene({R"("time": {"step_s": 0.1, "until_s": 60}, "floes": [])",
                       list("ships", {ship(R"("name": "tanker", "hull": {"length_m": 100}, "position_m": [5, 0], )"
                                           R"("propulsion": {"thrust_N": 2e5},
      "mooring": {"surge_stiffness_N_per_m": 1e4, "surge_damping_N_s_per_m": 1e5, "sway_stiffness_N_per_m": 1e4,
                  "break_load_N": 1e5})")})}));
  EXPECT_HAS(line_with(outcome.err, "mooring of tanker broke at"), "events.ndjson");
  const std::string events = done("inspect run --events").out, line = read("run/events.ndjson");
  EXPECT_HAS(events, "mooring_break of tanker at (", "breaks above 1e+05 N");
  EXPECT_EQ(std::ranges::count(events, '\n'), 1);
  EXPECT_HAS(done("inspect run --events --json").out, line.substr(0, line.size() - 1));
}

TEST_F(RunCommand, ShipsThatMeetAreReportedAndNoIceLoad) {
  const std::string hull = R"("hull": {"length_m": 100, "beam_m": 20}, "propulsion": )";
  const Outcome outcome = run_scene(
      scene({R"("time": {"until_s": 30, "step_s": 0.01}, "floes": [])",
             R"("structures": [{"name": "pier", "radius_m": 5, "position_m": [70, 0]}])",
             list("ships", {ship(hull + R"({"constant_speed_m_per_s": 1}, "name": "leader", "position_m": [0, 0])"),
                            ship(hull + R"({"thrust_N": 0}, "name": "follower", "position_m": [-110, 0],
                                     "speed_m_per_s": 2)")})}));
  const std::string met = line_with(outcome.err, "leader and follower came into contact");
  EXPECT_HAS(met, "closing at 1 m/s", "_from_ships") << outcome.err;
  const std::string through = line_with(outcome.err, "leader and pier came into contact");
  EXPECT_HAS(through, "pass through each other") << outcome.err;
  EXPECT_HAS(line_with(outcome.out, "ship force  leader"), "surge") << outcome.out;
  EXPECT_HAS(outcome.out, "ship force  follower: surge -");
  const io::Run run = read_run();
  EXPECT_EQ(run.summary.find("warnings")->items().size(), 2U);
  ASSERT_EQ(run.events.size(), 2U);
  EXPECT_NEAR(run.events[0].time, 10, 0.02);
  EXPECT_NEAR(run.events[1].time, 15, 0.02);
  EXPECT_TRUE(std::get<simulation::HullContact>(run.events[1].what).is_prescribed);
}

TEST_F(RunCommand, JsonProgressIsOneObjectALine) {
  const std::string progress = done("run scenes/level-plate.json --until 5 --progress json").err;
  const std::string line = progress.substr(0, progress.find('\n'));
  const auto document = io::parse_json(line);
  EXPECT_TRUE(document.faults.empty()) << line;
  for (const char* key : {"sim_time_s", "until_s", "wall_time_s", "real_time_factor", "time_left_s", "fractures"}) {
    EXPECT_NE(document.root.find(key), nullptr) << key;
  }
  EXPECT_LACKS(done("run scenes/level-plate.json --until 5 --progress none --out quiet").err, "%");
}

TEST_F(RunCommand, ProductsAreMadeOfARunAndRemovedWithIt) {
  done("run scenes/level-plate.json --until 30 --out run");
  done("channel run");
  EXPECT_BEGINS(read("run/channel.csv"), "station,along_m,");
  EXPECT_HAS(read("run/channel.geojson"), "\"swept band\"");

  const std::string sums = done("channel run --json").out;
  EXPECT_BEGINS(sums, "{\n");
  EXPECT_EQ(sums, done("channel run --format json").out) << "its older spelling";

  // `polynya figures` writes these (tests/python/test_figures.py).
  for (const auto name : io::run_file::kFigures)
    for (const char* suffix : {".svg", ".png", ".pdf"})
      write_file(std::filesystem::path(folder / ("run/" + std::string(name))).replace_extension(suffix), "");

  EXPECT_HAS(done("export run --vtk vtk --geojson gis").err, "no \"origin\"");
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/run.pvd"));

  done("run scenes/level-plate.json --until 1 --out run --overwrite");
  for (const std::string name :
       {"channel.csv", "channel.geojson", "figure-loads.svg", "figure-energy.png", "figure-floes.pdf"})
    EXPECT_FALSE(std::filesystem::exists(folder / ("run/" + name))) << name;
}

// ---- a run that does not fit into memory: refused before it starts, or ended as one that was killed

/// Returns a scene of floes in a square that are at rest until the first step. All of them start to move in that step,
/// which takes more memory than before. The scene has two steps.
std::string drifting_floes(int rows) {
  return R"({"name": "drifting", "time": {"step_s": 0.02, "until_s": 0.04}, "record": {"frames_interval_s": 0.02},
    "floes": [{"lattice": {"rows": )" +
         std::to_string(rows) + R"(, "columns": )" + std::to_string(rows) +
         R"(, "pitch_m": 10, "size_m": 9.5}, "velocity_m_per_s": [0.1, 0]}]})";
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these take all addresses

constexpr rlim_t kMegabyte = 1'000'000;

Outcome run_within(rlim_t addresses, const Start& start, const Words& words) {
  Start limited = start;
  limited.arrange_streams = [addresses] {
    const rlimit limit{addresses, addresses};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(126);
  };
  return polynya(words, limited);
}

/// A run that ends for lack of memory leaves the same as `kill -9` does: nothing, or a folder that can be resumed.
TEST(Memory, RunsOutAndLeavesNothingOrARunThatGoesOn) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  write_file(folder / "scene.json", drifting_floes(100));
  ASSERT_EQ(polynya("run scene.json --out whole --progress none", start).code, 0);
  int before = 0, during = 0;
  for (rlim_t limit = 40; limit < 400; limit += 20) {
    const std::string out = "run" + std::to_string(limit);
    const Outcome outcome =
        run_within(limit * kMegabyte, start, {"run", "scene.json", "--out", out, "--progress", "none"});
    if (outcome.code == 0) break;
    SCOPED_TRACE(std::to_string(limit) + " MB: " + outcome.err);
    if (!std::filesystem::exists(folder / out)) {
      ++before;
      continue;
    }
    if (outcome.code == 4) {
      EXPECT_HAS(outcome.err, "polynya resume " + out);
    }
    if (++during % 3 != 1) continue;
    EXPECT_EQ(polynya({"resume", out, "--progress", "none"}, start).code, 0);
    EXPECT_EQ(first_difference(folder / "whole", folder / out), "");
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(during, 0);
}

/// The most memory that a run had [bytes]. Without rsvg-convert, whose memory would count too.
double peak_of_run(const std::string& scene, Start start) {
  start.arrange_streams = [] { setenv("PATH", "", 1); };
  const pid_t child = start_polynya({"run", scene, "--out", scene + "-run", "--progress", "none"}, start);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TEST(Memory, IsEstimatedWithinAFactorOfWhatRunsTake) {
  const TemporaryFolder folder;
  const Start start{folder.path()};
  write_file(folder / "few.json", drifting_floes(2));
  const double program = peak_of_run("few.json", start);
  for (const int rows : {50, 100}) {
    const std::string name = std::to_string(rows) + ".json";
    write_file(folder / name, drifting_floes(rows));
    const double taken = peak_of_run(name, start) - program;
    const auto scene = checked(io::read_scene_file(folder / name));
    const simulation::MemoryEstimate estimate = simulation::estimate_memory(scene->scene);
    EXPECT_LT(estimate.at_start, taken) << "a run that fits would be refused";
    EXPECT_LT(taken, 7 * estimate.at_start);
    EXPECT_LT(estimate.all_moving, 1.5 * taken);
    EXPECT_LT(taken, 1.5 * estimate.all_moving);
  }
}

#endif

using app::may_fit;

TEST(MemoryCheck, RefusesWhatSurelyDoesNotFitAndNotesWhatMayNot) {
  simulation::Scene scene;
  const geometry::Ring square{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  scene.floes.assign(1000, {{square, {}}, {}, 0});
  const auto said_of = [&](double bytes, bool expected) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(may_fit(scene, "scene.json", {bytes, "a limit"}), expected);
    return testing::internal::GetCapturedStderr();
  };
  const std::string refusal = said_of(200e3, false);
  EXPECT_HAS(refusal,
             "scene.json: 1000 floes need at least 1 MB of memory, and 0 MB are available (a limit); "
             "nothing was written");
  EXPECT_HAS(said_of(3e6, true), "note: scene.json: the run takes about");
  EXPECT_EQ(said_of(1e9, true), "");
}

}  // namespace
}  // namespace polynya::tests
