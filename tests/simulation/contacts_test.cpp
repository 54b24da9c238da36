// Recorded contacts. Contacts with ice explain the loads on ships and the motion of floes, and contacts with other
// ships are recorded separately. Overlaps that no contact removes are ground to brash.
#include <algorithm>
#include <map>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "simulation/ship/waterline.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Vector;

Scene pack(RecordedContacts contacts) {
  Scene scene = ship_in_pack().without_drag().recorded_each_step();
  scene.record.contacts = contacts;
  return scene;
}

/// A floe of 100 m drifts onto a pile of 1 m radius at 1 m/s. Its energy crushes more ice than the pile is wide.
TEST(RigidImpulses, LetAFloePassThroughAPileAtAnyStepAndCountIt) {
  const auto passing_steps = [](Laws laws, double speed, double step) {
    Build scene = Build(laws).step(step).without_drag().unbreakable().pile({0, 0}, 1).floe(
        rectangle(1.5, -50, 101.5, 50), {-speed, 0});
    Simulation simulation(scene);
    while (simulation.time() < 6) skip(simulation);
    return simulation.counts().passing_steps;
  };
  for (const double step : {0.05, 0.01}) EXPECT_GT(passing_steps(Laws::kPaper, 1, step), 0) << step;
  EXPECT_EQ(passing_steps(Laws::kPaper, 0.1, 0.05), 0) << "its energy crushes less than half of the pile's width";
  EXPECT_EQ(passing_steps(Laws::kDefault, 1, 0.05), 0) << "what is crushed is cut off";
}

/// Two floes spin and collide without friction. Their collision gained 1.2 % of energy when restitution gave back
/// impulses alone.
TEST(RigidImpulses, GiveBackNoMoreThanTheyTookAndCrushNoNegativeWork) {
  for (int k = 0; k < 60; ++k) {
    const double restitution = 0.5 * (k % 3);
    Build scene = Build(Laws::kPaper).step(0.05).without_drag().restitution(restitution);
    scene.ice.friction = 0;
    const geometry::Pose turned{{25, -1.9852835619899993}, geometry::Rotation::by((44.46312111964577 + k) * kDegree)};
    geometry::Polygon second = rectangle(0, 0, 4.385577229137644, 6.426607373336808);
    second.outer = transform(turned, second.outer);
    scene.floe(rectangle(0, 0, 10, 3.4501189066657707), {1.4244319324419155, 0})
        .floe(second, {}, -3.640942773334231 * kDegree);
    const Trial done =
        run(scene, 20, [](const Simulation& s) { EXPECT_EQ(validate_world(s.world()).value_or("sound"), "sound"); });
    const EnergyFlows& energy = done.simulation.audit().sums.energy;
    const double scale = done.simulation.audit().sums.initial_energy;
    EXPECT_GE(energy.crushing, 0) << restitution;
    EXPECT_GE(energy.crushing + energy.restitution, -1e-12 * scale) << restitution;
    EXPECT_LE(done.simulation.counts().energy_created, 1e-12 * scale) << restitution;
    EXPECT_EQ(done.simulation.counts().peak_contacts, 1) << "they should meet";
  }
}

TEST(Contacts, OfAShipAddUpToItsLoadInTheStep) {
  Simulation simulation(pack(RecordedContacts::kShips));
  int pressed = 0;
  int most = 0;
  bool has_crushed = false;
  dynamics::Planar carried;  // impulse that was missed before contacts were found, which is booked later
  while (simulation.time() < 25) {
    const HullState before = simulation.ship_states()[0];
    const double time_before = simulation.time();
    simulation.step();
    const HullSample sample = simulation.journal().samples.back();
    const dynamics::Planar given =
        sample.from_ice + 1 / (simulation.time() - time_before) * (sample.carried + -1.0 * carried);
    carried = sample.carried;
    simulation.journal().clear();
    Vector force;
    double moment = 0;
    double size = 1;
    const auto contacts = simulation.contact_states();
    for (const ContactState& contact : contacts) {
      ASSERT_EQ(contact.on.ship, 0);
      ASSERT_GE(contact.by.floe, 0);
      force += contact.force;
      moment += cross(contact.point_in_world - before.world_from_ship.position, contact.force);
      size += length(contact.force);
      has_crushed = has_crushed || contact.is_crushing;
    }
    const Vector in_ship = rotate_back(geometry::Rotation::by(before.heading), force);
    ASSERT_NEAR(in_ship.x, given.surge, 1e-9 * size) << simulation.time();
    ASSERT_NEAR(in_ship.y, given.sway, 1e-9 * size);
    ASSERT_NEAR(moment, given.yaw, 1e-7 * size);
    ASSERT_EQ(static_cast<int>(contacts.size()), sample.contacts);
    pressed += size > 1e4;
    most = std::max(most, sample.contacts);
  }
  EXPECT_GT(simulation.counts().bends, 0);
  EXPECT_GT(pressed, 500);
  EXPECT_GE(most, 3);
  EXPECT_TRUE(has_crushed);
}

