#include <algorithm>
#include <functional>
#include <iterator>

#include "analysis/channel.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/degrees.hpp"
#include "io/import/floe_properties.hpp"
#include "io/import/gdal.hpp"
#include "io/import/projected_lines.hpp"
#include "io/run/records.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_writer.hpp"
#include "views/export/export.hpp"

namespace polynya::views {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

/// A feature of a layer. It is in the scene's plane until it is projected.
struct LayerFeature {
  enum class Kind { kPoint, kLine, kPolygon };
  std::string properties;  ///< members of JSON
  Kind kind = Kind::kPoint;
  Polygon shape;  ///< a point or a line uses only `outer`
};

struct Layer {
  std::string file;
  std::vector<LayerFeature> features;

  using WriteProperties = std::function<void(io::JsonWriter&)>;
  void add(LayerFeature::Kind kind, Polygon shape, const WriteProperties& write) {
    LayerFeature& feature = features.emplace_back(LayerFeature{{}, kind, std::move(shape)});
    io::JsonWriter json(feature.properties);
    write(json);
  }
  void add(Polygon polygon, const WriteProperties& write) {
    add(LayerFeature::Kind::kPolygon, std::move(polygon), write);
  }
};

Layer floes_layer(std::string file, const io::Run& run, const std::vector<io::PlacedFloe>& floes, double time) {
  Layer layer{std::move(file), {}};
  for (const io::PlacedFloe& floe : floes) {
    const simulation::BirthRecord& birth = *floe.birth;
    const io::RunFloe& of_run = *run.floe(birth.floe);
    layer.add(transform(floe.world_from_body, *floe.polygon_in_body), [&](io::JsonWriter& json) {
      json.key("floe_id").value(birth.floe).key("parent_id").value(io::id_or_none(birth.parent));
      json.key("born_s").value(birth.time).key("generation").value(birth.generation);
      json.key("area_m2").value(birth.area).key("mass_kg").value(birth.mass).key("t_s").value(time);
      io::append_ice(json, ice_of(run.scene.scene, birth.own_ice));
      json.key("speed_m_per_s").value(floe.motion ? std::optional(length(floe.motion->velocity)) : std::nullopt);
      json.key("came_up").value(of_run.came_up);
      if (run.is_under(birth.floe, time)) json.key("went_under_s").value(of_run.went_under);
    });
  }
  return layer;
}

Layer fractures_layer(const io::Run& run, double time) {
  Layer layer{"fractures.geojson", {}};
  for (const simulation::Event& event : run.events) {
    if (event.time > time || !event.is_fracture()) continue;
    const fracture::FailureCriteria& criteria = event.criteria();
    layer.add(LayerFeature::Kind::kPoint, {{event.point_in_world}, {}}, [&](io::JsonWriter& json) {
      json.key("t_s").value(event.time).key("kind").value(name_of(event));
      json.key("ship").value(io::hull_name(run.scene.scene, event.ship)).key("floe_id").value(event.ice()->floe);
      json.key("contact_force_N").value(criteria.contact_force);
      json.key("collision_force_N").value(criteria.collision_force);
      json.key("vertical_force_N").value(criteria.vertical_force);
      json.key("submerged_area_m2").value(event.ice()->submerged_area);
    });
  }
  return layer;
}

Layer tracks_layer(const io::Run& run, const io::MotionIndex& motions, double time) {
  Layer layer{"tracks.geojson", {}};
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    Ring track;
    for (const double t : frame_times_until(run, time)) track.push_back(ship_pose_at(run, motions, ship, t).position);
    if (track.size() < 2) continue;
    layer.add(LayerFeature::Kind::kLine, {std::move(track), {}},
              [&](io::JsonWriter& json) { json.key("ship").value(hull_of(run.scene.scene, ship).name); });
  }
  return layer;
}

Layer ships_layer(const io::Run& run, const io::MotionIndex& motions, double time) {
  Layer layer{"ships.geojson", {}};
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    const auto& waterline = hull_of(run.scene.scene, ship).hull.waterline;
    layer.add({transform(ship_pose_at(run, motions, ship, time), waterline), {}}, [&](io::JsonWriter& json) {
      json.key("ship").value(hull_of(run.scene.scene, ship).name).key("t_s").value(time);
    });
  }
  return layer;
}

