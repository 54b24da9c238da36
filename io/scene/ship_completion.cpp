#include "io/scene/ship_completion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "simulation/sailing.hpp"

namespace polynya::io {
namespace {

using simulation::ShipSpec;

constexpr double kLargestRudder = 0.2;        ///< A_R of L T; rudders have a tenth of that [-]
constexpr double kRudderShare = 0.018;        ///< A_R of L T [-]
constexpr double kPropellerOfDraught = 0.65;  ///< D of T (recall) [-]
constexpr double kGyrationOfLength = 0.25;    ///< [-]
constexpr double kLeastBlock = 0.2;           ///< [-]

/// One ship while it is completed.
class Completion {
 public:
  Completion(const JsonValue& item, const std::string& path, SceneDraft& draft, ProblemCollector& problems)
      : item_(item),
        path_(path),
        density_(draft.scene.water.water.density),
        drive_(draft.drive),
        ship_(draft.ship()),
        problems_(problems) {}

  void run() {
    add_mass();
    if (auto* engine = std::get_if<simulation::Engine>(&ship_.propulsion)) add_engine(*engine);
    if (ship_.water.acts) check_hull();
    check_steering();
    if (ship_.mooring) add_mooring(*ship_.mooring);
  }

 private:
  void report(std::string_view key, std::string found, std::string allowed) {
    problems_.report(0, nearest_offset(item_, key), fmt::format("{}.{}", path_, key), std::move(found),
                     std::move(allowed));
  }

  dynamics::MainDimensions dimensions() const { return dimensions_of(ship_, density_); }

  void add_mass() {
    const bool has_form = ship_.hull.draught > 0 && ship_.water.block_coefficient > 0;
    const auto d = dimensions();
    if (has_form && ship_.mass == 0)
      ship_.mass = density_ * d.block_coefficient * d.length * d.beam * d.draught;
    if (has_form && ship_.moment_of_inertia == 0)
      ship_.moment_of_inertia = ship_.mass * std::pow(kGyrationOfLength * d.length, 2);
    const std::string from_form = ", or hull.draught_m and hull.block_coefficient, from which it follows";
    if (ship_.mass == 0) report("mass_kg", "nothing", "a number ≥ 1, ≤ 1e+12 [kg]" + from_form);
    if (ship_.moment_of_inertia == 0)
      report("moment_of_inertia_kg_m2", "nothing", "a number ≥ 0.001, ≤ 1e+16 [kg m²]" + from_form);
    for (double* missing : {&ship_.mass, &ship_.moment_of_inertia})
      if (*missing == 0) *missing = std::numeric_limits<double>::infinity();  // no further faults by it
  }

  void add_engine(simulation::Engine& engine) {
    const std::string key = "propulsion.engine";
    engine.power = drive_.power;
    const double diameter =
        drive_.propeller_diameter > 0 ? drive_.propeller_diameter : kPropellerOfDraught * ship_.hull.draught;
    engine.propeller_area = drive_.propellers * 0.25 * std::numbers::pi * diameter * diameter;
    if (engine.bollard_pull == 0 && drive_.power > 0 && drive_.propeller_diameter > 0)
      engine.bollard_pull =
          dynamics::bollard_pull(drive_.power, diameter, drive_.propellers, drive_.has_nozzles);
    if (engine.bollard_pull == 0)
      return report(key, "neither bollard_pull_kN nor power_MW with propeller_diameter_m",
                    "bollard_pull_kN, or power_MW and propeller_diameter_m");
    if (ship_.hull.draught > 0 && dimensions().block_coefficient <= 1)
      check_speed(engine, key + ".open_water_speed_m_per_s");
  }

  /// The friction of the water alone must leave something of thrust and power at that speed.
  void check_speed(const simulation::Engine& engine, const std::string& key) {
    const double v = engine.open_water_speed;
    const double resistance =
        0.5 * density_ * ship_.water.resistance_coefficient * wetted_surface(dimensions()) * v * v;
    const std::string at =
        fmt::format("{:g}: the water's friction on the hull there is {:.4g} kN", v, 1e-3 * resistance);
    if (resistance > engine.bollard_pull)
      return report(key, fmt::format("{}, the bollard pull {:.4g} kN", at, 1e-3 * engine.bollard_pull),
                    "a speed that the engine can reach");
    if (engine.power > 0 && resistance * v > engine.power)
      report(
          key,
          fmt::format("{}, which takes {:.4g} MW of {:.4g}", at, 1e-6 * resistance * v, 1e-6 * engine.power),
          "a speed that the engine can reach");
  }

