#include "io/scene/scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "geometry/cut/overlapping_pairs.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/pose.hpp"
#include "io/scene/speed_check.hpp"
#include "io/scene/wall_check.hpp"
#include "simulation/limits.hpp"

namespace polynya::io {
namespace {

using geometry::Polygon;

constexpr double kMostSteps = 1e9;
constexpr std::size_t kMostOverlaps = 200;

void check_water_and_time(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems) {
  const auto& scene = draft.scene;
  const auto report = [&](const std::string& path, std::string found, std::string allowed) {
    problems.report(0, nearest_offset(resolved, path), path, std::move(found), std::move(allowed));
  };
  if (scene.ice.density >= scene.water.water.density)
    report("ice.density_kg_per_m3", fmt::format("{}: this ice sinks", scene.ice.density),
           fmt::format("a number < the water's density, {} [kg/m³]", scene.water.water.density));
  if (scene.time.until < scene.time.step)
    report("time.until_s", fmt::format("{}, less than one step", scene.time.until),
           fmt::format("a number ≥ step_s, {} [s]", scene.time.step));
  if (scene.time.until / scene.time.step > kMostSteps)
    report("time.until_s", fmt::format("{:.3g} steps", scene.time.until / scene.time.step),
           fmt::format("at most {:g} steps", kMostSteps));
  if (scene.ships.empty() && scene.floes.empty() && problems.count() == 0)
    problems.add(0, resolved.offset,
                 {.found = "neither ships nor floes", .allowed = "at least one ship or floe"});
}

/// The first floe of each entry whose own ice sinks.
void check_own_density(const SceneDraft& draft, ProblemCollector& problems) {
  const double water = draft.scene.water.water.density;
  std::optional<std::size_t> last;  // entry that has its report
  for (std::size_t i = 0; i < draft.scene.floes.size(); ++i) {
    const std::int32_t own_ice = draft.scene.floes[i].own_ice;
    const Origin& origin = draft.floe_origins[i];
    if (own_ice == simulation::kSceneIce || last == origin.group) continue;
    const double density = ice_of(draft.scene, own_ice).density;
    if (density < water) continue;
    last = origin.group;
    problems.report(origin.source, origin.offset, floe_path(draft, i) + ": ice.density_kg_per_m3",
                    fmt::format("{:g}: this ice sinks", density),
                    fmt::format("numbers < the water's density, {:g} [kg/m³]; `most` bounds a law", water));
  }
}

/// A body that takes part in the search for overlaps.
struct Named {
  std::string path;
  const Origin* origin;
  bool is_ship;
  std::size_t index;  ///< in the scene
};

void check_ships(const SceneDraft& draft, ProblemCollector& problems, std::vector<Named>& named,
                 std::vector<Polygon>& outlines) {
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i) {
    const auto& ship = draft.scene.ships[i];
    const Origin& origin = draft.ship_origins[i];
    const std::string path = ship_path(draft, i);
    const auto report = [&](std::string_view key, std::string found, std::string allowed) {
      problems.report(origin.source, origin.offset, fmt::format("{}.{}", path, key), std::move(found),
                      std::move(allowed));
    };
    for (std::size_t k = 0; k < i; ++k) {
      if (draft.scene.ships[k].name == ship.name)
        report("name", fmt::format("\"{}\" a second time", ship.name),
               "each ship and structure its own name");
    }
    const auto& hull = ship.hull;
    const geometry::Box box = bounding_box(hull.waterline);
    if (hull.draught > box.high.x - box.low.x)
      report("hull.draught_m", fmt::format("{:g}", hull.draught),
             fmt::format("at most the waterline's length, {:g} [m]", box.high.x - box.low.x));
    if (!hull.angles_from_vertical.empty() && hull.angles_from_vertical.size() != hull.waterline.size())
      report("hull.angles_from_vertical_deg", fmt::format("{} angles", hull.angles_from_vertical.size()),
             fmt::format("none, or one for each of the waterline's {} vertices", hull.waterline.size()));
    if (const auto defect = geometry::find_defect({hull.waterline, {}})) {
      report(origin.is_structure ? "waterline_m" : "hull", "an invalid waterline: " + describe(*defect),
             origin.is_structure ? "a simple ring with an area"
                                 : "a simple ring with an area; a wedge bow must end before the stern");
      continue;
    }
    outlines.push_back(waterline_in_world(ship));
    named.push_back({path, &origin, true, i});
  }
}

void check_floes(const SceneDraft& draft, ProblemCollector& problems, std::vector<Named>& named,
                 std::vector<Polygon>& outlines) {
  for (std::size_t i = 0; i < draft.scene.floes.size(); ++i) {
    const Polygon& polygon = draft.scene.floes[i].polygon_in_world;
    const Origin& origin = draft.floe_origins[i];
    if (!origin.is_known_valid) {
      if (const auto defect = geometry::find_defect(polygon)) {
        problems.report(origin.source, origin.offset, floe_path(draft, i),
                        "an invalid polygon: " + describe(*defect),
                        "simple rings with an area, holes inside and apart");
        continue;
      }
    }
    const geometry::Measures measures = geometry::measure(polygon);
    if (!simulation::can_be_floe(measures)) {
      problems.report(
          origin.source, origin.offset, floe_path(draft, i),
          fmt::format("a floe of {:.3g} m², second moment {:.3g} m⁴", measures.area, measures.second_moment),
          fmt::format("at least {:g} m², and a second moment above 0", simulation::kLeastFloeArea));
      continue;
    }
    outlines.push_back(polygon);
    named.push_back({floe_path(draft, i), &origin, false, i});
  }
}

/// Whether two bodies may share that area: ice in contact overlaps by what it crushed. Not by nearly
/// all of the smaller one, which would be the same ice twice.
bool is_crushed(const SceneDraft& draft, const Named& first, const Named& second, double area,
                const Polygon& a, const Polygon& b) {
  const auto is_as_a_run_left_it = [&](const Named& one) {
    return !one.is_ship && draft.scene.floes[one.index].has_crushed_overlaps;
  };
  constexpr double kMostShare = 0.9;
  return (is_as_a_run_left_it(first) || is_as_a_run_left_it(second)) &&
         area <= kMostShare * std::min(geometry::measure(a).area, geometry::measure(b).area);
}

/// All of a scene that may have overlaps, else as many as are reported.
std::size_t most_overlaps(const SceneDraft& draft) {
  const bool may_overlap =
      std::ranges::any_of(draft.scene.floes, &simulation::FloeSpec::has_crushed_overlaps);
  return may_overlap ? std::numeric_limits<std::size_t>::max() : kMostOverlaps;
}

bool is_wall(const Named& body) {
  return body.is_ship && body.origin->list == "walls";
}

std::string remedy_of(const Named& first, const Named& second) {
  if (is_wall(second)) return "a face and a depth_m clear of it";
  if (!first.is_ship || second.is_ship) return "bodies that at most touch";
  return is_wall(first) ? "floes in front of the wall" : "floes outside the waterline";
}

void check_overlaps(const SceneDraft& draft, const std::vector<Named>& named,
                    const std::vector<Polygon>& outlines, ProblemCollector& problems) {
  auto overlaps = geometry::find_overlapping_pairs(outlines, most_overlaps(draft));
  std::erase_if(overlaps, [&](const geometry::OverlappingPair& overlap) {
    return is_crushed(draft, named[overlap.first], named[overlap.second], overlap.area,
                      outlines[overlap.first], outlines[overlap.second]);
  });
  if (overlaps.size() > kMostOverlaps) overlaps.resize(kMostOverlaps);
  for (const geometry::OverlappingPair& overlap : overlaps) {
    const Named& first = named[overlap.first];
    const Named& second = named[overlap.second];
    if (is_wall(second) && first.origin->is_structure) continue;  // walls cross each other and structures
    const std::string area = std::isnan(overlap.area) ? "" : fmt::format(", {:.6g} m² shared", overlap.area);
    problems.add(second.origin->source, second.origin->offset,
                 {.path = second.path,
                  .found = fmt::format("an overlap with {}{}", first.path, area),
                  .allowed = remedy_of(first, second)});
  }
  if (overlaps.size() == kMostOverlaps)
    problems.add(0, 0,
                 {.path = "floes", .found = fmt::format("{} overlaps, and perhaps more", kMostOverlaps)});
}

}  // namespace