/// Contacts are the only forces on a floe without drag. The test checks Newton's second law for each floe and step.
TEST(Contacts, BetweenFloesTooExplainHowEachFloeMoves) {
  Scene scene = pack(RecordedContacts::kAll);
  scene.fracture.breakable_size_factor = 1e6;
  Simulation simulation(scene, {.sleeps = false});
  int between_floes = 0;
  for (int step = 0; step < 1000; ++step) {
    std::map<FloeId, Vector> before, gained;
    for (const FloeState& state : simulation.floe_states()) before[state.floe] = state.mass * state.velocity;
    skip(simulation);
    for (const FloeState& state : simulation.floe_states())  // one that loses ice becomes another
      if (before.contains(state.floe)) gained[state.floe] = state.mass * state.velocity - before[state.floe];
    double size = 1;
    for (const ContactState& contact : simulation.contact_states()) {
      const Vector impulse = scene.time.step * contact.force;
      if (gained.contains(contact.on.floe)) gained[contact.on.floe] -= impulse;
      if (gained.contains(contact.by.floe)) gained[contact.by.floe] += impulse;
      between_floes += contact.on.floe != kNoFloe && length(impulse) > 0;
      size += length(impulse);
    }
    for (const auto& [floe, left] : gained) ASSERT_NEAR(length(left), 0, 1e-8 * size) << floe;
  }
  EXPECT_GT(between_floes, 500);
}

TEST(Contacts, AreThoseTheSceneAsksFor) {
  Simulation all(pack(RecordedContacts::kAll));
  Simulation ships(pack(RecordedContacts::kShips));
  Simulation none(pack(RecordedContacts::kNone));
  EXPECT_TRUE(all.contact_states().empty()) << "nothing was stepped yet";
  std::size_t others = 0;
  for (int step = 0; step < 1000; ++step) {
    for (Simulation* simulation : {&all, &ships, &none}) skip(*simulation);
    const auto of_ships = ships.contact_states();
    auto of_all = all.contact_states();
    others += std::erase_if(of_all, [](const ContactState& contact) { return contact.on.ship < 0; });
    ASSERT_EQ(of_all.size(), of_ships.size());
    for (std::size_t i = 0; i < of_all.size(); ++i) {
      EXPECT_EQ(of_all[i].by, of_ships[i].by);
      EXPECT_EQ(of_all[i].force, of_ships[i].force);
    }
    ASSERT_TRUE(none.contact_states().empty());
  }
  EXPECT_GT(others, 300U);
  EXPECT_EQ(all.state_hash(), none.state_hash()) << "recording changes nothing";
}

