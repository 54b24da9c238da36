// Floes of files from other sources: their positions in the plane, and the floes that are repaired, trimmed or refused.
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "expect_text.hpp"
#include <fmt/format.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "io/import/floe_import.hpp"
#include "io/import/gdal.hpp"
#include "io/import/projected_lines.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;

constexpr double kRad = std::numbers::pi / 180;

SourceFloe square_floe(double x, double y, double side) {
  return {{{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}}, {}};
}
simulation::GeographicOrigin origin(double latitude, double longitude, double heading = 90) {
  return {latitude * kRad, longitude * kRad, heading * kRad};
}
PlaneSettings plane() {
  PlaneSettings settings;
  settings.origin_in_words = [](double lat, double lon) {
    return "origin " + std::to_string(lat).substr(0, 5) + "," + std::to_string(lon).substr(0, 5);
  };
  settings.shift_in_words = "shift them";
  settings.source_in_words = "name it";
  return settings;
}
PlaneSettings about(double latitude, double longitude, double heading = 90) {
  PlaneSettings settings = plane();
  settings.origin = origin(latitude, longitude, heading);
  return settings;
}

/// Brings the floes into the plane. No floe may be refused by itself.
tl::expected<PlaneReport, PlaneError> bring(std::vector<SourceFloe>& floes, const std::string& crs,
                                            const PlaneSettings& settings) {
  auto report = bring_to_plane(floes, {crs, {}}, settings);
  for (const SourceFloe& floe : floes) EXPECT_EQ(floe.refused, "");
  return report;
}

/// The polar stereographic of EPSG:3413 in closed form (Snyder 1987, 21-33 to 21-40), true at 70° N, 45° W down.
Point polar_stereographic(double latitude, double longitude) {
  const double a = 6378137, e = 0.0818191908426215;
  const auto t = [&](double lat) {
    const double s = e * std::sin(lat);
    return std::tan(std::numbers::pi / 4 - lat / 2) / std::pow((1 - s) / (1 + s), e / 2);
  };
  const double true_at = 70 * kRad;
  const double m = std::cos(true_at) / std::sqrt(1 - std::pow(e * std::sin(true_at), 2));
  const double rho = a * m * t(latitude * kRad) / t(true_at);
  const double angle = (longitude + 45) * kRad;
  return {rho * std::sin(angle), -rho * std::cos(angle)};
}

TEST(Projection, OfPolarStereographicIsItsClosedForm) {
  const std::vector<Point> degrees{{15.6, 78.2}, {-45, 70}, {170, 89}, {-100, 65}, {std::nan(""), 1}, {0, 90}};
  const auto images = tests::checked(transform(degrees, "OGC:CRS84", "EPSG:3413"));
  const auto back = tests::checked(transform(*images, "EPSG:3413", "OGC:CRS84"));
  for (std::size_t i = 0; i < 4; ++i) {
    const Point expected = polar_stereographic(degrees[i].y, degrees[i].x);
    EXPECT_NEAR((*images)[i].x, expected.x, 1e-5);
    EXPECT_NEAR((*images)[i].y, expected.y, 1e-5);
    EXPECT_NEAR((*back)[i].x, degrees[i].x, 1e-11);
    EXPECT_NEAR((*back)[i].y, degrees[i].y, 1e-11);
  }
  EXPECT_FALSE(is_finite((*images)[4])) << "a point that is none keeps its place in the list";
  EXPECT_NEAR(length((*images)[5] - Point{}), 0, 1e-6);
}

TEST(CoordinateFrame, ThereAndBackIsTheSamePlace) {
  for (const auto& at : {origin(78.2, 15.6, 30), origin(-64, 179.9), origin(90, 0), origin(0, -30, 200)}) {
    const std::vector<Point> points{{0, 0}, {12345.678, -400}, {-3e4, 4e4}};
    const auto places = tests::checked(project(points, frame_about(at), in_degrees()));
    const auto back = tests::checked(project(*places, in_degrees(), frame_about(at)));
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(distance((*back)[i], points[i]), 1e-6);
  }
}

TEST(Crs, IsKnownByItsNames) {
  EXPECT_TRUE(find_crs("urn:ogc:def:crs:OGC:1.3:CRS84")->is_geographic);
  EXPECT_TRUE(find_crs("EPSG:4326")->is_geographic);
  const auto polar = tests::checked(find_crs("urn:ogc:def:crs:EPSG::3413"));
  EXPECT_TRUE(polar->is_projected && polar->is_metric && !polar->is_geographic);
  EXPECT_FALSE(find_crs("EPSG:2229")->is_metric);  // California, in feet
  EXPECT_EQ(polar->code, "EPSG:3413");
  for (const char* nothing : {"EPSG:1", "metres of the ice tank", ""}) EXPECT_FALSE(find_crs(nothing));
}

