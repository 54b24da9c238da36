// Figures of runs with several ships: each has its own panels and curves, and all its own numbers.
#include "views/map/figures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "../io/temporary_folder.hpp"
#include <gtest/gtest.h>

#include "io/text/json_parser.hpp"
#include "views/export/geojson_export.hpp"
#include "views/export/vtk_export.hpp"

namespace polynya::views {
namespace {

/// Two ships and a structure: each one's surge goes to its own extremes, and the second breaks a floe.
io::Run run_of_three(const std::string& name) {
  const std::string hull = R"("hull": {"length_m": 40, "beam_m": 8, "entrance_angle_deg": 27}, "mass_kg": 1e6,
    "moment_of_inertia_kg_m2": 1e8, "propulsion": {"constant_speed_m_per_s": 1})";
  auto scene =
      io::read_scene(R"({"name": ")" + name + R"(", "ships": [{"name": "north", "position_m": [0, 50], )" +
                         hull + R"(}, {"name": "south", )" + hull +
                         R"(}], "structures": [{"name": "pile", "radius_m": 5, "position_m": [90, 0]}],
    "floes": [{"rectangle": {"corner_m": [200, 0], "size_m": 10}}]})",
                     "scene.json", ".");
  EXPECT_TRUE(scene.has_value());
  io::Run run;
  run.scene = std::move(*scene);
  run.label = name;
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
  runs[0].scene.scene.fracture.splitting = fracture::SplittingModel::kMichel;
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

/// The numbers of an attribute, in the order they stand.
std::vector<double> numbers_of(const std::string& svg, const std::string& attribute) {
  std::vector<double> numbers;
  const std::string mark = " " + attribute + "='";
  for (std::size_t at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + 1))
    numbers.push_back(std::stod(svg.substr(at + mark.size())));
  return numbers;
}

/// A run whose figures have something to show: floes, and energy that came and went.
io::Run run_with_energy(const std::string& name) {
  io::Run run = run_of_three(name);
  for (int i = 0; i < 5; ++i) {
    io::RunFloe floe;
    floe.birth.floe = i;
    floe.birth.area = 10.0 * (i + 1) * (i + 1);
    run.floes.push_back(floe);
    run.shapes.add({{{20.0 * i, 0}, {20.0 * i + 3 * (i + 1), 0}, {20.0 * i, 3.0 * (i + 1)}}, {}});
  }
  run.summary =
      io::parse_json(R"({"energy": {"initial_J": 1e6, "kinetic_J": 2e6, "thrust_J": 5e6, "current_J": 0,
    "drag_J": 1e6, "crushing_J": 3e6, "imbalance_J": 0, "turnover_J": 6e6}})")
          .root;
  return run;
}

std::vector<std::string> pages_of(const std::vector<io::Run>& runs, const PageStyle& page) {
  PictureSheet maps = map_figure(runs, {0, 10});
  maps.page = page;
  Chart motion = motion_figure(runs), sizes = size_figure(runs);
  motion.page = sizes.page = page;
  return {to_svg(maps), to_svg(load_figure(runs, "true", page)), to_svg(motion), to_svg(sizes),
          energy_figure(runs, page)};
}

// The page is as wide as asked, its words have 7 to 9 pt there, and end on it.
TEST(Figures, AreReadableAtTheirWidthOnPaper) {
  std::vector<io::Run> runs;
  for (const char* name : {"a-scene-of-a-long-name", "another-scene-of-a-long-name"})
    runs.push_back(run_with_energy(name));
  for (const double width : {85.0, 170.0, 260.0}) {
    for (const std::string& svg : pages_of(runs, {width, {}})) {
      EXPECT_NEAR(numbers_of(svg, "width").front(), width, 0.01);
      const std::size_t box = svg.find("viewBox='0 0 ");
      const double pixels = std::stod(svg.substr(box + 13));
      const double points = width / pixels / 25.4 * 72;  // of a pixel
      const std::vector<double> sizes = numbers_of(svg, "font-size");
      EXPECT_GT(sizes.size(), 5U);
      for (const double size : sizes) {
        EXPECT_GE(size * points, 6.99) << width;
        EXPECT_LE(size * points, 9.01) << width;
      }
      for (std::size_t at = svg.find("<text x='"); at != std::string::npos;
           at = svg.find("<text x='", at + 1)) {
        const std::size_t words = svg.find('>', at) + 1;
        const std::string tag = svg.substr(at, words - at);
        const double x = std::stod(tag.substr(9)), size = numbers_of(tag, "font-size").front();
        const double length = width_of(svg.substr(words, svg.find("</text>", words) - words), size);
        const bool is_middle = tag.find("'middle'") != std::string::npos,
                   is_end = tag.find("'end'") != std::string::npos;
        const double left = is_middle ? x - length / 2 : is_end ? x - length : x;
        EXPECT_GE(left, -1) << tag << " at " << width;
        EXPECT_LE(left + length, pixels + 1) << tag << " at " << width;
      }
    }
  }
}

