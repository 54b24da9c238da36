// Exported files: triangles that cover a polygon, VTK's layout, and scenes that continue a run.
#include "views/export/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "../base64.hpp"
#include "../io/scene_text.hpp"
#include "../io/temporary_folder.hpp"
#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/outline.hpp"
#include "io/run/run_loop.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using geometry::Ring;

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

/// Returns the n-th value of a column, from the text of the file alone.
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

// ---- a run's end, or one of its frames, as the start of another

/// A ship that pushes floes too small to break against each other, in a drifting sheared current.
std::string crowd(double until) {
  return fmt::format(R"({{
    "name": "crowd", "time": {{"step_s": 0.01, "until_s": {}}},
    "record": {{"forces_interval_s": 0.1, "frames_interval_s": 1}},
    "water": {{"drift_m_per_s": [0.1, -0.2], "shear": {{"rate_per_s": 1e-4}}}},
    "ships": [{{"name": "pusher", "hull": {{"length_m": 60, "beam_m": 14, "entrance_angle_deg": 30}}, "mass_kg": 3e6,
               "moment_of_inertia_kg_m2": 5e8, "position_m": [-31, 1], "speed_m_per_s": 2, )"
                     R"("propulsion": {{"thrust_N": 2e5}}}}],
    "floes": [{{"lattice": {{"columns": 8, "rows": 9, "origin_m": [0, -36], "pitch_m": 8, "size_m": 7.9}}}}]}})",
                     until);
}

class SceneExport : public testing::Test {
 protected:
  /// Runs a scene in the folder and reads the run.
  io::Run run(const std::string& name, const io::LoadedScene& scene) const {
    auto active = io::start_run(folder / name, scene);
    EXPECT_TRUE(active) << active.error();
    EXPECT_EQ(run_to_end(*active).end, io::RunEnd::kFinished);
    auto read = io::read_run(folder / name);
    EXPECT_TRUE(read) << read.error();
    return std::move(*read);
  }
  io::LoadedScene load(const std::string& text) const { return tests::load(text, folder.path()); }
  /// The scene that continues a run from a time.
  io::LoadedScene continued(const io::Run& run, double time) const {
    const auto scene = views::continued_scene(run, time);
    EXPECT_TRUE(scene) << scene.error();
    for (const auto& [name, text] : scene->files) write_file(folder / name, text);
    return load(scene->files[0].second);
  }
  void expect_ship_goes_on(const io::Run& whole, double time) const {
    const auto at = io::MotionIndex(whole).ship_at(0, time);
    const io::LoadedScene loaded = continued(whole, time);
    const simulation::Ship& ship = loaded.scene.ships[0];
    EXPECT_EQ(ship.position_in_world, at->position);
    const geometry::Vector ahead{std::cos(at->angle), std::sin(at->angle)};
    EXPECT_NEAR(length(ship.speed * ahead + ship.sway_speed * perpendicular(ahead) - at->velocity), 0, 1e-12);
    EXPECT_NEAR(ship.yaw_rate, at->angular_velocity, 1e-12);
  }
  TemporaryFolder folder;
};

/// How far apart two runs are at their ends [m].
struct Miss {
  double ship = 0;
  double floes = 0;  ///< the largest of all
};
Miss miss_between(const io::Run& a, const io::Run& b) {
  const io::MotionIndex motions_a(a), motions_b(b);
  Miss miss;
  miss.ship =
      geometry::distance(motions_a.ship_at(0, a.end_time())->position, motions_b.ship_at(0, b.end_time())->position);
  EXPECT_EQ(a.floes.size(), b.floes.size());
  for (std::size_t i = 0; i < a.floes.size(); ++i) {
    const auto id = static_cast<simulation::FloeId>(i);
    const auto p = motions_a.floe_at(id, a.end_time()), q = motions_b.floe_at(id, b.end_time());
    if (p && q) miss.floes = std::max(miss.floes, geometry::distance(p->position, q->position));
  }
  return miss;
}

