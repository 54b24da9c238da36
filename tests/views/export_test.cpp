// Where exports put things: closed forms of the projection, triangles that cover a polygon, VTK's layout.
#include "views/export/export.hpp"

#include <cmath>
#include <cstring>
#include <numbers>

#include "../base64.hpp"
#include "../io/expect_text.hpp"

#include "geometry/exact/measures.hpp"
#include "geometry/shape/outline.hpp"
#include "io/import/projection.hpp"
#include "io/text/encoding.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using geometry::Ring;
using simulation::GeographicOrigin;

constexpr double kRad = std::numbers::pi / 180;

/// WGS 84's radii of curvature at a latitude: along the meridian and across it [m].
double meridian_radius(double latitude) {
  const double e2 = 0.00669437999014, s = std::sin(latitude);
  return 6378137 * (1 - e2) / std::pow(1 - e2 * s * s, 1.5);
}
double normal_radius(double latitude) {
  const double e2 = 0.00669437999014, s = std::sin(latitude);
  return 6378137 / std::sqrt(1 - e2 * s * s);
}

TEST(Geographic, SmallStepsFollowTheRadiiOfCurvature) {
  for (const double latitude : {-60.0, 0.0, 45.0, 78.2}) {
    const double lat = latitude * kRad;
    const GeographicOrigin north_up{lat, 0, 90 * kRad};  // x east, y north
    const double d = 10;
    EXPECT_NEAR(io::GeographicPlane::about(north_up)->geographic_of({0, d}).latitude - lat, d / meridian_radius(lat),
                1e-11);
    EXPECT_NEAR(io::GeographicPlane::about(north_up)->geographic_of({d, 0}).longitude,
                d / (normal_radius(lat) * std::cos(lat)), 1e-11);
    const GeographicOrigin x_north{lat, 0, 0};  // x north, y west
    EXPECT_NEAR(io::GeographicPlane::about(x_north)->geographic_of({d, 0}).latitude - lat, d / meridian_radius(lat),
                1e-11);
    EXPECT_LT(io::GeographicPlane::about(x_north)->geographic_of({0, d}).longitude, 0);
  }
}

TEST(Geographic, ConvergesOnThePole) {
  const GeographicOrigin pole{90 * kRad, 0, 0};
  for (const double angle : {0.1, 1.0, 2.5})
    EXPECT_NEAR(
        io::GeographicPlane::about(pole)->geographic_of({1000 * std::cos(angle), 1000 * std::sin(angle)}).latitude,
        90 * kRad - 1000 / meridian_radius(90 * kRad), 1e-10);
}

double covered(const Polygon& polygon) {
  Ring corners = polygon.outer;
  for (const Ring& hole : polygon.holes) corners.insert(corners.end(), hole.begin(), hole.end());
  double sum = 0;
  for (const geometry::Triangle& t : geometry::triangulate(polygon)) {
    const double area = geometry::signed_area({corners[t[0]], corners[t[1]], corners[t[2]]});
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

TEST(Triangulation, CoversThePolygonAndNotItsHoles) {
  const Polygon holed{{{0, 0}, {10, 0}, {10, 10}, {5, 3}, {0, 10}},
                      {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}, {{7, 1}, {7, 2}, {8, 1}}}};
  EXPECT_NEAR(covered(holed), measure(holed).area, 1e-12);
  EXPECT_EQ(geometry::triangulate(holed).size(), 12 - 2 + 2 * 2U);  // n − 2 + 2 h
  const Polygon hole_touches{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{{0, 0}, {1, 2}, {2, 1}}}};
  EXPECT_NEAR(covered(hole_touches), 100 - 1.5, 1e-12);
}

TEST(Triangulation, HasTwoTrianglesLessThanCornersForStarsOfAnySize) {
  for (const int corners : {3, 4, 9, 200}) {
    Ring star;
    for (int i = 0; i < 2 * corners; ++i) {
      const double angle = std::numbers::pi * i / corners, radius = i % 2 == 0 ? 10 : 7;
      star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const Polygon polygon{star, {}};
    EXPECT_EQ(geometry::triangulate(polygon).size(), star.size() - 2);
    EXPECT_NEAR(covered(polygon), measure(polygon).area, 1e-10);
  }
}

/// The n-th value of a column, from the file's text alone.
double value_at(const std::string& text, const std::string& name, std::size_t n) {
  const std::size_t tag = text.find("Name=\"" + name + "\"");
  const std::size_t start = text.find('>', tag) + 1;
  const std::string bytes = from_base64(std::string_view(text).substr(start));
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), 8);
  EXPECT_EQ(length + 8, bytes.size()) << name;
  double value = 0;
  std::memcpy(&value, bytes.data() + 8 + 8 * n, 8);
  return value;
}

TEST(VtkFile, HoldsPointsCellsAndColumnsAsItsHeaderSays) {
  views::VtkPolyData data;
  data.points = {{0, 0}, {1.25, 0}, {0, -3.5}};
  data.lines = {{0, 1, 2, 0}};
  data.polygons = {{0, 1, 2}};
  data.time = 12.5;
  data.cell_data = {{"mass_kg", {7.5, 8.25}, 1, false}, {"velocity_m_per_s", {1, 2, 0, 3, 4, 0}, 3, false}};
  const std::string text = to_vtp(data);
  EXPECT_HAS(text, "NumberOfPoints=\"3\" NumberOfVerts=\"0\" NumberOfLines=\"1\"");
  EXPECT_HAS(text, ">12.5<");
  EXPECT_EQ(value_at(text, "Points", 3), 1.25);
  EXPECT_EQ(value_at(text, "Points", 7), -3.5);
  EXPECT_EQ(value_at(text, "mass_kg", 1), 8.25);
  EXPECT_EQ(value_at(text, "velocity_m_per_s", 4), 4);
  EXPECT_LACKS(views::to_pvd({{0.5, 1, "a&b.vtp"}}), "a&b");
}

}  // namespace
}  // namespace polynya::tests