TEST(ShipContacts, AreNoIceLoadAndEndAsEq5Says) {
  // Two equal barges bow to bow, steel on steel, no ice in the scene: restitution in one blow.
  const Ship barge_ahead = barge({0, 0}, ConstantThrust{0}, 0.5);
  Ship barge_back = barge_ahead;
  barge_back.position_in_world = {60.55, 0};
  barge_back.heading = std::numbers::pi;
  const Scene scene = Build(Laws::kPaper).without_drag().ship(barge_ahead).ship(barge_back);
  const auto [simulation, story] = run(scene, 1);
  double surge = 0;
  for (const HullSample& sample : story.samples) {
    EXPECT_EQ(sample.from_ice.surge, 0);
    EXPECT_EQ(sample.from_ice_largest.surge, 0);
    EXPECT_EQ(sample.friction_of_ice.surge, 0);
    EXPECT_EQ(sample.collision.surge, 0);
    EXPECT_EQ(sample.contacts, 0);
    if (sample.ship == 0) surge += scene.record.forces_interval * sample.from_ships.surge;
  }
  EXPECT_NEAR(simulation.ship_states()[0].velocity.x, -0.05, 1e-6);
  EXPECT_NEAR(simulation.ship_states()[1].velocity.x, 0.05, 1e-6);
  EXPECT_NEAR(surge, 1e7 * (simulation.ship_states()[0].velocity.x - 0.5), 1e-3);
  const Event met = only(story.of_kind<HullContact>());
  const auto& contact = std::get<HullContact>(met.what);
  EXPECT_NEAR(met.time, 0.55, 2 * scene.time.step + 1e-9);
  EXPECT_EQ(met.ship, 0);
  EXPECT_EQ(contact.other, 1);
  EXPECT_NEAR(contact.closing_speed, 1, 1e-6);
  EXPECT_NEAR(contact.relative_speed, 1, 1e-6);
  EXPECT_NEAR(met.point_in_world.x, 0.275, 0.01);
  EXPECT_FALSE(contact.is_prescribed);
}

TEST(ShipContacts, WithIceBetweenTheTwoLoadsAddUpToTheMotion) {
  for (const Laws laws : kBothLaws) {
    const auto [simulation, story] = run(Build(laws)
                                             .without_drag()
                                             .ship(barge({0, 0}, ConstantThrust{0}, 1))
                                             .pile({25, 3}, 5)
                                             .floe(rectangle(1, -8, 9, -2)),
                                         40);
    dynamics::Planar by_ice, by_pile;
    for (const HullSample& sample : story.samples) {
      if (sample.ship != 0) continue;
      by_ice += 0.1 * sample.from_ice;
      by_pile += 0.1 * sample.from_ships;
    }
    const HullState end = simulation.ship_states()[0];
    EXPECT_LT(by_ice.surge, -1e4);
    EXPECT_LT(by_pile.surge, -1e6);
    EXPECT_NEAR((by_ice.yaw + by_pile.yaw) / (5e9 * end.angular_velocity), 1, 1e-9);
    // The heading turns by less than a degree while the pile is touched. The impulse is therefore m Δv along the
    // heading within this accuracy.
    EXPECT_NEAR((by_ice.surge + by_pile.surge) / (1e7 * (end.velocity.x - 1)), 1, 1e-2);
  }
}

TEST(ShipContacts, OfPrescribedMotionsAreRecorded) {
  // The pile is at this distance from the course. Every step length and place finds the touch, and none finds one
  // beside it.
  for (const double step : {0.005, 0.013, 0.05}) {
    for (const double off : {-18.0, -16.9, -12.0, -3.7, 0.0, 5.0, 12.0, 16.9, 17.1, 30.0}) {
      const Story story =
          run(Build().step(step).ship(barge({0, 0}, ConstantSpeed{2})).pile({25, off}, 5).pile({-150, 0}, 5), 30).story;
      SCOPED_TRACE(testing::Message() << off << " in steps of " << step);
      if (std::abs(off) > 17) {
        EXPECT_TRUE(story.of_kind<HullContact>().empty());
        continue;
      }
      const Event met = only(story.of_kind<HullContact>());
      const auto& contact = std::get<HullContact>(met.what);
      // The side of the bow that meets the pile is at most 20 m from it, or 25 m if the pile meets the edge itself.
      EXPECT_GE(met.time, 10 - 1e-9);
      EXPECT_LE(met.time, (std::abs(off) < 11 ? 10 : 12.5) + 2 * step);
      EXPECT_EQ(contact.relative_speed, 2);
      EXPECT_GT(contact.closing_speed, 0);
      EXPECT_TRUE(contact.is_prescribed);
      EXPECT_EQ(largest(story, &HullSample::from_ships), 0);
    }
  }
}

