#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "geometry/exact/measures.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation::scenes {

inline constexpr double kDegree = std::numbers::pi / 180;

inline geometry::Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

inline FloeSpec floe(const geometry::Polygon& polygon, geometry::Vector velocity = {},
                     double angular_velocity = 0) {
  return {polygon, velocity, angular_velocity};
}

/// The paper's ship, its stem at `stem`, heading along x.
inline Ship icebreaker(geometry::Point stem, const Propulsion& propulsion, double speed = 1) {
  Ship ship;
  ship.name = "icebreaker";
  ship.hull.waterline = wedge_bow_waterline(120, 24, 27 * kDegree);
  ship.hull.stem_angle = 30 * kDegree;
  ship.mass = 1e7;
  ship.moment_of_inertia = 5e9;
  ship.position_in_world = {stem.x - 60, stem.y};
  ship.speed = speed;
  ship.propulsion = propulsion;
  return ship;
}

/// A box-shaped ship with vertical walls: it can only crush.
inline Ship barge(geometry::Point middle_of_bow, const Propulsion& propulsion, double speed = 1) {
  Ship ship = icebreaker(middle_of_bow, propulsion, speed);
  ship.name = "barge";
  ship.hull.waterline = rectangle(-60, -12, 60, 12).outer;
  ship.hull.angles_from_vertical = {0, 0, 0, 0};
  return ship;
}

/// A structure of the same hull in the same place.
inline Structure standing(const PlacedHull& hull) {
  return {hull};
}

/// A cylinder, or a cone whose walls have an angle from the vertical [rad].
inline Structure pile(geometry::Point at, double radius, double wall_angle = 0) {
  Structure pile;
  pile.name = "pile";
  pile.hull.waterline = cylinder_waterline(radius);
  pile.hull.angles_from_vertical.assign(pile.hull.waterline.size(), wall_angle);
  pile.position_in_world = at;
  return pile;
}

/// Everything a run recorded.
struct Story {
  std::vector<Event> events;
  std::vector<Birth> births;
  std::vector<Death> deaths;
  std::vector<ShipSample> samples;
};

template <class Kind>
std::vector<Event> of_kind(const Story& story) {
  std::vector<Event> events;
  std::ranges::copy_if(story.events, std::back_inserter(events), &Event::is<Kind>);
  return events;
}

inline void listen(Simulation& simulation, Story& story) {
  Journal& journal = simulation.journal();
  story.events.insert(story.events.end(), journal.events.begin(), journal.events.end());
  story.births.insert(story.births.end(), journal.births.begin(), journal.births.end());
  story.deaths.insert(story.deaths.end(), journal.deaths.begin(), journal.deaths.end());
  story.samples.insert(story.samples.end(), journal.samples.begin(), journal.samples.end());
  journal.clear();
}

inline Story run(Simulation& simulation, double until) {
  Story story;
  listen(simulation, story);
  while (simulation.time() < until - 1e-9 && !simulation.numerical_failure()) {
    simulation.step();
    listen(simulation, story);
  }
  return story;
}

/// A scene whose contacts and splits are the paper's: rigid impulses with restitution, j/τ_c.
inline Scene paper_scene() {
  Scene scene;
  scene.contact.law = ContactLaw::kImpulse;
  scene.fracture.radial_cracks = fracture::RadialCracks::kIgnored;
  scene.fracture.splitting = fracture::SplittingModel::kMichel;
  scene.contact.iterations = 30;
  return scene;
}

/// Ice and water without drag, so that nothing but contacts changes a velocity.
inline Scene without_drag() {
  Scene scene = paper_scene();
  scene.water.drag_coefficient = 0;
  return scene;
}

}  // namespace polynya::simulation::scenes
