#include "analysis/channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "../io/expect_text.hpp"

#include "geometry/exact/measures.hpp"

namespace polynya::tests {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Vector;

Polygon box(Point low, Point high) {
  return {{low, {high.x, low.y}, high, {low.x, high.y}}, {}};
}

/// A run made by hand: a hull 20 m long and 8 m wide goes 100 m straight along `heading` in 50 s, over the
/// water, through ice that goes with the water.
struct HandMadeRun {
  io::Run run;
  double heading;
  Vector drift;

  explicit HandMadeRun(double turned_by = 0, Vector drifting = {}) : heading(turned_by), drift(drifting) {
    simulation::Scene& scene = run.scene.scene;
    scene.water.drift = drift;
    scene.ships.push_back({});
    scene.ships.back().name = "ship";
    scene.ships.back().hull.waterline = box({-10, -4}, {10, 4}).outer;
    for (int i = 0; i <= 10; ++i) {
      const double t = 5.0 * i;
      run.frames.push_back({t, {{world(Point{2 * t, 0}, t), heading, {}, 0}}, {}});
    }
  }
  Point world(Point p, double time) const {
    return Point{} + rotate(geometry::Rotation::by(heading), p - Point{}) + time * drift;
  }
  /// Ice along the track's axes.
  void add(const Polygon& along_track) {
    simulation::BirthRecord birth;
    birth.floe = static_cast<simulation::FloeId>(run.floes.size());
    Polygon polygon = along_track;
    for (Point& p : polygon.outer) p = world(p, 0);
    run.shapes.add(polygon);
    const auto measures = geometry::measure(polygon);
    birth.area = measures.area;
    birth.centroid_in_body = measures.centroid;
    run.scene.scene.floes.push_back({polygon, {}, 0});
    run.frames.front().floes.push_back({birth.floe, {birth.centroid_in_body, 0, drift, 0}});
    run.floes.push_back({.birth = birth, .death_event = {}});
  }
  /// Ice on both sides of the track, 33 m apart.
  void add_walls() {
    add(box({-50, 14}, {200, 40}));
    add(box({-50, -60}, {200, -19}));
  }
  /// Adds a piece that surfaced from under the hull.
  void add_brash(const Polygon& along_track) {
    add(along_track);
    run.floes.back().came_up = true;
  }
};

analysis::Channel measured(const io::Run& run, analysis::ChannelOptions options = {}) {
  auto channel = measure_channel(run, options);
  EXPECT_TRUE(channel.has_value()) << channel.error();
  return *channel;
}

TEST(Channel, IsAsWideAsItsWallsAreApartWhateverTheHeadingAndTheDrift) {
  for (const double heading : {0.0, 0.7, -2.5}) {
    for (const Vector drift : {Vector{0, 0}, Vector{-0.3, 0.11}}) {
      HandMadeRun made(heading, drift);
      made.add_walls();
      made.add(box({41, 2}, {47, 6}));  // half of it in the band
      const analysis::Channel channel = measured(made.run);
      ASSERT_EQ(channel.stations.size(), 11U);  // 90 m behind the stern, 8 m each
      for (const analysis::ChannelStation& s : channel.stations) {
        EXPECT_NEAR(s.starboard, 19, 1e-9);
        const bool has_floe = s.along > 40 && s.along < 48;
        EXPECT_NEAR(s.port, has_floe ? 2 : 14, 1e-9);
        EXPECT_NEAR(s.passed, s.along / 2, 1e-9);
      }
      EXPECT_NEAR(channel.swept_area, 120 * 8, 1e-8);
      EXPECT_NEAR(channel.swept_ice_at_start, 12, 1e-9);
      ASSERT_EQ(channel.floes.size(), 1U);
      EXPECT_EQ(channel.floes[0].floe, 2);
      EXPECT_NEAR(channel.floes[0].inside, 12, 1e-9);
      // 88 m of cells between walls 33 m apart, without the floe.
      EXPECT_NEAR(channel.open_area, 88 * 33 - 24, 1e-8);
    }
  }
}

TEST(Channel, WithoutIceInReachHasNoWidth) {
  HandMadeRun made;
  made.add(box({-50, 14}, {200, 40}));
  const analysis::Channel channel = measured(made.run, analysis::ChannelOptions{0, {}, 0, 10});
  EXPECT_EQ(widths(channel).count, 0U);
  EXPECT_TRUE(channel.open_water.empty());
  for (const analysis::ChannelStation& s : channel.stations) {
    EXPECT_FALSE(s.has_port_ice);
    EXPECT_EQ(s.width(), 20);
  }
  EXPECT_HAS(to_table(channel), ">20.00");
}

TEST(Channel, IceAcrossTheTrackClosesIt) {
  HandMadeRun made;
  made.add(box({30, -5}, {34, 5}));
  const analysis::Channel channel = measured(made.run);
  const analysis::ChannelStation& closed = channel.stations[3];  // 24 to 32 m
  EXPECT_EQ(closed.width(), 0);
  EXPECT_NEAR(closed.ice_across_beam, 0.25, 1e-12);
  EXPECT_TRUE(closed.is_bounded());
}

TEST(Channel, LeftoverIceOfTheBandIsAccountedForFloeByFloe) {
  HandMadeRun made(0.3);
  made.add(box({10, -1}, {12, 1}));
  made.add(box({20, -30}, {60, -3}));
  const analysis::Channel channel = measured(made.run);
  ASSERT_EQ(channel.floes.size(), 2U);
  EXPECT_GT(channel.floes[0].size, channel.floes[1].size);
  EXPECT_NEAR(channel.swept_ice(), 4 + 40, 1e-9);
  EXPECT_NEAR(channel.swept_ice_at_start, 4 + 40, 1e-9);
}

/// Cells are 8 m long and 33 m wide between the walls; brash in the first, across the border of the first
/// two, across the whole channel, and half under a wall.
TEST(Channel, BrashCoversItAndDoesNotNarrowIt) {
  for (const double heading : {0.0, 0.7}) {
    HandMadeRun made(heading, {0.2, -0.1});
    made.add_walls();
    made.add_brash(box({1, -2}, {5, 2}));      // 16 m²
    made.add_brash(box({7, -1}, {16, 3}));     // 4 and 32 m²
    made.add_brash(box({26, -19}, {29, 14}));  // 99 m²: water on both sides of it
    made.add_brash(box({66, 12}, {67, 16}));   // 4 m², 2 of them in the wall
    const analysis::Channel channel = measured(made.run);
    ASSERT_EQ(channel.stations.size(), 11U);
    const double wanted[] = {20, 32, 0, 99, 0, 0, 0, 0, 2, 0, 0};
    for (std::size_t i = 0; i < channel.stations.size(); ++i) {
      const analysis::ChannelStation& station = channel.stations[i];
      EXPECT_NEAR(station.port, 14, 1e-9) << i;
      EXPECT_NEAR(station.starboard, 19, 1e-9) << i;
      EXPECT_NEAR(station.channel_area, 8 * 33, 1e-8) << i;
      EXPECT_NEAR(station.brash_area, wanted[i], 1e-8) << i;
      EXPECT_NEAR(station.brash_cover(), wanted[i] / (8 * 33), 1e-10) << i;
    }
    EXPECT_NEAR(channel.area, 88 * 33, 1e-8);
    EXPECT_NEAR(channel.open_area, 88 * 33 - 153, 1e-8);
    EXPECT_NEAR(channel.brash_cover(), 153.0 / (88 * 33), 1e-10);
    const analysis::BrashSizes sizes = brash_sizes(channel);
    EXPECT_EQ(sizes.count, 4U);
    EXPECT_NEAR(sizes.mean, (4 + 6 + std::sqrt(99.0) + 2) / 4, 1e-9);
    EXPECT_NEAR(sizes.median, 6, 1e-9);
    EXPECT_NEAR(sizes.largest, std::sqrt(99.0), 1e-9);
    EXPECT_NEAR(channel.brash_pieces.back().inside, 2, 1e-8);
    EXPECT_HAS(to_table(channel), "brash covers 5.27 % of the 2904.00 m2 from ice to ice, 94.73 % is open");
    EXPECT_HAS(to_json_text(channel), "\"brash_pieces\": 4");
    EXPECT_HAS(to_geojson(channel), "\"part\":\"brash\"");
    const std::string csv = to_csv(channel);
    EXPECT_EQ(csv.substr(0, csv.find('\n')).substr(csv.find("channel_area_m2")),
              "channel_area_m2,brash_area_m2,brash_cover,is_channel");
  }
}

/// How many of a run's stations are a channel that pictures show.
std::size_t shown(const io::Run& run) {
  const analysis::Channel channel = measured(run);
  const auto count =
      static_cast<std::size_t>(std::ranges::count_if(channel.stations, &analysis::ChannelStation::is_channel));
  EXPECT_EQ(channel.cut_water.empty(), count == 0);
  return count;
}

TEST(Channel, IsShownWhereAShipCutItAndNotWhereIceIsFar) {
  for (const double side : {6.0, 11.9, 12.1}) {  // three beams are 24 m
    HandMadeRun made(0.7, {0.2, -0.1});
    made.add(box({-50, side}, {200, 40}));
    made.add(box({-50, -60}, {200, -side}));
    EXPECT_EQ(shown(made.run), side < 12 ? 11U : 0U) << side;
  }
}

TEST(Channel, OfAMooredOrDriftingShipIsNotShown) {
  HandMadeRun made;
  made.add(box({-50, 6}, {200, 40}));
  made.add(box({-50, -60}, {200, -6}));
  made.run.scene.scene.ships.back().mooring.emplace();
  EXPECT_EQ(shown(made.run), 0U) << "moored";
  made.run.scene.scene.ships.back().mooring.reset();
  ASSERT_EQ(shown(made.run), 11U);
  for (io::Frame& frame : made.run.frames) frame.ships.front().angle += 0.6;
  EXPECT_EQ(shown(made.run), 0U) << "it goes half sideways";
  for (io::Frame& frame : made.run.frames) frame.ships.front().angle += std::numbers::pi - 0.6;
  EXPECT_EQ(shown(made.run), 11U) << "astern";
}

/// A circle of that radius through narrow ice, made of many small boxes: one frame a second at 2 m/s.
std::size_t shown_on_circle(double radius) {
  HandMadeRun made;
  made.run.frames.resize(1);
  made.run.frames.front().ships.front().position = {radius, 0};
  made.run.frames.front().ships.front().angle = std::numbers::pi / 2;
  for (int i = 1; i <= 60; ++i) {
    const double turn = 2.0 * i / radius;
    const Point at{radius * std::cos(turn), radius * std::sin(turn)};
    made.run.frames.push_back({1.0 * i, {{at, turn + std::numbers::pi / 2, {}, 0}}, {}});
  }
  for (double turn = -0.5; turn < 125 / radius; turn += 3 / radius) {
    for (const double r : {radius - 7, radius + 7}) {
      const Point c{r * std::cos(turn), r * std::sin(turn)};
      made.add(box(c - Vector{1, 1}, c + Vector{1, 1}));
    }
  }
  return shown(made.run);
}

TEST(Channel, IsShownInAWideTurnAndNotInATightOne) {
  EXPECT_GT(shown_on_circle(80), 10U);  // ten beams
  EXPECT_EQ(shown_on_circle(24), 0U);   // three beams
}

TEST(Channel, WithoutBrashHasNoPiecesAndNoSizes) {
  HandMadeRun made;
  made.add_walls();
  const analysis::Channel channel = measured(made.run);
  EXPECT_EQ(channel.brash_cover(), 0);
  EXPECT_EQ(brash_sizes(channel).count, 0U);
  EXPECT_TRUE(std::isnan(brash_sizes(channel).mean));
  EXPECT_LACKS(to_table(channel), "brash");
}

TEST(Channel, WaterCarriesAffinelyAndBack) {
  simulation::WaterSettings water;
  water.drift = {0.2, -0.1};
  water.shear = {0.01, 0.5, {3, 4}};
  for (const Point p : {Point{0, 0}, Point{100, -20}, Point{-7, 55}}) {
    const Point there = analysis::carried_by_water(water, p, 10, 200);
    const Point back = analysis::carried_by_water(water, there, 200, 10);
    EXPECT_NEAR(distance(p, back), 0, 1e-9);
    const Point halfway = analysis::carried_by_water(water, analysis::carried_by_water(water, p, 10, 80), 80, 200);
    EXPECT_NEAR(distance(there, halfway), 0, 1e-9);
  }
}

TEST(Channel, RefusesTimesAndShipsThatAreNotThere) {
  const HandMadeRun made;
  EXPECT_FALSE(measure_channel(made.run, analysis::ChannelOptions{1, {}, 0, 0}).has_value());
  EXPECT_FALSE(measure_channel(made.run, analysis::ChannelOptions{0, 51, 0, 0}).has_value());
}

// ---- ice where it is placed, and parts of it

const Polygon kSquare{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}};