/// A name in a file of others leads neither to a file of this machine nor to an address of the web.
TEST(Crs, IsNoFileAndNoAddress) {
  for (const char* elsewhere : {"/etc/passwd", "http://127.0.0.1:1/crs", "--help", "@list"})
    EXPECT_HAS(tests::refused(find_crs(elsewhere)), "PROJ knows no coordinate system");
}

/// A thousandth of a degree by the radii of curvature:
/// a (1 − e²)/(1 − e² sin²φ)^1.5 north, a cos φ/√(1 − e² sin²φ) east.
TEST(Plane, DegreesComeToMetresAboutTheOrigin) {
  for (const auto& [latitude, east, north] :
       {std::tuple{78.2, 22.8378, 111.6468}, {0.0, 111.3195, 110.5743}, {-60.0, 55.8000, 111.4123}}) {
    std::vector<SourceFloe> floes{square_floe(15.6, latitude, 0.001)};
    ASSERT_TRUE(bring(floes, "EPSG:4326", about(latitude, 15.6)));
    const Polygon& floe = floes[0].polygon;
    EXPECT_NEAR(floe.outer[0].x, 0, 1e-6);
    EXPECT_NEAR(floe.outer[0].y, 0, 1e-6);
    EXPECT_NEAR(floe.outer[1].x, east, 1e-3);
    EXPECT_NEAR(floe.outer[3].y, north, 1e-3);
  }
  std::vector<SourceFloe> without_crs{square_floe(15.6, 78.2, 0.001)};
  EXPECT_EQ(tests::checked(bring(without_crs, "", about(78.2, 15.6)))->system, "WGS 84");
}

TEST(Plane, ARunsCoordinatesAcrossTheAntimeridianStayTogether) {
  std::vector<SourceFloe> floes{square_floe(179.999, 70, 0.002)};
  floes[0].polygon.outer[1].x = floes[0].polygon.outer[2].x = -179.999;
  ASSERT_TRUE(bring(floes, "EPSG:4326", about(70, 180)));
  EXPECT_LT(std::abs(floes[0].polygon.outer[1].x - floes[0].polygon.outer[0].x), 80);
}

TEST(Plane, MetresOfThePlaneStayAsTheyAre) {
  const std::vector<SourceFloe> before{square_floe(100.1, -7.3, 800)};
  for (const PlaneSettings& settings : {plane(), about(78.2, 15.6)}) {
    std::vector<SourceFloe> floes = before;
    ASSERT_TRUE(bring(floes, "", settings));
    EXPECT_EQ(floes[0].polygon, before[0].polygon);
  }
  std::vector<SourceFloe> floes = before;
  const auto report = tests::checked(bring(floes, "EPSG:3413", plane()));
  EXPECT_EQ(floes[0].polygon, before[0].polygon);
  EXPECT_EQ(report->target, "EPSG:3413");
}

TEST(Plane, AShiftIsOfWholeMetres) {
  std::vector<SourceFloe> floes{square_floe(1104312.5, -512345.25, 800)};
  PlaneSettings settings = plane();
  settings.is_shifted = true;
  const auto report = tests::checked(bring(floes, "EPSG:3413", settings));
  EXPECT_EQ(report->shift, (geometry::Vector{-1104713, 511945}));
  EXPECT_EQ(floes[0].polygon.outer[0], (Point{-400.5, -400.25}));
}

TEST(Plane, VelocitiesTurnWithTheAxes) {
  std::vector<SourceFloe> floes{square_floe(15.6, 78.2, 0.001)};
  floes[0].properties.velocity_x = 0.3;                          // east
  floes[0].properties.velocity_y = 0.1;                          // north
  ASSERT_TRUE(bring(floes, "EPSG:4326", about(78.2, 15.6, 0)));  // x is north, y west
  EXPECT_NEAR(*floes[0].properties.velocity_x, 0.1, 1e-6);
  EXPECT_NEAR(*floes[0].properties.velocity_y, -0.3, 1e-6);
}

