#include "views/export/geojson_export.hpp"

#include <numbers>

#include "analysis/geojson_layer.hpp"
#include "io/run/placed_floes.hpp"
#include "io/scene/geographic.hpp"

namespace polynya::views {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

using analysis::GeojsonLayer;
using analysis::Project;

Project projection(const std::optional<simulation::GeographicOrigin>& origin) {
  if (!origin) return {};
  return [place = *origin](geometry::Point p) {
    const io::Geographic at = io::geographic_of(place, p);
    return geometry::Point{kDegrees * at.longitude, kDegrees * at.latitude};
  };
}

void append_id(io::JsonWriter& json, simulation::FloeId id) {
  if (id == simulation::kNoFloe)
    json.null();
  else
    json.value(id);
}

std::string floes_layer(const io::Run& run, const io::MotionIndex& motions, double time,
                        const Project& project) {
  GeojsonLayer layer(time, project);
  for (const io::PlacedFloe& floe : floes_at(run, motions, time)) {
    const simulation::BirthRecord& birth = *floe.birth;
    io::JsonWriter& json = layer.start();
    json.key("floe_id").value(birth.floe).key("parent_id");
    append_id(json, birth.parent);
    json.key("born_s").value(birth.time).key("generation").value(birth.generation);
    json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass).key("t_s").value(time);
    json.key("speed_m_per_s");
    if (floe.motion)
      json.value(length(floe.motion->velocity));
    else
      json.null();
    layer.end_with(transform(floe.world_from_body, *floe.polygon_in_body));
  }
  return layer.finish();
}

std::string_view ship_name(const io::Run& run, int ship) {
  const auto& ships = run.scene.scene.ships;
  return ship >= 0 && ship < std::ssize(ships) ? std::string_view(ships[static_cast<std::size_t>(ship)].name)
                                               : "";
}

std::string fractures_layer(const io::Run& run, double time, const Project& project) {
  GeojsonLayer layer(time, project);
  for (const simulation::Event& event : run.events) {
    if (event.time > time || event.kind == simulation::EventKind::kRejectedCut) continue;
    io::JsonWriter& json = layer.start();
    json.key("t_s").value(event.time).key("kind").value(name_of(event.kind));
    json.key("ship").value(ship_name(run, event.ship)).key("floe_id").value(event.floe);
    json.key("collision_force_N").value(event.criteria.collision_force);
    json.key("vertical_force_N").value(event.criteria.vertical_force);
    json.key("submerged_area_m2").value(event.submerged_area);
    layer.end_with(event.point_in_world);
  }
  return layer.finish();
}

std::string tracks_layer(const io::Run& run, const io::MotionIndex& motions, double time,
                         const Project& project) {
  GeojsonLayer layer(time, project);
  for (std::size_t ship = 0; ship < run.scene.scene.ships.size(); ++ship) {
    geometry::Ring track;
    for (const double t : frame_times_until(run, time))
      track.push_back(ship_pose_at(run, motions, ship, t).position);
    if (track.size() < 2) continue;
    layer.start().key("ship").value(ship_name(run, static_cast<int>(ship)));
    layer.end_with(track);
  }
  return layer.finish();
}

std::string ships_layer(const io::Run& run, const io::MotionIndex& motions, double time,
                        const Project& project) {
  GeojsonLayer layer(time, project);
  for (std::size_t ship = 0; ship < run.scene.scene.ships.size(); ++ship) {
    layer.start().key("ship").value(ship_name(run, static_cast<int>(ship))).key("t_s").value(time);
    const auto& waterline = run.scene.scene.ships[ship].hull.waterline;
    layer.end_with(geometry::Polygon{transform(ship_pose_at(run, motions, ship, time), waterline), {}});
  }
  return layer.finish();
}

std::string channel_layer(const io::Run& run, double time, const Project& project) {
  GeojsonLayer layer(time, project);
  for (std::size_t ship = 0; ship < run.scene.scene.ships.size(); ++ship) {
    const auto channel =
        analysis::measure_channel(run, {.ship = ship, .time = time, .spacing = 0, .reach = 0});
    if (!channel) continue;
    for (const geometry::Polygon& water : channel->open_water) {
      io::JsonWriter& json = layer.start().key("ship").value(std::string_view(channel->ship));
      json.key("mean_width_m").value(analysis::widths(*channel).mean);
      layer.end_with(water);
    }
  }
  return layer.finish();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> geojson_layers(
    const io::Run& run, double time, const std::optional<simulation::GeographicOrigin>& origin) {
  const Project project = projection(origin);
  const io::MotionIndex motions(run);
  return {{"floes.geojson", floes_layer(run, motions, time, project)},
          {"fractures.geojson", fractures_layer(run, time, project)},
          {"tracks.geojson", tracks_layer(run, motions, time, project)},
          {"ships.geojson", ships_layer(run, motions, time, project)},
          {"channel.geojson", channel_layer(run, time, project)}};
}

}  // namespace polynya::views
