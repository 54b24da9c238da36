#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "geometry/contact/manifolds.hpp"

namespace polynya::dynamics {

/// Distance by which two bodies can move from a relative pose before a statement about them may fail. The statement
/// holds while no point of one body has moved farther than `distance` in the frame of the other.
struct Clearance {
  geometry::Pose a_from_b;  ///< b's centre of mass and axes in a's, when the statement was made
  double distance = -1;     ///< [m]; negative: the statement does not hold
};

/// The parts of two bodies that are near each other, and the records of their contacts.
struct NearParts {
  geometry::NearEdges edges;  ///< edges of the two boundaries that are near each other
  std::vector<PersistentContact> records;
  std::vector<geometry::NearPair> circles;  ///< circles that are near each other; with ContactRule::is_circle_centres
};

/// Two bodies whose grown boxes overlap, with the known bounds of their distance. a < b. The first cache line contains
/// the data that most steps need of a pair that does not touch.
struct alignas(64) Pair {
  BodyIndex a = 0;
  BodyIndex b = 0;
  std::unique_ptr<NearParts> parts;  ///< null: no parts are near, and there is no record
  Clearance apart;                   ///< statement: the bodies do not touch
  bool is_dropped = false;           ///< its slot is freed when the lists of pairs are cleaned up
  bool is_outside = false;           ///< neither is inside the other; this stays so until they touch
  // The first cache line ends here.
  /// Value of travel[a] + travel[b] up to which the statement `near` is known to hold, without further computation [m].
  double near_bound = -1;
  Clearance near;  ///< statement: only the near edges (or circles) in `parts` can touch

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

/// Covers with more pieces than this are always kept, because making them takes long. Larger: hulls and plates are
/// covered again in every step when there are many covers. Smaller: more memory is used.
inline constexpr double kManyPieces = 512;

/// Settings for finding contacts.
struct ContactRule {
  /// Radius of the contact circles, and largest length of the pieces of boundary in a cover [m]. Smaller values take
  /// more memory; a contact may also move less in a step and still be the same one (ContactTracker).
  double circle_radius = 1.0;
  bool is_circle_centres = false;   ///< the paper's normals instead of the boundary's
  bool is_culling = true;           ///< false: every step collides all pairs with one awake body (for tests)
  bool presses_prescribed = false;  ///< a hull presses ice even if both motions are prescribed
  /// With the law of crushing ice: the depth of a crescent is its mean thickness unless both motions are prescribed,
  /// overlaps of less than 1 µm depth count as rectangles, and Contact::width_ahead is found.
  bool is_depth_bounded = false;
  /// Number of cover pieces up to which covers are kept, at 64 bytes each; enough for about 50 000 floes of 20 m.
  /// Covers of further bodies are made again when they are needed, with the same contacts.
  double most_kept_pieces = 4'194'304;
  /// Number of pairs up to which all near edges (about half a kilobyte per pair) are kept. With more pairs they are
  /// kept only if the bodies are within `kept_gap`, and found again otherwise, with the same contacts.
  double most_pairs_with_edges = 1'048'576;
  double kept_gap = 0.1;  ///< distance of two bodies [m]
};

/// Returns true if the near parts of two bodies are found by their covers. If there are few edges, they are compared
/// without covers.
inline bool need_covers(const Bodies& bodies, BodyIndex a, BodyIndex b, const ContactRule& rule) {
  return rule.is_circle_centres || !have_few_edges(bodies.boundary[a]->edges, bodies.boundary[b]->edges);
}

/// Covers (geometry::Cover) of boundaries that do not keep their own, made as they are needed. The last few are kept.
class CoverCache {
 public:
  /// Returns the boundaries of two bodies with their covers, valid until the next call.
  std::pair<geometry::Covered, geometry::Covered> of(const Bodies& bodies, BodyIndex a, BodyIndex b,
                                                     const geometry::CircleRule& rule);
  /// Frees all covers.
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

/// Memory that collide_pair reuses.
struct PairScratch {
  /// False if there are so many pairs that near edges of distant bodies are not kept
  /// (ContactRule::most_pairs_with_edges).
  bool keeps_distant_edges = true;
  CoverCache covers;
  std::vector<geometry::NearPair> near_circles;
  geometry::NearEdges near_edges;
  std::vector<geometry::ContactManifold> manifolds;
  std::vector<geometry::ContactManifold> manifolds_ahead;  ///< where the bodies would be at the end of a step
  geometry::ManifoldScratch crossings;
  std::vector<PersistentContact> records;       ///< records of the present pair, while they are updated
  std::vector<InseparableOverlap> inseparable;  ///< inseparable overlaps found so far
  std::vector<PartedContact> parted;            ///< contacts that ended, found so far
  std::int64_t unpaired = 0;                    ///< number of contact stretches so far whose crossings did not pair up
};

/// Returns how far the two bodies can still move within a clearance [m]; `pose` is b's centre of mass in a's frame.
double clearance_left(const Bodies& bodies, BodyIndex b, const geometry::Pose& pose, const Clearance& clearance);

/// Appends the contacts of a pair and updates their records. Returns how far the two bodies can move from here without
/// touching; negative if they touch [m].
double collide_pair(const Bodies& bodies, Pair& pair, const geometry::Pose& pose, const ContactRule& rule, double dt,
                    PairScratch& scratch, std::vector<Contact>& contacts);

/// Distance that is far larger than the rounding errors of positions and distances [m]; lower bounds of distances are
/// reduced by it. Smaller: bodies that touch may be taken as apart. Larger: pairs that are close are tested in vain.
inline constexpr double kRounding = 1e-9;

}  // namespace polynya::dynamics
