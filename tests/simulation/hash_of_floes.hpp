#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

/// FNV-1a of all coordinates' bytes, of the outer rings.
inline std::uint64_t hash_of(const std::vector<geometry::Polygon>& floes) {
  std::uint64_t hash = 14695981039346656037U;
  for (const geometry::Polygon& floe : floes) {
    for (const geometry::Point p : floe.outer) {
      unsigned char bytes[sizeof p];
      std::memcpy(bytes, &p, sizeof p);
      for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211U;
    }
  }
  return hash;
}

}  // namespace polynya::simulation
