#pragma once

#include <utility>
#include <vector>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// Covers of boundaries that keep none, made as they are needed: the last few of them.
class CoverCache {
 public:
  /// Two bodies' boundaries with their covers, valid until the next call.
  std::pair<geometry::Covered, geometry::Covered> of(const Bodies& bodies, BodyIndex a, BodyIndex b,
                                                     const geometry::CircleRule& rule);
  /// Frees them all.
  void clear();

 private:
  struct Entry {
    BodyIndex body = -1;
    geometry::Cover cover;
  };
  const geometry::Cover& first(const geometry::Boundary& boundary, BodyIndex body,
                               const geometry::CircleRule& rule);
  const geometry::Cover& second(const geometry::Boundary& boundary, BodyIndex body,
                                const geometry::CircleRule& rule);

  Entry first_;                ///< the first body of the last pair
  std::vector<Entry> second_;  ///< by body; empty until one is needed
};

}  // namespace polynya::dynamics
