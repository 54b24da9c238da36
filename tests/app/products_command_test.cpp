// What `channel`, `figures` and `export` make of a real run, and that a new run takes it away again.
#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/run_folder.hpp"

namespace polynya::tests {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Products, AreMadeOfARunAndRemovedWithIt) {
  const TemporaryFolder folder;
  const Start here{folder.path()};
  ASSERT_EQ(polynya({"run", scene_path("level-plate"), "--until", "30", "--out", "run"}, here).code, 0);
  const std::string events = read_file(folder / "run/events.ndjson");

  ASSERT_EQ(polynya({"channel", "run"}, here).code, 0);
  EXPECT_TRUE(read_file(folder / "run/channel.csv").starts_with("station,along_m,"));
  EXPECT_NE(read_file(folder / "run/channel.geojson").find("\"swept band\""), std::string::npos);

  const Outcome sums = polynya({"channel", "run", "--json"}, here);
  EXPECT_EQ(sums.code, 0);
  EXPECT_TRUE(sums.out.starts_with("{\n")) << sums.out;
  EXPECT_EQ(sums.out, polynya({"channel", "run", "--format", "json"}, here).out) << "its older spelling";

  const Outcome drawn = polynya({"figures", "run"}, here);
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  for (const auto name : io::run_file::kFigures) {
    const std::string svg = read_file(folder / ("run/" + std::string(name)));
    EXPECT_TRUE(svg.starts_with("<svg ")) << name;
    EXPECT_TRUE(svg.ends_with("</svg>\n")) << name;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << name;
    EXPECT_EQ(svg.find("inf"), std::string::npos) << name;
  }
  // Of each cusp a stroke in each of three panels, and two in the legend's.
  const std::string loads = read_file(folder / "run/figure-loads.svg");
  EXPECT_EQ(count(loads, "v10' stroke='#555555' stroke-opacity"), 3 * count(events, "\"kind\":\"bend\""));

  const Outcome exported = polynya({"export", "run", "--vtk", "vtk", "--geojson", "gis"}, here);
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_NE(exported.err.find("no \"origin\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/run.pvd"));

  ASSERT_EQ(
      polynya({"run", scene_path("level-plate"), "--until", "1", "--out", "run", "--overwrite"}, here).code,
      0);
  for (const std::string name : {"channel.csv", "channel.geojson", "figure-loads.svg", "figure-loads.png"})
    EXPECT_FALSE(std::filesystem::exists(folder / ("run/" + name))) << name;
}

TEST(Products, TellWhatIsWrongWithTheCommandLine) {
  const TemporaryFolder folder;
  const Start here{folder.path()};
  ASSERT_EQ(polynya({"run", scene_path("two-floes"), "--until", "1", "--out", "run"}, here).code, 0);
  EXPECT_EQ(polynya({"channel", "run"}, here).code, 2);  // no ship
  EXPECT_EQ(polynya({"figures", "run", "--at", "7"}, here).code, 2);
  EXPECT_EQ(polynya({"export", "run"}, here).code, 2);
  EXPECT_EQ(polynya({"export", "run", "--geojson", "g", "--at", "7"}, here).code, 2);
  EXPECT_EQ(polynya({"channel", "nothing"}, here).code, 5);
  EXPECT_EQ(polynya({"figures", "nothing"}, here).code, 5);
  EXPECT_EQ(polynya({"export", "nothing", "--vtk", "v"}, here).code, 5);
}

}  // namespace
}  // namespace polynya::tests
