#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamics/contact/hash_grid.hpp"
#include "dynamics/contact/narrow_phase.hpp"

namespace polynya::dynamics {

/// The data about a pair of bodies in a saved run. a < b.
struct PairState {
  BodyIndex a = 0;
  BodyIndex b = 0;
  /// Sum of Bodies::travel of a and b up to which the two are known not to touch; −1: not known [m].
  double separation_bound = -1;
  std::vector<PersistentContact> records;
};

/// The sum of the overlaps of a body that breaks with another body.
struct OverlapMemory {
  BodyIndex other = 0;
  double paid_area = 0;  ///< sum of the paid areas [m²]
  double area = 0;       ///< sum of the areas [m²]
  CrushedIce crushed{};  ///< largest one; its pose is the other body's frame in the frame of the broken body
  Booked booked{};
};

/// A body that a breaking body does not touch; neither is inside the other.
struct Outside {
  BodyIndex other = 0;
  double clearance = 0;  ///< how far the two can move without touching [m]
};

/// The data about contacts that a breaking floe passes on to its fragments.
struct ContactMemory {
  std::vector<OverlapMemory> overlaps;
  std::vector<Outside> outside;  ///< ordered by the other body
};

/// Returns a box around a body at its present place: the tightest one for bodies with up to 64 edges, otherwise the box
/// of its bounding circle, which takes no time for each vertex.
geometry::Box box_in_water(const Bodies& bodies, BodyIndex i);

/// Finds which bodies overlap. A grid finds the pairs whose grown boxes overlap. Each pair keeps the edges that are
/// near each other, until the bodies have moved so far relative to each other that other edges might be near. All
/// bounds are conservative: culled pairs cannot touch, so the contacts are the same as in a search over everything.
class BroadPhase {
 public:
  /// `grid_cell` is the side of the grid's largest cells [m] (hash_grid.hpp).
  BroadPhase(const ContactRule& rule, double grid_cell);

  /// Reserves memory for this number of bodies in total.
  void reserve(std::size_t bodies) {
    entries_.reserve(bodies);
    travel_limits_.reserve(bodies);
  }
  /// Adds a body, which is asleep.
  void add(const Bodies& bodies, BodyIndex body);
  /// Removes a body and its pairs.
  void remove(BodyIndex body);
  /// Returns the overlaps of a breaking floe with other bodies, and the bodies that lie outside of it.
  ContactMemory contact_memory_of(const Bodies& bodies, BodyIndex parent) const;
  /// Passes this memory on to a fragment that was added and woken.
  void pass_contact_memory(const Bodies& bodies, BodyIndex fragment, const ContactMemory& memory);
  /// Marks all present overlaps of a body as paid, because their ice is gone. The body must have been woken.
  void note_paid(BodyIndex body);
  /// Wakes a body. Pairs are kept only if one of the two bodies is awake and may move. Ice that is held in place
  /// therefore has pairs only with approaching bodies, although a fast plate may have a thousand resting pieces in its
  /// box.
  void wake(const Bodies& bodies, BodyIndex body);
  /// Puts a body to sleep and removes its pairs with bodies that cannot move.
  void sleep(const Bodies& bodies, BodyIndex body);

  /// Updates the boxes and pairs of bodies that have left their grown boxes, or may leave them within the time `ahead`
  /// [s] at their rim speed. A longer time renews boxes earlier; it does not make them larger.
  void update(const Bodies& bodies, const std::vector<BodyIndex>& awake, double ahead = 0, int threads = 1);

  /// Finds all contacts at the present positions, ordered by (a, b, place); the result does not depend on the number of
  /// threads. Contact records are kept over the steps.
  void find_contacts(const Bodies& bodies, double dt, std::vector<Contact>& contacts, int threads = 1);

  /// Returns the pairs, ordered by (a, b). Together with the bodies they determine the contacts that the next steps
  /// find.
  std::vector<PairState> pair_states() const;
  /// Returns the pairs that touch. The other pairs are only near and are found again.
  std::vector<PairState> touching_states() const;

  /// Adds saved pairs, after all bodies have been added. Their caches are filled as they are used.
  void restore(const Bodies& bodies, const std::vector<PairState>& pairs);

  /// Calls use(body) for each body whose box may overlap the box; large bodies may be passed more than once.
  template <class Use>
  void for_bodies_near(const geometry::Box& box, Use use) const {
    grid_.for_each_near(box, [&](BodyIndex body) {
      if (overlaps(entries_[static_cast<std::size_t>(body)].box, box)) use(body);
    });
  }

  /// Calls use(other) for each body that has a pair with this one, for which matters(other) is true, and whose box
  /// overlaps this body's box at their present places when it is grown by reach(other) [m]. The result does not depend
  /// on which more distant pairs are kept, which may differ after a resume. `reach` must not exceed the margins that
  /// update() leaves around both boxes, for each the body's rim speed times `ahead` and at most kBoxMargin; beyond it
  /// there may be no pair.
  template <class Matters, class Reach, class Use>
  void for_bodies_at(const Bodies& bodies, BodyIndex body, Matters matters, Reach reach, Use use) const {
    std::optional<geometry::Box> box;
    for (const std::uint32_t slot : entries_[static_cast<std::size_t>(body)].pairs) {
      const BodyIndex other = pairs_[slot].a == body ? pairs_[slot].b : pairs_[slot].a;
      if (!matters(other)) continue;
      if (!box) box = box_in_water(bodies, body);
      if (overlaps(grown(box_in_water(bodies, other), reach(other)), *box)) use(other);
    }
  }

