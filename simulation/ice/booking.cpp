#include <algorithm>
#include <cmath>

#include "fracture/crushing.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Contact;

/// Books what an overlap has grown in the step: crushed as far as the ice edge stood still, else tilted. The work
/// of the normal force alone: friction along an inclined hull has the share μ tan θ_s of it.
void book(double thickness, double friction, const HullSlope& hull, const Contact& c) {
  dynamics::Booked& booked = c.record->booked;
  const double loaded = c.record->loaded_area;
  if (loaded < booked.loaded) booked = loaded / booked.loaded * booked;
  const double grown = loaded - booked.loaded;
  const double crushed = hull.crushed_share * grown;
  const fracture::Overlap overlap{c.width, c.depth, c.area};
  const double angle = hull.tangent == 0 ? 0 : std::atan(hull.tangent);
  const auto volume_of = [&](double area) { return fracture::crushed_volume(overlap, area, thickness, angle); };
  if (crushed > 0) booked.volume += volume_of(booked.crushed + crushed) - volume_of(booked.crushed);
  booked.crushed += crushed;
  booked.tilted += grown - crushed;
  booked.work -= hull.crushed_share * c.normal_work / (1 + friction * hull.tangent);
  booked.loaded = loaded;
}

}  // namespace

void book_overlaps(const Setup& setup, const Population& population, const StepData& step) {
  if (!is_crush_law(setup)) return;
  const std::vector<double>& thickness = population.bodies.thickness;
  const double friction = setup.scene.ice.friction;
  for (std::size_t i = 0; i < step.contacts.size(); ++i) {
    const Contact& c = step.contacts[i];
    if (c.total_normal_impulse() == 0 || c.is_rigid()) continue;
    const bool is_at_hull = i < step.slopes.size();
    book(is_at_hull ? thickness[c.b] : std::min(thickness[c.a], thickness[c.b]), friction,
         is_at_hull ? step.slopes[i] : HullSlope{}, c);
  }
}

}  // namespace polynya::simulation
