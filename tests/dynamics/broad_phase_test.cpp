// The pair finder against a search over all pairs, while a pack of floes moves, collides, sleeps, breaks up
// and grows.
#include "dynamics/contact/broad_phase.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "dynamics/contact/hash_grid.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Point;
using geometry::Pose;
using geometry::Vector;
using namespace scenery;

constexpr double kStep = 0.05;

using Found = std::tuple<BodyIndex, BodyIndex, double, double, double>;  ///< a, b, width, depth, area

/// Returns every pair of which at least one body is awake, without any memory.
std::vector<Found> over_all_pairs(const Bodies& bodies, const ContactRule& rule) {
  std::vector<Found> found;
  geometry::ManifoldScratch scratch;
  for (BodyIndex a = 0; a < bodies.size(); ++a) {
    for (BodyIndex b = a + 1; b < bodies.size(); ++b) {
      if (!bodies.is_alive[a] || !bodies.is_alive[b] || (!bodies.is_awake[a] && !bodies.is_awake[b])) continue;
      if (distance(bodies.position[a], bodies.position[b]) > bodies.bounding_radius[a] + bodies.bounding_radius[b])
        continue;
      const Pose a_from_b = dynamics::a_from_b(bodies, a, b, centre_a_from_b(bodies, a, b));
      std::vector<geometry::NearPair> circles;
      geometry::NearEdges edges;
      std::vector<geometry::ContactManifold> manifolds;
      near_circles(*bodies.boundary[a], *bodies.boundary[b], a_from_b, 0, circles);
      if (rule.is_circle_centres) {
        find_circle_manifolds(*bodies.boundary[a], *bodies.boundary[b], a_from_b, circles, manifolds);
      } else {
        edges_of(*bodies.boundary[a], *bodies.boundary[b], circles, edges);
        find_manifolds({*bodies.boundary[a], *bodies.boundary[b], a_from_b}, edges, scratch, manifolds);
      }
      for (const geometry::ContactManifold& manifold : manifolds)
        found.push_back({a, b, manifold.width, manifold.depth, manifold.area});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// A pack of random floes, thrown at its middle.
struct FloePack {
  Bodies bodies;
  std::vector<BodyIndex> awake;
  BroadPhase finder;
  Random random{99};
  bool has_covers;  ///< true if covers exist before another body comes near
  int corners;      ///< least number of corners of a body

  FloePack(const ContactRule& rule, int columns, bool are_covered = true, int least_corners = 5)
      : finder(rule, 15), has_covers(are_covered), corners(least_corners) {
    for (int row = 0, i = 0; row < columns; ++row) {
      for (int column = 0; column < columns; ++column, ++i) add({14.0 * column, 14.0 * row}, i % 3 != 0, columns);
    }
    for (int i = 0; i < columns * columns; ++i) {
      if (i % 3 != 0) wake(i);
    }
  }

  void add(Point at, bool is_moving, int columns) {
    NewBody body = floe_body(random_star(random, corners + random.below(8), 3, 8), at, random.angle());
    const Vector inwards = Point{7.0 * columns, 7.0 * columns} - at;
    if (is_moving) {
      body.velocity = 0.05 * inwards + Vector{random.between(-2, 2), random.between(-2, 2)};
      body.angular_velocity = random.between(-0.4, 0.4);
    }
    if (!has_covers) body.boundary->cover.reset();
    const BodyIndex i = add_body(bodies, body);
    finder.add(bodies, i);
  }

  void wake(BodyIndex i) {
    if (bodies.is_awake[i]) return;
    bodies.is_awake[i] = 1;
    awake.insert(std::lower_bound(awake.begin(), awake.end(), i), i);
    finder.wake(bodies, i);
  }

  void put_to_sleep(BodyIndex i) {
    if (!bodies.is_awake[i]) return;
    bodies.velocity[i] = {};
    bodies.angular_velocity[i] = 0;
    bodies.is_awake[i] = 0;
    awake.erase(std::find(awake.begin(), awake.end(), i));
    finder.sleep(bodies, i);
  }

  void remove(BodyIndex i) {
    if (!bodies.is_alive[i]) return;
    finder.remove(i);
    bodies.is_alive[i] = 0;
    if (bodies.is_awake[i]) awake.erase(std::find(awake.begin(), awake.end(), i));
    bodies.is_awake[i] = 0;
  }
};

void run_against_brute_force(const ContactRule& rule, int columns, int steps) {
  FloePack pack(rule, columns);
  ContactSolver solver;
  std::vector<Contact> contacts;
  std::size_t seen = 0;
  for (int step = 0; step < steps; ++step) {
    pack.finder.update(pack.bodies, pack.awake);
    pack.finder.find_contacts(pack.bodies, kStep, contacts);
    std::vector<Found> found;
    for (const Contact& c : contacts) found.push_back({c.a, c.b, c.width, c.depth, c.area});
    ASSERT_TRUE(std::ranges::is_sorted(contacts, {}, [](const Contact& c) { return std::pair(c.a, c.b); }));
    // Bodies that sleep both may still be listed while their pair is known; brute force does not list them.
    std::erase_if(found, [&](const Found& f) {
      return !pack.bodies.is_awake[std::get<0>(f)] && !pack.bodies.is_awake[std::get<1>(f)];
    });
    std::ranges::sort(found);
    ASSERT_EQ(found, over_all_pairs(pack.bodies, rule)) << "step " << step;
    seen += found.size();

    solver.solve(pack.bodies, contacts, RestitutionLaw{}, {});
    for (const Contact& c : contacts) {
      if (c.total_normal_impulse() == 0) continue;
      pack.wake(c.a);
      pack.wake(c.b);
    }
    separate(pack.bodies, contacts, {}, kStep);
    integrate(pack.bodies, pack.awake, kStep);
    if (step % 10 == 9) pack.put_to_sleep(pack.random.below(pack.bodies.size()));
    if (step % 16 != 15) continue;
    pack.remove(pack.random.below(pack.bodies.size()));
    pack.add({14.0 * columns + 10, pack.random.between(0, 14.0 * columns)}, true, columns);
    pack.wake(pack.bodies.size() - 1);
  }
  EXPECT_GT(seen, 1000u);
}

TEST(BroadPhase, FindsWhatASearchOverAllPairsFinds) {
  run_against_brute_force({}, 14, 400);
  run_against_brute_force({1.0, true}, 10, 200);  // by circles
}

constexpr int kColumns = 14;

/// Steps two packs, one of which stores less about its pairs. Their contacts must be the same to the bit. Returns the
/// number of contacts.
std::size_t compare_contacts(FloePack& keeping, FloePack& making, bool are_bounds_the_same) {
  const auto of_contact = [](const Contact& c) {
    return std::tuple(c.a, c.b, c.width, c.depth, c.area, c.normal, c.ends[0], c.ends[1]);
  };
  std::vector<Contact> kept, made;
  std::size_t seen = 0;
  for (int step = 0; step < 300 && !testing::Test::HasFailure(); ++step) {
    for (FloePack* pack : {&keeping, &making}) pack->finder.update(pack->bodies, pack->awake);
    keeping.finder.find_contacts(keeping.bodies, kStep, kept);
    making.finder.find_contacts(making.bodies, kStep, made);
    EXPECT_TRUE(std::ranges::equal(kept, made, {}, of_contact, of_contact)) << step;
    seen += kept.size();
    EXPECT_TRUE(!are_bounds_the_same ||
                std::ranges::equal(keeping.finder.pair_states(), making.finder.pair_states(), {},
                                   &PairState::separation_bound, &PairState::separation_bound))
        << step;
    for (FloePack* pack : {&keeping, &making}) {
      integrate(pack->bodies, pack->awake, kStep);
      if (step % 16 == 15) pack->remove(step % pack->bodies.size());
    }
  }
  return seen;
}

TEST(BroadPhase, FindsTheSameToTheBitWhereCoversAreMadeAsTheyAreNeeded) {
  ContactRule few;
  few.most_kept_pieces = 1000;
  constexpr int kFew = 8, kMany = 130;  // two have too many edges to be compared one by one
  FloePack keeping({}, kFew, false, kMany), making(few, kFew, false, kMany);
  const auto covers_of = [](const FloePack& pack) {
    return std::ranges::count_if(pack.bodies.boundary, [](const auto& boundary) { return boundary->is_ready(); });
  };
  EXPECT_GT(compare_contacts(keeping, making, true), 1000U);
  EXPECT_EQ(covers_of(keeping), keeping.bodies.size());
  EXPECT_LT(covers_of(making), keeping.bodies.size() / 4);
  EXPECT_GT(covers_of(making), 0);
}

TEST(BroadPhase, MakesNoCoversOfBodiesOfFewCorners) {
  FloePack pack({}, kColumns, false);
  std::vector<Contact> contacts;
  pack.finder.update(pack.bodies, pack.awake);
  pack.finder.find_contacts(pack.bodies, kStep, contacts);
  EXPECT_FALSE(contacts.empty());
  for (const auto& boundary : pack.bodies.boundary) EXPECT_FALSE(boundary->is_ready());
}

TEST(BroadPhase, FindsTheSameToTheBitWhereEdgesThatAreNotYetNearAreForgotten) {
  ContactRule forgetful;
  forgetful.most_pairs_with_edges = 10;
  FloePack keeping({}, kColumns, false), forgetting(forgetful, kColumns, false);
  EXPECT_GT(compare_contacts(keeping, forgetting, false), 1000U);
}

TEST(BroadPhase, AFastFloeIsNotMissed) {
  // The body moves by 40 m in a step, which is more than every margin.
  Bodies bodies;
  add_floe(bodies, rectangle(40, 40), {0, 0});
  add_floe(bodies, rectangle(4, 4), {-221, 0.5}, {800, 0});
  ContactFinder finder(bodies);
  bodies.is_awake = {1, 1};
  std::size_t met = 0;
  for (int step = 0; step < 12; ++step) {
    const std::size_t found = finder.contacts(bodies, kStep).size();
    EXPECT_EQ(found, over_all_pairs(bodies, {}).size()) << step;
    met += found;
    integrate(bodies, {0, 1}, kStep);
  }
  EXPECT_GT(met, 0u);
}

/// A fast plate is awake while a ship breaks it. It used to have a pair with each of a thousand pieces of brash at rest
/// in its box, and each cusp entered these pairs again.
TEST(BroadPhase, IceThatIsHeldIsPairedOnlyWithWhatMoves) {
  Bodies bodies;
  add_held(bodies, rectangle(100, 100), {});
  for (int i = 0; i < 9; ++i) add_floe(bodies, rectangle(4, 4), {52.5, 10.0 * i - 40});
  BroadPhase finder({}, 150);
  for (BodyIndex i = 0; i < bodies.size(); ++i) finder.add(bodies, i);
  const auto wake = [&](BodyIndex i) {
    bodies.is_awake[i] = 1;
    finder.wake(bodies, i);
  };
  wake(0);
  EXPECT_TRUE(finder.pair_states().empty());
  wake(3);
  EXPECT_EQ(only(finder.pair_states()).b, 3);
  bodies.velocity[3] = {-1, 0};
  integrate(bodies, {0, 3}, 0.6);  // 10 cm into the plate
  std::vector<Contact> contacts;
  finder.update(bodies, {0, 3});
  finder.find_contacts(bodies, 0.6, contacts);
  EXPECT_EQ(std::pair(only(contacts).a, contacts[0].b), std::pair(0, 3));

  finder.remove(0);  // The plate breaks: its remainder is paired with moving bodies, too.
  const BodyIndex rest = add_held(bodies, rectangle(100, 100), {0.05, 0});
  finder.add(bodies, rest);
  wake(rest);
  EXPECT_EQ(only(finder.pair_states()).a, 3);
  EXPECT_EQ(finder.pair_states()[0].b, rest);
  bodies.is_awake[3] = 0;
  finder.sleep(bodies, 3);
  EXPECT_TRUE(finder.pair_states().empty()) << "the plate is awake, but neither moves";
  wake(5);
  EXPECT_EQ(finder.pair_states().size(), 1U);
}

TEST(BroadPhase, ARecordIsKeptWhileItsContactLastsAndDroppedAfter) {
  Bodies bodies;
  add_floe(bodies, rectangle(10, 40), {-5, 0});
  add_floe(bodies, rectangle(8, 8), {3.9, 0}, {-0.5, 0});
  ContactFinder finder(bodies);
  for (int step = 1; step <= 10; ++step) {
    const Contact contact = only(finder.contacts(bodies, 0.01));
    EXPECT_NEAR(contact.record->age, 0.01 * step, 1e-12);
    EXPECT_NEAR(contact.record->approach, 0.005 * step, 1e-12);
    contact.record->has_crushed = true;
    integrate(bodies, {0, 1}, 0.01);
  }
  bodies.velocity[1] = {100, 0};
  integrate(bodies, {1}, 0.01);
  EXPECT_TRUE(finder.contacts(bodies, 0.01).empty());
  bodies.velocity[1] = {-100, 0};
  integrate(bodies, {1}, 0.01);
  const Contact contact = only(finder.contacts(bodies, 0.01));
  EXPECT_FALSE(contact.record->has_crushed);
  EXPECT_NEAR(contact.record->age, 0.01, 1e-12);
}

std::set<BodyIndex> near(const HashGrid& grid, const geometry::Box& box) {
  std::set<BodyIndex> found;
  grid.for_each_near(box, [&](BodyIndex other) { found.insert(other); });
  return found;
}

geometry::Box box(double x, double y, double side) {
  return {{x, y}, {x + side, y + side}};
}

/// A plate of 100 km among floes of 4 m used to take a grid cell for every 5 m, and all of the memory.
TEST(HashGrid, AVastBodyIsNearAllAndTakesNoCells) {
  HashGrid grid(5);
  const geometry::Box plate = box(0, 0, 1e5), floe = box(10, 10, 4), far = box(-1e4, 0, 4);
  grid.insert(0, plate);
  grid.insert(1, floe);
  grid.insert(2, far);
  EXPECT_EQ(near(grid, floe), (std::set<BodyIndex>{0, 1}));
  EXPECT_EQ(near(grid, far), (std::set<BodyIndex>{0, 2}));
  EXPECT_EQ(near(grid, plate), (std::set<BodyIndex>{0, 1, 2}));
  grid.remove(0, plate);
  EXPECT_EQ(near(grid, floe), (std::set<BodyIndex>{1}));
  EXPECT_EQ(near(grid, plate), (std::set<BodyIndex>{1, 2}));
}

/// All pieces that broke out of a plate were in the plate's own cell: each looked through all others.
TEST(HashGrid, PiecesOfAPlateHaveCellsOfTheirSize) {
  HashGrid grid(900);
  const geometry::Box plate = box(0, 0, 600);
  grid.insert(0, plate);
  for (BodyIndex i = 1; i < 100; ++i) grid.insert(i, box(6.0 * i, 300, 5));
  const std::set<BodyIndex> found = near(grid, box(300, 300, 5));
  EXPECT_EQ(found.count(0), 1U);
  EXPECT_EQ(found.count(50), 1U);  // 300 to 305 m
  EXPECT_LT(found.size(), 12U);
  EXPECT_EQ(near(grid, plate).size(), 100U);
  grid.remove(50, box(300, 300, 5));
  EXPECT_EQ(near(grid, box(300, 300, 5)).count(50), 0U);
  EXPECT_EQ(near(grid, box(-2000, 300, 5)), (std::set<BodyIndex>{}));
}

/// A wedge of 90° is in a notch of the same angle. The overlap is a thin band along both flanks, 2 m deep along the
/// normal and 0.2 m thick on average.
TEST(DepthOfAContact, InANotchIsTheMeanThicknessOfTheOverlap) {
  const geometry::Polygon notched{{{-6, -4}, {0, -4}, {0, -2}, {-2, 0}, {0, 2}, {0, 4}, {-6, 4}}, {}};
  const geometry::Polygon wedge{{{-2.2, 0}, {-0.4, -1.8}, {6, -1.8}, {6, 1.8}, {-0.4, 1.8}}, {}};
  for (const bool is_bounded : {true, false}) {
    Bodies bodies;
    for (const geometry::Polygon& floe : {notched, wedge}) add_floe(bodies, floe, geometry::measure(floe).centroid);
    BroadPhase finder({.is_depth_bounded = is_bounded}, 20);
    for (const BodyIndex i : all_of(bodies)) finder.add(bodies, i);
    for (const BodyIndex i : all_of(bodies)) finder.wake(bodies, i);
    finder.update(bodies, all_of(bodies));
    std::vector<Contact> contacts;
    finder.find_contacts(bodies, 0.01, contacts);
    const Contact& contact = only(contacts);
    EXPECT_NEAR(contact.width, 3.6, 1e-9);
    EXPECT_NEAR(contact.area, 0.72, 1e-9);
    EXPECT_NEAR(contact.depth, is_bounded ? 0.2 : 2.0, 1e-9);
  }
}

}  // namespace
}  // namespace polynya::dynamics
