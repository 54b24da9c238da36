#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "elementary/elementary.hpp"
#include "geometry/cut/overlap.hpp"
#include "io/scene/gone_keys.hpp"
#include "io/scene/scene_check.hpp"
#include "simulation/ship/sailing.hpp"
#include "simulation/world/default_tick.hpp"
#include "simulation/world/parts.hpp"
#include "simulation/world/population.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Vector;
using simulation::PlacedHull;
using simulation::Ship;
using simulation::Wall;

// Limits of values that are usual. Values beyond them give a hint. Block coefficients are those of slender and of full
// ships. Draughts are given as fractions of the beam; usual is a third.
constexpr double kSlenderBlock = 0.4, kFullBlock = 0.9;                        // [-]
constexpr double kLeastDraughtOfBeam = 1 / 8.0, kMostDraughtOfBeam = 2 / 3.0;  // [-]
/// Largest relative difference between the mass and the displacement of the hull [-].
constexpr double kMassError = 0.05;
constexpr double kFastestShip = 12;    ///< icebreakers reach 11 m/s in open water [m/s]
constexpr double kFastestIce = 3;      ///< ice drifts at 1 m/s in a storm, at 3 m/s in tidal straits [m/s]
constexpr double kThinnestIce = 0.01;  ///< thinner ice is grease and slush [m]
constexpr double kThickestIce = 4;     ///< level ice grows no thicker; ridges are no plates [m]
/// Least number of ticks per period of a mooring [-]. With it, the period in the run is right to 0.2 %: the midpoint
/// rule makes it too long by the fraction (ωΔt)²/12. A larger value would warn of moorings that are accurate enough.
constexpr double kLeastTicksInPeriod = 40;
/// A hint is given if the recording intervals make the tick shorter than the motion requires by this factor or more
/// [-]. A smaller value gives the hint more often.
constexpr double kShortenedTick = 2.5;
constexpr double kKnots = 3600 / 1852.0;  ///< [kn / (m/s)]

Vector ahead_of(const PlacedHull& hull) {
  return {elementary::cos(hull.heading), elementary::sin(hull.heading)};
}

bool is_steered(const Ship& ship) {
  return !std::holds_alternative<simulation::NoSteering>(ship.steering);
}
/// Returns true if water slows the ship.
bool is_slowed(const Ship& ship) {
  return ship.water.acts || std::holds_alternative<simulation::Engine>(ship.propulsion);
}

class SceneHints {
 public:
  SceneHints(const SceneDraft& draft, const JsonValue& given, ProblemCollector& hints)
      : scene_(draft.scene), draft_(draft), given_(given), hints_(hints) {}

  void add_all() {
    hint_at_ice();
    for (std::size_t i = 0; i < scene_.ships.size(); ++i) {
      hint_at_mass(i);
      hint_at_mooring(i);
      hint_at_period(i);
      hint_at_speed(i);
      hint_at_course(i);
    }
    for (std::size_t i = 0; i < scene_.walls.size(); ++i)
      hint_at_side(scene_.walls[i], hull_count(scene_) - scene_.walls.size() + i);
    hint_at_crossings();
    hint_at_drift();
    hint_at_step();
    hint_at_intervals();
  }

 private:
  void add(Severity severity, const std::string& path, std::string sentence) {
    hints_.add(0, nearest_offset(given_, path), {.path = path, .sentence = std::move(sentence), .severity = severity});
  }
  void add(Severity severity, std::size_t hull, std::string_view key, std::string sentence) {
    add(severity, fmt::format("{}.{}", hull_path(draft_, hull), key), std::move(sentence));
  }

  void hint_at_ice() {
    if (scene_.floes.empty() && std::ranges::any_of(scene_.ships, simulation::sails)) return;
    if (scene_.floes.empty()) {
      add(Severity::kHint, "floes", "there is no ice in this scene");
      return;
    }
    const double h = scene_.ice.thickness;
    if (h > kThickestIce || h < kThinnestIce)
      add(Severity::kHint, "ice.thickness_m",
          fmt::format("{:g} m: ice under {:g} m is slush, and level ice is {:g} m at most", h, kThinnestIce,
                      kThickestIce));
  }