TEST(ShipContacts, AreRecordedOnceAlsoAfterAResume) {
  const Scene scene = Build()
                          .ship(barge({0, 0}, ConstantThrust{1e5}))
                          .ship(barge({0, 100}, ConstantSpeed{1}))
                          .pile({6, 0}, 5)
                          .pile({6.5, 100}, 5);
  EXPECT_EQ(run(scene, 3).story.of_kind<HullContact>().size(), 2U);
  EXPECT_EQ(run(scene, 6).story.of_kind<HullContact>().size(), 2U);
  EXPECT_TRUE(expect_resumes(scene, 3, 6).story.of_kind<HullContact>().empty());
}

Trial after_one_step(const Scene& scene) {
  return run(scene, scene.time.step);
}

/// Fraction by which an outline that cuts is enlarged about its centre, so that the remaining ice does not touch it
/// [-].
constexpr double kClearance = 1e-6;

TEST(Grind, APlankThroughAStripBecomesTwoAndTheOverlapBrash) {
  const auto [simulation, story] =
      after_one_step(Build().structure(rectangle(-30, -1, 30, 1).outer).floe(rectangle(-2, -10, 2, 8), {0, 0.3}));
  const Event event = only(story.events);
  const auto& grind = std::get<Grind>(event.what);
  EXPECT_EQ(event.ship, 0);
  EXPECT_EQ(grind.by_floe, kNoFloe);
  EXPECT_EQ(grind.children.size(), 2U);
  EXPECT_NEAR(grind.brash_area, 8, 1.01 * 8 * kClearance);
  EXPECT_NEAR(grind.criterion.overlap_area, 8, 1.01 * 8 * kClearance);
  EXPECT_LT(grind.criterion.width, 1e-9);
  EXPECT_NEAR(grind.criterion.least_width, 0.25 * 8 / 4, 1e-9);
  EXPECT_EQ(simulation.counts().ground, 1);
  EXPECT_EQ(simulation.area_ledger().brash, grind.brash_area);
  EXPECT_GT(simulation.audit().sums.energy.grinding, 0);
  expect_closed(simulation);
}

TEST(Grind, AFloeAllInsideAHullIsBrashAndAPileAllInsideAFloeLeavesItsHole) {
  const auto [inside, story_inside] =
      after_one_step(Build().structure(rectangle(-30, -10, 30, 10).outer).floe(rectangle(3, -2, 6, 2)));
  const auto ground = std::get<Grind>(only(story_inside.grinds()).what);
  EXPECT_TRUE(ground.children.empty());
  EXPECT_EQ(ground.brash_area, 12);
  EXPECT_TRUE(inside.floe_states().empty());

  const auto [around, story_around] =
      after_one_step(Build().structure(rectangle(-1, -1, 1, 1).outer).floe(rectangle(-40, -40, 40, 40)));
  const auto hole = std::get<Grind>(only(story_around.grinds()).what);
  EXPECT_EQ(only(around.floe_states()).polygon_in_body->holes.size(), 1U);
  EXPECT_NEAR(hole.brash_area, 4, 2.01 * 4 * kClearance);
  EXPECT_NEAR(hole.criterion.overlap_area, 4, 2.01 * 4 * kClearance) << "the smaller of the two";
}

TEST(Grind, OfTwoFloesTheSmallerIsGround) {
  const Trial done = after_one_step(Build().floe(rectangle(-20, -1, 20, 1), {0.1, 0}).floe(rectangle(-1, -12, 1, 12)));
  const Event event = only(done.story.grinds());
  EXPECT_EQ(event.ice()->floe, 1);
  EXPECT_EQ(event.ice()->by_floe, 0);
  EXPECT_EQ(event.ship, -1);
  EXPECT_EQ(event.ice()->children.size(), 2U);
}

TEST(Grind, AWedgeIsPartedByItsContactInstead) {
  const Trial done = run(
      Build().structure({{5, 0}, {-25, 9}, {-25, -9}}).floe(rectangle(0, -10, 1.5, 10), {-0.3, 0}).unbreakable(), 2);
  for (const Event& event : done.story.events)
    EXPECT_EQ(std::get<Grind>(event.what).criterion.least_width, 0) << "crushed, not inseparable";
  EXPECT_GT(done.simulation.counts().crush_contacts, 0);
}

