// Positions of floes on the Earth. Files in several coordinate systems become scenes, runs and files again. A scene
// whose files disagree with it about the origin is refused.
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "program.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/box_tree.hpp"
#include "io/import/degrees.hpp"
#include "io/import/gdal.hpp"
#include "io/import/projected_lines.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::tests {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

constexpr double kRad = std::numbers::pi / 180;

simulation::GeographicOrigin origin_at(double latitude, double longitude) {
  return {latitude * kRad, longitude * kRad, 90 * kRad};
}

std::string ring_json(const Ring& ring) {
  std::vector<std::string> points;
  for (std::size_t i = 0; i <= ring.size(); ++i)
    points.push_back(fmt::format("[{},{}]", ring[i % ring.size()].x, ring[i % ring.size()].y));
  return fmt::format("[{}]", fmt::join(points, ","));
}
std::string feature_json(const Polygon& polygon, const std::string& properties = "") {
  std::string rings = ring_json(polygon.outer);
  for (const Ring& hole : polygon.holes) rings += "," + ring_json(hole);
  return fmt::format(R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Polygon","coordinates":[{}]}}}})",
                     properties, rings);
}
std::string collection_json(const std::vector<std::string>& features, const std::string& crs) {
  return fmt::format(R"({{"type":"FeatureCollection","crs":{{"type":"name","properties":{{"name":"{}"}}}},)"
                     R"("features":[{}]}})",
                     crs, fmt::join(features, ",\n"));
}

io::CoordinateFrame frame_of(const std::string& system) {
  const auto crs = checked(io::find_crs(system));
  return {.system = system, .is_in_degrees = crs->is_geographic, .is_metric = crs->is_metric};
}

/// Converts a ring of a coordinate system to a ring in the plane about an origin. Its edges follow the edges in that
/// system to a hundredth of a millimetre.
Ring in_plane(const Ring& ring, const std::string& system, const simulation::GeographicOrigin& origin) {
  const io::CoordinateFrame from = frame_of(system), to = io::frame_about(origin);
  std::vector<io::ProjectedLine> lines{io::line_in(from, ring, true)};
  checked(io::project_vertices(lines, from, to));
  checked(io::add_points(lines, from, to, 1e-4));
  return image_of(lines[0]);
}

/// A vertex of one ring that lies farther from the other ring than that [m].
std::optional<Point> far_vertex(const Ring& from, const Ring& ring, double most) {
  const std::vector<geometry::Edge> edges = geometry::edges_of({ring, {}});
  const geometry::BoxTree tree(edges);
  for (const Point p : from) {
    bool is_near = false;
    tree.for_each_near({{p.x - most, p.y - most}, {p.x + most, p.y + most}}, [&](std::size_t i) {
      is_near = is_near || distance(p, nearest_on_segment(edges[i].a, edges[i].b, p)) <= most;
      return !is_near;
    });
    if (!is_near) return p;
  }
  return {};
}

/// Returns whether the boundaries of the two rings are within `most` of each other [m].
testing::AssertionResult are_near(const Ring& a, const Ring& b, double most) {
  for (const auto& [one, other] : {std::pair{&a, &b}, {&b, &a}})
    if (const auto p = far_vertex(*one, *other, most))
      return testing::AssertionFailure() << fmt::format("({}, {}) lies farther than {} m from the other", p->x, p->y,
                                                        most);
  return testing::AssertionSuccess();
}

/// Floes around a place, in its plane: ragged floes of some hundred metres, a long floe, a floe with a hole, and a floe
/// that contains the place.
std::vector<Polygon> floes_about() {
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> spread(0.7, 1.3);
  const auto ragged = [&](Point centre, double radius, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, r = radius * spread(dice);
      ring.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
    }
    return ring;
  };
  Ring hole = ragged({1500, 900}, 100, 6);
  std::ranges::reverse(hole);
  return {{ragged({0, 0}, 200, 11), {}},
          {ragged({-900, 300}, 250, 7), {}},
          {ragged({1500, 900}, 400, 9), {hole}},
          {{{-3000, -900}, {3000, -1100}, {3000, -800}, {-3000, -600}}, {}}};
}

