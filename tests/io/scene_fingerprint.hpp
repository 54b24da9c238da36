#pragma once

#include <string>

#include <fmt/format.h>

#include "simulation/scene.hpp"

namespace polynya::tests {

inline std::string text_of(const geometry::Ring& ring) {
  std::string text;
  for (const geometry::Point p : ring) text += fmt::format("({},{})", p.x, p.y);
  return text;
}

/// A pilot's settings, one by one.
struct PilotText {
  std::string operator()(const simulation::ConstantPilot& p) const {
    return fmt::format(" constant {} {}", p.lever, p.steering_angle);
  }
  std::string operator()(const simulation::SpeedPilot& p) const {
    return fmt::format(" speed {} {}", p.speed, p.heading);
  }
  std::string operator()(const simulation::HeadingPilot& p) const {
    return fmt::format(" heading {} {}", p.heading, p.lever);
  }
  std::string operator()(const simulation::RoutePilot& p) const {
    std::string text = fmt::format(" route {} {}", p.look_ahead, p.arrival);
    for (const auto& w : p.waypoints)
      text += fmt::format(" {} {} {}", w.position_in_world.x, w.position_in_world.y, w.speed);
    return text;
  }
  std::string operator()(const simulation::TablePilot& p) const {
    std::string text = " table";
    for (const auto& r : p.rows) text += fmt::format(" {} {} {}", r.time, r.lever, r.steering_angle);
    return text;
  }
  std::string operator()(const simulation::RammingPilot& p) const {
    return fmt::format(" ram {} {} {} {} {} {}", p.heading, p.lever_ahead, p.lever_astern, p.stuck_speed,
                       p.stuck_time, p.back_distance);
  }
  std::string operator()(const simulation::FollowingPilot& p) const {
    return fmt::format(" follow {} {}", p.ship, p.distance);
  }
};

inline std::string sailing_fingerprint(const simulation::ShipSpec& ship) {
  const auto& w = ship.water;
  std::string text = fmt::format(" water {} {} {} {} {}", w.acts, w.block_coefficient, w.cross_flow_drag,
                                 w.surge_added_mass, w.resistance_coefficient);
  if (const auto* e = std::get_if<simulation::Engine>(&ship.propulsion))
    text += fmt::format(" engine {} {} {} {} {} {}", e->bollard_pull, e->open_water_speed, e->astern_share,
                        e->lever_rate, e->power, e->propeller_area);
  if (const auto* r = std::get_if<simulation::RudderSettings>(&ship.steering))
    text += fmt::format(" rudder {} {} {} {}", r->area, r->aspect_ratio, r->rate, r->most);
  if (const auto* a = std::get_if<simulation::AzimuthSettings>(&ship.steering))
    text += fmt::format(" azimuth {} {}", a->rate, a->most);
  text += std::visit(PilotText{}, ship.pilot);
  if (const auto& m = ship.mooring)
    text += fmt::format(" mooring {} {} {} {} {} {} {} {} {} {}", m->position_in_world.x,
                        m->position_in_world.y, m->heading, m->surge_stiffness, m->sway_stiffness,
                        m->yaw_stiffness, m->surge_damping, m->sway_damping, m->yaw_damping, m->break_load);
  return text;
}

/// Everything a scene holds, as text: two scenes are the same where their fingerprints are.
inline std::string fingerprint(const simulation::Scene& s) {
  std::string text = fmt::format("{} {} {} {}\n", s.name, s.seed, s.time.step, s.time.until);
  if (s.origin)
    text += fmt::format("origin {} {} {}\n", s.origin->latitude, s.origin->longitude, s.origin->heading);
  text +=
      fmt::format("water {} {} {} {} {} {} {} {} {}\n", s.water.water.density, s.water.drag_coefficient,
                  static_cast<int>(s.water.drag_area), s.water.drift.x, s.water.drift.y, s.water.shear.rate,
                  s.water.shear.direction, s.water.shear.origin.x, s.water.shear.origin.y);
  text += fmt::format("skin {} wind {} {} {} {}\n", s.water.skin_drag_coefficient, s.wind.velocity.x,
                      s.wind.velocity.y, s.wind.drag_coefficient, s.wind.density);
  text +=
      fmt::format("ice {} {} {} {} {} {} {} {} {}\n", s.ice.thickness, s.ice.density, s.ice.youngs_modulus,
                  s.ice.poisson_ratio, s.ice.flexural_strength, s.ice.compressive_strength,
                  s.ice.tensile_strength, s.ice.fracture_toughness, s.ice.friction);
  text += fmt::format("contact {} {} {} {} {} {} {} {} {} {}\n", static_cast<int>(s.contact.law),
                      s.contact.substeps, s.contact.is_warm_started, s.contact.tolerance,
                      s.contact.circle_radius, static_cast<int>(s.contact.normal), s.contact.restitution,
                      s.contact.contact_time, s.contact.separation_time, s.contact.iterations);
  text += fmt::format("fracture {} {} {} {} {} {} {} {} {} {} {} {} {}\n", s.fracture.bending_scatter,
                      static_cast<int>(s.fracture.characteristic_length), s.fracture.breakable_size_factor,
                      static_cast<int>(s.fracture.bending), static_cast<int>(s.fracture.radial_cracks),
                      s.fracture.follows_deflection, static_cast<int>(s.fracture.splitting),
                      s.fracture.splitting_shape_factor, s.fracture.least_piece.width_over_l,
                      s.fracture.least_piece.area_over_l2, static_cast<int>(s.fracture.cusp_fate),
                      s.fracture.cusp_sagitta, s.fracture.smallest_floe_area);
  const auto& under = s.fracture.going_under;
  const auto& up = s.fracture.resurface;
  text += fmt::format("under {} {} {} {} up {} {} {} {} {}\n", under.is_enabled,
                      under.tilting.added_mass_factor, under.tilting.damping, under.tilting.edge_deflection,
                      up.is_enabled, up.retry, up.give_up, up.rim_loss, up.scatter);
  text += fmt::format("record {} {} {}\n", s.record.forces_interval, s.record.frames_interval,
                      static_cast<int>(s.record.contacts));
  for (const auto& ship : s.ships) {
    text += fmt::format("hull {} {} ", ship.hull.draught, ship.hull.has_speed_factor);
    text += fmt::format("ship {} {} {} {} {} {} {} {} ", ship.name, ship.mass, ship.moment_of_inertia,
                        ship.position_in_world.x, ship.position_in_world.y, ship.heading, ship.speed,
                        ship.hull.stem_angle);
    text += fmt::format("{} {} ", ship.sway_speed, ship.yaw_rate);
    text += text_of(ship.hull.waterline);
    for (const double angle : ship.hull.angles_from_vertical) text += fmt::format(" {}", angle);
    text += sailing_fingerprint(ship);
    if (const auto* thrust = std::get_if<simulation::ConstantThrust>(&ship.propulsion))
      text += fmt::format(" thrust {}\n", thrust->thrust);
    else if (const auto* held = std::get_if<simulation::ConstantSpeed>(&ship.propulsion))
      text += fmt::format(" speed {}\n", held->speed);
    else if (const auto* wall = std::get_if<simulation::Wall>(&ship.propulsion))
      text += fmt::format(" wall {} {} {} {} {} {}\n", wall->velocity.x, wall->velocity.y, wall->length,
                          wall->line_load, wall->closing_speed, wall->mass_per_length);
    else
      text += " fixed\n";
  }
  for (const auto& floe : s.floes) {
    text += fmt::format("floe {} {} {} {} {}", text_of(floe.polygon_in_world.outer), floe.velocity.x,
                        floe.velocity.y, floe.angular_velocity, floe.is_fast);
    text += fmt::format(" {} {}", floe.has_crushed_overlaps, floe.source_floe);
    const fracture::Ice& ice = ice_of(s, floe.own_ice);
    text += fmt::format(" {} {} {} {} {} {}", ice.thickness, ice.density, ice.flexural_strength,
                        ice.compressive_strength, ice.tensile_strength, ice.fracture_toughness);
    for (const auto& hole : floe.polygon_in_world.holes) text += " hole " + text_of(hole);
    text += '\n';
  }
  return text;
}

}  // namespace polynya::tests