TEST(Figures, HaveTheTitleAndTheLabelsTheyAreGiven) {
  std::vector<io::Run> runs;
  for (const char* name : {"harbour", "roads"}) runs.push_back(run_with_energy(name));
  runs[0].label = "10 m floes";
  for (const std::string& svg : pages_of(runs, {170, "A title of mine"})) {
    EXPECT_NE(svg.find(">A title of mine</text>"), std::string::npos);
    EXPECT_NE(svg.find("10 m floes"), std::string::npos);
    EXPECT_EQ(svg.find("harbour"), std::string::npos);
  }
  for (const std::string& svg : pages_of(runs, {170, ""}))
    EXPECT_EQ(svg.find("font-size='18'"), std::string::npos);
}

TEST(Figures, PanelsHaveLettersWhereThereAreSeveral) {
  std::vector<io::Run> runs;
  runs.push_back(run_with_energy("harbour"));
  for (const std::string& svg : pages_of(runs, {})) {
    EXPECT_NE(svg.find(">(a) "), std::string::npos);
    EXPECT_NE(svg.find(">(b) "), std::string::npos);
  }
  EXPECT_EQ(to_svg(map_figure(runs, {0})).find("(a) "), std::string::npos);
  EXPECT_EQ(letter_of(27, 28), "(ab) ");
}

TEST(Figures, SharesOfTheIceEndAtAHundredPercent) {
  std::vector<io::Run> runs;
  runs.push_back(run_with_energy("harbour"));
  const Chart sizes = size_figure(runs);
  EXPECT_EQ(sizes.panels.at(1).y.range, (std::pair{0.0, 100.0}));
  const std::string svg = to_svg(sizes);
  EXPECT_NE(svg.find(">100</text>"), std::string::npos);
  EXPECT_EQ(svg.find(">120</text>"), std::string::npos);
}

TEST(Figures, EnergyKeepsSourcesAndSinksApart) {
  std::vector<io::Run> runs;
  runs.push_back(run_with_energy("harbour"));
  const std::string svg = energy_figure(runs);
  const auto at = [&](const char* words) { return svg.find(std::string(">") + words + "</text>"); };
  for (const char* words : {"motion at the start", "thrust and holding", "current"}) {
    EXPECT_GT(at(words), at("(a) Sources"));
    EXPECT_LT(at(words), at("(b) Sinks")) << words;
  }
  for (const char* words : {"motion at the end", "water drag", "crushing"}) {
    EXPECT_GT(at(words), at("(b) Sinks")) << words;
    EXPECT_NE(at(words), std::string::npos) << words;
  }
}

TEST(Figures, AWindowShowsItsPartOfTheWorld) {
  std::vector<io::Run> runs;
  runs.push_back(run_with_energy("harbour"));
  PictureSheet sheet = map_figure(runs, {0});
  const std::string whole = to_svg(sheet);
  sheet.window = geometry::Box{{195, -5}, {215, 15}};
  const std::string part = to_svg(sheet);
  // The floe of 10 m takes half of the window across, and so 20 times as much as of the whole.
  const auto width_of_ice = [](const std::string& svg) {
    const std::size_t at = svg.find("<path d='M", svg.find("fill='#a9cadd'"));
    const std::size_t line = svg.find('L', at);
    return std::stod(svg.substr(line + 1)) - std::stod(svg.substr(at + 10));
  };
  EXPECT_NEAR(width_of_ice(part) / numbers_of(part.substr(part.find("<clipPath")), "width").front(), 0.5,
              0.01);
  EXPECT_GT(width_of_ice(part), 5 * width_of_ice(whole));
}

/// Of the five floes the first floats all the time, the second is under a hull from 5 s on, and the third
/// came up.
io::Run run_with_ice_under_a_hull() {
  io::Run run = run_with_energy("level");
  run.scene.scene.ships[0].hull.draught = 6;
  run.floes[1].went_under = 5;
  run.floes[2].came_up = true;
  run.floes[2].birth.generation = 2;
  for (const auto kind : {simulation::EventKind::kSubmerge, simulation::EventKind::kSubmerge,
                          simulation::EventKind::kResurface, simulation::EventKind::kStayUnder}) {
    simulation::Event event;
    event.time = 5;
    event.ship = 1;
    event.kind = kind;
    run.events.push_back(event);
  }
  return run;
}

std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

