#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry::trials {

/// Decisions drawn from bytes, zero once the bytes run out. The same bytes lead to the same decisions in RapidCheck and
/// in the fuzzer.
class Dice {
 public:
  explicit Dice(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  int below(int count);
  double between(double low, double high);
  bool is_empty() const { return next_ >= bytes_.size(); }

 private:
  std::uint8_t byte() { return next_ < bytes_.size() ? bytes_[next_++] : std::uint8_t{0}; }
  std::vector<std::uint8_t> bytes_;
  std::size_t next_ = 0;
};

/// A tool for cutting: a ring or a polyline.
struct Knife {
  bool is_ring = true;
  Ring points;
};

/// Returns a floe of a difficult kind: needle, comb, spiral, star, holes touching the boundary, tiny or far away. It
/// may be invalid.
Polygon roll_floe(Dice& dice);

/// Returns a knife aimed at the weak places of the floe: through vertices, tangent to edges, centred on vertices, along
/// edges, or one ulp beside them. It may be invalid.
Knife roll_knife(Dice& dice, const Polygon& floe);

/// A tool that the general path cuts with: several polygons, which may overlap, touch and have holes, or a
/// crack that may cross itself.
struct ManyKnives {
  bool is_crack = false;
  std::vector<Polygon> polygons;  ///< valid ones
  Ring crack;
};
ManyKnives roll_knives(Dice& dice, const Polygon& floe);

}  // namespace polynya::geometry::trials