struct Site {
  std::string name;
  double latitude = 0, longitude = 0;
  std::string utm;  ///< empty: beyond its limits
};
const std::vector<Site> kSites{
    {"60N", 60, 20, "EPSG:32634"}, {"78N", 78, 15.6, "EPSG:32633"},   {"84N", 83.9, -40, "EPSG:32624"},
    {"89N", 89, -120, ""},         {"180", 72, 180, "EPSG:32660"},    {"180W", 75, -179.995, "EPSG:32601"},
    {"pole", 90, 0, ""},           {"near the pole", 89.999, 70, ""}, {"south", -75, 164, ""},
    {"south pole", -90, 0, ""}};

class RoundTrip : public InFolder, public testing::WithParamInterface<std::size_t> {
 protected:
  /// Returns the floes of a file after conversion to a scene, a run and an export at the start in the same system.
  std::vector<Polygon> there_and_back(const std::string& file, const Site& site, const std::string& system) {
    write("mapped.geojson", file);
    done(Words(fmt::format("import mapped.geojson --origin {},{} --out floes.geojson", site.latitude, site.longitude)));
    write("scene.json", fmt::format(R"({{"origin": {{"latitude_deg": {}, "longitude_deg": {}}},
                                        "time": {{"until_s": 0.1}}, "floes": [{{"file": "floes.geojson"}}]}})",
                                    site.latitude, site.longitude));
    done("run scene.json --out run --overwrite --no-map --progress none");
    done(Words("export run --geojson layers --at 0 --crs") + Words{system});
    const auto text = checked(io::read_floe_text(read("layers/floes.geojson")));
    std::vector<Polygon> floes;
    for (const io::FloeEntry& entry : text->entries) floes.push_back(entry.polygon);
    return floes;
  }
};