TEST(Figures, AWallIsDrawnAsOneAndLeavesNoTrack) {
  Picture picture;
  picture.ships.push_back({{{0, 0}, {50, 0}, {50, 5}, {0, 5}}, {{25, 0}, {25, 9}}, true});
  const std::string walls = to_svg(picture);
  EXPECT_NE(walls.find(">wall<"), std::string::npos);
  EXPECT_EQ(walls.find("<polyline"), std::string::npos);
  picture.ships.front().is_wall = false;
  const std::string ships = to_svg(picture);
  EXPECT_EQ(ships.find(">wall<"), std::string::npos);
  EXPECT_NE(ships.find("<polyline"), std::string::npos);
}

TEST(Figures, IceUnderAHullIsNeitherFloatingIceNorAFracture) {
  std::vector<io::Run> runs;
  runs.push_back(run_with_ice_under_a_hull());
  const Picture picture = picture_at(runs[0], io::MotionIndex(runs[0]), 10);
  EXPECT_EQ(picture.floes.size(), 4U);
  EXPECT_EQ(picture.ice_under_hulls.size(), 1U);
  EXPECT_EQ(picture.fractures.size(), 1U);
  const PictureSheet maps = map_figure(runs, {0, 10});
  EXPECT_EQ(maps.pictures[0].caption, "0 cusps, 0 splits, 5 floes");
  EXPECT_EQ(maps.pictures[1].caption, "1 cusps, 0 splits, 4 floes; 2 pieces went under the hull, 1 came up");
  EXPECT_EQ(load_figure(runs, "max").panels.at(1).marks.size(), 1U);
  const std::string with = to_svg(maps), without = to_svg(map_figure({run_with_energy("plain")}, {0, 10}));
  for (const char* words :
       {">ice under the hull or waiting behind it<", ">piece that came up from under the hull<"}) {
    EXPECT_EQ(count_of(with, words), 1U) << words;
    EXPECT_EQ(count_of(without, words), 0U) << words;
  }
}

TEST(Figures, IceUnderAHullHasALayerOfItsOwn) {
  const io::Run run = run_with_ice_under_a_hull();
  const auto layers = geojson_layers(run, 10, {});
  ASSERT_EQ(layers.size(), 6U);
  EXPECT_EQ(count_of(layers[0].second, "\"floe_id\""), 4U);
  EXPECT_EQ(count_of(layers[0].second, "\"came_up\":true"), 1U);
  EXPECT_EQ(count_of(layers[1].second, "\"kind\""), 1U);
  EXPECT_EQ(layers[5].first, "under-hull.geojson");
  EXPECT_EQ(count_of(layers[5].second, "\"floe_id\""), 1U);
  EXPECT_EQ(count_of(layers[5].second, "\"went_under_s\":5"), 1U);
  EXPECT_EQ(geojson_layers(run_with_energy("plain"), 10, {}).size(), 5U);
}

TEST(Figures, IceUnderAHullIsAPartOfTheVtkExport) {
  const tests::TemporaryFolder folder;
  ASSERT_TRUE(export_vtk(run_with_ice_under_a_hull(), {}, folder.path()).has_value());
  const auto count = [&](const char* file, const std::string& words) {
    std::ifstream stream(folder.path() / file);
    EXPECT_TRUE(stream) << file;
    return count_of({std::istreambuf_iterator<char>(stream), {}}, words);
  };
  EXPECT_EQ(count("run.pvd", "under-hull-"), 2U);
  EXPECT_EQ(count("under-hull-00000.vtp", "NumberOfLines=\"0\""), 1U);
  EXPECT_EQ(count("under-hull-00001.vtp", "NumberOfLines=\"1\""), 1U);
  EXPECT_EQ(count("ice-00001.vtp", "NumberOfLines=\"4\""), 1U);
  EXPECT_EQ(count("loads-00001.vtp", "NumberOfVerts=\"4\""), 1U) << "three ships and one fracture";
}

TEST(Figures, ALegendKeepsEachSwatchBesideItsWords) {
  const std::vector<Legend::Entry> entries{
      {"short"}, {"words that take up more than the whole of a narrow page do not leave it"}, {"last"}};
  const Legend legend(entries, 10, 200);
  SvgText svg(210, 300);
  double before = -1;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const geometry::Point at = legend.draw(svg, i, 0);
    EXPECT_NEAR(at.x, 10, 1e-9) << "no room for a second one in the row";
    EXPECT_GT(at.y, before);
    before = at.y;
  }
  EXPECT_LE(before, legend.height());
  const std::string text = svg.finish();
  const std::vector<double> x = numbers_of(text, "x");
  EXPECT_GT(x.size(), 5U) << "the long words in lines";
  for (const double left : x) EXPECT_NEAR(left, 68, 1e-9) << "beside the swatches";
}

}  // namespace
}  // namespace polynya::views
