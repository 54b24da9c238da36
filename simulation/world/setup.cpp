#include "simulation/world/setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/published_forms.hpp"
#include "fracture/characteristic_length.hpp"
#include "fracture/splitting.hpp"
#include "simulation/world/parts.hpp"

namespace polynya::simulation {
namespace {

/// Makes the bending model that the scene chooses. Only the database uses the scene's choice of radial cracks.
std::unique_ptr<const fracture::BendingModel> make_bending_model(const FractureSettings& settings) {
  switch (settings.bending) {
    case BendingModelKind::kNevel:
      return std::make_unique<fracture::NevelModel>();
    case BendingModelKind::kKashtelyan:
      return std::make_unique<fracture::KashtelyanModel>();
    case BendingModelKind::kFsiDatabase:
      return std::make_unique<fracture::FsiDatabaseModel>(settings.radial_cracks);
  }
  return nullptr;  // unreachable: all kinds are handled above
}

/// Returns the limits of all kinds of ice of a scene (IceLimits): first of Scene::ice, then of each Scene::own_ice. κ
/// l, the √area below which a floe neither bends nor splits, follows from Eq. (7) of [Sawamura2017]. The least
/// splitting force is that of a crack as long and as wide as the ice is thick: the force grows with the size of the
/// crack, so a smaller force splits no floe, and no crack is searched for it, which saves time. The last member tells
/// whether slender floes below κ l may break across as beams. If κ l exceeds the characteristic length, such floes are
/// only pushed.
std::vector<IceLimits> limits_of(const Scene& scene) {
  const auto limits = [&](const fracture::Ice& ice) -> IceLimits {
    const double breakable = scene.fracture.breakable_size_factor *
                             fracture::breakable_length(ice, scene.water.water, scene.fracture.characteristic_length);
    return {breakable, fracture::lefm_splitting_force(ice, ice.thickness, ice.thickness),
            breakable <= fracture::characteristic_length(ice, scene.water.water)};
  };
  std::vector<IceLimits> all{limits(scene.ice)};
  for (const fracture::Ice& ice : scene.own_ice) all.push_back(limits(ice));
  return all;
}

}  // namespace

Setup::Setup(Scene scene_of_run, Shortcuts shortcuts_of_run)
    : scene(std::move(scene_of_run)),
      shortcuts(shortcuts_of_run),
      bending(make_bending_model(scene.fracture)),
      current(current_of(scene.water.shear)),
      ice_limits(limits_of(scene)) {
  solver.max_iterations = scene.contact.iterations;
  for (std::size_t hull = 0; hull < hull_count(scene); ++hull) {
    underwater.push_back(underwater_of(hull_of(scene, hull).hull));
    waterlines.push_back(waterline_of(hull_of(scene, hull).hull.waterline));
  }
  for (const Ship& ship : scene.ships) sailing.push_back(sailing_of(ship, scene.water.water.density));
  const ContactSettings& contact = scene.contact;
  // The law of crushing sets two members of ContactRule: presses_prescribed, by which a hull presses ice even if the
  // motions of both are prescribed, and is_depth_bounded, which determines the depth of an overlap. It also takes the
  // solver tolerance of the scene; the law of impulses keeps that of SolverSettings. Only with this law a hull carries
  // the water pressure that is missing on a turning cusp until water has flowed onto the cusp, if the scene asks for
  // that.
  const bool crushes = contact.law == ContactLaw::kCrush;
  contact_rule = {contact.circle_radius, contact.normal == ContactNormal::kCircleCentres, shortcuts.culls, crushes,
                  crushes};
  longest_step_by_walls = simulation::longest_step_by_walls(scene);
  if (crushes) {
    solver.tolerance = contact.tolerance;
    has_flooding_decks = scene.fracture.floods_decks && scene.fracture.cusp_fate == CuspFate::kUnderHull;
  }
}

// Walls without a line load press nothing and do not limit the step.
double longest_step_by_walls(const Scene& scene) {
  double longest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : scene.walls)
    if (const auto& p = wall.pressure; p && p->line_load > 0)
      longest = std::min({longest, kStepUnderPressure, p->closing_speed * p->mass_per_length / p->line_load});
  return longest;
}

// A steady drift is computed as a product, a changing one (tide, rows of a table) as an integral over time.
geometry::Vector drift_at(const Setup& setup, double time) {
  const WaterSettings& water = setup.scene.water;
  return water.is_steady() ? time * water.drift_at(0) : water.drift_path(time);
}

Underwater underwater_of(const Hull& hull) {
  const geometry::Box box = bounding_box(hull.waterline);
  const double half_beam = 0.5 * (box.high.y - box.low.y);
  const double middle = 0.5 * (box.high.y + box.low.y);
  // x of the foremost vertex at which the hull has its full beam, from which the bow narrows to the stem. The tolerance
  // 1e-6 only absorbs rounding of the coordinates; with a larger one, the bow would be taken too short and too blunt.
  double widest = box.low.x;
  for (const geometry::Point p : hull.waterline) {
    if (std::abs(p.y - middle) > (1 - 1e-6) * half_beam) widest = std::max(widest, p.x);
  }
  Underwater underwater;
  underwater.form = {.length = box.high.x - box.low.x,
                     .beam = 2 * half_beam,
                     .draught = hull.draught,
                     .stem_angle = hull.stem_angle,
                     .entrance_angle = elementary::atan2(half_beam, box.high.x - widest)};
  underwater.can_take_ice = hull.draught > 0;  // without a draught there is no way under the hull, and no path
  if (underwater.can_take_ice) underwater.path = dynamics::submersion_path(underwater.form);
  return underwater;
}

dynamics::ShearCurrent current_of(const ShearSettings& shear) {
  return {{elementary::cos(shear.direction), elementary::sin(shear.direction)}, shear.rate, shear.origin};
}

}  // namespace polynya::simulation
