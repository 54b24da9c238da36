#include "io/scene/scene_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/shape/pose.hpp"
#include "simulation/world/limits.hpp"
#include "simulation/world/parts.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::io {
namespace {

using geometry::Polygon;
using simulation::BodyKind;

constexpr double kMostSteps = 1e9;  ///< largest number of ticks of a run; longer runs are refused as mistakes
/// Largest acceleration that a thrust may give a ship [m/s²]. Icebreakers have some 0.1. With a larger value, scenes
/// are accepted whose ships exceed all speeds within a few steps.
constexpr double kMostAcceleration = 10;
constexpr std::size_t kMostOverlaps = 200;  ///< number of overlaps that are reported at most

void check_water_and_time(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  const auto& scene = draft.scene;
  const ReportAt report{problems, given, ""};
  if (scene.ice.density >= scene.water.water.density)
    report("ice.density_kg_per_m3", fmt::format("{}: this ice sinks", scene.ice.density),
           fmt::format("a number < the water's density, {} [kg/m³]", scene.water.water.density));
  if (scene.time.until / scene.time.step > kMostSteps)
    report("time.until_s", fmt::format("{:.3g} steps", scene.time.until / scene.time.step),
           fmt::format("at most {:g} steps", kMostSteps));
}

/// Checks rules between the keys of `contact`.
void check_contact(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  const simulation::ContactSettings& contact = draft.scene.contact;
  if (contact.normal == simulation::ContactNormal::kCircleCentres && contact.law == simulation::ContactLaw::kCrush)
    ReportAt{problems, given, ""}(
        "contact.normal",
        "circle-centres with law crush, which needs the overlap of the bodies and not of their circles",
        "boundary, or circle-centres with contact.law impulse");
}

/// Reports ships at places where a sheared current is faster than a run allows, because the water carries them along.
void check_currents_at_ships(const SceneDraft& draft, ProblemCollector& problems) {
  const dynamics::ShearCurrent current = simulation::current_of(draft.scene.water.shear);
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i) {
    const double speed = length(current.velocity_at(draft.scene.ships[i].position_in_world));
    if (speed < simulation::kRunawaySpeed) continue;
    const Origin& origin = draft.hull_origins[i];
    problems.report(origin.source, origin.offset, hull_path(draft, i),
                    fmt::format("a ship in a current of {:.4g} m/s: water.shear grows with the distance", speed),
                    fmt::format("a place where it is slower than {:g} m/s, or a smaller water.shear.rate_per_s",
                                simulation::kRunawaySpeed));
  }
}

/// Reports the first floe of each entry whose own density makes it sink.
void check_own_density(const SceneDraft& draft, ProblemCollector& problems) {
  const double water = draft.scene.water.water.density;
  std::optional<std::size_t> last;  // entry that was reported last
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

/// Returns the speed of a ship after the first step [m/s].
double speed_of(const simulation::Scene& scene, const simulation::Ship& ship) {
  return std::abs(ship.speed) + std::abs(thrust_of(ship)) / ship.mass * scene.time.step;
}

/// Returns the largest initial speed of a point of a floe relative to the water [m/s]; 0 for an outline that is no
/// floe, which is reported elsewhere.
double rim_speed_of(const dynamics::ShearCurrent& current, const simulation::FloeSpec& floe) {
  const geometry::Measures measures = geometry::measure(floe.polygon_in_world);
  if (!simulation::can_be_floe(measures)) return 0;
  double radius = 0;
  for (const geometry::Point p : floe.polygon_in_world.outer) radius = std::max(radius, distance(p, measures.centroid));
  return length(floe.velocity + current.velocity_at(measures.centroid)) +
         std::abs(floe.angular_velocity + current.angular_velocity()) * radius;
}

/// The fastest body found so far.
struct Fastest {
  double speed = 0;  ///< [m/s]
  std::string path;
};

void report_runaway(const Fastest& body, const Origin& origin, ProblemCollector& problems) {
  if (body.speed < simulation::kRunawaySpeed) return;
  problems.add(origin.source, origin.offset,
               {.path = body.path,
                .found = fmt::format("a rim that moves at {:.4g} m/s at the start", body.speed),
                .allowed = fmt::format("less than {:g} m/s, the water's shear included", simulation::kRunawaySpeed)});
}

/// Returns the fastest of the water and the ships.
Fastest fastest_ship(const SceneDraft& draft) {
  Fastest fastest{draft.scene.water.fastest_drift(), "the drift"};
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i)
    if (const double speed = speed_of(draft.scene, draft.scene.ships[i]); speed > fastest.speed)
      fastest = {speed, hull_path(draft, i)};
  return fastest;
}

