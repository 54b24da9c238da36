// What a run leaves out changes nothing: the same scene with and without culling gives the same bytes, and
// without sleep the same within what the rest speed explains.
#include <cstring>

#include <gtest/gtest.h>

#include "simulation/field/floe_field.hpp"
#include "simulation/world/world.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

/// Everything a run recorded and where it ended, as numbers.
class Record {
 public:
  void add(double value) { numbers_.push_back(value); }
  void add(Vector v) {
    add(v.x);
    add(v.y);
  }
  void add(Point p) { add(p - Point{}); }
  const std::vector<double>& numbers() const { return numbers_; }
  bool is_same(const Record& other) const {
    return numbers_.size() == other.numbers_.size() &&
           std::memcmp(numbers_.data(), other.numbers_.data(), numbers_.size() * sizeof(double)) == 0;
  }

 private:
  std::vector<double> numbers_;
};

void add(Record& record, const Story& story) {
  for (const ShipSample& s : story.samples) {
    for (const double value : {s.time, static_cast<double>(s.ship), s.from_ice.surge, s.from_ice.sway,
                               s.from_ice.yaw, s.collision.surge, s.collision.sway, s.collision.yaw,
                               s.from_ice_largest.surge, s.from_ice_largest.sway, s.from_ice_largest.yaw,
                               s.heading, s.yaw_rate, s.thrust, static_cast<double>(s.contacts)})
      record.add(value);
    record.add(s.position_in_world);
    record.add(s.velocity_in_world);
  }
  for (const Event& e : story.events) {
    for (const double value :
         {e.time, static_cast<double>(e.what.index()), static_cast<double>(e.ice()->floe),
          e.is<Bend>() ? std::get<Bend>(e.what).cusp_radius : 0, e.ice()->penetration,
          e.ice()->submerged_area, e.ice()->brash_area, e.criteria().collision_force,
          e.criteria().vertical_force, e.criteria().bending_capacity})
      record.add(value);
    record.add(e.point_in_world);
    record.add(e.ice()->normal_in_world);
  }
  for (const Birth& b : story.births) {
    record.add(b.area);
    for (const Point p : b.polygon_in_body.outer) record.add(p);
  }
}

struct Outcome {
  Record record;
  Story story;
  std::vector<FloeState> floes;
  Counts counts;
};

Outcome outcome_of(const Scene& scene, Shortcuts shortcuts, double until) {
  Simulation simulation(scene, shortcuts);
  Outcome outcome;
  outcome.story = run(simulation, until);
  outcome.floes = simulation.floe_states();
  outcome.counts = simulation.counts();
  add(outcome.record, outcome.story);
  for (FloeState& state : outcome.floes) {
    outcome.record.add(static_cast<double>(state.floe));
    outcome.record.add(state.world_from_body.position);
    outcome.record.add(state.velocity);
    outcome.record.add(state.angle);
    outcome.record.add(state.angular_velocity);
    state.polygon_in_body = nullptr;
  }
  return outcome;
}

void add_field(Scene& scene, double x0, double y0, double x1, double y1, double concentration, double size) {
  FloeField field;
  field.region = rectangle(x0, y0, x1, y1).outer;
  field.floe_size = size;
  field.concentration = concentration;
  field.seed = 5;
  for (std::size_t i = 0; i < hull_count(scene); ++i) {
    const PlacedHull& hull = hull_of(scene, i);
    geometry::Polygon clear{hull.hull.waterline, {}};
    for (Point& p : clear.outer) p += hull.position_in_world - Point{};
    field.kept_clear.push_back(clear);
  }
  for (const auto& polygon : make_floe_field(field).floes) scene.floes.push_back(floe(polygon));
}

/// A ship that breaks its way through a plate and pushes floes in a drift.
Scene voyage() {
  Scene scene = paper_scene();
  scene.time.step = 0.01;
  scene.water.drift = {-0.1, 0.05};
  scene.ships = {icebreaker({0, 0}, ConstantThrust{4e5}, 2)};
  scene.floes = {floe(rectangle(5, -50, 45, 40))};
  add_field(scene, 47, -50, 100, 50, 0.6, 14);
  add_field(scene, 47, 200, 80, 230, 0.6, 14);  // far off, never touched
  return scene;
}

