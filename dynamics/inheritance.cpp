#include "dynamics/broad_phase.hpp"

namespace polynya::dynamics {

using geometry::Pose;

std::vector<Inheritance> BroadPhase::inheritance_of(const Bodies& bodies, BodyIndex body) const {
  std::vector<Inheritance> inheritance;
  for (const std::uint32_t slot : entries_[body].pairs) {
    const Pair& pair = pairs_[slot];
    const Pose water_from_b = water_from_body(bodies, pair.b);
    for (const PersistentContact& record : pair.records) {
      if (record.loaded_area == 0) continue;
      inheritance.push_back({pair.a == body ? pair.b : pair.a,
                             transform(water_from_b, record.last_point_in_b), record.reach,
                             record.loaded_area});
    }
  }
  return inheritance;
}

void BroadPhase::inherit(const Bodies& bodies, BodyIndex piece, const std::vector<Inheritance>& inheritance) {
  for (const std::uint32_t slot : entries_[piece].pairs) {
    Pair& pair = pairs_[slot];
    for (const Inheritance& old : inheritance) {
      if (old.other != pair.a && old.other != pair.b) continue;
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