bool is_too_fast_for_step(const Fastest& fastest, const simulation::Scene& scene) {
  return fastest.speed < simulation::kRunawaySpeed &&  // above this speed no time step would help
         fastest.speed * scene.time.step >= scene.contact.circle_radius;
}

void report_step(const Fastest& fastest, const simulation::Scene& scene, const JsonValue& given,
                 ProblemCollector& problems) {
  ReportAt{problems, given, ""}(
      "time.step_s",
      fmt::format("{}: {} moves {:.3g} m in one step at {:.3g} m/s", scene.time.step, fastest.path,
                  fastest.speed * scene.time.step, fastest.speed),
      fmt::format("a step in which nothing moves as far as a circle's radius, {} m", scene.contact.circle_radius));
}

/// Keys of a flow: as a table over time, and as a constant.
struct FlowKeys {
  std::string table;
  std::string constant;
};

/// Reports a flow over time whose rows are not in ascending order, or that is given together with a constant one.
void check_flow(const std::vector<dynamics::FlowRow>& rows, geometry::Vector constant, const FlowKeys& keys,
                const JsonValue& given, ProblemCollector& problems) {
  const ReportAt report{problems, given, ""};
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (rows[i].time <= rows[i - 1].time)
      report(fmt::format("{}[{}].t_s", keys.table, i), fmt::format("{:g}", rows[i].time),
             fmt::format("a time after that of the row before, {:g} [s]", rows[i - 1].time));
  if (!rows.empty() && constant != geometry::Vector{})
    report(keys.constant, "a velocity, and a table", "one of the two");
}

/// Reports thrusts that no ship has, judged by the acceleration, and by the final speed if no water slows the ship.
void check_thrusts(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  const simulation::Scene& scene = draft.scene;
  for (std::size_t i = 0; i < scene.ships.size(); ++i) {
    const simulation::Ship& ship = scene.ships[i];
    const double acceleration = std::abs(thrust_of(ship)) / ship.mass;
    const auto report = [&](std::string found, std::string allowed) {
      const std::string path = hull_path(draft, i) + ".propulsion";
      problems.report(0, nearest_offset(given, path), path, std::move(found), std::move(allowed));
    };
    if (acceleration > kMostAcceleration) {
      report(fmt::format("a thrust that accelerates the ship by {:.3g} m/s²", acceleration),
             fmt::format("at most {:g} m/s²: a smaller thrust, or a larger mass_kg", kMostAcceleration));
      continue;
    }
    const bool is_slowed = ship.water.acts || std::holds_alternative<simulation::Engine>(ship.propulsion);
    const double speed = std::abs(ship.speed) + acceleration * scene.time.until;
    if (!is_slowed && speed >= simulation::kRunawaySpeed)
      report(fmt::format("a thrust that takes the ship to {:.3g} m/s by {:g} s, since no water slows it", speed,
                         scene.time.until),
             fmt::format("less than {:g} m/s: a smaller thrust, an earlier time.until_s, or water.model manoeuvring",
                         simulation::kRunawaySpeed));
  }
}

void check_speeds_of_ships(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i)
    report_runaway({speed_of(draft.scene, draft.scene.ships[i]), hull_path(draft, i)}, draft.hull_origins[i], problems);
  const Fastest fastest = fastest_ship(draft);
  if (is_too_fast_for_step(fastest, draft.scene)) report_step(fastest, draft.scene, given, problems);
}

void check_speeds_of_floes(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  const simulation::Scene& scene = draft.scene;
  const dynamics::ShearCurrent current = simulation::current_of(scene.water.shear);
  Fastest fastest = fastest_ship(draft);
  if (is_too_fast_for_step(fastest, scene)) return;  // already reported with the ships
  for (std::size_t i = 0; i < scene.floes.size(); ++i) {
    const double speed = rim_speed_of(current, scene.floes[i]);
    if (speed <= fastest.speed && speed < simulation::kRunawaySpeed) continue;
    const Fastest floe{speed, floe_path(draft, i)};
    report_runaway(floe, draft.floe_origins[i], problems);
    if (speed > fastest.speed) fastest = floe;
  }
  if (is_too_fast_for_step(fastest, scene)) report_step(fastest, scene, given, problems);
}

/// Returns the largest σ_c h of the floes, or that of the scene's ice if there are no floes [N/m].
double most_that_ice_bears(const simulation::Scene& scene) {
  const auto borne = [](const fracture::Ice& ice) { return ice.compressive_strength * ice.thickness; };
  if (scene.floes.empty()) return borne(scene.ice);
  double most = 0;
  for (const simulation::FloeSpec& floe : scene.floes)
    most = std::max(most, borne(simulation::ice_of(scene, floe.own_ice)));
  return most;
}

