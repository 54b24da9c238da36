#include "simulation/setup.hpp"

#include <algorithm>
#include <cmath>

#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/bending/kashtelyan.hpp"
#include "fracture/bending/nevel.hpp"

namespace polynya::simulation {
namespace {

std::unique_ptr<const fracture::BendingModel> make_bending_model(BendingModelKind kind) {
  switch (kind) {
    case BendingModelKind::kNevel:
      return std::make_unique<fracture::NevelModel>();
    case BendingModelKind::kKashtelyan:
      return std::make_unique<fracture::KashtelyanModel>();
    case BendingModelKind::kFsiDatabase:
      return std::make_unique<fracture::FsiDatabaseModel>();
  }
  return nullptr;  // no other kind
}

}  // namespace

Setup::Setup(Scene scene_of_run, Shortcuts shortcuts_of_run)
    : scene(std::move(scene_of_run)),
      shortcuts(shortcuts_of_run),
      bending(make_bending_model(scene.fracture.bending)),
      current(current_of(scene.water.shear)) {
  solver.restitution = scene.contact.restitution;
  solver.max_iterations = scene.contact.iterations;
  separation.time = scene.contact.separation_time;
  steps_per_sample = std::max<std::int64_t>(1, std::llround(scene.record.forces_interval / scene.time.step));
}

dynamics::ShearCurrent current_of(const ShearSettings& shear) {
  return {{std::cos(shear.direction), std::sin(shear.direction)}, shear.rate, shear.origin};
}

}  // namespace polynya::simulation