  void hint_at_mass(std::size_t i) {
    const Ship& ship = scene_.ships[i];
    const auto [length, beam] = size_of(ship.hull);
    const double displaced =
        scene_.water.water.density * ship.water.block_coefficient * length * beam * ship.hull.draught;
    if (displaced > 0 && std::abs(ship.mass / displaced - 1) > kMassError)
      add(Severity::kWarning, i, "mass_kg",
          fmt::format("{:.4g} kg, and draught and block coefficient displace {:.4g} kg of water", ship.mass,
                      displaced));
    if (displaced > 0) return;
    const double shallow = kLeastDraughtOfBeam * beam, deep = kMostDraughtOfBeam * beam;
    const double area = scene_.water.water.density * length * beam;
    const double least = kSlenderBlock * area * shallow, most = kFullBlock * area * deep;
    if (ship.mass >= least && ship.mass <= most) return;
    add(Severity::kWarning, i, "mass_kg",
        fmt::format("{:.4g} kg for a hull of {:.4g} × {:.4g} m, which displaces {:.2g} to {:.2g} kg of water at a "
                    "draught of {:.2g} to {:.2g} m and block coefficients of {:g} to {:g}",
                    ship.mass, length, beam, least, most, shallow, deep, kSlenderBlock, kFullBlock));
  }

  void hint_at_mooring(std::size_t i) {
    const auto& m = scene_.ships[i].mooring;
    if (!m || m->surge_stiffness + m->sway_stiffness + m->yaw_stiffness > 0 ||
        m->surge_damping + m->sway_damping + m->yaw_damping > 0)
      return;
    add(Severity::kWarning, i, "mooring",
        "all its stiffnesses and dampings are 0: it holds nothing; give surge_stiffness_N_per_m");
  }

  /// Warns of a mooring whose period is so short compared with the tick that the run makes it too long
  /// (docs/theory/ship.md).
  void hint_at_period(std::size_t i) {
    const Ship& ship = scene_.ships[i];
    if (!ship.mooring || scene_.time.until <= scene_.time.step) return;
    const simulation::Sailing sailing = simulation::sailing_of(ship, scene_.water.water.density);
    const auto& added = sailing.hull.added_mass.rows;
    const struct {
      const char* way;
      double stiffness, inertia;
    } ways[] = {{"in surge", ship.mooring->surge_stiffness, ship.mass + added[0].surge},
                {"in sway", ship.mooring->sway_stiffness, ship.mass + added[1].sway},
                {"in yaw", ship.mooring->yaw_stiffness, ship.moment_of_inertia + added[2].yaw}};
    const auto* stiffest =
        std::ranges::max_element(ways, {}, [](const auto& way) { return way.stiffness / way.inertia; });
    if (stiffest->stiffness == 0) return;
    const double frequency = std::sqrt(stiffest->stiffness / stiffest->inertia);
    const double period = 2 * std::numbers::pi / frequency, tick = scene_.time.step;
    if (period >= kLeastTicksInPeriod * tick) return;
    const double half_turn = 0.5 * frequency * tick;
    add(Severity::kWarning, i, "mooring",
        fmt::format(
            "it swings {} with a period of {:.3g} s, which is {:.2g} ticks of {:g} s: the period comes out {:.4g} "
            "times as long; give time.step_s {:.2g} s or less, or softer springs",
            stiffest->way, period, period / tick, tick, half_turn / elementary::atan(half_turn),
            period / kLeastTicksInPeriod));
  }

  void hint_at_speed(std::size_t i) {
    const Ship& ship = scene_.ships[i];
    const auto too_fast = [&](double speed) { return std::abs(speed) > kFastestShip; };
    const std::string most = fmt::format("ships in ice stay below {:g} m/s", kFastestShip);
    const bool is_prescribed = std::holds_alternative<simulation::ConstantSpeed>(ship.propulsion);
    const std::string_view key = is_prescribed ? "propulsion" : "speed_m_per_s";
    if (too_fast(ship.speed))
      return add(Severity::kHint, i, key,
                 fmt::format("{:.4g} m/s ({:.3g} kn): {}", ship.speed, ship.speed * kKnots, most));
    const double gained = thrust_of(ship) / ship.mass * scene_.time.until;
    if (is_slowed(ship) || !too_fast(ship.speed + gained)) return;
    add(Severity::kHint, i, "propulsion",
        fmt::format("where no ice stops it this thrust takes the ship to {:.3g} m/s by {:g} s, since no water slows "
                    "it (water.model none); {}",
                    ship.speed + gained, scene_.time.until, most));
  }