/// Boundaries return within a millimetre in every system, both for edges that are straight in the file and for edges
/// that are straight in the scene's plane.
TEST_P(RoundTrip, KeepsBoundariesWithinAMillimetre) {
  const Site& site = kSites[GetParam()];
  const simulation::GeographicOrigin origin = origin_at(site.latitude, site.longitude);
  std::vector<std::string> systems{"EPSG:4326"};
  if (site.latitude > 0) systems.insert(systems.end(), {"EPSG:3413", "EPSG:3996"});
  if (site.latitude < 0) systems.emplace_back("EPSG:3031");
  if (!site.utm.empty()) systems.push_back(site.utm);
  for (const std::string& system : systems) {
    SCOPED_TRACE(site.name + " in " + system);
    const io::CoordinateFrame plane = io::frame_about(origin), file = frame_of(system);
    std::vector<Polygon> drawn;
    std::vector<std::string> features;
    for (Polygon floe : floes_about()) {
      std::vector<io::ProjectedLine> lines{io::line_in(plane, floe.outer, true)};
      for (const Ring& hole : floe.holes) lines.push_back(io::line_in(plane, hole, true));
      checked(io::project_vertices(lines, plane, file));
      if (file.is_in_degrees) checked(io::add_points(lines, plane, file, 1));
      floe.outer = image_of(lines[0]);
      for (std::size_t i = 0; i < floe.holes.size(); ++i) floe.holes[i] = image_of(lines[i + 1]);
      if (file.is_in_degrees) floe = io::drawn_in_degrees(floe, site.longitude);
      features.push_back(feature_json(floe));
      drawn.push_back(std::move(floe));
    }
    const std::vector<Polygon> back = there_and_back(collection_json(features, system), site, system);
    ASSERT_EQ(back.size(), drawn.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      EXPECT_TRUE(are_near(in_plane(back[i].outer, system, origin), in_plane(drawn[i].outer, system, origin), 1e-3))
          << "floe " << i;
      ASSERT_EQ(back[i].holes.size(), drawn[i].holes.size());
      for (std::size_t h = 0; h < back[i].holes.size(); ++h)
        EXPECT_TRUE(
            are_near(in_plane(back[i].holes[h], system, origin), in_plane(drawn[i].holes[h], system, origin), 1e-3));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfSites, RoundTrip, testing::Range(std::size_t{0}, kSites.size()));

class PlaceOnEarth : public InFolder {
 protected:
  /// The middle of the floes that a scene's run exports in degrees at its start.
  Point exported_middle(const std::string& scene) {
    write("scene.json", scene);
    done("run scene.json --out run --overwrite --no-map --progress none");
    done("export run --geojson layers --at 0");
    const auto text = checked(io::read_floe_text(read("layers/floes.geojson")));
    Point sum;
    double count = 0;
    for (const io::FloeEntry& entry : text->entries)
      for (std::size_t i = 0; i + 1 < entry.polygon.outer.size(); ++i) {
        sum = sum + (entry.polygon.outer[i] - Point{});
        ++count;
      }
    return {sum.x / count, sum.y / count};
  }
  static std::string scene(const std::string& members, const std::string& more = "", const std::string& file = "") {
    return fmt::format(R"({{{} "time": {{"until_s": 0.1}}, "floes": [{{"file": "{}"{}}}]}})", members,
                       file.empty() ? "floes.geojson" : file, more);
  }
  static std::string origin_json(double latitude, double longitude, double heading = 90) {
    return fmt::format(R"("origin": {{"latitude_deg": {}, "longitude_deg": {}, "heading_deg": {}}},)", latitude,
                       longitude, heading);
  }
};

const std::string kMappedSquare =
    R"({"crs":{"type":"name","properties":{"name":"OGC:CRS84"}},"type":"Polygon",)"
    R"("coordinates":[[[15.6,78.2],[15.61,78.2],[15.61,78.202],[15.6,78.202],[15.6,78.2]]]})";
constexpr Point kMiddle{15.605, 78.201};

/// Exported floes lie where they were mapped, however the file was converted to metres and wherever the scene's origin
/// is.
TEST_F(PlaceOnEarth, OfAFileAndOfItsSceneAreOne) {
  write("square.geojson", kMappedSquare);
  for (const char* how : {"--origin 78.3,15", "--origin 78.3,15 --shift", "--origin 78.3,15,30 --shift", "",
                          "--crs EPSG:3413 --shift", "--crs EPSG:32633 --shift"}) {
    done(Words("import square.geojson --out floes.geojson") + Words(how));
    for (const std::string& origin : {origin_json(78.3, 15), origin_json(78.25, 15.5, 200)}) {
      const Point middle = exported_middle(scene(origin));
      EXPECT_NEAR(middle.x, kMiddle.x, 1e-7) << how << origin;
      EXPECT_NEAR(middle.y, kMiddle.y, 1e-8) << how << origin;
    }
  }
}

TEST_F(PlaceOnEarth, OfARunIsInTheFloesThatItLeaves) {
  write("square.geojson", kMappedSquare);
  done("import square.geojson --origin 78.2,15.6,30 --out floes.geojson");
  write("scene.json", scene(origin_json(78.2, 15.6, 30)));
  done("run scene.json --out run --no-map --progress none");
  EXPECT_HAS(read("run/final.geojson"), R"("origin":{"latitude_deg":78.2,"longitude_deg":15.6,"heading_deg":30})");
  done("export run --scene --out next");
  done("export run --geojson metres --metres");
  for (const std::string file : {"run/final.geojson", "next/floes.geojson", "metres/floes.geojson"}) {
    const Point middle = exported_middle(scene(origin_json(78.25, 15.2), "", file));
    EXPECT_NEAR(middle.x, kMiddle.x, 1e-7) << file;
    EXPECT_NEAR(middle.y, kMiddle.y, 1e-8) << file;
  }
}

TEST_F(PlaceOnEarth, OfAnImportedFileIsKeptByAnotherImportAndByACut) {
  write("square.geojson", kMappedSquare);
  done("import square.geojson --origin 78.3,15 --shift --out first.geojson");
  const std::string place = R"("origin":{"latitude_deg":78.3,"longitude_deg":15,"heading_deg":90},"shift_m":[)";
  EXPECT_HAS(read("first.geojson"), place);
  done("import first.geojson --simplify 0.1 --out floes.geojson");
  EXPECT_HAS(read("floes.geojson"), place);
  done("cut floes.geojson --crack 0,0,30 --out pieces.geojson");
  EXPECT_HAS(read("pieces.geojson"), place);
  done("import first.geojson --origin 78.2,15.6 --out moved.geojson");
  EXPECT_HAS(read("moved.geojson"), R"("origin":{"latitude_deg":78.2,"longitude_deg":15.6,"heading_deg":90},)");
  EXPECT_LACKS(read("moved.geojson"), "shift_m");
  for (const char* file : {"floes.geojson", "pieces.geojson", "moved.geojson"})
    EXPECT_NEAR(exported_middle(scene(origin_json(78.25, 15.5), "", file)).y, kMiddle.y, 1e-5) << file;
  EXPECT_HAS(expect_code(4, call("import first.geojson --from EPSG:3413 --out floes.geojson")).err,
             "the file states its own place, the plane about 78.3° N, 15° E", "EPSG:3413 is given");
}

TEST_F(PlaceOnEarth, ThatIsNotOneIsRefusedByName) {
  write("square.geojson", kMappedSquare);
  done("import square.geojson --origin 78.3,15 --shift --out floes.geojson");
  done("import square.geojson --origin 78.4,15 --out other.geojson");
  done("import square.geojson --crs EPSG:3413 --shift --out polar.geojson");
  const auto refuse = [&](const std::string& text) {
    write("scene.json", text);
    return expect_code(3, call("validate scene.json")).err;
  };
  EXPECT_HAS(refuse(scene(origin_json(78.3, 15), R"(, "import": {"shift": true})")),
             "import.shift in a scene that has an origin");
  EXPECT_HAS(refuse(R"({"floes": [{"file": "floes.geojson"}, {"file": "other.geojson"}]})"),
             "metres of the plane about 78.4° N, 15° E", "the plane about 78.3° N, 15° E, x along 90°, shifted by (");
  EXPECT_HAS(refuse(R"({"floes": [{"file": "floes.geojson"}, {"file": "polar.geojson"}]})"),
             "metres of the plane of EPSG:3413, shifted by (");
  write("floes.geojson", R"({"origin": {"latitude_deg": 95, "longitude_deg": 0},)" + kMappedSquare.substr(1));
  EXPECT_HAS(refuse(scene(origin_json(78.3, 15))), R"(its "origin" is not latitude_deg, longitude_deg)");
}

TEST_F(PlaceOnEarth, OfAFileIsToldWhereTheSceneHasNone) {
  write("square.geojson", kMappedSquare);
  done("import square.geojson --origin 78.3,15 --shift --out floes.geojson");
  write("scene.json", scene(""));
  EXPECT_HAS(done("validate scene.json").err, "its metres are of the plane about 78.3° N, 15° E", "no \"origin\"");
  done("run scene.json --out run --no-map --progress none");
  EXPECT_HAS(expect_code(2, call("export run --geojson layers --crs EPSG:3413")).err, "no \"origin\"");
}

/// Neighbours that share a parallel keep touching, although one has a vertex where the other has none.
TEST_F(PlaceOnEarth, EdgesFollowTheirParallel) {
  write("chart.geojson", R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
      [[[15, 78.2], [15.5, 78.2], [15.5, 78.25], [15, 78.25], [15, 78.2]]]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
      [[[15, 78.2], [15, 78.15], [15.5, 78.15], [15.5, 78.2], [15.21, 78.2], [15, 78.2]]]}}]})");
  for (const double tolerance : {0.0005, 0.01, 1.0}) {
    const Outcome imported = done(
        Words(fmt::format("import chart.geojson --origin 78.2,15.2 --tolerance {} --out floes.geojson", tolerance)));
    EXPECT_HAS(imported.err, "added to edges");
    const auto floes = checked(io::read_floe_text(read("floes.geojson")));
    // The deviation of the one shared edge from the other.
    const Ring &north = floes->entries[0].polygon.outer, &south = floes->entries[1].polygon.outer;
    double most = 0;
    int shared = 0;
    for (const Point p : north) {
      double least = 1e9;
      for (std::size_t i = 0; i + 1 < south.size(); ++i)
        least = std::min(least, distance(p, nearest_on_segment(south[i], south[i + 1], p)));
      if (least < 15) {
        most = std::max(most, least);
        ++shared;
      }
    }
    EXPECT_GT(shared, 2);
    EXPECT_LE(most, 2 * tolerance) << tolerance;
  }
  done("import chart.geojson --origin 78.2,15.2 --tolerance 0 --out floes.geojson");
  EXPECT_EQ(checked(io::read_floe_text(read("floes.geojson")))->entries[0].polygon.outer.size(), 5U);
}

