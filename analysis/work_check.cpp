#include "analysis/work_check.hpp"

#include <algorithm>

#include "fracture/crushing.hpp"
#include "geometry/exact/measures.hpp"

namespace polynya::analysis {
namespace {

std::int64_t key_of(const simulation::ContactState::Body& body) {
  return body.ship >= 0 ? -1 - std::int64_t{body.ship} : body.floe;
}

}  // namespace

void WorkCheck::compare(double time) {
  double expected_then = 0;
  double work_then = 0;
  auto row = std::ranges::lower_bound(run_.crushed, time, {}, &io::RunCrushed::time);
  for (; row != run_.crushed.end() && row->time == time; ++row) {
    const simulation::CrushedOverlap& overlap = row->overlap;
    const auto [first, second] =
        std::minmax(overlap.on, overlap.by, [](const Body& a, const Body& b) { return key_of(a) < key_of(b); });
    if (second.ship >= 0) continue;  // steel on steel
    const fracture::Ice& of_second = ice_of(second);
    const fracture::Ice ice = first.ship >= 0 ? of_second : fracture::crushed_between(ice_of(first), of_second);
    const double expected = ice.compressive_strength * overlap.volume;
    expected_then += expected;
    work_then += overlap.work;
    const double smaller = std::min(area_of(first), area_of(second));
    if (overlap.volume > kUncrushedShare * smaller * ice.thickness)
      enter({key_of(first), key_of(second)}, {first, second, time, overlap.area, expected, overlap.work});
  }
  if (expected_then <= check_.most_expected) return;
  check_.most_expected = expected_then;
  check_.work_then = work_then;
}

const fracture::Ice& WorkCheck::ice_of(const Body& floe) const {
  return simulation::ice_of(run_.scene.scene, run_.floe(floe.floe)->birth.own_ice);
}

double WorkCheck::area_of(const Body& body) const {
  if (body.ship < 0) return run_.floe(body.floe)->birth.area;
  return geometry::measure({hull_of(run_.scene.scene, static_cast<std::size_t>(body.ship)).hull.waterline, {}}).area;
}

/// Of a pair that differs at several frames, that at which the most is crushed.
void WorkCheck::enter(const Key& pair, const UnpaidOverlap& overlap) {
  compared_.insert(pair);
  check_.paid_pairs = compared_.size();
  if (kMostWorkFactor * overlap.work >= overlap.expected && overlap.work <= kMostWorkFactor * overlap.expected) return;
  const auto [known, is_new] = unpaid_.try_emplace(pair, check_.unpaid.size());
  if (is_new)
    check_.unpaid.push_back(overlap);
  else if (overlap.expected > check_.unpaid[known->second].expected)
    check_.unpaid[known->second] = overlap;
}

}  // namespace polynya::analysis
