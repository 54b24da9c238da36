// Where the ice presses on a hull: peaks of contacts' forces, their places on the waterline, and loads by panels.
#include <map>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "simulation/ship/waterline.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

using geometry::Vector;

/// Onto a hull with panels.
Scene pack(Laws laws) {
  Scene scene = ship_in_pack(laws).step(0.01);
  scene.ships[0].panels =
      PanelSettings{.length = 2.5, .bottom = -0.3, .top = 0, .rows = 2};  // some ice is above and below
  scene.record.least_peak = 0;
  return scene;
}

void expect_same(const LoadPeak& a, const LoadPeak& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.state.on, b.state.on);
  EXPECT_EQ(a.state.by, b.state.by);
  EXPECT_EQ(a.state.point_in_world, b.state.point_in_world);
  EXPECT_EQ(a.state.force, b.state.force);
  EXPECT_EQ(a.state.arc, b.state.arc);
  EXPECT_EQ(a.state.pressure, b.state.pressure);
  EXPECT_EQ(a.state.ended_by, b.state.ended_by);
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
  // Of a foremost edge the middle is the stem, wherever the ring begins.
  geometry::Ring box{{-10, -4}, {10, -4}, {10, 6}, {-10, 6}};
  for (int turn = 0; turn < 4; ++turn) {
    const Waterline line = waterline_of(box);
    EXPECT_NEAR(arc_at(line, {10, 1}), 0, 1e-12);
    EXPECT_NEAR(arc_at(line, {11, 6}), 5, 1e-12);
    EXPECT_NEAR(arc_at(line, {0, -4}), -15, 1e-12);
    std::ranges::rotate(box, box.begin() + 1);
  }
}

/// Limit momentum of a straight edge on a cylinder of radius a: δ = (3 E_k / (4 p h √(2a)))^⅔, F = 2 p h √(2aδ), by
/// which a width of 2 √(2aδ) and the pressure p; at port, a quarter of the circle from the stem.
TEST(LoadPeaks, OfAnEdgeOnACylinderAreThoseOfTheClosedForm) {
  for (const double step : {1e-3, 5e-3}) {
    for (const double circle_radius : {0.5, 1.0, 2.0}) {
      Scene scene = Build()
                        .unbreakable()
                        .without_drag()
                        .step(step)
                        .structure(shapes::regular(2048, 10).outer)
                        .floe(rectangle(-20, 10.001, 20, 50.001), {0, -0.5});
      scene.contact.circle_radius = circle_radius;
      scene.structures[0].panels = PanelSettings{.length = 1, .bottom = -1, .top = 1};
      scene.record.forces_interval = step;
      scene.record.peak_response = 0;
      const Trial done = run(scene, 0.5);
      ASSERT_EQ(done.story.peaks.size(), 1);
      const ContactState& peak = done.story.peaks[0].state;
      const double error = step > 2e-3 ? 0.03 : 0.01;  // F is that of the deepest overlap at a step's begin
      EXPECT_NEAR(length(peak.force) / 2.766e6, 1, error) << step << " " << circle_radius;
      EXPECT_NEAR(peak.width / (2 * std::sqrt(2 * 10 * 0.0488)), 1, error);
      EXPECT_NEAR(peak.pressure / scene.ice.compressive_strength, 1, error);
      EXPECT_NEAR(peak.arc, std::numbers::pi / 2 * 10, 0.01);
      EXPECT_NEAR(peak.station, 10, 0.01);
      EXPECT_EQ(peak.height, scene.ice.thickness);
      EXPECT_EQ(peak.thickness, scene.ice.thickness);
      EXPECT_EQ(peak.ended_by, PeakEnd::kSlip);
      // The panels from 14 to 17 m bear it: that in the middle all that its metre of ice carries.
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

/// The peaks of a force step by step: the first largest of each stretch that is nowhere below half of it.
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

/// Floes in a lane run onto a pile one after the other: the first of them bears all their blows. With a gauge of time
/// constant τ that is between the contact and its record, dF/dt = (force - F)/τ.
TEST(LoadPeaks, AreThoseBetweenTwoTimesBelowHalf) {
  for (const double time_constant : {0.0, 0.05}) {
    Scene scene = Build().unbreakable().without_drag().step(0.01).pile({0, 0}, 3);
    for (int i = 0; i < 6; ++i) scene.floes.push_back(floe(rectangle(4 + 12 * i, -5, 14 + 12 * i, 5), {-0.5, 0}));
    scene.record.least_peak = 0;
    scene.record.peak_response = time_constant;
    Simulation simulation(scene);
    std::vector<double> force;
    std::vector<double> times;
    Story story;
    double gauge = 0;
    while (simulation.time() < 30) {
      simulation.step();
      listen(simulation, story);
      const auto contacts = simulation.contact_states();
      ASSERT_LE(contacts.size(), 1);
      const double now = contacts.empty() ? 0 : contacts[0].pressure * contacts[0].width * contacts[0].height;
      gauge = contacts.empty() || time_constant == 0 ? now : now + (gauge - now) * std::exp(-0.01 / time_constant);
      force.push_back(gauge);
      times.push_back(simulation.time());
    }
    const std::vector<std::size_t> expected = peaks_of(force);
    ASSERT_GT(expected.size(), 3);
    ASSERT_EQ(story.peaks.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const ContactState& peak = story.peaks[i].state;
      EXPECT_EQ(story.peaks[i].time, times[expected[i]]);
      EXPECT_NEAR(length(peak.force), force[expected[i]], 1e-6 * force[expected[i]]);
      EXPECT_NEAR(peak.pressure * peak.width * peak.height, force[expected[i]], 1e-9 * force[expected[i]]);
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
  const auto force = [](const LoadPeak& p) { return p.state.pressure * p.state.width * p.state.height; };
  std::erase_if(expected, [&](const LoadPeak& peak) { return force(peak) < 1e5; });
  ASSERT_EQ(large.story.peaks.size(), expected.size());
  ASSERT_GT(expected.size(), 3);
  ASSERT_LT(expected.size(), all.story.peaks.size());
  for (std::size_t i = 0; i < expected.size(); ++i) expect_same(large.story.peaks[i], expected[i]);
  EXPECT_EQ(large.simulation.world().accounts.load_peaks.counts.below,
            std::ssize(all.story.peaks) - std::ssize(expected));
}

/// At every record, those above and below all rows included.
TEST(Panels, AddUpToTheForceOfTheIce) {
  for (const Laws laws : kBothLaws) {
    const Trial done = run(pack(laws), 20);
    std::size_t next = 0;
    int loaded = 0;
    bool is_outside = false;
    for (const HullSample& sample : done.story.samples) {
      dynamics::Planar sum;
      for (; next < done.story.panels.size() && done.story.panels[next].time == sample.time; ++next) {
        const PanelSample& panel = done.story.panels[next];
        sum += panel.load;
        is_outside = is_outside || panel.row < 0;
        EXPECT_GE(panel.largest, panel.force);
        ++loaded;
      }
      const double size = 1 + std::hypot(sample.from_ice.surge, sample.from_ice.sway);
      ASSERT_NEAR(sum.surge, sample.from_ice.surge, 1e-12 * size) << sample.time;
      ASSERT_NEAR(sum.sway, sample.from_ice.sway, 1e-12 * size);
      ASSERT_NEAR(sum.yaw, sample.from_ice.yaw, 1e-10 * size);
    }
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
}  // namespace polynya::simulation::scenes
