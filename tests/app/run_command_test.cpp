#include "../io/scene_text.hpp"
#include "interrupted_run.hpp"
#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::tests {
namespace {

TEST(RunCommand, WritesAFolderAndTellsTheResult) {
  const TemporaryFolder folder;
  EXPECT_HAS(expect_code(0, polynya("run scenes/level-plate.json --until 10", folder)).out, "simulated   10 s",
             "real time", "cusps broken by bending", "splits", "imbalance", "ice force", "run folder  runs/level-plate",
             "picture     runs/level-plate/final.");
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
    const Outcome outcome = expect_code(0, polynya({"run", "scene.json", "--out", model}, folder));
    const auto run = checked(io::read_run(folder / model));
    double mean = 0, step = 0;
    for (const simulation::HullSample& sample : run->samples) {
      mean = std::min(mean, sample.from_ice.surge);
      step = std::min(step, sample.from_ice_largest.surge);
    }
    const std::size_t first = outcome.out.find("ice force"), last = outcome.out.find("j/τ_c");
    EXPECT_NEAR(surge_in(line_with(outcome.out, "largest mean over 0.1 s")) / mean, 1, 1e-3) << outcome.out;
    EXPECT_NEAR(surge_in(line_with(outcome.out, "largest single step of")) / step, 1, 1e-3);
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
  const Outcome outcome = expect_code(0, polynya("run scene.json --out run", folder));
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
      scene({R"("time": {"until_s": 30, "step_s": 0.01}, "floes": [])",
             R"("structures": [{"name": "pier", "radius_m": 5, "position_m": [70, 0]}])",
             list("ships", {ship(hull + R"({"constant_speed_m_per_s": 1}, "name": "leader", "position_m": [0, 0])"),
                            ship(hull + R"({"thrust_N": 0}, "name": "follower", "position_m": [-110, 0],
                                     "speed_m_per_s": 2)")})}));
  const Outcome outcome = expect_code(0, polynya("run scene.json --out run", folder));
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
  EXPECT_TRUE(std::get<simulation::HullContact>(run->events[1].what).is_prescribed);
}

TEST(RunCommand, AnExistingRunIsKeptUnlessTold) {
  const TemporaryFolder folder;
  ASSERT_EQ(polynya("run scenes/level-plate.json --until 2", folder).code, 0);
  const std::string kept = read_file(folder / "runs/level-plate/forces.csv");
  EXPECT_HAS(expect_code(5, polynya("run scenes/level-plate.json --until 3", folder)).err, "--overwrite");
  EXPECT_EQ(read_file(folder / "runs/level-plate/forces.csv"), kept);
  EXPECT_EQ(polynya("run scenes/level-plate.json --until 3 --overwrite", folder).code, 0);
  EXPECT_NE(read_file(folder / "runs/level-plate/forces.csv"), kept);
}

TEST(RunCommand, JsonProgressIsOneObjectALine) {
  const TemporaryFolder folder;
  const Outcome outcome = expect_code(0, polynya("run scenes/level-plate.json --until 5 --progress json", folder));
  const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
  const auto document = io::parse_json(line);
  EXPECT_TRUE(document.faults.empty()) << line;
  for (const char* key : {"sim_time_s", "until_s", "wall_time_s", "real_time_factor", "time_left_s", "fractures"}) {
    EXPECT_NE(document.root.find(key), nullptr) << key;
  }
  const Outcome quiet = polynya("run scenes/level-plate.json --until 5 --progress none --out quiet", folder);
  EXPECT_LACKS(quiet.err, "%");
}

TEST(Products, AreMadeOfARunAndRemovedWithIt) {
  const TemporaryFolder folder;
  const Start here{folder.path()};
  ASSERT_EQ(polynya("run scenes/level-plate.json --until 30 --out run", here).code, 0);

  ASSERT_EQ(polynya("channel run", here).code, 0);
  EXPECT_TRUE(read_file(folder / "run/channel.csv").starts_with("station,along_m,"));
  EXPECT_HAS(read_file(folder / "run/channel.geojson"), "\"swept band\"");

  const Outcome sums = expect_code(0, polynya("channel run --json", here));
  EXPECT_TRUE(sums.out.starts_with("{\n")) << sums.out;
  EXPECT_EQ(sums.out, polynya("channel run --format json", here).out) << "its older spelling";

  // `polynya figures` writes these (tests/python/test_figures.py).
  for (const auto name : io::run_file::kFigures)
    for (const char* suffix : {".svg", ".png", ".pdf"})
      write_file(std::filesystem::path(folder / ("run/" + std::string(name))).replace_extension(suffix), "");

  EXPECT_HAS(expect_code(0, polynya("export run --vtk vtk --geojson gis", here)).err, "no \"origin\"");
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/run.pvd"));

  ASSERT_EQ(polynya("run scenes/level-plate.json --until 1 --out run --overwrite", here).code, 0);
  for (const std::string name :
       {"channel.csv", "channel.geojson", "figure-loads.svg", "figure-energy.png", "figure-floes.pdf"})
    EXPECT_FALSE(std::filesystem::exists(folder / ("run/" + name))) << name;
}

}  // namespace
}  // namespace polynya::tests