  /// Warns if all ice is behind the hull and the ship moves away from it.
  void hint_at_course(std::size_t i) {
    const Ship& ship = scene_.ships[i];
    const bool is_ice_moved =
        !scene_.water.is_steady() || scene_.water.shear.rate != 0 || scene_.wind.blows() || !scene_.walls.empty() ||
        std::ranges::any_of(scene_.floes, [](const simulation::FloeSpec& floe) { return floe.velocity != Vector{}; });
    if (scene_.floes.empty() || is_ice_moved || ship.mooring || is_steered(ship)) return;
    const double drift = dot(scene_.water.drift_at(0), ahead_of(ship));
    const double speed = ship.speed - drift, thrust = thrust_of(ship);
    if ((speed == 0 && thrust == 0) || speed * thrust < 0) return;
    const Vector course = (speed + thrust > 0 ? 1.0 : -1.0) * ahead_of(ship);
    double stern = std::numeric_limits<double>::infinity(), ice = -stern;
    for (const Point p : waterline_in_world(ship).outer) stern = std::min(stern, dot(p - Point{}, course));
    for (const simulation::FloeSpec& floe : scene_.floes) {
      for (const Point p : floe.polygon_in_world.outer) ice = std::max(ice, dot(p - Point{}, course));
    }
    if (ice > stern) return;
    add(Severity::kWarning, i, "heading_deg",
        fmt::format("the ship moves away from all ice: the nearest lies {:.4g} m behind its end", stern - ice));
  }