/// Reports a wall's load that no ice can carry, and one that accelerates the wall beyond the closing speed in the
/// shortest step.
void check_load(const simulation::Scene& scene, const simulation::WallPressure& pressure, const JsonValue& given,
                const std::string& path, ProblemCollector& problems) {
  const ReportAt report{problems, given, path};
  if (const double most = most_that_ice_bears(scene); pressure.line_load >= most)
    report("pressure.line_load_N_per_m",
           fmt::format("{:g} N/m, which crushes the strongest ice of the scene without end", pressure.line_load),
           fmt::format("less than its σ_c h, {:.4g} [N/m]", most));
  const bool has_parts = scene.contact.law == simulation::ContactLaw::kCrush;
  const double shortest_step = has_parts ? scene.time.step / simulation::kMostParts : scene.time.step;
  const double gain = shortest_step * pressure.line_load / pressure.mass_per_length;
  if (gain > pressure.closing_speed)
    report("pressure.mass_kg_per_m",
           fmt::format("{:g} kg/m, which the load takes to {:.3g} m/s in one step, beyond the closing speed",
                       pressure.mass_per_length, gain),
           fmt::format("at least {:.4g} [kg/m], or a shorter time.step_s",
                       shortest_step * pressure.line_load / pressure.closing_speed));
}

/// Calls `call` with the pressure, the JSON and the path of each wall that has a pressure.
template <class Call>
void each_pressing_wall(const SceneDraft& draft, const JsonValue& given, Call call) {
  std::size_t hull = hull_count(draft.scene) - draft.scene.walls.size();
  for (const simulation::Wall& wall : draft.scene.walls) {
    const std::size_t index = draft.hull_origins[hull++].group;
    if (wall.pressure) call(*wall.pressure, given.find("walls")->items()[index], fmt::format("walls[{}]", index));
  }
}

void check_walls(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  each_pressing_wall(draft, given, [&](const auto&, const JsonValue& item, const std::string& path) {
    const ReportAt report{problems, item, path};
    if (item.find("velocity_m_per_s"))
      report("velocity_m_per_s", "a velocity of a wall with pressure", "either of them: the load moves the wall");
    if (draft.scene.contact.law == simulation::ContactLaw::kImpulse)
      report("pressure", "a load with contact.law impulse",
             "contact.law crush, or velocity_m_per_s: rigid impulses bear no definite load");
  });
}

void check_loads_of_walls(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  each_pressing_wall(draft, given, [&](const auto& pressure, const JsonValue& item, const std::string& path) {
    check_load(draft.scene, pressure, item, path, problems);
  });
}

/// A body in the search for overlaps.
struct Named {
  std::string path;
  const Origin* origin;
  std::size_t index;  ///< index of the body in the scene

  bool is_floe() const { return origin->kind == BodyKind::kFloe; }
  bool is_wall() const { return origin->kind == BodyKind::kWall; }
};

void check_hulls(const SceneDraft& draft, ProblemCollector& problems) {
  for (std::size_t i = 0; i < hull_count(draft.scene); ++i) {
    const simulation::PlacedHull& placed = hull_of(draft.scene, i);
    const Origin& origin = draft.hull_origins[i];
    const std::string path = hull_path(draft, i);
    const auto report = [&](std::string_view key, std::string found, std::string allowed) {
      problems.report(origin.source, origin.offset, fmt::format("{}.{}", path, key), std::move(found),
                      std::move(allowed));
    };
    for (std::size_t k = 0; k < i; ++k) {
      if (hull_of(draft.scene, k).name == placed.name)
        report("name", fmt::format("\"{}\" a second time", placed.name), "each ship and structure its own name");
    }
    const auto& hull = placed.hull;
    if (placed.panels && placed.panels->top <= placed.panels->bottom)
      report("panels.top_m", fmt::format("{:g}", placed.panels->top),
             fmt::format("above bottom_m, {:g} [m]", placed.panels->bottom));
    if (const double length = size_of(hull).x; hull.draught > length)
      report("hull.draught_m", fmt::format("{:g}", hull.draught),
             fmt::format("at most the waterline's length, {:g} [m]", length));
    if (!hull.angles_from_vertical.empty() && hull.angles_from_vertical.size() != hull.waterline.size())
      report("hull.angles_from_vertical_deg", fmt::format("{} angles", hull.angles_from_vertical.size()),
             fmt::format("none, or one for each of the waterline's {} vertices", hull.waterline.size()));
    if (const auto defect = geometry::find_defect({hull.waterline, {}}))
      report(origin.kind == BodyKind::kShip ? "hull" : "waterline_m", "an invalid waterline: " + describe(*defect),
             origin.kind == BodyKind::kShip ? "a simple ring with an area; a wedge bow must end before the stern"
                                            : "a simple ring with an area");
  }
}