/// The exports are made at the end of a shorter run, and at the frame before 8.6 s of the run itself.
TEST_F(SceneExport, ContinuingMovesAsAnUnbrokenRun) {
  const io::Run whole = run("whole", load(crowd(12)));
  EXPECT_GT(distance(io::MotionIndex(whole).ship_at(0, 12)->position, {-31, 1}), 5);
  const io::Run half = run("half", load(crowd(8)));
  io::LoadedScene of_half = continued(half, half.end_time());
  EXPECT_TRUE(std::ranges::any_of(of_half.scene.floes, [](const simulation::FloeSpec& floe) {
    return length(floe.velocity) > 0.05;
  })) << "ice is on the move";
  EXPECT_EQ(of_half.scene.floes[5].source_floe, 5);
  EXPECT_EQ(load(of_half.resolved_text).hash, of_half.hash);
  const std::string text = read_file(folder / "scene.json");
  const std::size_t at = text.find("\"until_s\": ");
  of_half = load(std::string(text).replace(at, text.find_first_of(",\n}", at) - at, "\"until_s\": 4"));

  const auto scene = checked(views::continued_scene(whole, 8.6));
  EXPECT_EQ(scene->time, 8);
  EXPECT_TRUE(scene->left_out.empty());
  const io::LoadedScene of_frame = continued(whole, 8.6);
  EXPECT_NEAR(of_frame.scene.time.until, 4, 1e-12);
  EXPECT_NEAR(of_frame.scene.water.shear.origin.y, -1.6, 1e-12);
  for (const auto& [name, rest] : {std::pair("end", of_half), std::pair("frame", of_frame)}) {
    const Miss miss = miss_between(whole, run(name, rest));
    EXPECT_LT(miss.ship, 2e-3) << name;
    EXPECT_LT(miss.floes, 0.2) << name;
  }
  expect_ship_goes_on(half, half.end_time());
}

TEST_F(SceneExport, TheClockOfATablePilotGoesOn) {
  const std::string text = R"({"time": {"step_s": 0.1, "until_s": 40}, "ships": [{"ship": "reference",
    "pilot": {"table": {"rows": [{"t_s": 0, "lever": 0}, {"t_s": 20, "lever": 1}, {"t_s": 60, "lever": 0.2}]}}}]})";
  const io::LoadedScene loaded = continued(run("sailing", load(text)), 10);
  const auto& rows = std::get<simulation::TablePilot>(loaded.scene.ships[0].pilot).rows;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].time, 0);
  EXPECT_NEAR(rows[0].lever, 0.5, 1e-12);
  EXPECT_EQ(rows[1].time, 10);
  EXPECT_EQ(rows[2].time, 50);
}

/// A ship presses a plate under, in drifting water. The distance is that of the frames. A scene does not contain the
/// water that is missing on decks.
TEST_F(SceneExport, IceUnderAHullStaysThere) {
  const std::string text = R"({"time": {"step_s": 0.01, "until_s": 30}, "water": {"drift_m_per_s": [0, 0.1]},
    "fracture": {"bending": {"decks": "wet"}},
    "ships": [{"name": "icebreaker", "hull": {"length_m": 40, "beam_m": 8, "entrance_angle_deg": 27, )"
                           R"("stem_angle_deg": 30,
      "draught_m": 2}, "mass_kg": 1e6, "moment_of_inertia_kg_m2": 1e8, "position_m": [-21, 0],
      "propulsion": {"constant_speed_m_per_s": 2}}],
    "floes": [{"rectangle": {"corner_m": [0, -25], "size_m": [100, 50]}}]})";
  const io::Run whole = run("whole", load(text));
  for (const double time : {20.0, 30.0}) {
    const auto before = floes_under_hulls_at(whole, io::MotionIndex(whole), time);
    ASSERT_GT(before.size(), 5U);
    EXPECT_TRUE(checked(views::continued_scene(whole, time))->left_out.empty());
    const io::LoadedScene scene = continued(whole, time);
    EXPECT_EQ(load(scene.resolved_text).hash, scene.hash);
    const io::Run rest = run(fmt::format("rest-{}", time), scene);
    const auto after = floes_under_hulls_at(rest, io::MotionIndex(rest), 0);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_NEAR(after[i].birth->area, before[i].birth->area, 1e-9);
      EXPECT_LT(distance(after[i].motion->position, before[i].motion->position), 2e-3);
    }
    if (time == 30.0) continue;
    // The ice surfaces behind the ship as in the uninterrupted run, except for the places where it finds room.
    const auto area_under = [](const io::Run& of, double at) {
      double area = 0;
      for (const io::PlacedFloe& floe : floes_under_hulls_at(of, io::MotionIndex(of), at)) area += floe.birth->area;
      return area;
    };
    EXPECT_NEAR(area_under(rest, 2), area_under(whole, 22), 0.2 * area_under(whole, 22));
    const auto force = [](const io::Run& of, double at) {
      const auto row = std::ranges::lower_bound(of.samples, at - 1e-6, {}, &simulation::HullSample::time);
      return row->from_submerged.surge;
    };
    EXPECT_LT(force(whole, 20.1), 0);
    EXPECT_NEAR(force(rest, 0.1), force(whole, 20.1), 0.25 * std::abs(force(whole, 20.1)));
  }
}

}  // namespace
}  // namespace polynya::tests