std::string ship_path(const SceneDraft& draft, std::size_t ship) {
  const Origin& origin = draft.ship_origins[ship];
  return fmt::format("{}[{}]", origin.list, origin.group);
}

std::string floe_path(const SceneDraft& draft, std::size_t floe) {
  const Origin& origin = draft.floe_origins[floe];
  const std::string group = fmt::format("floes[{}]", origin.group);
  return origin.member < 0 ? group : fmt::format("{} (its floe {})", group, origin.member);
}

std::string describe(const geometry::DefectAt& defect) {
  return fmt::format("{}{}", name_of(defect.defect), places_in_words(defect.places, 3));
}

Polygon waterline_in_world(const simulation::ShipSpec& ship) {
  const geometry::Pose world_from_ship{ship.position_in_world, geometry::Rotation::by(ship.heading)};
  return {transform(world_from_ship, ship.hull.waterline), {}};
}

void check_scene(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems) {
  check_water_and_time(draft, resolved, problems);
  if (problems.count() == 0) check_own_density(draft, problems);
  check_walls(draft, resolved, problems);
  std::vector<Named> named;
  std::vector<Polygon> outlines;
  check_ships(draft, problems, named, outlines);
  check_floes(draft, problems, named, outlines);
  check_speeds(draft, resolved, problems);
  check_overlaps(draft, named, outlines, problems);
}

}  // namespace polynya::io
