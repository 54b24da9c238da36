// Figures of runs with several ships: each has its own panels and curves, and all its own numbers.
#include "io/figures.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace polynya::io {
namespace {

/// Two ships and a structure: each one's surge goes to its own extremes, and the second breaks a floe.
Run run_of_three(const std::string& name) {
  const std::string hull = R"("hull": {"length_m": 40, "beam_m": 8, "entrance_angle_deg": 27}, "mass_kg": 1e6,
    "moment_of_inertia_kg_m2": 1e8, "propulsion": {"constant_speed_m_per_s": 1})";
  auto scene =
      read_scene(R"({"name": ")" + name + R"(", "ships": [{"name": "north", "position_m": [0, 50], )" + hull +
                     R"(}, {"name": "south", )" + hull +
                     R"(}], "structures": [{"name": "pile", "radius_m": 5, "position_m": [90, 0]}],
    "floes": [{"rectangle": {"corner_m": [200, 0], "size_m": 10}}]})",
                 "scene.json", ".");
  EXPECT_TRUE(scene.has_value());
  Run run;
  run.scene = std::move(*scene);
  for (int step = 1; step <= 100; ++step) {
    for (int ship = 0; ship < 3; ++ship) {
      simulation::ShipSample sample;
      sample.time = 0.1 * step;
      sample.ship = ship;
      sample.surge_max = step == 50 ? -1e5 * (ship + 1) : 10 * step;
      sample.velocity_in_world = {ship + 1.0, 0};
      run.samples.push_back(sample);
    }
  }
  run.frames = {{.time = 0, .ships = {}, .floes = {}}, {.time = 10, .ships = {}, .floes = {}}};
  simulation::Event event;
  event.time = 5;
  event.ship = 1;
  run.events = {event};
  return run;
}

double least(const Chart::Panel& panel) {
  return std::ranges::min(panel.curves.at(0).points, {}, &Chart::Point::y).y;
}

TEST(Figures, EveryShipAndStructureHasItsLoads) {
  std::vector<io::Run> runs;
  runs.push_back(run_of_three("harbour"));
  const Chart chart = load_figure(runs, "max");
  EXPECT_EQ(chart.columns, 3U);
  ASSERT_EQ(chart.panels.size(), 9U);
  const char* names[] = {"harbour, north: surge", "harbour, south: surge", "harbour, pile: surge"};
  for (std::size_t ship = 0; ship < 3; ++ship) {
    EXPECT_EQ(chart.panels[ship].title, names[ship]);
    EXPECT_NEAR(least(chart.panels[ship]), -100 * (static_cast<double>(ship) + 1), 1e-9) << "in kN";
    EXPECT_EQ(chart.panels[ship].marks.size(), ship == 1 ? 1U : 0U);
    EXPECT_EQ(chart.panels[ship].y.range, chart.panels[0].y.range) << "one scale";
  }
}

TEST(Figures, LeadWithTheTrueForce) {
  std::vector<io::Run> runs;
  runs.push_back(run_of_three("harbour"));
  for (simulation::ShipSample& sample : runs[0].samples) {
    sample.surge_force = -7e3;
    sample.surge_peak = -1e9;
    sample.surge_from_ships = -3e9;
  }
  const Chart chart = load_figure(runs, "true");
  const Chart::Panel& surge = chart.panels.at(0);
  ASSERT_EQ(surge.curves.size(), 2U);
  EXPECT_EQ(surge.curves[0].name, "single step of 0.005 s");
  EXPECT_EQ(surge.curves[1].name, "mean over 0.1 s") << "in front";
  EXPECT_NEAR(std::ranges::min(surge.curves[1].points, {}, &Chart::Point::y).y, -7, 1e-9) << "in kN";
  EXPECT_NEAR(surge.y.range->first, -300, 1e-9) << "neither j/τ_c nor the other ships are in its scale";
  const Chart by_ships = load_figure(runs, "ships"), by_the_paper = load_figure(runs, "j-over-tau-c");
  EXPECT_NEAR(by_ships.panels.at(0).curves.at(1).points.at(0).y, -3, 1e-9) << "in GN";
  EXPECT_NEAR(least(by_the_paper.panels.at(0)), -1, 1e-9) << "in GN";
  runs[0].scene.scene.fracture.splitting = fracture::SplittingModel::kLefm;
  EXPECT_TRUE(load_figure(runs, "j-over-tau-c").panels.empty()) << "nothing there splits by it";
}

TEST(Figures, ShipsOfSeveralRunsStandInRowsOfThree) {
  std::vector<io::Run> runs;
  for (const char* name : {"a", "b", "c"}) runs.push_back(run_of_three(name));
  const Chart nine = load_figure(runs, "max");
  EXPECT_EQ(nine.columns, 3U);
  EXPECT_EQ(nine.panels.size(), 27U);
  EXPECT_EQ(nine.panels[9].title, "b, north: surge");
  runs.pop_back();
  runs.back().scene.scene.ships.pop_back();
  const Chart five = load_figure(runs, "max");
  ASSERT_EQ(five.panels.size(), 18U);
  EXPECT_EQ(five.panels[10].title, "b, south: surge");
  EXPECT_EQ(five.panels[11].title, "") << "a place left blank";
  const std::string svg = to_svg(five);
  std::size_t frames = 0;
  for (std::size_t at = svg.find("<clipPath"); at != std::string::npos; at = svg.find("<clipPath", at + 1))
    ++frames;
  EXPECT_EQ(frames, 15U);
}

TEST(Figures, EveryShipHasItsSpeedAndItsName) {
  std::vector<io::Run> runs;
  runs.push_back(run_of_three("harbour"));
  const Chart chart = motion_figure(runs);
  const Chart::Panel& speed = chart.panels.at(0);
  ASSERT_EQ(speed.curves.size(), 3U);
  for (std::size_t ship = 0; ship < 3; ++ship) {
    ASSERT_EQ(speed.curves[ship].points.size(), 100U);
    EXPECT_EQ(speed.curves[ship].points[50].y, static_cast<double>(ship) + 1);
    EXPECT_NE(speed.curves[ship].colour, speed.curves[(ship + 1) % 3].colour);
  }
  for (const char* name : {"harbour, north", "harbour, south", "harbour, pile"})
    EXPECT_NE(to_svg(chart).find(std::string(name) + "</text>"), std::string::npos) << "in the legend";
}

}  // namespace
}  // namespace polynya::io