TEST(Plane, WhatHasNoPlaceIsRefusedWithWhatWouldDo) {
  struct Case {
    SourceFloe floe;
    std::string crs;
    PlaneSettings settings;
    std::vector<std::string> parts;
  };
  PlaneSettings to_degrees = plane(), to_nowhere = plane(), to_polar = plane(), from_polar = plane();
  to_degrees.target = "EPSG:4326";
  to_nowhere.target = "EPSG:99";
  to_polar.target = "EPSG:3413";
  from_polar.source = "EPSG:3413";
  PlaneSettings of_command = about(78.2, 15.6);
  of_command.keeps_metres = false;
  const SourceFloe arctic = square_floe(15.6, 78.2, 0.01), metres = square_floe(0, 0, 800);
  const std::string degrees = "EPSG:4326";
  for (const Case& c : std::vector<Case>{
           {arctic, "", plane(), {"look like longitude and latitude", "0.0001 m²", "origin 78.20,15.60"}},
           {arctic, degrees, plane(), {"no origin", "origin 78.20"}},
           {square_floe(15.6, -75.1, 0.01),
            degrees,
            about(78.2, 15.6),
            {"75.1° S, 15.6° E lies 17", "km from the origin at 78.2° N", "in the other hemisphere", "origin -75.1"}},
           {square_floe(78.2, 15.6, 0.01), degrees, about(78.2, 15.6), {"exchanged", "[longitude, latitude]"}},
           {square_floe(15.6, 110, 0.01),
            degrees,
            about(78.2, 15.6),
            {"[15.6, 110]", "-90 to 90", "latitude seems to come first"}},
           {metres, "", to_polar, {"names no coordinate system", "name it"}},
           {arctic, degrees, to_degrees, {"EPSG:4326 (WGS 84) is not a plane in metres"}},
           {arctic, degrees, to_nowhere, {"PROJ knows no coordinate system \"EPSG:99\""}},
           {arctic, degrees, from_polar, {"names its own coordinate system, EPSG:4326"}},
           {square_floe(1.2e6, 0, 800), "EPSG:3413", plane(), {"found [1200000, 0]", "-1e+06 to 1e+06", "shift them"}},
           {metres,
            "+proj=nonsense",
            plane(),
            {"no coordinate system \"+proj=nonsense\"", "allowed: EPSG:n", "has no crs"}},
           {metres, "metres of the ice tank", about(78.2, 15.6), {"\"metres of the ice tank\""}},
           {metres, "", of_command, {"names no coordinate system", "name it", "where no origin is given"}},
           {square_floe(6e6, 2e6, 900), "EPSG:2229", plane(), {"not in metres"}}}) {
    std::vector<SourceFloe> floes{c.floe};
    const std::string words = tests::refused(bring(floes, c.crs, c.settings)).words;
    for (const std::string& part : c.parts) EXPECT_HAS(words, part);
  }
}

TEST(Plane, AWrongNumberDoesNotMoveTheOriginThatIsChosen) {
  PlaneSettings settings = plane();
  settings.chooses_origin = true;
  std::vector<SourceFloe> floes{square_floe(15.6, 78.2, 0.01), square_floe(15.62, 78.2, 0.01),
                                square_floe(78.2, 15.6, 0.01)};
  const auto report = tests::checked(bring_to_plane(floes, {"EPSG:4326", {}}, settings));
  EXPECT_NEAR(report->origin->latitude / kRad, 78.205, 0.001);
  EXPECT_NEAR(report->origin->longitude / kRad, 15.615, 0.001);
  EXPECT_HAS(floes[2].refused, "With latitude and longitude exchanged");
}

/// Number of kinds of damage. A kind is a wrong number in one vertex or, from kOtherHemisphere on, in all vertices.
constexpr int kDamages = 8, kOtherHemisphere = 6;
Point damaged(Point p, int kind) {
  const Point all[kDamages]{{p.x, 10 * p.y},     {p.x, p.y + 180},
                            {std::nan(""), p.y}, {p.x, std::numeric_limits<double>::infinity()},
                            {1000 * p.x, p.y},   {p.x, std::round(1e4 * p.y)},
                            {p.x, -p.y},         {p.y, p.x}};
  return all[kind];
}

