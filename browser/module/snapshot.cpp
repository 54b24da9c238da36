#include "browser/module/snapshot.hpp"

#include <algorithm>
#include <cstdint>

#include "io/run/event_records.hpp"
#include "io/run/records.hpp"
#include "io/text/json_writer.hpp"
#include "simulation/world/world.hpp"

namespace polynya::browser {

using simulation::Birth;
using simulation::FloeState;
using simulation::HullSample;

void SnapshotMaker::gather(const simulation::Journal& journal, const simulation::Scene& scene) {
  births_.insert(births_.end(), journal.births.begin(), journal.births.end());
  samples_.insert(samples_.end(), journal.samples.begin(), journal.samples.end());
  for (const simulation::Event& event : journal.events) {
    io::JsonWriter json(events_);
    write_shown_event(json, event, scene);
    events_ += '\n';
  }
}

views::ColumnWriter SnapshotMaker::take(const simulation::Simulation& simulation) {
  views::ColumnWriter columns;
  add_births(columns);
  add_places(columns, simulation);
  add_samples(columns, simulation.scene());
  columns.add("events", events_);
  births_.clear();
  samples_.clear();
  events_.clear();
  return columns;
}

void SnapshotMaker::add_births(views::ColumnWriter& columns) {
  std::vector<std::int32_t> ring_sizes;
  std::vector<double> points;
  std::vector<std::int32_t> rings;
  const auto add_ring = [&](const geometry::Ring& ring) {
    ring_sizes.push_back(static_cast<std::int32_t>(ring.size()));
    for (const geometry::Point p : ring) points.insert(points.end(), {p.x, p.y});
  };
  for (const Birth& birth : births_) {
    add_ring(birth.polygon_in_body.outer);
    std::ranges::for_each(birth.polygon_in_body.holes, add_ring);
    rings.push_back(static_cast<std::int32_t>(1 + birth.polygon_in_body.holes.size()));
    const auto floe = static_cast<std::size_t>(birth.floe);
    if (centroids_.size() <= floe) centroids_.resize(floe + 1);
    centroids_[floe] = birth.centroid_in_body;
  }
  columns.add("born_floe", births_, &Birth::floe);
  columns.add("born_parent", births_, &Birth::parent);
  columns.add("born_generation", births_, &Birth::generation);
  columns.add("born_s", births_, &Birth::time);
  columns.add("born_area_m2", births_, &Birth::area);
  columns.add("born_x_m", births_, [](const Birth& birth) { return birth.centroid_in_body.x; });
  columns.add("born_y_m", births_, [](const Birth& birth) { return birth.centroid_in_body.y; });
  columns.add("born_rings", rings);
  columns.add("ring_sizes", ring_sizes);
  columns.add("points_m", points);
}

void SnapshotMaker::add_places(views::ColumnWriter& columns, const simulation::Simulation& simulation) {
  std::vector<std::int32_t> ids;
  std::vector<double> places;  // x, y, cosine, sine, vx, vy of each floe
  const auto add = [&](const FloeState& state) {
    const geometry::Pose& pose = state.world_from_body;
    const geometry::Point at = transform(pose, centroids_[static_cast<std::size_t>(state.floe)]);
    ids.push_back(static_cast<std::int32_t>(state.floe));
    places.insert(places.end(),
                  {at.x, at.y, pose.rotation.cosine, pose.rotation.sine, state.velocity.x, state.velocity.y});
  };
  simulation.for_each_floe(simulation::Living::kFloating, add);
  const auto floating = static_cast<std::int32_t>(ids.size());
  const std::vector<FloeState> all = simulation.floe_states(simulation::Living::kAll);
  for (const FloeState& state : all)
    if (!std::ranges::binary_search(ids.begin(), ids.begin() + floating, static_cast<std::int32_t>(state.floe)))
      add(state);
  std::vector<double> hulls;  // x, y, heading, vx, vy, yaw rate, lever, steering angle of each hull
  const std::vector<simulation::Helm>& helms = simulation.world().population.helms;
  const std::vector<simulation::HullState> states = simulation.ship_states();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const simulation::HullState& state = states[i];
    const simulation::Helm helm = i < helms.size() ? helms[i] : simulation::Helm{};
    hulls.insert(hulls.end(),
                 {state.world_from_ship.position.x, state.world_from_ship.position.y, state.heading, state.velocity.x,
                  state.velocity.y, state.angular_velocity, helm.lever, helm.steering_angle});
  }
  columns.add("floe", ids);
  columns.add("place", places);
  columns.add("floating", std::vector<std::int32_t>{floating});
  columns.add("hull", hulls);
}

void SnapshotMaker::add_samples(views::ColumnWriter& columns, const simulation::Scene& scene) {
  columns.add("sample_hull", samples_, &HullSample::ship);
  columns.add("sample_s", samples_, &HullSample::time);
  for (const io::ForceColumn* column : io::plotted_columns(scene)) columns.add(column->name, samples_, column->read);
}

}  // namespace polynya::browser
