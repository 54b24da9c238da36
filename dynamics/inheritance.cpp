#include <algorithm>

#include "dynamics/broad_phase.hpp"

namespace polynya::dynamics {

using geometry::Pose;

Inheritance BroadPhase::inheritance_of(const Bodies& bodies, BodyIndex body) const {
  Inheritance inheritance;
  for (const std::uint32_t slot : entries_[body].pairs) {
    const Pair& pair = pairs_[slot];
    const BodyIndex other = pair.a == body ? pair.b : pair.a;
    if (pair.is_outside) inheritance.outside.push_back(other);
    const Pose water_from_b = water_from_body(bodies, pair.b);
    for (const PersistentContact& record : pair.records) {
      if (record.loaded_area == 0) continue;
      inheritance.pressed.push_back(
          {other, transform(water_from_b, record.last_point_in_b), record.reach, record.loaded_area});
    }
  }
  std::sort(inheritance.outside.begin(), inheritance.outside.end());
  return inheritance;
}

void BroadPhase::inherit(const Bodies& bodies, BodyIndex piece, const Inheritance& inheritance) {
  const std::vector<BodyIndex>& outside = inheritance.outside;
  for (const std::uint32_t slot : entries_[piece].pairs) {
    Pair& pair = pairs_[slot];
    const BodyIndex other = pair.a == piece ? pair.b : pair.a;
    pair.is_outside = std::binary_search(outside.begin(), outside.end(), other);
    for (const PressedOverlap& old : inheritance.pressed) {
      if (old.other != other) continue;
      PersistentContact record;
      record.last_point_in_b = inverse_transform(water_from_body(bodies, pair.b), old.place);
      record.reach = old.reach;
      record.loaded_area = old.loaded_area;
      record.is_inherited = true;
      pair.records.push_back(record);
    }
  }
}

}  // namespace polynya::dynamics