/// Degrees, some of them wrong, never become metres. Each floe is projected as it would be without the others, or
/// refused by itself. A longitude plus a full turn is the same meridian.
TEST(FloeImport, WrongNumbersInDegreesRefuseTheirFloesAlone) {
  std::mt19937 dice(1);
  const auto draw = [&](int below) { return static_cast<int>(dice() % static_cast<unsigned>(below)); };
  constexpr int kFloes = 6;
  std::vector<ImportSettings> ways(4);
  const char* const systems[] = {"", "", "EPSG:4326", "EPSG:4326"};
  for (ImportSettings& way : ways) way.plane = about(78.2, 15.6);
  ways[1].plane.keeps_metres = false;
  ways[3].plane.origin.reset();
  ways[3].plane.target = "EPSG:3413";
  ways[3].plane.is_shifted = true;
  std::vector<SourceFloe> whole;
  for (int i = 0; i < kFloes; ++i) whole.push_back(square_floe(15.6 + 0.01 * i, 78.2, 0.001 * (1 + i)));
  std::vector<ImportOutcome> expected;
  for (std::size_t way = 0; way < ways.size(); ++way) {
    std::vector<SourceFloe> floes = whole;
    expected.push_back(import_floes(floes, {systems[way], {}}, ways[way]).value());
    ASSERT_EQ(expected.back().floes.size(), whole.size());
  }
  int refused_files = 0;
  for (int trial = 0; trial < 30; ++trial) {
    const std::size_t way = dice() % ways.size();
    const int kind = draw(kDamages);
    const int most = kind < kOtherHemisphere ? kFloes : 2;
    const int wrong = draw(most + 1);
    const bool is_of_one_vertex = draw(2) == 0;
    std::vector<SourceFloe> floes = whole;
    for (int i = 0; i < kFloes; ++i) {
      const double turn = 360 * (draw(3) - 1);
      for (Point& p : floes[i].polygon.outer)
        if (!is_of_one_vertex || &p == &floes[i].polygon.outer[2])
          p = i < wrong ? damaged(p, kind) : Point{p.x + turn, p.y};
    }
    SCOPED_TRACE(fmt::format("trial {}, way {}, damage {} of {} floes, one vertex {}", trial, way, kind, wrong,
                             is_of_one_vertex));
    const auto outcome = import_floes(floes, {systems[way], {}}, ways[way]);
    if (!outcome) {
      ++refused_files;
      EXPECT_GT(wrong, 2);
      continue;
    }
    EXPECT_EQ(outcome->totals.refused, static_cast<std::size_t>(wrong));
    ASSERT_EQ(outcome->floes.size(), static_cast<std::size_t>(kFloes - wrong));
    for (const ImportedFloe& floe : outcome->floes) {
      const double area = geometry::exact_area(expected[way].floes[floe.source].polygon);
      EXPECT_GE(floe.source, static_cast<std::size_t>(wrong));
      EXPECT_NEAR(geometry::exact_area(floe.polygon), area, 1e-6 * area);
    }
  }
  EXPECT_LT(refused_files, 8);
}

TEST(FloeProperties, NamesNearAKnownOneAreFound) {
  for (const auto& [key, meant] : std::vector<std::pair<std::string, std::string>>{
           {"thickness", "thickness_m=thickness"},
           {"thickness_cm", "thickness_m=thickness_cm*0.01"},
           {"Thickness_M", "thickness_m=Thickness_M"},
           {"THICK_MM", "thickness_m=THICK_MM*0.001"},
           {"ice thickness [cm]", "thickness_m=ice thickness [cm]*0.01"},
           {"thicknes_m", "thickness_m=thicknes_m"},
           {"flexural_strength_MPa", "flexural_strength_Pa=flexural_strength_MPa*1e+06"},
           {"vx", "vx_m_per_s=vx"},
           {"density", "density_kg_per_m3=density"},
           {"intensity", ""},
           {"area_m2", ""},
           {"id", ""},
           {"x", ""}}) {
    const PropertyNames none;
    NearMisses misses(none);
    misses.add(parse_json(fmt::format(R"({{"{}": 5}})", key)).root, {});
    ASSERT_EQ(misses.found().size(), meant.empty() ? 0U : 1U) << key;
    if (meant.empty()) continue;
    EXPECT_EQ(as_property_name(misses.found()[0]), meant);
    EXPECT_EQ(misses.found()[0].floes, 1U);
    PropertyNames names;
    ASSERT_TRUE(add_property_name(meant, names)) << meant;
    NearMisses read(names);
    read.add(parse_json(fmt::format(R"({{"{}": 5}})", key)).root, {});
    EXPECT_TRUE(read.found().empty()) << "read under its own name";
  }
}