/// Two floes that touch at a corner, to the last bit and a little more or less.
TEST(Grind, WhatOnlyTouchesIsLeft) {
  for (const double off : {-1e-9, -1e-16, 0.0, 1e-16, 1e-9}) {
    const Trial done = after_one_step(Build()
                                          .floe({{{0.1, 0.3}, {-20, 7}, {-20, -7}}, {}}, {1e-3, 0})
                                          .floe({{{0.1 + off, 0.3}, {30, -20}, {30, 20}}, {}}));
    EXPECT_TRUE(done.story.events.empty()) << off;
  }
}

TEST(Grind, IsPartOfTheStateAndDoesNotDependOnThreads) {
  const Scene scene = Build()
                          .structure(rectangle(-30, -1, 30, 1).outer)
                          .floe(rectangle(-2, -10, 2, 8), {0, 0.3})
                          .floe(rectangle(4, -10, 6, 8), {0.2, 0.3});
  EXPECT_EQ(expect_resumes(scene, 0.5, 1, 2).simulation.counts().ground, 2);
}

// ---- where the ice presses on a hull: peaks, their places on the waterline, panels

/// Onto a hull with panels.
Scene pack(Laws laws) {
  Scene scene = ship_in_pack(laws).step(0.01);
  scene.ships[0].panels =
      PanelSettings{.length = 2.5, .bottom = -0.3, .top = 0, .rows = 2};  // some ice is above and below
  scene.record.least_peak = 0;
  return scene;
}

void expect_same(const LoadPeak& a, const LoadPeak& b) {
  const auto members = [](const LoadPeak& peak) {
    const ContactState& s = peak.state;
    return std::tuple(peak.time, s.on, s.by, s.point_in_world, s.force, s.arc, s.pressure, s.ended_by);
  };
  EXPECT_TRUE(members(a) == members(b)) << a.time;
}

double force_of(const LoadPeak& peak) {
  return peak.state.pressure * peak.state.width * peak.state.height;
}

TEST(Waterline, ArcsAreFromTheStemToPort) {
  const Waterline wedge = waterline_of(wedge_bow_waterline(60, 14, 30 * kDegree));
  const double flank = 7 / std::sin(30 * kDegree);
  EXPECT_DOUBLE_EQ(wedge.stem_x, 30);
  EXPECT_NEAR(arc_at(wedge, {30, 0}), 0, 1e-12);
  EXPECT_NEAR(arc_at(wedge, {30 - flank * std::cos(30 * kDegree), 7}), flank, 1e-9);
  EXPECT_NEAR(arc_at(wedge, {30 - flank * std::cos(30 * kDegree), -7}), -flank, 1e-9);
  EXPECT_NEAR(arc_at(wedge, {-20, 7.3}), flank + 50 - flank * std::cos(30 * kDegree), 1e-9);
  EXPECT_NEAR(std::abs(arc_at(wedge, {-30, 0})), wedge.length / 2, 1e-9);
  // If the foremost part of a ring is an edge, the stem is the middle of that edge, wherever the ring begins.
  geometry::Ring box{{-10, -4}, {10, -4}, {10, 6}, {-10, 6}};
  for (int turn = 0; turn < 4; ++turn) {
    const Waterline line = waterline_of(box);
    EXPECT_NEAR(arc_at(line, {10, 1}), 0, 1e-12);
    EXPECT_NEAR(arc_at(line, {11, 6}), 5, 1e-12);
    EXPECT_NEAR(arc_at(line, {0, -4}), -15, 1e-12);
    std::rotate(box.begin(), box.begin() + 1, box.end());
  }
}