void add_valid_hulls(const SceneDraft& draft, std::vector<Named>& named, std::vector<Polygon>& outlines) {
  for (std::size_t i = 0; i < hull_count(draft.scene); ++i) {
    const simulation::PlacedHull& hull = hull_of(draft.scene, i);
    if (geometry::find_defect({hull.hull.waterline, {}})) continue;
    outlines.push_back(waterline_in_world(hull));
    named.push_back({hull_path(draft, i), &draft.hull_origins[i], i});
  }
}

void check_floes(const SceneDraft& draft, ProblemCollector& problems, std::vector<Named>& named,
                 std::vector<Polygon>& outlines) {
  for (std::size_t i = 0; i < draft.scene.floes.size(); ++i) {
    const Polygon& polygon = draft.scene.floes[i].polygon_in_world;
    const Origin& origin = draft.floe_origins[i];
    if (!origin.is_known_valid) {
      if (const auto defect = geometry::find_defect(polygon)) {
        problems.report(origin.source, origin.offset, floe_path(draft, i), "an invalid polygon: " + describe(*defect),
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
    if (draft.scene.floes[i].under_ship >= 0) continue;  // a submerged floe may overlap the hull and other ice
    outlines.push_back(polygon);
    named.push_back({floe_path(draft, i), &origin, i});
  }
}

/// Returns true if an overlap of two bodies may be there because ice was crushed. An overlap of nearly the whole
/// smaller body is not accepted, since it would be the same ice twice.
bool is_crushed(const SceneDraft& draft, const std::vector<Named>& named, const std::vector<Polygon>& outlines,
                const geometry::OverlappingPair& overlap) {
  const auto is_as_a_run_left_it = [&](const Named& one) {
    return one.is_floe() && draft.scene.floes[one.index].has_crushed_overlaps;
  };
  constexpr double kMostShare = 0.9;
  const auto area_of = [&](std::size_t body) { return geometry::measure(outlines[body]).area; };
  return (is_as_a_run_left_it(named[overlap.first]) || is_as_a_run_left_it(named[overlap.second])) &&
         overlap.area <= kMostShare * std::min(area_of(overlap.first), area_of(overlap.second));
}

/// Returns the largest number of overlaps to search for: all, if the scene allows some, or else as many as are
/// reported.
std::size_t most_overlaps(const SceneDraft& draft) {
  const bool may_overlap = std::ranges::any_of(draft.scene.floes, &simulation::FloeSpec::has_crushed_overlaps);
  return may_overlap ? std::numeric_limits<std::size_t>::max() : kMostOverlaps;
}

std::string remedy_of(const Named& first, const Named& second) {
  if (second.is_wall()) return "a face and a depth_m clear of it";
  if (first.is_floe() || !second.is_floe()) return "bodies that at most touch";
  return first.is_wall() ? "floes in front of the wall" : "floes outside the waterline";
}

void check_overlaps(const SceneDraft& draft, const std::vector<Named>& named, const std::vector<Polygon>& outlines,
                    ProblemCollector& problems) {
  auto overlaps = geometry::find_overlapping_pairs(outlines, most_overlaps(draft));
  std::erase_if(overlaps,
                [&](const geometry::OverlappingPair& overlap) { return is_crushed(draft, named, outlines, overlap); });
  if (overlaps.size() > kMostOverlaps) overlaps.resize(kMostOverlaps);
  for (const geometry::OverlappingPair& overlap : overlaps) {
    const Named& first = named[overlap.first];
    const Named& second = named[overlap.second];
    if (second.is_wall() && is_grounded(first.origin->kind)) continue;  // walls may cross each other and structures
    const std::string area = std::isnan(overlap.area) ? "" : fmt::format(", {:.6g} m² shared", overlap.area);
    problems.add(second.origin->source, second.origin->offset,
                 {.path = second.path,
                  .found = fmt::format("an overlap with {}{}", first.path, area),
                  .allowed = remedy_of(first, second)});
  }
  if (overlaps.size() == kMostOverlaps)
    problems.add(0, 0, {.path = "floes", .found = fmt::format("{} overlaps, and perhaps more", kMostOverlaps)});
}

}  // namespace

std::string_view list_of(BodyKind kind) {
  constexpr std::string_view kLists[] = {"ships", "structures", "walls", "floes"};
  return kLists[static_cast<std::size_t>(kind)];
}

geometry::Vector size_of(const simulation::Hull& hull) {
  const geometry::Box box = bounding_box(hull.waterline);
  return box.high - box.low;
}

double thrust_of(const simulation::Ship& ship) {
  const auto* constant = std::get_if<simulation::ConstantThrust>(&ship.propulsion);
  const auto* engine = std::get_if<simulation::Engine>(&ship.propulsion);
  return constant ? constant->thrust : engine ? engine->bollard_pull : 0;
}
std::string hull_path(const SceneDraft& draft, std::size_t hull) {
  const Origin& origin = draft.hull_origins[hull];
  return fmt::format("{}[{}]", list_of(origin.kind), origin.group);
}

std::string floe_path(const SceneDraft& draft, std::size_t floe) {
  const Origin& origin = draft.floe_origins[floe];
  const std::string group = fmt::format("floes[{}]", origin.group);
  return origin.member < 0 ? group : fmt::format("{} (its floe {})", group, origin.member);
}

std::string describe(const geometry::DefectAt& defect) {
  return fmt::format("{}{}", name_of(defect.defect), places_in_words(defect.places, 3));
}

Polygon waterline_in_world(const simulation::PlacedHull& hull) {
  const geometry::Pose world_from_hull{hull.position_in_world, geometry::Rotation::by(hull.heading)};
  return {transform(world_from_hull, hull.hull.waterline), {}};
}

void check_without_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  check_water_and_time(draft, given, problems);
  check_contact(draft, given, problems);
  check_currents_at_ships(draft, problems);
  const simulation::Scene& scene = draft.scene;
  check_flow(scene.water.drift_rows, scene.water.drift, {"water.drift_table", "water.drift_m_per_s"}, given, problems);
  check_flow(scene.wind.rows, scene.wind.velocity, {"wind.table", "wind.velocity_m_per_s"}, given, problems);
  check_walls(draft, given, problems);
  check_hulls(draft, problems);
  check_speeds_of_ships(draft, given, problems);
  check_thrusts(draft, given, problems);
}

/// Reports fast ice that would run onto other fast ice before the end. The motion of both is prescribed, so that
/// nothing can resist, and their overlap would be counted as ice twice. The check compares boxes, swept by the relative
/// motion.
void check_fast_ice(const SceneDraft& draft, ProblemCollector& problems) {
  const std::vector<simulation::FloeSpec>& floes = draft.scene.floes;
  std::vector<std::size_t> fast;
  for (std::size_t i = 0; i < floes.size(); ++i)
    if (floes[i].is_fast) fast.push_back(i);
  const auto velocity = [&](std::size_t i) { return floes[i].velocity; };
  if (std::ranges::adjacent_find(fast, std::not_equal_to{}, velocity) == fast.end()) return;
  const auto box = [&](std::size_t i) { return bounding_box(floes[i].polygon_in_world.outer); };
  for (std::size_t k = 1; k < fast.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) {
      const geometry::Vector way = draft.scene.time.until * (velocity(fast[k]) - velocity(fast[other]));
      geometry::Box swept = box(fast[k]);
      extend(swept, swept.low + way);
      extend(swept, swept.high + way);
      if (way == geometry::Vector{} || !overlaps(swept, box(fast[other]))) continue;
      const Origin& origin = draft.floe_origins[fast[k]];
      problems.report(origin.source, origin.offset, floe_path(draft, fast[k]),
                      fmt::format("fast ice that can reach the fast ice of {} before the end, by another velocity",
                                  floe_path(draft, fast[other])),
                      "the same velocity_m_per_s for both, or fast ice that does not meet");
    }
  }
}

void check_ice(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems) {
  if (draft.hull_origins.empty() && draft.scene.floes.empty() && problems.count() == 0)
    problems.add(0, given.offset, {.found = "neither ships nor floes", .allowed = "at least one ship or floe"});
  if (problems.count() == 0) check_own_density(draft, problems);
  check_loads_of_walls(draft, given, problems);
  std::vector<Named> named;
  std::vector<Polygon> outlines;
  add_valid_hulls(draft, named, outlines);
  check_floes(draft, problems, named, outlines);
  check_speeds_of_floes(draft, given, problems);
  check_fast_ice(draft, problems);
  check_overlaps(draft, named, outlines, problems);
}

}  // namespace polynya::io