TEST(FloeProperties, WrongTypesAndSignsAreRefusedWithWhatIsAllowed) {
  const JsonDocument json = parse_json(
      R"({"thickness_m": -0.4, "flexural_strength_Pa": "0.8 MPa", "vx_m_per_s": 0.2, "density_kg_per_m3": null,
          "floe_id": 3.5, "THICK": 80})");
  std::string bad;
  const FloeProperties properties = PropertyReader(PropertyRules{}).read(json.root, bad);
  EXPECT_EQ(bad,
            "property thickness_m: found -0.4, allowed: a number from 0.001 to 20 [m]; "
            "property flexural_strength_Pa: found \"0.8 MPa\", allowed: a number from 1 to 1e+09 [Pa]");
  EXPECT_EQ(properties.velocity_x, 0.2);
  EXPECT_FALSE(properties.density || properties.thickness || properties.floe_id);

  PropertyNames names;
  ASSERT_TRUE(add_property_name("thickness_m=THICK*0.01", names));
  bad.clear();
  PropertyReader reader({.names = names});
  EXPECT_NEAR(*reader.read(parse_json(R"({"THICK": 80})").root, bad).thickness, 0.8, 1e-15);
  EXPECT_FALSE(reader.read(parse_json(R"({"THICK": 0})").root, bad).thickness);
  EXPECT_HAS(bad, "property THICK: found 0, which is 0, allowed: ");
  for (const char* wrong : {"thickness_m", "thicknes_m=H", "thickness_m=", "thickness_m=H*much", "thickness_m=H*0"})
    EXPECT_FALSE(add_property_name(wrong, names)) << wrong;
}

TEST(FloeImport, EveryChangeIsItemisedAndTheAreasAddUp) {
  std::vector<SourceFloe> floes{square_floe(0, 0, 100), square_floe(90, 10, 30), square_floe(300, 0, 40),
                                square_floe(300, 0, 40), square_floe(500, 0, 1)};
  floes.resize(7);
  floes[5].polygon.outer = {{600, 0}, {640, 30}, {640, 0}, {600, 30}};  // a bow tie
  floes[6].polygon.outer = {{700, 0}, {750, 0.1}, {800, 0}, {800, 50}, {700, 50}};
  ImportSettings settings;
  settings.plane = plane();
  settings.repair = geometry::FillRule::kEvenOdd;
  settings.least_area = 4;
  settings.simplify = 0.2;
  const auto imported = tests::checked(import_floes(floes, {}, settings));
  const ImportTotals& totals = imported->totals;
  EXPECT_EQ((std::vector{totals.read, totals.refused, totals.repaired, totals.simplified, totals.trimmed,
                         totals.dropped, totals.written}),
            (std::vector<std::size_t>{7, 0, 1, 1, 2, 2, 6}))
      << "dropped are the copy, and the square of 1 m²";
  EXPECT_EQ(totals.area_trimmed, 300 + 1600);
  EXPECT_EQ(totals.area_dropped, 1);
  EXPECT_EQ(totals.area_repaired, 600);
  EXPECT_EQ(totals.area_read, 10000 + 900 + 1600 + 1600 + 1 + 0 + geometry::exact_area(floes[6].polygon));
  EXPECT_NEAR(
      totals.area_written,
      totals.area_read + totals.area_repaired + totals.area_simplified - totals.area_trimmed - totals.area_dropped,
      1e-9);
  EXPECT_EQ(imported->items.size(), 5U);
  EXPECT_EQ(imported->items[0].yields, std::vector<std::size_t>{0});
  std::vector<Polygon> written;
  for (const ImportedFloe& floe : imported->floes) written.push_back(floe.polygon);
  EXPECT_TRUE(geometry::find_overlapping_pairs(written, 1).empty());
}

TEST(FloeImport, WithoutARuleCrossingOutlinesAreRefusedAndTheOthersKept) {
  std::vector<SourceFloe> floes{square_floe(0, 0, 10), {}, square_floe(50, 0, 10), square_floe(80, 0, 10)};
  floes[1].polygon.outer = {{600, 0}, {640, 30}, {640, 0}, {600, 30}};
  ImportSettings settings;
  settings.plane = plane();
  floes[2].refused = "property thickness_m: found -1";
  const auto imported = tests::checked(import_floes(floes, {}, settings));
  EXPECT_EQ(imported->totals.refused, 2U);
  EXPECT_EQ(imported->floes.size(), 2U);
  EXPECT_HAS(imported->items[0].refused, "self-crossing at (620, 15)");
  EXPECT_EQ(imported->items[1].refused, "property thickness_m: found -1");
  EXPECT_EQ(imported->totals.area_read, 200);
}

}  // namespace
}  // namespace polynya::io