/// A floe over a pole is written as one ring with a seam to the pole, and is read back without the seam. A floe with
/// the pole on its boundary has the pole as a vertex. Files of other programs draw such a ring with longitudes from
/// -180 to 180.
TEST_F(PlaceOnEarth, OverThePoleIsOneRing) {
  for (const double pole : {90.0, -90.0}) {
    const double lat = pole > 0 ? 89.998 : -89.998;
    std::string ring, seam;
    for (int lon = -180; lon <= 180; lon += 30) ring += fmt::format("[{},{}],", lon, lat);
    seam = fmt::format("[180,{}],[-180,{}],", pole, pole);
    double area = 0;
    for (const std::string& text : {ring + seam + fmt::format("[-180,{}]", lat), ring.substr(0, ring.size() - 1)}) {
      write("cap.geojson", R"({"type":"Polygon","coordinates":[[)" + text + "]]}");
      done(Words(fmt::format("import cap.geojson --origin {},0 --out floes.geojson", pole)));
      const auto floes = checked(io::read_floe_text(read("floes.geojson")));
      ASSERT_EQ(floes->entries.size(), 1U);
      const double of_file = std::abs(geometry::signed_area(floes->entries[0].polygon.outer));
      EXPECT_NEAR(of_file, std::numbers::pi * 223.4 * 223.4, 0.01 * of_file) << "a disc about the pole";
      EXPECT_TRUE(area == 0 || std::abs(of_file - area) < 1e-3);
      area = of_file;
    }
    exported_middle(scene(origin_json(pole, 0)));
    const auto back = checked(io::read_floe_text(read("layers/floes.geojson")));
    const Ring& drawn = back->entries[0].polygon.outer;
    const auto at_pole = std::ranges::count_if(drawn, io::is_pole);
    EXPECT_EQ(at_pole, 2) << "a seam to the pole";
    const auto [west, east] = std::ranges::minmax(drawn, {}, &Point::x);
    EXPECT_NEAR(east.x - west.x, 360, 1e-9);
    EXPECT_GT(geometry::signed_area(drawn), 0);
    // One floe has a corner at the pole, and another has an edge through it.
    write("scene.json",
          fmt::format(R"({{{} "time": {{"until_s": 0.1}}, "floes": [{{"polygon": {{"outer_m": [[0,0],[90,0],[0,90]]}}}},
        {{"polygon": {{"outer_m": [[-100,-50],[-10,-50],[-10,50],[-100,50]]}}}},
        {{"polygon": {{"outer_m": [[-5,-200],[5,-200],[5,-100],[-5,-100]]}}}}]}})",
                      origin_json(pole, 0)));
    done("run scene.json --out run --overwrite --no-map --progress none");
    done("export run --geojson layers --at 0");
    done(Words(fmt::format("import layers/floes.geojson --origin {},0 --out floes.geojson", pole)));
    const auto corner = checked(io::read_floe_text(read("floes.geojson")));
    ASSERT_EQ(corner->entries.size(), 3U);
    EXPECT_TRUE(are_near(corner->entries[0].polygon.outer, {{0, 0}, {90, 0}, {0, 90}}, 1e-3));
  }
}

}  // namespace
}  // namespace polynya::tests
