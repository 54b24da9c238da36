// The map of a run's end, and the layers of exports, with ice under a hull.
#include "views/map/final_map.hpp"

#include <algorithm>
#include <map>

#include "../io/scene_text.hpp"
#include "../io/temporary_folder.hpp"

#include "views/export/export.hpp"

namespace polynya::views {
namespace {

/// Two ships and a structure; the second ship breaks a floe. `more` are further members of the scene.
io::Run run_of_three(const std::string& name, const std::string& more = "") {
  const auto named = [](const std::string& members) {
    return tests::ship(R"("hull": {"length_m": 40, "beam_m": 8}, "propulsion": {"constant_speed_m_per_s": 1}, )" +
                       members);
  };
  io::Run run;
  run.scene =
      tests::load(tests::scene({"\"name\": \"" + name + '"' + more, tests::list("floes", {tests::square(200, 0, 10)}),
                                tests::list("ships", {named(R"("name": "north", "position_m": [0, 50])"),
                                                      named(R"("name": "south", "position_m": [0, 0])")}),
                                R"("structures": [{"name": "pile", "radius_m": 5, "position_m": [90, 0]}])"}));
  run.label = name;
  for (int ship = 0; ship < 3; ++ship) {
    simulation::HullSample& sample = run.samples.emplace_back();
    sample.time = 10;
    sample.ship = ship;
  }
  run.frames = {{.time = 0, .ships = {}, .floes = {}}, {.time = 10, .ships = {}, .floes = {}}};
  run.events = {{5, 1, {}, simulation::Bend()}};
  return run;
}

/// Returns the numbers of an attribute, in the order in which they occur.
std::vector<double> numbers_of(const std::string& svg, const std::string& attribute) {
  std::vector<double> numbers;
  const std::string mark = " " + attribute + "='";
  for (std::size_t at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + 1))
    numbers.push_back(std::stod(svg.substr(at + mark.size())));
  return numbers;
}

/// Returns a run with five floes.
io::Run run_with_floes(const std::string& name) {
  io::Run run = run_of_three(name);
  for (int i = 0; i < 5; ++i) {
    io::RunFloe floe;
    floe.birth.floe = i;
    floe.birth.area = 10.0 * (i + 1) * (i + 1);
    run.floes.push_back(floe);
    run.shapes.add({{{20.0 * i, 0}, {20.0 * i + 3 * (i + 1), 0}, {20.0 * i, 3.0 * (i + 1)}}, {}});
  }
  return run;
}

/// The first of the five floes floats all the time, the second is under a hull from 5 s on, and the third has surfaced.
io::Run run_with_ice_under_a_hull() {
  io::Run run = run_with_floes("level");
  run.scene.scene.ships[0].hull.draught = 6;
  run.floes[1].went_under = 5;
  run.floes[2].came_up = true;
  run.floes[2].birth.generation = 2;
  using namespace simulation;
  for (const decltype(Event::what)& what :
       std::initializer_list<decltype(Event::what)>{Submerge(), Submerge(), Resurface(), StayUnder()})
    run.events.push_back({5, 1, {}, what});
  return run;
}

std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

/// The page is as wide as a page of a journal. Its words have 7 to 9 pt there, stay on the page, and do not overlap.
void expect_readable(const std::string& svg) {
  EXPECT_NEAR(numbers_of(svg, "width").front(), 170, 0.01);
  const double pixels = std::stod(svg.substr(svg.find("viewBox='0 0 ") + 13));
  const double points = 170 / pixels / 25.4 * 72;  // size of a pixel [pt]
  std::map<double, double> ends;                   // ends of the words of a line, by its height
  for (std::size_t at = svg.find("<text x='"); at != std::string::npos; at = svg.find("<text x='", at + 1)) {
    const std::size_t begin = svg.find('>', at) + 1, end = svg.find("</text>", begin);
    const std::string tag = " " + svg.substr(at, begin - at);
    const double left = numbers_of(tag, "x").front(), size = numbers_of(tag, "font-size").front();
    const std::vector<double> squeezed = numbers_of(tag, "textLength");
    const double width = squeezed.empty() ? 0.62 * size * static_cast<double>(end - begin) : squeezed.front();
    EXPECT_GE(size * points, 6.99);
    EXPECT_LE(size * points, 9.01);
    double& before = ends.try_emplace(numbers_of(tag, "y").front(), -1).first->second;
    EXPECT_GE(left, before) << tag;
    before = left + width;
    EXPECT_LE(before, pixels + 1) << tag;
  }
  EXPECT_GT(ends.size(), 5U);
}

TEST(FinalMap, IsReadableAtItsWidthOnPaper) {
  expect_readable(final_map(run_with_floes("a-scene-of-a-long-name")));
  io::Run of_long_label = run_with_floes("long");
  of_long_label.label = std::string(150, 'n');
  expect_readable(final_map(of_long_label));
  expect_readable(final_map(run_with_ice_under_a_hull()));
}

TEST(FinalMap, AWallIsDrawnAsOneAndLeavesNoTrack) {
  const std::string ships = final_map(run_of_three("ships"));
  const std::string walls =
      final_map(run_of_three("walls", R"(, "walls": [{"from_m": [-60, -90], "to_m": [200, -90]}])"));
  EXPECT_EQ(count_of(ships, ">wall<"), 0U);
  EXPECT_EQ(count_of(walls, ">wall<"), 1U);
  EXPECT_EQ(count_of(ships, "<polyline"), 3U);
  EXPECT_EQ(count_of(walls, "<polyline"), 3U);
}

TEST(FinalMap, IceUnderAHullIsNeitherFloatingIceNorAFracture) {
  const std::string with = final_map(run_with_ice_under_a_hull()), without = final_map(run_with_floes("plain"));
  EXPECT_EQ(count_of(with, ">1 cusp broken by bending, 0 splits, 4 floes, 1 at the start<"), 1U);
  EXPECT_EQ(count_of(without, ">1 cusp broken by bending, 0 splits, 5 floes, 1 at the start<"), 1U);
  for (const char* words : {">2 pieces went under the hull, 1 came up<", ">ice under the hull or waiting behind it<",
                            ">piece that came up from under the hull<"}) {
    EXPECT_EQ(count_of(with, words), 1U) << words;
    EXPECT_EQ(count_of(without, words), 0U) << words;
  }
}

TEST(FinalMap, IceUnderAHullHasALayerOfItsOwn) {
  const io::Run run = run_with_ice_under_a_hull();
  const auto layers = tests::checked(geojson_layers(run, 10, {})).value();
  ASSERT_EQ(layers.size(), 6U);
  EXPECT_EQ(count_of(layers[0].second, "\"floe_id\""), 4U);
  EXPECT_EQ(count_of(layers[0].second, "\"came_up\":true"), 1U);
  EXPECT_EQ(count_of(layers[1].second, "\"kind\""), 1U);
  EXPECT_EQ(layers[5].first, "under-hull.geojson");
  EXPECT_EQ(count_of(layers[5].second, "\"floe_id\""), 1U);
  EXPECT_EQ(count_of(layers[5].second, "\"went_under_s\":5"), 1U);
  EXPECT_EQ(geojson_layers(run_with_floes("plain"), 10, {})->size(), 5U);
}

TEST(FinalMap, IceUnderAHullIsAPartOfTheVtkExport) {
  const tests::TemporaryFolder folder;
  ASSERT_TRUE(export_vtk(run_with_ice_under_a_hull(), {}, folder.path()).has_value());
  EXPECT_EQ(count_of(tests::read_file(folder / "run.pvd"), "under-hull-"), 2U);
  for (const auto& [file, words] : {std::pair{"under-hull-00000.vtp", "NumberOfLines=\"0\""},
                                    {"under-hull-00001.vtp", "NumberOfLines=\"1\""},
                                    {"ice-00001.vtp", "NumberOfLines=\"4\""},
                                    {"loads-00001.vtp", "NumberOfVerts=\"4\""}})  // three ships and one fracture
    EXPECT_EQ(count_of(tests::read_file(folder / file), words), 1U) << file;
}

}  // namespace
}  // namespace polynya::views
