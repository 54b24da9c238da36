#include "simulation/ice/ice_scatter.hpp"

#include <bit>

#include "simulation/field/portable_math.hpp"

namespace polynya::simulation {
namespace {

/// First key of a draw. It keeps the draws for floes and for bending events independent.
enum class Stream : std::uint64_t { kFloe = 1, kBending = 2 };

std::uint64_t key_of(Stream stream) {
  return static_cast<std::uint64_t>(stream);
}
/// Returns the key of a coordinate. Adding 0 gives −0 the same key as 0.
std::uint64_t key_of(double coordinate) {
  return std::bit_cast<std::uint64_t>(coordinate + 0.0);
}

}  // namespace

double drawn_share(std::uint64_t seed, std::initializer_list<std::uint64_t> keys) {
  std::uint64_t mixed = Random(seed).next();
  for (const std::uint64_t key : keys) mixed = Random(mixed ^ key).next();
  return (static_cast<double>(mixed >> 12) + 0.5) * 0x1p-52;
}

double drawn_property(const fracture::ScatterLaw& law, std::uint64_t seed, std::size_t floe, std::size_t property) {
  return fracture::quantile(law, drawn_share(seed, {key_of(Stream::kFloe), floe, property}));
}

double strength_factor(std::uint64_t seed, geometry::Point first_touch_in_body, double spread) {
  const double share =
      drawn_share(seed, {key_of(Stream::kBending), key_of(first_touch_in_body.x), key_of(first_touch_in_body.y)});
  return fracture::quantile({.kind = fracture::ScatterKind::kLogNormal, .mean = 1, .spread = spread}, share);
}

}  // namespace polynya::simulation
