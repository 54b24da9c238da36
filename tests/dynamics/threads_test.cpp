// Loops on several threads: each chunk once, and the same impulses on any number of them.
#include <atomic>
#include <set>
#include <span>
#include <utility>

#include <gtest/gtest.h>

#include "dynamics/chunks.hpp"
#include "dynamics/contact/contact_islands.hpp"
#include "dynamics/thread_limit.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::dynamics {
namespace {

using namespace scenery;

TEST(Threads, RunEachChunkOfManyLoopsOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadLimit limit(threads);
    std::vector<int> runs(13 * 40);
    limit.execute([&] {
      for (std::size_t loop = 1; loop <= 3000; ++loop) {
        const std::size_t chunks = loop % 13 + 1;
        std::atomic<std::size_t> within = 0;
        for_chunks(40 * chunks, 40, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
          EXPECT_EQ(begin, 40 * chunk);
          for (std::size_t i = begin; i < end; ++i) ++runs[i];
          for_chunks(2, 1, threads, [&](std::size_t, std::size_t, std::size_t) { ++within; });  // a loop in a loop
        });
        EXPECT_EQ(within, 2 * chunks);
        for (std::size_t i = 0; i < runs.size(); ++i) ASSERT_EQ(std::exchange(runs[i], 0), i < 40 * chunks ? 1 : 0);
      }
    });
  }
}

/// Floes that overlap a little, in columns and rows, between two walls that close.
struct ClosingPack {
  Bodies bodies;
  explicit ClosingPack(int columns, int rows) {
    Random random(kSeed);
    add_held(bodies, rectangle(10, 10.0 * rows), {-4.9, 5.0 * rows}, {0.3, 0});
    add_held(bodies, rectangle(10, 10.0 * rows), {10.0 * columns + 4.9, 5.0 * rows}, {-0.3, 0});
    for (int i = 0; i < columns * rows; ++i)
      add_floe(bodies, rectangle(10.1, 10.1), {10.0 * (i % columns) + 5, 10.0 * (i / columns) + 5},
               {random.between(-0.3, 0.3), random.between(-0.3, 0.3)}, random.between(-0.02, 0.02));
  }
};

TEST(Threads, HalvesOfALargeIslandShareNoBodyThatMoves) {
  ClosingPack pack(12, 14);
  ContactFinder finder(pack.bodies);
  const std::vector<Contact>& contacts = finder.contacts(pack.bodies, 0.05);
  ContactIslands islands;
  islands.find(pack.bodies, contacts);
  ASSERT_EQ(islands.islands().size(), 1U);
  const Island& island = islands.islands()[0];
  ASSERT_TRUE(island.is_divided());
  EXPECT_LT(island.between().end - island.between().begin, contacts.size() / 8);
  const auto part = [&](ContactRange range) {
    return std::span(islands.order()).subspan(range.begin, range.end - range.begin);
  };
  std::set<BodyIndex> of_first;
  for (const std::uint32_t i : part(island.first_half())) of_first.insert({contacts[i].a, contacts[i].b});
  for (const std::uint32_t i : part(island.second_half()))
    for (const BodyIndex body : {contacts[i].a, contacts[i].b})
      EXPECT_FALSE(pack.bodies.inverse_mass[body] != 0 && of_first.contains(body)) << body;
  EXPECT_EQ(std::set<std::uint32_t>(islands.order().begin(), islands.order().end()).size(), contacts.size());
}

TEST(Threads, LargeIslandsHaveTheSameImpulsesOnAnyNumberOfThem) {
  std::vector<std::vector<double>> impulses;
  for (const int threads : {1, 2, 3, 8}) {
    ClosingPack pack(12, 14);
    ContactFinder finder(pack.bodies);
    std::vector<Contact>& contacts = finder.contacts(pack.bodies, 0.05);
    for (Contact& c : contacts) c.friction = 0.1, c.crushing_force = 1e5, c.crushing_stiffness = 1e6;
    ThreadLimit limit(threads);
    SolverResult result;
    limit.execute([&] {
      result = ContactSolver().solve(pack.bodies, contacts, CrushLaw{.step = 0.05}, {200, 1e-7, threads});
    });
    EXPECT_TRUE(result.is_converged()) << result.residual;
    std::vector<double>& all = impulses.emplace_back();
    for (const Contact& c : contacts) all.insert(all.end(), {c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse});
    EXPECT_EQ(all, impulses.front()) << threads;
  }
}

}  // namespace
}  // namespace polynya::dynamics