/// Limit momentum of a straight edge on a cylinder of radius a: δ = (3 E_k / (4 p h √(2a)))^⅔,
/// F = 2 p h √(2aδ), by which a width of 2 √(2aδ) and the pressure p; at port, a quarter of the circle from the stem.
TEST(LoadPeaks, OfAnEdgeOnACylinderAreThoseOfTheClosedForm) {
  for (const double step : {1e-3, 5e-3}) {
    for (const double circle_radius : {0.5, 1.0, 2.0}) {
      Scene scene = Build()
                        .unbreakable()
                        .without_drag()
                        .step(step)
                        .structure(shapes::regular(2048, 10).outer)
                        .floe(rectangle(-20, 10.001, 20, 50.001), {0, -0.5})
                        .recorded_each_step();
      scene.contact.circle_radius = circle_radius;
      scene.structures[0].panels = PanelSettings{.length = 1, .bottom = -1, .top = 1};
      scene.record.peak_response = 0;
      const Trial done = run(scene, 0.5);
      const ContactState peak = only(done.story.peaks).state;
      const double error = step > 2e-3 ? 0.03 : 0.01;  // F belongs to the deepest overlap at a step's begin
      EXPECT_NEAR(length(peak.force) / 2.766e6, 1, error) << step << " " << circle_radius;
      EXPECT_NEAR(peak.width / (2 * std::sqrt(2 * 10 * 0.0488)), 1, error);
      EXPECT_NEAR(peak.pressure / scene.ice.compressive_strength, 1, error);
      EXPECT_NEAR(peak.arc, std::numbers::pi / 2 * 10, 0.01);
      EXPECT_NEAR(peak.station, 10, 0.01);
      EXPECT_EQ(peak.height, scene.ice.thickness);
      EXPECT_EQ(peak.thickness, scene.ice.thickness);
      EXPECT_EQ(peak.ended_by, PeakEnd::kSlip);
      // The panels from 14 to 17 m carry the load. The middle one carries the full strength of its metre of ice.
      double middle = 0;
      for (const PanelSample& panel : done.story.panels) {
        EXPECT_GE(panel.column, 14);
        EXPECT_LE(panel.column, 16);
        if (panel.column == 15) middle = std::max(middle, panel.largest);
      }
      EXPECT_NEAR(middle / (scene.ice.compressive_strength * scene.ice.thickness), 1, 0.02);
    }
  }
}

/// Returns the peaks of a force given step by step: the first largest value of each interval in which the force is
/// never below half of it.
std::vector<std::size_t> peaks_of(const std::vector<double>& force) {
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < force.size(); ++i) {
    bool is_peak = force[i] > 0;
    bool has_fallen = false;
    for (std::size_t k = i; is_peak && k-- > 0 && force[k] >= force[i] / 2;) is_peak = force[k] < force[i];
    for (std::size_t k = i + 1; is_peak && !has_fallen && k < force.size(); ++k) {
      has_fallen = force[k] < force[i] / 2;
      is_peak = force[k] <= force[i];
    }
    if (is_peak && has_fallen) peaks.push_back(i);
  }
  return peaks;
}

/// Floes in a lane run onto a pile one after the other, and the first of them transmits all impacts. If a gauge has the
/// time constant τ, its reading F follows dF/dt = (force - F)/τ, and the record contains F.
TEST(LoadPeaks, AreThoseBetweenTwoTimesBelowHalf) {
  for (const double time_constant : {0.0, 0.05}) {
    Build scene = Build().unbreakable().without_drag().step(0.01).pile({0, 0}, 3);
    for (int i = 0; i < 6; ++i) scene.floe(rectangle(4 + 12 * i, -5, 14 + 12 * i, 5), {-0.5, 0});
    scene.record.least_peak = 0;
    scene.record.peak_response = time_constant;
    std::vector<double> force, times;
    double gauge = 0;
    const Story story =
        run(scene, 30, [&](const Simulation& simulation) {
          const auto contacts = simulation.contact_states();
          EXPECT_LE(contacts.size(), 1);
          const double now = contacts.empty() ? 0 : contacts[0].pressure * contacts[0].width * contacts[0].height;
          gauge = contacts.empty() || time_constant == 0 ? now : now + (gauge - now) * std::exp(-0.01 / time_constant);
          force.push_back(gauge);
          times.push_back(simulation.time());
        }).story;
    const std::vector<std::size_t> expected = peaks_of(force);
    ASSERT_GT(expected.size(), 3);
    ASSERT_EQ(story.peaks.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const LoadPeak& peak = story.peaks[i];
      EXPECT_EQ(peak.time, times[expected[i]]);
      EXPECT_NEAR(length(peak.state.force), force[expected[i]], 1e-6 * force[expected[i]]);
      EXPECT_NEAR(force_of(peak), force[expected[i]], 1e-9 * force[expected[i]]);
    }
  }
}

