// Every failure that RapidCheck or the fuzzer found, shrunk, so that it stays found.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "geometry/exact/validity.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

Ring read_ring(std::istream& line) {
  Ring ring;
  for (std::string x, y; line >> x >> y;)
    ring.push_back({std::strtod(x.c_str(), nullptr), std::strtod(y.c_str(), nullptr)});
  return ring;
}

/// In fixtures.txt, in order: a hole's vertex on the shell became a corner on one path only; a chord joined
/// rings that touched elsewhere; a spike hid among the two sides of a chord; a rounded node fell on a vertex;
/// a crack along the floe's edges swallowed their vertices; a dangle shorter than a step counted as a miss.
TEST(Fixtures, FailuresOnceFoundStayFixed) {
  std::ifstream file(POLYNYA_SOURCE_DIR "/tests/geometry/fixtures.txt");
  Polygon floe;
  int fixtures = 0;
  for (std::string text; std::getline(file, text);) {
    std::istringstream line(text);
    std::string kind;
    line >> kind;
    const Ring ring = read_ring(line);
    ASSERT_GE(ring.size(), 2u);
    if (kind == "floe") floe = {ring, {}};
    if (kind == "hole") floe.holes.push_back(ring);
    if (kind == "floe" || kind == "hole") continue;
    SCOPED_TRACE(++fixtures);
    ASSERT_FALSE(find_defect(floe));
    const trials::Knife knife{kind == "ring", ring};
    const CutOutcome outcome = trials::cut(Shape{floe}, knife);
    EXPECT_TRUE(trials::is_sound(Shape{floe}, outcome));
    EXPECT_TRUE(trials::are_equal(outcome, trials::cut_generally(Shape{floe}, knife)));
  }
  EXPECT_EQ(fixtures, 6);
}

}  // namespace
}  // namespace polynya::geometry