  void check_hull() {
    if (ship_.hull.draught <= 0)
      return report("hull.draught_m", "nothing, and water acts on the hull",
                    "a draught, or water.model none");
    const auto d = dimensions();
    if (!std::isfinite(d.block_coefficient)) return;  // no mass: reported
    if (d.block_coefficient < kLeastBlock || d.block_coefficient > 1)
      return report("mass_kg",
                    fmt::format("{:.4g}, a block coefficient of {:.3g} for {:.4g} × {:.4g} × {:.4g} m",
                                ship_.mass, d.block_coefficient, d.length, d.beam, d.draught),
                    fmt::format("a block coefficient of {:g} to 1", kLeastBlock));
    if (!clarke_derivatives(d).are_physical())
      report(
          "water.model",
          fmt::format("manoeuvring, whose regression has no meaning for a hull of {:.4g} × {:.4g} × {:.4g} m",
                      d.length, d.beam, d.draught),
          "none, or a hull of ship's proportions");
  }

  void check_steering() {
    if (std::holds_alternative<simulation::NoSteering>(ship_.steering)) return;
    if (!std::holds_alternative<simulation::Engine>(ship_.propulsion))
      return report("steering", "a rudder or thrusters without an engine",
                    "propulsion.engine, or no steering");
    auto* rudder = std::get_if<simulation::RudderSettings>(&ship_.steering);
    if (!rudder) return;
    const auto d = dimensions();
    const double most = kLargestRudder * d.length * d.draught;
    if (rudder->area > 0 && most > 0 && rudder->area > most)
      return report("steering.rudder.area_m2", fmt::format("{:g}", rudder->area),
                    fmt::format("at most a fifth of length times draught, {:.4g} [m²]", most));
    if (rudder->area > 0) return;
    if (ship_.hull.draught <= 0)
      return report("steering.rudder.area_m2", "nothing, and no hull.draught_m", "an area, or a draught");
    rudder->area = kRudderShare * d.length * d.draught;
  }

  void add_mooring(simulation::MooringSettings& mooring) {
    if (std::holds_alternative<simulation::ConstantSpeed>(ship_.propulsion))
      return report("mooring", "a mooring of a ship whose speed is prescribed", "thrust_N or an engine");
    const JsonValue* given = item_.find("mooring");
    if (!given->find("position_m")) mooring.position_in_world = ship_.position_in_world;
    if (!given->find("heading_deg")) mooring.heading = ship_.heading;
    const geometry::Vector off = rotate_back(geometry::Rotation::by(mooring.heading),
                                             ship_.position_in_world - mooring.position_in_world);
    const double load = std::hypot(mooring.surge_stiffness * off.x, mooring.sway_stiffness * off.y);
    if (mooring.break_load > 0 && load > mooring.break_load)
      report("mooring.break_load_N",
             fmt::format("{:g}: the mooring is broken at the start, where it pulls with {:.4g} N",
                         mooring.break_load, load),
             "a greater load, or a ship nearer to mooring.position_m");
  }

  const JsonValue& item_;
  const std::string& path_;
  const double density_;
  const DriveDraft& drive_;
  ShipSpec& ship_;
  ProblemCollector& problems_;
};

}  // namespace

void choose_hull_water(const JsonValue& root, JsonValue& resolved) {
  std::vector<JsonValue>& ships = resolved.find("ships")->items();
  for (std::size_t i = 0; i < ships.size(); ++i) {
    const JsonValue* propulsion = ships[i].find("propulsion");
    JsonValue* water = ships[i].find("water");
    if (!propulsion || !propulsion->find("engine") || !water) continue;
    const JsonValue* given = root.find("ships")->items()[i].find("water");
    if (!given || !given->find("model")) water->find("model")->data = std::string("manoeuvring");
  }
}

void complete_ship(const JsonValue& item, const std::string& path, SceneDraft& draft,
                   ProblemCollector& problems) {
  Completion(item, path, draft, problems).run();
}

void fill_in_masses(const SceneDraft& draft, JsonValue& resolved) {
  std::vector<JsonValue>& ships = resolved.find("ships")->items();
  const auto insert_after = [](JsonValue& ship, std::string_view before, std::string_view key, double value) {
    if (ship.find(key)) return;
    auto& members = ship.members();
    const auto place = std::ranges::find(members, before, &JsonMember::key);
    members.insert(place + 1, {std::string(key), ship.offset, {value, ship.offset}});
  };
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i) {
    const Origin& origin = draft.ship_origins[i];
    if (origin.is_structure) continue;
    const ShipSpec& ship = draft.scene.ships[i];
    insert_after(ships[origin.group], "hull", "mass_kg", ship.mass);
    insert_after(ships[origin.group], "mass_kg", "moment_of_inertia_kg_m2", ship.moment_of_inertia);
  }
}

}  // namespace polynya::io
