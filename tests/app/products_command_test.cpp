// What `channel` and `export` make of a real run, and that a new run takes it away again.
#include "program.hpp"
#include <gtest/gtest.h>

#include "io/run/run_folder.hpp"

namespace polynya::tests {
namespace {

TEST(Products, AreMadeOfARunAndRemovedWithIt) {
  const TemporaryFolder folder;
  const Start here{folder.path()};
  ASSERT_EQ(polynya("run scenes/level-plate.json --until 30 --out run", here).code, 0);

  ASSERT_EQ(polynya("channel run", here).code, 0);
  EXPECT_TRUE(read_file(folder / "run/channel.csv").starts_with("station,along_m,"));
  EXPECT_HAS(read_file(folder / "run/channel.geojson"), "\"swept band\"");

  const Outcome sums = polynya("channel run --json", here);
  EXPECT_EQ(sums.code, 0);
  EXPECT_TRUE(sums.out.starts_with("{\n")) << sums.out;
  EXPECT_EQ(sums.out, polynya("channel run --format json", here).out) << "its older spelling";

  // `polynya figures` writes these (tests/python/test_figures.py).
  for (const auto name : io::run_file::kFigures)
    for (const char* suffix : {".svg", ".png", ".pdf"})
      write_file(std::filesystem::path(folder / ("run/" + std::string(name))).replace_extension(suffix), "");

  const Outcome exported = polynya("export run --vtk vtk --geojson gis", here);
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_HAS(exported.err, "no \"origin\"");
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/run.pvd"));

  ASSERT_EQ(polynya("run scenes/level-plate.json --until 1 --out run --overwrite", here).code, 0);
  for (const std::string name :
       {"channel.csv", "channel.geojson", "figure-loads.svg", "figure-energy.png", "figure-floes.pdf"})
    EXPECT_FALSE(std::filesystem::exists(folder / ("run/" + name))) << name;
}

}  // namespace
}  // namespace polynya::tests
