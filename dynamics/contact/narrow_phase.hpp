#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "geometry/contact/manifolds.hpp"

namespace polynya::dynamics {

/// How far two bodies can move from a relative pose before a statement about them may fail: it holds while no
/// point of one has moved farther than `distance` in the frame of the other.
struct Clearance {
  geometry::Pose a_from_b;  ///< of b's centre of mass and axes in a's, where the statement was found
  double distance = -1;     ///< [m]; negative: the statement does not hold
};

/// What is near each other of two bodies, and of their contacts.
struct NearParts {
  geometry::NearEdges edges;  ///< of the near circles
  std::vector<PersistentContact> records;
  std::vector<geometry::NearPair> circles;  ///< that are near each other; of ContactRule::is_circle_centres
};

/// Two bodies whose grown boxes meet, with what is known of their distance. a < b. What most steps need of a
/// pair that does not touch is in its first cache line.
struct alignas(64) Pair {
  BodyIndex a = 0;
  BodyIndex b = 0;
  std::unique_ptr<NearParts> parts;  ///< null: none is near, and there is no record
  Clearance apart;                   ///< statement: they do not touch
  bool is_dropped = false;           ///< its slot is freed when the lists of pairs are cleaned up
  bool is_outside = false;           ///< neither is inside the other: so it stays until they touch
  // The first line ends here.
  double near_bound = -1;  ///< `near` holds at least until the two have travelled this far together [m]
  Clearance near;          ///< statement: only the near circles and edges can meet

  bool has_near_edges() const { return parts != nullptr && !parts->edges.pairs.empty(); }
  std::span<const PersistentContact> records() const {
    return parts != nullptr ? std::span<const PersistentContact>(parts->records) : std::span<const PersistentContact>();
  }
  NearParts& own_parts() {
    if (parts == nullptr) parts = std::make_unique<NearParts>();
    return *parts;
  }
};
static_assert(sizeof(Pair) == 128, "of a million floes there are some millions");

/// A cover of more pieces is always kept: to make it again would take long. Greater, hulls and plates are
/// covered again in every step where covers are many; smaller, memory grows.
inline constexpr double kManyPieces = 512;

/// How contacts are found.
struct ContactRule {
  double circle_radius = 1.0;       ///< [m]
  bool is_circle_centres = false;   ///< the paper's own normals, instead of those of the boundary
  bool is_culling = true;           ///< false: every step collides all pairs with one awake (tests)
  bool presses_prescribed = false;  ///< a hull presses ice though both motions are prescribed
  bool is_depth_bounded = false;    ///< along a notch the depth is no more than its area and width allow
  /// Covers are kept until they have this many pieces in all, of 64 bytes each: those of some 50 000 floes of
  /// 20 m. Of more bodies they are made again where they are needed, for the same contacts.
  double most_kept_pieces = 4'194'304;
  /// Of more pairs, near edges (about half a kilobyte a pair) are kept where bodies are within `kept_gap`; of
  /// others they are found again, for the same contacts.
  double most_pairs_with_edges = 1'048'576;
  double kept_gap = 0.1;  ///< [m]
};

/// Whether what is near of two bodies is found by their covers: few edges are compared without.
inline bool need_covers(const Bodies& bodies, BodyIndex a, BodyIndex b, const ContactRule& rule) {
  return rule.is_circle_centres || !have_few_edges(bodies.boundary[a]->edges, bodies.boundary[b]->edges);
}

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
  const geometry::Cover& first(const geometry::Boundary& boundary, BodyIndex body, const geometry::CircleRule& rule);
  const geometry::Cover& second(const geometry::Boundary& boundary, BodyIndex body, const geometry::CircleRule& rule);

  Entry first_;                ///< the first body of the last pair
  std::vector<Entry> second_;  ///< by body; empty until one is needed
};

/// Reusable memory of collide_pair.
struct PairScratch {
  bool keeps_distant_edges = true;
  CoverCache covers;
  std::vector<geometry::NearPair> near_circles;
  geometry::NearEdges near_edges;
  std::vector<geometry::ContactManifold> manifolds;
  std::vector<geometry::ContactManifold> manifolds_ahead;  ///< where the bodies would be at the end of a step
  geometry::ManifoldScratch crossings;
  std::vector<PersistentContact> records;  ///< of the pair at hand, being updated
  std::vector<BlindOverlap> blind;         ///< found so far
  std::vector<PartedContact> parted;       ///< found so far
  std::int64_t unpaired = 0;               ///< contact stretches whose crossings did not pair up, counted on
};

/// How far the two can still move within a clearance [m]; `pose` is that of b's centre of mass in a's frame.
double clearance_left(const Bodies& bodies, BodyIndex b, const geometry::Pose& pose, const Clearance& clearance);

/// Appends the contacts of a pair and updates their records. Returns how far the two can move from here
/// without touching, negative where they touch [m].
double collide_pair(const Bodies& bodies, Pair& pair, const geometry::Pose& pose, const ContactRule& rule, double dt,
                    PairScratch& scratch, std::vector<Contact>& contacts);

/// Far more than the rounding errors of positions and distances. Smaller, bodies that touch may be
/// taken for apart [m].
inline constexpr double kRounding = 1e-9;

}  // namespace polynya::dynamics
