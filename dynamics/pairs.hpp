#pragma once

#include <vector>

#include "dynamics/contact.hpp"
#include "dynamics/pair_grid.hpp"
#include "geometry/boundary.hpp"

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
  double known_until = -1;  ///< and surely so until the two have travelled farther than this together [m]
  KnownNear quiet;          ///< they cannot touch at all
  std::vector<geometry::NearPair> covers;  ///< pieces of boundary near each other
  std::vector<geometry::NearPair> edges;   ///< the edges they lie on
  std::vector<ContactRecord> records;
};

/// How contacts are found.
struct ContactRule {
  double circle_radius = 1.0;      ///< [m]
  bool is_circle_centres = false;  ///< the paper's own normals, instead of those of the boundary
  bool is_culling = true;  ///< false: all pairs with one awake are looked at anew in every step (tests)
};

/// Finds which bodies overlap. A grid keeps the pairs whose grown boxes meet; each pair keeps the pieces of
/// boundary that are near each other, one contact circle each, until the bodies have moved so far relative to
/// each other that others might be. All bounds are conservative: what is culled cannot touch, so the contacts
/// are those of a search over everything.
class PairFinder {
 public:
  PairFinder(const ContactRule& rule, double grid_cell);

  /// Takes a new body in. Asleep; see wake.
  void add(const Bodies& bodies, BodyIndex body);
  /// Forgets a body and its pairs.
  void remove(BodyIndex body);
  /// Pairs are kept only where one of the two is awake.
  void wake(const Bodies& bodies, BodyIndex body);
  void sleep(const Bodies& bodies, BodyIndex body);

  /// Renews boxes and pairs of the awake bodies that have travelled out of their grown boxes.
  void update(const Bodies& bodies, const std::vector<BodyIndex>& awake);

  /// All contacts of the present positions, ordered by (a, b, place). Contact records are kept over the
  /// steps.
  void find_contacts(Bodies& bodies, double dt, std::vector<Contact>& contacts);

  /// Contact stretches whose crossings did not pair up (see geometry::find_patches), over all steps.
  std::int64_t unpaired_stretches() const { return unpaired_; }

 private:
  struct Entry {              // one body's place in the grid
    geometry::Box box;        // grown
    double travel_limit = 0;  // the box holds until the body has travelled this far
    std::vector<std::uint32_t> pairs;
    bool is_in = false;
  };
  struct ActivePair {
    BodyIndex a, b;
    double quiet_until;  // the two cannot touch until they have travelled farther than this together [m]
    std::uint32_t slot;
    friend bool operator<(const ActivePair& p, const ActivePair& q) {
      return p.a != q.a ? p.a < q.a : p.b < q.b;
    }
  };
  void place(const Bodies& bodies, BodyIndex body);
  void connect(const Bodies& bodies, BodyIndex body);
  void add_pair(const Bodies& bodies, BodyIndex a, BodyIndex b);
  void drop_pair(std::uint32_t pair);
  void tidy();
  void refresh(const Bodies& bodies, Pair& pair, const geometry::Pose& place);
  double examine(const Bodies& bodies, Pair& pair, const geometry::Pose& place,
                 std::vector<Contact>& contacts, double dt);
  bool collect(const Bodies& bodies, const Pair& pair, const geometry::Pose& place,
               std::vector<Contact>& contacts);

  ContactRule rule_;
  PairGrid grid_;
  std::vector<Entry> entries_;
  std::vector<Pair> pairs_;  // slots
  std::vector<std::uint32_t> free_pairs_;
  std::vector<ActivePair> active_;     // pairs in use, by (a, b), and dropped ones until tidied
  std::vector<ActivePair> new_pairs_;  // not yet in active_
  bool has_dropped_ = false;
  std::vector<geometry::ContactPatch> patches_;
  geometry::PatchScratch scratch_;
  std::vector<ContactRecord> records_;    // of the pair at hand, being renewed
  std::vector<std::uint32_t> own_pairs_;  // of a body, while some of them are dropped
  std::int64_t unpaired_ = 0;
};

}  // namespace polynya::dynamics