TEST(LoadPeaks, StateWhatEndedThem) {
  const Trial done = run(pack(Laws::kDefault), 25);
  std::map<PeakEnd, int> ends;
  for (const LoadPeak& peak : done.story.peaks) {
    ++ends[peak.state.ended_by];
    EXPECT_GT(peak.state.width, 0);
    EXPECT_LE(peak.state.height, peak.state.thickness);
  }
  EXPECT_GT(ends[PeakEnd::kBend], 5);
  EXPECT_GT(ends[PeakEnd::kSlip], 5);
  EXPECT_EQ(ends[PeakEnd::kNone], 0);
  const PeakCounts counts = done.simulation.world().accounts.load_peaks.counts;
  EXPECT_EQ(counts.recorded, std::ssize(done.story.peaks));
  EXPECT_EQ(counts.below, 0);
}

TEST(LoadPeaks, BelowTheScenesLeastAreCounted) {
  Scene scene = pack(Laws::kDefault);
  const Trial all = run(scene, 15);
  scene.record.least_peak = 1e5;
  const Trial large = run(scene, 15);
  std::vector<LoadPeak> expected = all.story.peaks;
  std::erase_if(expected, [](const LoadPeak& peak) { return force_of(peak) < 1e5; });
  ASSERT_EQ(large.story.peaks.size(), expected.size());
  ASSERT_GT(expected.size(), 3);
  ASSERT_LT(expected.size(), all.story.peaks.size());
  for (std::size_t i = 0; i < expected.size(); ++i) expect_same(large.story.peaks[i], expected[i]);
  EXPECT_EQ(large.simulation.world().accounts.load_peaks.counts.below,
            std::ssize(all.story.peaks) - std::ssize(expected));
}

/// The sum includes the rows above and below all panels. It holds over the whole run. In a single record the sums may
/// differ by the load that was missed before a contact was found, which each panel and the hull book later
/// (CarriedLoad).
TEST(Panels, AddUpToTheForceOfTheIce) {
  for (const Laws laws : kBothLaws) {
    const Trial done = run(pack(laws), 20);
    std::size_t next = 0;
    int loaded = 0;
    bool is_outside = false;
    dynamics::Planar sum, expected;
    double size = 1;
    for (const HullSample& sample : done.story.samples) {
      for (; next < done.story.panels.size() && done.story.panels[next].time == sample.time; ++next) {
        const PanelSample& panel = done.story.panels[next];
        sum += panel.load;
        is_outside = is_outside || panel.row < 0;
        EXPECT_GE(panel.largest, panel.force);
        ++loaded;
      }
      expected += sample.from_ice;
      size += std::hypot(sample.from_ice.surge, sample.from_ice.sway);
    }
    const double allowed = (laws == Laws::kPaper ? 1e-12 : 1e-4) * size;
    EXPECT_NEAR(sum.surge, expected.surge, allowed);
    EXPECT_NEAR(sum.sway, expected.sway, allowed);
    EXPECT_NEAR(sum.yaw, expected.yaw, 100 * allowed);
    EXPECT_EQ(next, done.story.panels.size());
    EXPECT_GT(loaded, 200);
    EXPECT_TRUE(is_outside);
  }
}

TEST(Loads, OfAResumedRunAreThoseOfOneThatWasNot) {
  const Scene scene = pack(Laws::kDefault);
  const Trial whole = run(scene, 16);
  for (const double from : {3.05, 7.51, 11.17}) {  // within intervals of forces.csv, in contacts
    const Trial again = expect_resumes(scene, from, 16, 2);
    ASSERT_GT(again.story.peaks.size(), 5);
    const auto skipped = whole.story.peaks.size() - again.story.peaks.size();
    for (std::size_t i = 0; i < again.story.peaks.size(); ++i)
      expect_same(again.story.peaks[i], whole.story.peaks[skipped + i]);
    const std::span<const PanelSample> panels(whole.story.panels);
    EXPECT_TRUE(std::ranges::equal(again.story.panels, panels.last(again.story.panels.size())));
  }
}

}  // namespace
}  // namespace polynya::simulation