  /// Warns of two bodies with prescribed motion whose paths cross, because they do not stop each other.
  void hint_at_crossings() {
    std::vector<dynamics::NewBody> bodies;
    for (std::size_t i = 0; i < hull_count(scene_); ++i) bodies.push_back(simulation::new_body_of(scene_, i));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t k = i + 1; k < bodies.size(); ++k) {
        const bool can_cross = !is_grounded(bodies[i].kind) || !is_grounded(bodies[k].kind);
        if (can_cross && bodies[i].is_prescribed && bodies[k].is_prescribed)
          hint_at_crossing(i, k, bodies[i].velocity, bodies[k].velocity);
      }
    }
  }

  /// Warns about one such pair. Velocities are in the water frame [m/s].
  void hint_at_crossing(std::size_t i, std::size_t k, Vector velocity, Vector velocity_of_other) {
    const PlacedHull &hull = hull_of(scene_, i), &other = hull_of(scene_, k);
    const auto touch = geometry::first_contact(waterline_in_world(hull).outer, waterline_in_world(other).outer,
                                               velocity_of_other - velocity, 0, scene_.time.until);
    if (!touch) return;
    const Point at = touch->point + touch->time * velocity + scene_.water.drift_path(touch->time);
    add(Severity::kWarning, i, "propulsion",
        fmt::format("it meets {} after {:.4g} s at ({:.4g}, {:.4g}) m, where the motion of both is prescribed: they "
                    "pass through each other without a force; give it thrust_N",
                    other.name, touch->time, at.x, at.y));
  }

  void hint_at_drift() {
    const double drift = scene_.water.fastest_drift();
    if (drift > kFastestIce)
      add(Severity::kHint, "water.drift_m_per_s",
          fmt::format("{:.3g} m/s: ice drifts at {:g} m/s at most", drift, kFastestIce));
  }

  /// Warns if all ice is behind the face of a wall.
  void hint_at_side(const Wall& wall, std::size_t hull) {
    const auto is_before = [&](Point p) { return dot(p - wall.position_in_world, ahead_of(wall)) > 0; };
    const auto has_part_before = [&](const simulation::FloeSpec& floe) {
      return std::ranges::any_of(floe.polygon_in_world.outer, is_before);
    };
    if (scene_.floes.empty() || std::ranges::any_of(scene_.floes, has_part_before)) return;
    add(Severity::kWarning, hull, "to_m", "all ice lies behind its face: exchange from_m and to_m");
  }

  /// Returns the shortest step [s]. A tick is divided into parts if a hull meets ice.
  double shortest_step(bool is_hull) const {
    const bool has_parts = is_hull && scene_.contact.law == simulation::ContactLaw::kCrush;
    return has_parts ? scene_.time.step / simulation::kMostParts : scene_.time.step;
  }

  /// Returns the limit of the displacement per step (simulation/world/parts.hpp) and its reason, in words.
  std::string most_way_as_text(double thickness) const {
    const double way = simulation::allowed_displacement(scene_.contact, thickness);
    if (way == simulation::kDisplacementOverThickness * thickness)
      return fmt::format("{:g} of the ice's thickness of {:g} m", simulation::kDisplacementOverThickness, thickness);
    if (way == simulation::kDisplacementTimesThickness / thickness)
      return fmt::format("{:g} m² over the ice's thickness of {:g} m", simulation::kDisplacementTimesThickness,
                         thickness);
    return fmt::format("{:g} of contact.circle_radius_m {:g}", simulation::kDisplacementOverRadius,
                       scene_.contact.circle_radius);
  }

  void hint_at_step() {
    if (scene_.floes.empty()) return;
    const auto thickness_of = [&](const simulation::FloeSpec& floe) { return ice_of(scene_, floe.own_ice).thickness; };
    const auto way_in = [&](double thickness) { return simulation::allowed_displacement(scene_.contact, thickness); };
    const auto thinnest_and_thickest = std::ranges::minmax_element(scene_.floes, {}, thickness_of);
    const double thin = thickness_of(*thinnest_and_thickest.min);
    const double thick = thickness_of(*thinnest_and_thickest.max);
    double speed = 0, way = 0, thickness = thin;
    const auto consider = [&](double of_one, bool is_hull) {
      const double own = of_one * shortest_step(is_hull);
      // The limit for floes is that of the thinnest ice.
      const double ice = is_hull && way_in(thick) < way_in(thin) ? thick : thin;
      if (own * way_in(thickness) <= way * way_in(ice)) return;
      speed = of_one;
      way = own;
      thickness = ice;
    };
    const double drift = scene_.water.fastest_drift();  // speed of ice towards bodies that do not move
    for (const Ship& ship : scene_.ships) consider(std::max(std::abs(ship.speed), ship.mooring ? drift : 0), true);
    if (!scene_.structures.empty()) consider(drift, true);
    for (const Wall& wall : scene_.walls)
      consider(wall.pressure ? wall.pressure->closing_speed : std::max(length(wall.velocity), drift), true);
    for (const simulation::FloeSpec& floe : scene_.floes) consider(length(floe.velocity), false);
    const double most = way_in(thickness);
    if (way <= 1.005 * most) return;  // the rounded value that the message below recommends would be no different
    add(Severity::kWarning, "time.step_s",
        fmt::format("at {:.3g} m/s bodies move {:.2g} m in a step, more than {}: loads depend on the step; "
                    "give {:.3g} s or less",
                    speed, way, most_way_as_text(thickness), most * scene_.time.step / way));
  }

  /// Hints if the chosen tick is much shorter than the motion of the bodies requires, because it must divide the
  /// recording intervals.
  void hint_at_intervals() {
    const JsonValue* time = given_.find("time", JsonValue::Kind::kObject);
    if (time != nullptr && time->find("step_s") != nullptr) return;
    const double tick = scene_.time.step, longest = simulation::tick_for_any_interval(scene_);
    if (longest < kShortenedTick * tick) return;
    const struct {
      const char* key;
      double interval;
    } intervals[] = {{"record.forces_interval_s", scene_.record.forces_interval},
                     {"record.frames_interval_s", scene_.record.frames_interval}};
    for (const auto& [key, interval] : intervals) {
      const double ticks = std::max(1.0, std::round(interval / longest));
      if (std::abs(interval / longest - ticks) < 1e-6 * ticks) continue;
      add(Severity::kHint, key,
          fmt::format(
              "{:g} s is no whole number of ticks of {:g} s: the tick is therefore {:g} s and the run takes {:.3g} "
              "times as many; give {:g} s, or time.step_s",
              interval, longest, tick, longest / tick, ticks * longest));
    }
  }

  const simulation::Scene& scene_;
  const SceneDraft& draft_;
  const JsonValue& given_;
  ProblemCollector& hints_;
};

}  // namespace

void add_scene_hints(const SceneDraft& draft, const JsonValue& given, ProblemCollector& hints) {
  SceneHints(draft, given, hints).add_all();
  add_hints_at_gone_keys(given, hints);
}

}  // namespace polynya::io