/// Floes that a sheared current carries past a pile: all awake, jammed and parting.
Scene pile_in_shear() {
  Scene scene = paper_scene();
  scene.time.step = 0.02;
  scene.water.drift = {0.6, 0};
  scene.water.shear = {0.004, 0, {0, 0}};
  scene.structures = {pile({40, 0}, 8)};
  add_field(scene, -60, -40, 60, 40, 0.75, 12);
  return scene;
}

TEST(Shortcuts, CullingChangesNoByte) {
  for (const auto& [scene, until] : {std::pair(voyage(), 40.0), std::pair(pile_in_shear(), 60.0)}) {
    const Outcome with = outcome_of(scene, {}, until);
    const Outcome without = outcome_of(scene, {.culls = false}, until);
    EXPECT_GT(with.counts.peak_contacts, 10);
    EXPECT_GT(with.record.numbers().size(), 5000u);
    EXPECT_TRUE(with.record.is_same(without.record));
    EXPECT_EQ(with.counts.crush_contacts, without.counts.crush_contacts);
    EXPECT_EQ(with.counts.bends, without.counts.bends);
  }
  EXPECT_GT(outcome_of(voyage(), {}, 40).counts.bends, 3) << "ice did break";
}

TEST(Shortcuts, WhereNothingComesToRestSleepChangesNoByte) {
  // In the shear no floe ever may sleep.
  const Outcome with = outcome_of(pile_in_shear(), {}, 30);
  const Outcome without = outcome_of(pile_in_shear(), {.culls = false, .sleeps = false}, 30);
  EXPECT_TRUE(with.record.is_same(without.record));
}

TEST(Shortcuts, FloesComeToRestOnceASecondWhereIceCrushesAndInEachStepOfTheImpulseLaw) {
  for (const ContactLaw law : {ContactLaw::kCrush, ContactLaw::kImpulse}) {
    Scene scene = paper_scene();
    scene.contact.law = law;
    scene.time.step = 0.01;
    scene.floes = {floe(rectangle(0, 0, 10, 10))};
    scene.floes.front().velocity = {0.5 * kRestSpeed, 0};
    Simulation simulation(scene);
    const int steps = law == ContactLaw::kCrush ? 100 : 1;
    for (int i = 1; i <= steps; ++i) {
      EXPECT_EQ(simulation.world().population.awake.size(), 1u) << i;
      simulation.step();
    }
    EXPECT_TRUE(simulation.world().population.awake.empty());
  }
}

double farthest_apart(const Outcome& p, const Outcome& q) {
  double most = 0;
  for (std::size_t i = 0; i < std::min(p.floes.size(), q.floes.size()); ++i)
    most = std::max(most, distance(p.floes[i].world_from_body.position, q.floes[i].world_from_body.position));
  return most;
}

double mean_surge(const Outcome& outcome) {
  double sum = 0;
  for (const ShipSample& sample : outcome.story.samples) sum += sample.from_ice.surge;
  return sum / static_cast<double>(outcome.story.samples.size());
}

TEST(Shortcuts, SleepMovesFloesByNoMoreThanTheRestSpeedDoes) {
  // A floe put to rest would have gone on at less than the rest speed. While no collision has made something
  // else of it, places differ by less than that speed's way, and every fracture is the same; later,
  // collisions amplify any difference, and only means can be compared.
  const Shortcuts all_awake{.culls = false, .sleeps = false};
  const double before_chaos = 20;
  const Outcome with = outcome_of(voyage(), {}, before_chaos);
  const Outcome without = outcome_of(voyage(), all_awake, before_chaos);
  EXPECT_LT(with.counts.peak_awake, without.counts.peak_awake / 2) << "most slept";
  EXPECT_LT(farthest_apart(with, without), kRestSpeed * before_chaos);
  ASSERT_EQ(with.story.events.size(), without.story.events.size());
  EXPECT_GT(with.story.events.size(), 10u);
  for (std::size_t i = 0; i < with.story.events.size(); ++i)
    EXPECT_EQ(with.story.events[i].time, without.story.events[i].time);
  EXPECT_NEAR(mean_surge(with) / mean_surge(without), 1, 1e-4);

  const double later = 40;
  const Outcome with_later = outcome_of(voyage(), {}, later);
  const Outcome without_later = outcome_of(voyage(), all_awake, later);
  EXPECT_NEAR(mean_surge(with_later) / mean_surge(without_later), 1, 0.05);
}

}  // namespace
}  // namespace polynya::simulation