/// The ice of a valid floe is exact, also near the edges of boxes. The ice of a floe whose ring crosses itself is the
/// area around which the ring winds.
TEST(PlacedIce, IsWhatItsFloeEncloses) {
  std::vector<analysis::PlacedIce> ice, crossed, none;
  ASSERT_TRUE(analysis::add_ice(ice, nullptr, kSquare));
  ASSERT_EQ(ice.size(), 1);
  EXPECT_EQ(ice[0].polygon.outer, kSquare.outer);
  EXPECT_EQ(ice[0].box.high.x, 2);
  EXPECT_EQ(near(ice, {{1, 1}, {5, 5}}).size(), 1);
  EXPECT_EQ(near(ice, {{3, 1}, {5, 5}}).size(), 0);
  ASSERT_TRUE(analysis::add_ice(crossed, nullptr, {{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}));
  ASSERT_EQ(crossed.size(), 2);
  EXPECT_EQ(geometry::measure(crossed[0].polygon).area + geometry::measure(crossed[1].polygon).area, 2);
  EXPECT_TRUE(analysis::add_ice(none, nullptr, {{{0, 0}, {1, 1}, {2, 2}}, {}}));
  const Polygon endless{{{0, 0}, {1, 0}, {0, std::numeric_limits<double>::infinity()}}, {}};
  const auto placed = analysis::add_ice(none, nullptr, endless);
  ASSERT_FALSE(placed.has_value());
  EXPECT_HAS(placed.error(), "a placed floe is not a polygon");
  EXPECT_TRUE(none.empty());
}

TEST(PlacedIce, IsPartedIntoWhatOthersCoverAndTheRest) {
  const Polygon half{{{-1, -1}, {1, -1}, {1, 3}, {-1, 3}}, {}};
  const auto parted = checked(analysis::part(kSquare, {half}));
  EXPECT_EQ(parted->inside_area, 2);
  ASSERT_EQ(parted->outside.size(), 1);
  EXPECT_EQ(geometry::measure(parted->outside[0]).area, 2);
  const Polygon far{{{10, 10}, {11, 10}, {11, 11}}, {}};
  for (const auto& by : {std::vector<Polygon>{}, std::vector<Polygon>{far}}) {
    const auto whole = checked(analysis::part(kSquare, by));
    EXPECT_TRUE(whole->inside.empty());
    ASSERT_EQ(whole->outside.size(), 1);
    EXPECT_EQ(whole->outside[0].outer, kSquare.outer);
  }
}

}  // namespace
}  // namespace polynya::tests