Layer channel_layer(const io::Run& run, double time) {
  Layer layer{"channel.geojson", {}};
  for (std::size_t ship = 0; ship < hull_count(run.scene.scene); ++ship) {
    const auto channel = analysis::measure_channel(run, {.ship = ship, .time = time, .spacing = 0, .reach = 0});
    if (!channel) continue;
    for (const Polygon& water : channel->open_water) {
      layer.add(water, [&](io::JsonWriter& json) {
        json.key("ship").value(channel->ship).key("mean_width_m").value(analysis::widths(*channel).mean);
        json.key("brash_cover").value(channel->brash_cover());
      });
    }
  }
  return layer;
}

/// Calls use(ring) for each ring of a feature's shape.
template <class Use>
void for_rings(LayerFeature& feature, Use use) {
  use(feature.shape.outer);
  for (Ring& hole : feature.shape.holes) use(hole);
}

/// Rewrites a feature that was projected to degrees in the usual notation of degrees.
void draw_in_degrees(LayerFeature& feature, double longitude) {
  Polygon& shape = feature.shape;
  if (feature.kind == LayerFeature::Kind::kPolygon)
    shape = io::drawn_in_degrees(shape, longitude);
  else
    shape.outer = io::line_in_degrees(shape.outer, longitude);
}

/// Projects the features of all layers from the plane about the scene's origin to another system.
io::Result<> project(std::vector<Layer>& layers, const simulation::GeographicOrigin& origin, const LayerPlane& plane) {
  const auto crs = io::find_crs(plane.system);
  if (!crs) return io::fail(crs.error());
  const io::CoordinateFrame from = io::frame_about(origin);
  const io::CoordinateFrame to{
      .system = plane.system, .is_in_degrees = crs->is_geographic, .is_metric = crs->is_metric};
  std::vector<io::ProjectedLine> lines;
  for (Layer& layer : layers) {
    for (LayerFeature& feature : layer.features)
      for_rings(feature, [&](const Ring& ring) {
        lines.push_back(io::line_in(from, ring, feature.kind == LayerFeature::Kind::kPolygon));
      });
  }
  if (auto done = io::project_vertices(lines, from, to); !done) return done;
  if (auto done = io::add_points(lines, from, to, plane.tolerance); !done) return done;
  auto next = lines.begin();
  for (Layer& layer : layers) {
    for (LayerFeature& feature : layer.features) {
      for_rings(feature, [&](Ring& ring) { ring = io::image_of(*next++); });
      if (to.is_in_degrees) draw_in_degrees(feature, geometry::kDegreesPerRadian * origin.longitude);
    }
  }
  return {};
}

std::string text_of(const Layer& layer, double time, const std::string& members) {
  io::GeojsonLayer text(time, members);
  for (const LayerFeature& feature : layer.features) {
    text.start().json(feature.properties);
    if (feature.kind == LayerFeature::Kind::kPolygon)
      text.end_with(feature.shape);
    else if (feature.kind == LayerFeature::Kind::kLine)
      text.end_with(feature.shape.outer);
    else
      text.end_with(feature.shape.outer.front());
  }
  return text.finish();
}

/// Returns the members of a layer that state its coordinate system. Without them, GeoJSON is in OGC:CRS84.
std::string members_of(const std::optional<simulation::GeographicOrigin>& origin, const std::string& system) {
  if (system.empty()) return io::place_members(origin);
  if (system == io::kDegreesOnEarth) return "";
  std::string members;
  io::JsonWriter(members)
      .key("crs")
      .open('{')
      .key("type")
      .value("name")
      .key("properties")
      .open('{')
      .key("name")
      .value(system)
      .close('}')
      .close('}');
  return members;
}

}  // namespace

io::Result<std::vector<std::pair<std::string, std::string>>> geojson_layers(const io::Run& run, double time,
                                                                            const LayerPlane& plane) {
  const io::MotionIndex motions(run);
  const auto& origin = run.scene.scene.origin;
  std::vector<Layer> layers{floes_layer("floes.geojson", run, floes_at(run, motions, time), time),
                            fractures_layer(run, time), tracks_layer(run, motions, time),
                            ships_layer(run, motions, time), channel_layer(run, time)};
  if (has_draught(run.scene.scene))
    layers.push_back(floes_layer("under-hull.geojson", run, floes_under_hulls_at(run, motions, time), time));
  if (!plane.system.empty() && !origin)
    return io::fail("the scene has no \"origin\": its place on the Earth is not known");
  if (!plane.system.empty())
    if (auto projected = project(layers, *origin, plane); !projected) return io::fail(projected.error());
  const std::string members = members_of(origin, plane.system);
  std::vector<std::pair<std::string, std::string>> files;
  for (const Layer& layer : layers) files.emplace_back(layer.file, text_of(layer, time, members));
  return files;
}

}  // namespace polynya::views
