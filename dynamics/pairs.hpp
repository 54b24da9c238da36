#pragma once

#include <vector>

#include "dynamics/contact.hpp"
#include "dynamics/pair_grid.hpp"
#include "geometry/boundary.hpp"

namespace polynya::dynamics {

/// Two bodies near enough to meet, with what is known of their distance. a < b.
struct Pair {
  BodyIndex a = 0;
  BodyIndex b = 0;
  /// Until the two have travelled farther than this together, only `edges` (or `circles`) can meet [m].
  double known_until = -1;
  /// Until the two have travelled farther than this together, they cannot touch at all [m].
  double quiet_until = -1;
  std::vector<geometry::NearPair> circles;  ///< contact circles near each other
  std::vector<geometry::NearPair> edges;    ///< the boundary edges behind them
  std::vector<ContactRecord> records;
};

/// How contacts are found.
struct ContactRule {
  double circle_radius = 1.0;      ///< [m]
  bool is_circle_centres = false;  ///< the paper's own normals, instead of those of the boundary
};

/// Finds which bodies overlap. A grid keeps the pairs whose grown boxes meet; each pair keeps the contact
/// circles that are near each other, until the bodies have moved so far that others might be. Both bounds are
/// conservative: what is culled cannot touch, so the contacts are those of a search over everything.
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
  void place(const Bodies& bodies, BodyIndex body);
  void connect(const Bodies& bodies, BodyIndex body);
  void add_pair(BodyIndex a, BodyIndex b);
  void drop_pair(std::uint32_t pair);
  void refresh(const Bodies& bodies, Pair& pair);
  void collect(const Bodies& bodies, Pair& pair, std::vector<Contact>& contacts, double dt);

  ContactRule rule_;
  PairGrid grid_;
  std::vector<Entry> entries_;
  std::vector<Pair> pairs_;  // slots; free ones have a == b
  std::vector<std::uint32_t> free_pairs_;
  std::vector<std::uint32_t> active_;  // pairs in use
  std::vector<std::uint32_t> place_in_active_;
  std::vector<geometry::ContactPatch> patches_;
  geometry::PatchScratch scratch_;
  std::vector<ContactRecord> records_;    // of the pair at hand, being renewed
  std::vector<std::uint32_t> own_pairs_;  // of a body, while some of them are dropped
  std::int64_t unpaired_ = 0;
};

}  // namespace polynya::dynamics
