#include <memory>

#include "analysis/channel.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/floe_properties.hpp"
#include "io/import/plane.hpp"
#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_writer.hpp"
#include "views/export/export.hpp"

namespace polynya::views {
namespace {

using io::GeojsonLayer;
using io::Project;

std::string floes_layer(const io::Run& run, const std::vector<io::PlacedFloe>& floes, double time,
                        const Project& project) {
  GeojsonLayer layer(time, project);
  for (const io::PlacedFloe& floe : floes) {
    const simulation::BirthRecord& birth = *floe.birth;
    const io::RunFloe& of_run = *run.floe(birth.floe);
    io::JsonWriter& json = layer.start();
    json.key("floe_id").value(birth.floe).key("parent_id").value(io::id_or_none(birth.parent));
    json.key("born_s").value(birth.time).key("generation").value(birth.generation);
    json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass).key("t_s").value(time);
    io::append_ice(json, ice_of(run.scene.scene, birth.own_ice));
    json.key("speed_m_per_s").value(floe.motion ? std::optional(length(floe.motion->velocity)) : std::nullopt);
    json.key("came_up").value(of_run.came_up);
    if (run.is_under(birth.floe, time)) json.key("went_under_s").value(of_run.went_under);
    layer.end_with(transform(floe.world_from_body, *floe.polygon_in_body));
  }
  return layer.finish();
}

std::string fractures_layer(const io::Run& run, double time, const Project& project) {
  GeojsonLayer layer(time, project);
  for (const simulation::Event& event : run.events) {
    if (event.time > time || !event.is_fracture()) continue;
    const fracture::FailureCriteria& criteria = event.criteria();
    io::JsonWriter& json = layer.start();
    json.key("t_s").value(event.time).key("kind").value(name_of(event));
    json.key("ship").value(io::hull_name(run.scene.scene, event.ship)).key("floe_id").value(event.ice()->floe);
    json.key("contact_force_N").value(criteria.contact_force);
    json.key("collision_force_N").value(criteria.collision_force);
    json.key("vertical_force_N").value(criteria.vertical_force);
    json.key("submerged_area_m2").value(event.ice()->submerged_area);
    layer.end_with(event.point_in_world);
  }
  return layer.finish();
}

std::string tracks_layer(const io::Run& run, const io::MotionIndex& motions, double time, const Project& project) {
  GeojsonLayer layer(time, project);
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    geometry::Ring track;
    for (const double t : frame_times_until(run, time)) track.push_back(ship_pose_at(run, motions, ship, t).position);
    if (track.size() < 2) continue;
    layer.start().key("ship").value(hull_of(run.scene.scene, ship).name);
    layer.end_with(track);
  }
  return layer.finish();
}

std::string ships_layer(const io::Run& run, const io::MotionIndex& motions, double time, const Project& project) {
  GeojsonLayer layer(time, project);
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    layer.start().key("ship").value(hull_of(run.scene.scene, ship).name).key("t_s").value(time);
    const auto& waterline = hull_of(run.scene.scene, ship).hull.waterline;
    layer.end_with(geometry::Polygon{transform(ship_pose_at(run, motions, ship, time), waterline), {}});
  }
  return layer.finish();
}

std::string channel_layer(const io::Run& run, double time, const Project& project) {
  GeojsonLayer layer(time, project);
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    const auto channel = analysis::measure_channel(run, {.ship = ship, .time = time, .spacing = 0, .reach = 0});
    if (!channel) continue;
    for (const geometry::Polygon& water : channel->open_water) {
      io::JsonWriter& json = layer.start().key("ship").value(channel->ship);
      json.key("mean_width_m").value(analysis::widths(*channel).mean);
      json.key("brash_cover").value(channel->brash_cover());
      layer.end_with(water);
    }
  }
  return layer.finish();
}

}  // namespace

io::Result<Project> degrees_about(const simulation::GeographicOrigin& origin) {
  auto made = io::GeographicPlane::about(origin);
  if (!made) return io::fail(made.error());
  return Project([plane = std::make_shared<io::GeographicPlane>(std::move(*made))](geometry::Point p) {
    const io::Geographic at = plane->geographic_of(p);
    return geometry::Point{geometry::kDegreesPerRadian * at.longitude, geometry::kDegreesPerRadian * at.latitude};
  });
}

std::vector<std::pair<std::string, std::string>> geojson_layers(const io::Run& run, double time,
                                                                const Project& project) {
  const io::MotionIndex motions(run);
  std::vector<std::pair<std::string, std::string>> layers{
      {"floes.geojson", floes_layer(run, floes_at(run, motions, time), time, project)},
      {"fractures.geojson", fractures_layer(run, time, project)},
      {"tracks.geojson", tracks_layer(run, motions, time, project)},
      {"ships.geojson", ships_layer(run, motions, time, project)},
      {"channel.geojson", channel_layer(run, time, project)}};
  if (has_draught(run.scene.scene))
    layers.emplace_back("under-hull.geojson",
                        floes_layer(run, floes_under_hulls_at(run, motions, time), time, project));
  return layers;
}

}  // namespace polynya::views
