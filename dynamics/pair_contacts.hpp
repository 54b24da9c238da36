#pragma once

#include <vector>

#include "dynamics/contact.hpp"
#include "geometry/contact/boundary.hpp"

namespace polynya::dynamics {

/// What was found at some relative place of two bodies holds while no point of one has moved farther than
/// this in the frame of the other.
struct KnownNear {
  geometry::Pose a_from_b;  ///< where it was found, of b's centre of mass
  double way = -1;          ///< [m]; negative: nothing is known
};

/// Two bodies near enough to meet, with what is known of their distance. a < b.
struct Pair {
  BodyIndex a = 0;
  BodyIndex b = 0;
  bool is_dropped = false;  ///< its slot is free once the list of pairs is tidied
  KnownNear known;          ///< only `edges` (or the circles of `covers`) can meet
  double near_bound = -1;   ///< and surely so until the two have travelled farther than this together [m]
  KnownNear quiet;          ///< they cannot touch at all
  std::vector<geometry::NearPair> covers;  ///< pieces of boundary near each other
  std::vector<geometry::NearPair> edges;   ///< the edges they lie on
  std::vector<PersistentContact> records;
};

/// How contacts are found.
struct ContactRule {
  double circle_radius = 1.0;      ///< [m]
  bool is_circle_centres = false;  ///< the paper's own normals, instead of those of the boundary
  bool is_culling = true;  ///< false: all pairs with one awake are looked at anew in every step (tests)
};

/// Reusable memory of collide_pair.
struct PairScratch {
  std::vector<geometry::ContactManifold> manifolds;
  geometry::ManifoldScratch crossings;
  std::vector<PersistentContact> records;  ///< of the pair at hand, being renewed
  std::int64_t unpaired = 0;               ///< contact stretches whose crossings did not pair up, counted on
};

/// What is left of the way that `known` holds for, b being at `place` in a's frame of the centre of mass [m].
double clearance_left(const Bodies& bodies, BodyIndex b, const geometry::Pose& place, const KnownNear& known);

/// Appends the contacts of a pair and brings their records up to date. Returns how far the two can move from
/// here without touching, negative where they touch [m].
double collide_pair(const Bodies& bodies, Pair& pair, const geometry::Pose& place, const ContactRule& rule,
                    double dt, PairScratch& scratch, std::vector<Contact>& contacts);

/// Of positions and distances, far more than rounding can make of them [m].
inline constexpr double kRounding = 1e-9;

}  // namespace polynya::dynamics
