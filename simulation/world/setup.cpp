#include "simulation/world/setup.hpp"

#include <algorithm>
#include <cmath>

#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/published_forms.hpp"
#include "fracture/characteristic_length.hpp"
#include "fracture/splitting.hpp"

namespace polynya::simulation {
namespace {

std::unique_ptr<const fracture::BendingModel> make_bending_model(const FractureSettings& settings) {
  switch (settings.bending) {
    case BendingModelKind::kNevel:
      return std::make_unique<fracture::NevelModel>();
    case BendingModelKind::kKashtelyan:
      return std::make_unique<fracture::KashtelyanModel>();
    case BendingModelKind::kFsiDatabase:
      return std::make_unique<fracture::FsiDatabaseModel>(settings.radial_cracks);
  }
  return nullptr;  // no other kind
}

/// Of all ices of a scene, the scene's own first. κ l by Eq. (7) of [Sawamura2017].
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
      step(scene.time.step),
      bending(make_bending_model(scene.fracture)),
      current(current_of(scene.water.shear)),
      ice_limits(limits_of(scene)) {
  solver.max_iterations = scene.contact.iterations;
  for (std::size_t hull = 0; hull < hull_count(scene); ++hull) {
    underwater.push_back(underwater_of(hull_of(scene, hull).hull));
    waterlines.push_back(waterline_of(hull_of(scene, hull).hull.waterline));
  }
  for (const Ship& ship : scene.ships) sailing.push_back(sailing_of(ship, scene.water.water.density));
  steps_per_sample = std::max<std::int64_t>(1, std::llround(scene.record.forces_interval / scene.time.step));
  steps_per_frame = std::max<std::int64_t>(1, std::llround(scene.record.frames_interval / scene.time.step));
  const ContactSettings& contact = scene.contact;
  if (contact.law == ContactLaw::kCrush) {
    law = dynamics::CrushLaw{scene.time.step, contact.substeps, contact.is_warm_started};
    solver.tolerance = contact.tolerance;
    levels = scene.time.levels;
    steps_per_rest = std::max<std::int64_t>(1, std::llround(kRestInterval / scene.time.step));
  } else {
    law = dynamics::RestitutionLaw{contact.restitution, scene.time.step};
    separation = {.time = contact.separation_time};  // crushed overlap is gone ice
  }
}

void take_step(Setup& setup, Clock& clock, int ticks, int parts) {
  clock.ticks_in_step = ticks;
  clock.parts = parts;
  clock.step = setup.step = ticks * clock.tick / parts;
  std::visit([&](auto& law) { law.step = setup.step; }, setup.law);
}

void advance(Clock& clock) {
  if (++clock.part < clock.parts) return;
  clock.part = 0;
  clock.steps += clock.ticks_in_step;
}

Underwater underwater_of(const Hull& hull) {
  const geometry::Box box = bounding_box(hull.waterline);
  const double half_beam = 0.5 * (box.high.y - box.low.y);
  const double middle = 0.5 * (box.high.y + box.low.y);
  double widest = box.low.x;  // the foremost place with the full beam
  for (const geometry::Point p : hull.waterline) {
    if (std::abs(p.y - middle) > (1 - 1e-6) * half_beam) widest = std::max(widest, p.x);
  }
  Underwater underwater;
  underwater.form = {.length = box.high.x - box.low.x,
                     .beam = 2 * half_beam,
                     .draught = hull.draught,
                     .stem_angle = hull.stem_angle,
                     .entrance_angle = std::atan2(half_beam, box.high.x - widest)};
  underwater.can_take_ice = hull.draught > 0;
  if (underwater.can_take_ice) underwater.path = dynamics::submersion_path(underwater.form);
  return underwater;
}

dynamics::ShearCurrent current_of(const ShearSettings& shear) {
  return {{std::cos(shear.direction), std::sin(shear.direction)}, shear.rate, shear.origin};
}

}  // namespace polynya::simulation
