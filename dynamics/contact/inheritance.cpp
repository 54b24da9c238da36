#include <algorithm>

#include "dynamics/contact/broad_phase.hpp"

namespace polynya::dynamics {

using geometry::Pose;

namespace {

constexpr double kPieceRounding = 1e-6;  ///< pieces' vertices are rounded, by far less than that [m]

/// How far a body that breaks can move without touching the pair's other one, 0 where that is not known [m].
double clearance_of(const Bodies& bodies, const Pair& pair) {
  const Pose pose = centre_a_from_b(bodies, pair.a, pair.b);
  return std::max(0.0, clearance_left(bodies, pair.b, pose, pair.apart) - kPieceRounding);
}

}  // namespace

Inheritance BroadPhase::inheritance_of(const Bodies& bodies, BodyIndex body) const {
  Inheritance inheritance;
  for (const std::uint32_t slot : entries_[body].pairs) {
    const Pair& pair = pairs_[slot];
    const BodyIndex other = pair.a == body ? pair.b : pair.a;
    if (pair.is_outside) inheritance.outside.push_back({other, clearance_of(bodies, pair)});
    const Pose water_from_b = water_from_body(bodies, pair.b);
    for (const PersistentContact& record : pair.records()) {
      if (record.loaded_area == 0) continue;
      inheritance.pressed.push_back(
          {other, transform(water_from_b, record.last_point_in_b), record.reach, record.loaded_area});
    }
  }
  std::sort(inheritance.outside.begin(), inheritance.outside.end(),
            [](const Outside& p, const Outside& q) { return p.other < q.other; });
  return inheritance;
}

void BroadPhase::note_pressed(BodyIndex body) {
  constexpr double kEverywhere = 1e9;  // [m], and [m²] of the overlap that is found there
  PersistentContact record;
  record.reach = kEverywhere;
  record.loaded_area = kEverywhere * kEverywhere;
  record.is_inherited = true;
  for (const std::uint32_t slot : entries_[body].pairs) pairs_[slot].own_parts().records = {record};
}

void BroadPhase::inherit(const Bodies& bodies, BodyIndex piece, const Inheritance& inheritance) {
  for (const std::uint32_t slot : entries_[piece].pairs) {
    Pair& pair = pairs_[slot];
    const BodyIndex other = pair.a == piece ? pair.b : pair.a;
    const auto outside = std::lower_bound(inheritance.outside.begin(), inheritance.outside.end(), other,
                                          [](const Outside& o, BodyIndex body) { return o.other < body; });
    pair.is_outside = outside != inheritance.outside.end() && outside->other == other;
    if (pair.is_outside && outside->clearance > 0)
      pair.apart = {centre_a_from_b(bodies, pair.a, pair.b), outside->clearance};
    for (const PressedOverlap& old : inheritance.pressed) {
      if (old.other != other) continue;
      PersistentContact record;
      record.last_point_in_b = inverse_transform(water_from_body(bodies, pair.b), old.place);
      record.reach = old.reach;
      record.loaded_area = old.loaded_area;
      record.is_inherited = true;
      pair.own_parts().records.push_back(record);
    }
  }
}

}  // namespace polynya::dynamics