  /// The pairs, in no particular order. Pairs with is_dropped do not count.
  std::span<const Pair> pairs() const { return pairs_; }

  /// Calls use(a, b, paid, unpaid, booked) for each pair whose bodies overlap, in no particular order: the paid area of
  /// the overlap [m²], the area that is not paid and presses the two apart [m²], and the account of the paid area.
  template <class Use>
  void for_overlaps(Use use) const {
    for (const Pair& pair : pairs_) {
      double paid = 0;
      double unpaid = 0;
      Booked booked;
      for (const PersistentContact& record : pair.records()) {
        paid += record.paid_area;
        unpaid += std::max(0.0, record.area - record.paid_area);
        booked += record.booked;
      }
      if (paid + unpaid > 0 && !pair.is_dropped) use(pair.a, pair.b, paid, unpaid, booked);
    }
  }

  /// Returns the inseparable overlaps that find_contacts found since the last call, ordered by (a, b).
  void take_inseparable_overlaps(std::vector<InseparableOverlap>& overlaps);

  /// Returns the contacts that find_contacts found to have ended since the last call, ordered by (a, b).
  void take_parted(std::vector<PartedContact>& parted);

  /// Returns the number of contact stretches since the last call whose crossings did not pair up (see
  /// geometry::find_manifolds).
  std::int64_t take_unpaired_stretches();

 private:
  struct Entry {        // data of one body
    geometry::Box box;  // grown
    std::vector<std::uint32_t> pairs;
    std::uint32_t kept_pieces = 0;  // pieces of its cover (geometry::Cover), if that is kept
    bool is_in = false;
    std::int32_t mover = kNoMover;  // place in movers_
  };
  static constexpr std::int32_t kNoMover = -1;
  struct ActivePair {
    BodyIndex a, b;
    double separation_bound;  // sum of Bodies::travel of a and b up to which the two cannot touch [m]
    std::uint32_t slot;
    friend bool operator<(const ActivePair& p, const ActivePair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }
  };
  void place(const Bodies& bodies, BodyIndex body, const geometry::Box& box);
  bool may_move(const Bodies& bodies, BodyIndex body) const;
  void enter_mover(const Bodies& bodies, BodyIndex body);
  void leave_movers(BodyIndex body);
  void add_pairs_of(const Bodies& bodies, BodyIndex body);
  template <class Use>
  void for_new_partners(const Bodies& bodies, BodyIndex body, Use use) const;
  bool are_pair(BodyIndex a, BodyIndex b) const;
  void add_pair(const Bodies& bodies, BodyIndex a, BodyIndex b);
  void keep_cover(const Bodies& bodies, BodyIndex body);  // makes and keeps the cover of the body's boundary
  template <class Wanted>
  std::vector<PairState> states_where(Wanted is_wanted) const;
  void drop_pair(std::uint32_t pair);     // removes a pair from the lists of its bodies, and marks it as dropped
  void mark_dropped(std::uint32_t pair);  // marks only; its slot is freed later by erase_dropped()
  void merge_new();
  void erase_dropped(std::vector<ActivePair>& list);
  struct Share;
  std::size_t find_pending(const Bodies& bodies, std::size_t begin, std::size_t end, std::vector<ActivePair*>& pending);
  std::span<ActivePair* const> find_all_pending(const Bodies& bodies, int threads);
  void collide_share(const Bodies& bodies, std::span<ActivePair* const> pending, double dt, PairScratch& scratch,
                     std::vector<Contact>& contacts);
  void collide(const Bodies& bodies, ActivePair& active, double dt, PairScratch& scratch,
               std::vector<Contact>& contacts);

  ContactRule rule_;
  HashGrid grid_;
  std::vector<Entry> entries_;
  std::vector<BodyIndex> movers_;      // awake bodies that may move, in no particular order
  std::vector<double> travel_limits_;  // of bodies: the grown box contains a body until its travel exceeds this
  std::vector<Pair> pairs_;            // slots; some are free
  std::vector<std::uint32_t> free_pairs_;
  std::vector<ActivePair> active_;  // pairs in use, ordered by (a, b), including dropped ones
  std::vector<ActivePair> recent_;  // the same; merged into active_ when there are many
  std::vector<ActivePair> new_;     // not sorted yet
  std::size_t dropped_ = 0;         // dropped pairs in all three lists
  double kept_pieces_ = 0;          // pieces of all covers that are kept
  struct Pending {
    std::vector<ActivePair*> pairs;  // with room for more
    std::size_t count = 0;
  };
  std::vector<Pending> pending_;          // pairs that may touch in this step, from chunks of the pairs in use
  std::vector<ActivePair*> all_pending_;  // all of them, if there are several chunks
  struct Share {                          // a share of these pairs, for one thread at a time
    PairScratch scratch;
    std::vector<Contact> contacts;
    std::size_t first = 0;  // place of its first pair among all
  };
  std::vector<Share> shares_;
  std::vector<std::uint32_t> own_pairs_;  // pairs of a body, while some of them are dropped
  struct Moved {                          // some bodies that have left their boxes
    std::vector<std::uint32_t> parted;    // pairs to drop, some twice
    std::vector<std::array<BodyIndex, 2>> met;
  };
  std::vector<BodyIndex> moved_;
  std::vector<geometry::Box> boxes_;  // their new boxes
  std::vector<Moved> moved_some_;
};

}  // namespace polynya::dynamics
