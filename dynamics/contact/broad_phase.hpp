#pragma once

#include <optional>
#include <span>
#include <vector>

#include "dynamics/contact/hash_grid.hpp"
#include "dynamics/contact/narrow_phase.hpp"

namespace polynya::dynamics {

/// What a saved run keeps of a pair of bodies. a < b.
struct PairState {
  BodyIndex a = 0;
  BodyIndex b = 0;
  double separation_bound = -1;  ///< the two cannot touch until they have travelled this far together [m]
  std::vector<PersistentContact> records;
};

/// The overlaps of a body that breaks with another one, together.
struct OverlapMemory {
  BodyIndex other = 0;
  double paid_area = 0;  ///< [m²]
  double area = 0;       ///< [m²]
  CrushedIce crushed;    ///< the largest; its pose is that of the other's frame in the broken body's
  Booked booked;
};

/// A body that one that breaks does not touch, neither inside the other.
struct Outside {
  BodyIndex other = 0;
  double clearance = 0;  ///< how far the two can move without touching [m]
};

/// What a floe that breaks passes on to its fragments.
struct ContactMemory {
  std::vector<OverlapMemory> overlaps;
  std::vector<Outside> outside;  ///< by other
};

/// A box about a body where it is: the tightest of bodies of few edges, else that of its bounding circle.
geometry::Box box_in_water(const Bodies& bodies, BodyIndex i);

/// Finds which bodies overlap. A grid finds the pairs whose grown boxes meet; each pair keeps the edges that
/// are near each other until the bodies have moved so far relative to each other that others might be. All
/// bounds are conservative: what is culled cannot touch, so the contacts are those of a search over
/// everything.
class BroadPhase {
 public:
  BroadPhase(const ContactRule& rule, double grid_cell);

  /// Makes room for so many bodies in all.
  void reserve(std::size_t bodies) {
    entries_.reserve(bodies);
    travel_limits_.reserve(bodies);
  }
  /// Adds a body, asleep.
  void add(const Bodies& bodies, BodyIndex body);
  /// Removes a body and its pairs.
  void remove(BodyIndex body);
  /// The overlaps of a floe that breaks with other bodies, and the bodies that are outside it.
  ContactMemory contact_memory_of(const Bodies& bodies, BodyIndex parent) const;
  /// Passes it on to a fragment that was added and woken.
  void pass_contact_memory(const Bodies& bodies, BodyIndex fragment, const ContactMemory& memory);
  /// Notes that all overlaps of a body where it is are paid: their ice is gone. For a body that was woken.
  void note_paid(BodyIndex body);
  /// Pairs are kept only where one of the two is awake and may move: ice that is held where the water stands
  /// meets only what comes to it, though a fast plate has a thousand pieces at rest in its box.
  void wake(const Bodies& bodies, BodyIndex body);
  void sleep(const Bodies& bodies, BodyIndex body);

  /// Updates boxes and pairs of those bodies that have travelled out of their grown boxes, or will have by their
  /// rim speed in a time [s].
  void update(const Bodies& bodies, const std::vector<BodyIndex>& awake, double ahead = 0, int threads = 1);

  /// All contacts of the present positions, ordered by (a, b, place), the same on any number of threads.
  /// Contact records are kept over the steps.
  void find_contacts(const Bodies& bodies, double dt, std::vector<Contact>& contacts, int threads = 1);

  /// The pairs, by (a, b): together with the bodies, all that decides which contacts the next steps find.
  std::vector<PairState> pair_states() const;
  /// Those of them that touch: the others are only near, and found again.
  std::vector<PairState> touching_states() const;

  /// Adds saved pairs, after all bodies have been added. Their caches are filled again as they are used.
  void restore(const Bodies& bodies, const std::vector<PairState>& pairs);

  /// Calls use(body) for each body whose box may meet the box, more than once where it is large.
  template <class Use>
  void for_bodies_near(const geometry::Box& box, Use use) const {
    grid_.for_each_near(box, [&](BodyIndex body) {
      if (overlaps(entries_[static_cast<std::size_t>(body)].box, box)) use(body);
    });
  }

  /// Calls use(other) for each body of a pair with this one for which matters(other) is true, and whose box meets this
  /// body's box where they are now, grown by reach(other) [m]. That does not depend on which more distant pairs are
  /// kept, which may differ after a resume; `reach` must be within the margin of the pairs' boxes (update's `ahead`).
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

  /// The pairs, in no order, and what is_dropped among them: those are none.
  std::span<const Pair> pairs() const { return pairs_; }

  /// Calls use(a, b, paid, unpaid, booked) for each pair whose bodies overlap, in no order: the paid area of the
  /// overlap [m²], the area that is not paid and presses the two apart [m²], and what became of the paid area.
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

  /// What find_contacts found blind since the last call, ordered by (a, b).
  void take_blind_overlaps(std::vector<BlindOverlap>& overlaps);

  /// The contacts that find_contacts found ended since the last call, ordered by (a, b).
  void take_parted(std::vector<PartedContact>& parted);

  /// Contact stretches whose crossings did not pair up (see geometry::find_manifolds), since the last call.
  std::int64_t take_unpaired_stretches();

 private:
  struct Entry {        // one body
    geometry::Box box;  // grown
    std::vector<std::uint32_t> pairs;
    std::uint32_t kept_pieces = 0;  // of its cover
    bool is_in = false;
    std::int32_t mover = kNoMover;  // place in movers_
  };
  static constexpr std::int32_t kNoMover = -1;
  struct ActivePair {
    BodyIndex a, b;
    double separation_bound;  // the two cannot touch until they have travelled this far together [m]
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
  void keep_cover(const Bodies& bodies, BodyIndex body);
  template <class Wanted>
  std::vector<PairState> states_where(Wanted is_wanted) const;
  void drop_pair(std::uint32_t pair);
  void mark_dropped(std::uint32_t pair);
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
  std::vector<BodyIndex> movers_;      // those awake that may move, in no order
  std::vector<double> travel_limits_;  // of bodies: the grown box contains one until it has travelled this far
  std::vector<Pair> pairs_;            // slots
  std::vector<std::uint32_t> free_pairs_;
  std::vector<ActivePair> active_;  // pairs in use, by (a, b), dropped ones included
  std::vector<ActivePair> recent_;  // the same; merged into active_ when there are many
  std::vector<ActivePair> new_;     // not sorted yet
  std::size_t dropped_ = 0;         // of all three
  double kept_pieces_ = 0;          // of all bodies' covers
  struct Pending {
    std::vector<ActivePair*> pairs;  // and room for more
    std::size_t count = 0;
  };
  std::vector<Pending> pending_;          // that may touch in this step, of chunks of the pairs in use
  std::vector<ActivePair*> all_pending_;  // where they are several
  struct Share {                          // of those that may touch, for one thread at a time
    PairScratch scratch;
    std::vector<Contact> contacts;
    std::size_t first = 0;  // of these, among all
  };
  std::vector<Share> shares_;
  std::vector<std::uint32_t> own_pairs_;  // of a body, while some of them are dropped
  struct Moved {                          // out of their boxes, of some bodies
    std::vector<std::uint32_t> parted;    // pairs, some twice
    std::vector<std::array<BodyIndex, 2>> met;
  };
  std::vector<BodyIndex> moved_;
  std::vector<geometry::Box> boxes_;  // of these
  std::vector<Moved> moved_some_;
};

}  // namespace polynya::dynamics
