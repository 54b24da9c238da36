// Where a chart puts its points, and what it leaves out.
#include "views/map/chart.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

namespace polynya::tests {
namespace {

using views::Chart;

Chart of(Chart::Axis x, Chart::Axis y, std::vector<Chart::Point> points) {
  Chart chart;
  chart.panels.push_back(
      {"panel", std::move(x), std::move(y), {{"curve", 0, Chart::Dash::kSolid, std::move(points)}}});
  return chart;
}

/// The corners of the chart's curves: those paths that have a dash pattern and are not the legend's.
std::vector<std::array<double, 2>> corners(const std::string& svg) {
  std::vector<std::array<double, 2>> found;
  const std::size_t from = svg.find("<g clip-path"), to = svg.find("</g>", from);
  std::string curves = svg.substr(from, to - from);
  for (std::size_t path = curves.find("<path d='M"); path != std::string::npos;
       path = curves.find("<path d='M", path + 1)) {
    std::string numbers = curves.substr(path + 10, curves.find('\'', path + 10) - path - 10);
    for (char& c : numbers)
      if (c == 'L') c = ' ';
    std::istringstream stream(numbers);
    for (std::array<double, 2> corner{}; stream >> corner[0] >> corner[1];) found.push_back(corner);
  }
  return found;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Chart, LogAxesGiveEqualRatiosEqualSteps) {
  const auto at = corners(to_svg(of({"x", true}, {"y", true}, {{0.1, 3}, {1, 30}, {10, 300}})));
  ASSERT_EQ(at.size(), 3U);
  EXPECT_NEAR(at[1][0] - at[0][0], at[2][0] - at[1][0], 0.02);
  EXPECT_NEAR(at[1][1] - at[0][1], at[2][1] - at[1][1], 0.02);
  EXPECT_GT(at[1][0], at[0][0]);
  EXPECT_LT(at[1][1], at[0][1]);  // up on paper is less
}

TEST(Chart, LinearAxesGiveEqualDifferencesEqualStepsFromZero) {
  const auto at = corners(to_svg(of({"x", false}, {"y", false}, {{1, 10}, {2, 20}, {3, 30}})));
  ASSERT_EQ(at.size(), 3U);
  EXPECT_NEAR(at[1][1] - at[0][1], at[2][1] - at[1][1], 0.02);
  const double zero = at[0][1] - (at[1][1] - at[0][1]);  // where y = 0 would be: the frame's lower edge
  const auto down = corners(to_svg(of({"x", false}, {"y", false}, {{1, 0}, {3, 30}})));
  EXPECT_NEAR(down[0][1], zero, 0.02);
}

TEST(Chart, LeavesOutWhatHasNoPlace) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string svg = to_svg(
      of({"x", true}, {"y", true}, {{0, 1}, {1, 1}, {2, -1}, {3, std::nan("")}, {4, infinity}, {5, 2}}));
  EXPECT_EQ(corners(svg).size(), 2U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Chart, DrawsFaintWhatTouchesAFaintPoint) {
  const std::string svg =
      to_svg(of({"x", false}, {"y", false}, {{0, 1}, {1, 1}, {2, 1, true}, {3, 1, true}, {4, 1}, {5, 1}}));
  EXPECT_EQ(count(svg, "stroke-opacity='0.3'"), 1U);
  EXPECT_EQ(count(svg, "stroke-opacity='1'"), 2U);
  EXPECT_EQ(corners(svg).size(), 8U);  // 2 + 4 + 2: the runs share their ends
}

TEST(Chart, SurvivesNothingAndOneValue) {
  EXPECT_NE(to_svg(Chart{}).find("</svg>"), std::string::npos);
  for (const bool is_log : {false, true}) {
    for (const auto& points : {std::vector<Chart::Point>{}, {{2, 2}}, {{2, 2}, {2, 2}}}) {
      const std::string svg = to_svg(of({"x", is_log}, {"y", is_log}, points));
      EXPECT_EQ(svg.find("nan"), std::string::npos);
      EXPECT_EQ(svg.find("inf"), std::string::npos);
    }
  }
}

TEST(Chart, EscapesItsWords) {
  Chart chart = of({"<x>", false}, {"a & b", false}, {{1, 1}, {2, 2}});
  const std::string svg = to_svg(chart);
  EXPECT_NE(svg.find("&lt;x&gt;"), std::string::npos);
  EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
  EXPECT_EQ(svg, to_svg(chart));
}

}  // namespace
}  // namespace polynya::tests
