#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "simulation/world/population.hpp"

namespace polynya::simulation {

// Which bodies take steps of several ticks. A body takes steps of 2^k ticks, as long as it does not go farther than its
// share of the thickness relative to another that it may touch within the block of ticks ahead; and it has at most
// twice the step of such another, or the same where the two press each other by more than a little. Hulls, what they
// may touch and a few more bodies in a row go by the tick, or by its parts where it has some: these are level 0, and
// from 1 on levels are of 2^(level − 1) ticks. Of two bodies that touch, the shorter steps have the
// contact: in these the other gets its impulses, and moves by the tick. Ice that is held, or far heavier than others,
// shortens nothing: its contacts are those of the others' steps.

/// Who takes which steps in a block of ticks, and where it is sought.
struct Components {
  /// Awake bodies, ascending: those that go by the tick, or by its parts, of ticks_of_level, and last those that take
  /// the block in one step (level_of_block).
  std::array<std::vector<BodyIndex>, kMostLevels + 3> of_level;
  struct Node {
    BodyIndex body = 0;
    int level = 0;
    int rank = 0;                 ///< levels, in steps of one more body from what has a shorter step
    double longest = 0;           ///< step [s]
    geometry::Box box;            ///< in the water frame
    std::size_t first = 0;        ///< of its vertices
    std::size_t count = 0;        ///< 0 of round plates of many edges: their bounding circle is taken
    bool is_fixed = false;        ///< it goes by the tick and joins nothing
    bool is_along = false;        ///< in Population::moving_along
    geometry::Vector velocity;    ///< when its step began, or the block [m/s]
    double angular_velocity = 0;  ///< [rad/s]
    double turning = 0;           ///< of its rim, when the block began [m/s]
  };
  std::vector<Node> nodes;               ///< bodies awake, and those that they may touch
  std::vector<std::int32_t> node_of;     ///< by body; −1: none
  std::vector<geometry::Point> corners;  ///< of all nodes, in the water frame
  /// Of two nodes that may touch in the block, both of steps of their own.
  struct Touch {
    std::int32_t a = 0;
    std::int32_t b = 0;
    double longest = 0;  ///< step of one that has a longer one than the other [s]
  };
  std::vector<Touch> touching;
  std::vector<std::int32_t> first_partner;                      ///< by node, in `partners`
  std::vector<std::pair<std::int32_t, std::int32_t>> partners;  ///< the other node and the place in `touching`
};

/// Of the steps of a level from 1 on.
inline int ticks_of_level(int level) {
  return 1 << (level - 1);
}
/// The level of bodies that take a block in one step, where the block is longer than the 2^k ticks of others.
inline int level_of_block(const Setup& setup) {
  return setup.levels + 2;
}
/// Of the longest block: four times the longest of the other steps.
inline std::int64_t longest_block(const Setup& setup) {
  return setup.levels == 0 ? 1 : std::int64_t{4} << setup.levels;
}

/// Sorts the bodies by the steps that they take, from a tick to which all have come. Returns the number of ticks
/// for which that holds, at most so many; 1 where all take the next tick together.
std::int64_t begin_block(const Setup& setup, Clock& clock, std::int64_t most, int threads, Population& population,
                         Components& components);

/// Whether a body was there and awake, or near one that is, when the block began.
inline bool has_node(const Components& components, BodyIndex i) {
  const auto place = static_cast<std::size_t>(i);
  return place < components.node_of.size() && components.node_of[place] >= 0;
}
/// Whether a body of longer steps moves by the tick.
inline bool moves_along(const Components& components, BodyIndex i) {
  const auto place = static_cast<std::size_t>(i);
  return has_node(components, i) && components.nodes[static_cast<std::size_t>(components.node_of[place])].is_along;
}

/// All bodies have come to the same tick again.
void end_block(Population& population);

/// Keeps how bodies of longer steps move that have just begun one.
void begin_longer(const Population& population, int level, Components& components);

/// The bodies of longer steps that contacts of shorter ones have struck so that their own are too long by now;
/// ascending.
std::vector<BodyIndex> find_struck(const Setup& setup, const Population& population, const Components& components);

/// Has a body of longer steps move by the tick from now on; it is where what goes by the tick is.
void move_along(BodyIndex i, Population& population, Components& components);

/// Has a body that moved along go by the tick itself. Calls use(other) for each of longer steps that it may touch and
/// that does not move along yet.
template <class Use>
void go_by_tick(BodyIndex i, Population& population, Components& components, Use use);

/// Takes out contacts of bodies that take different steps, where the one of longer steps is not where it is seen: one
/// came farther than by the speeds at the block's begin. Adds that one to `met`.
void drop_unforeseen(const dynamics::Bodies& bodies, const Components& components,
                     std::vector<dynamics::Contact>& contacts, std::vector<BodyIndex>& met);

void take_out_of_level(BodyIndex i, Population& population, Components& components);

template <class Use>
void go_by_tick(BodyIndex i, Population& population, Components& components, Use use) {
  take_out_of_level(i, population, components);
  const std::int32_t node = components.node_of[static_cast<std::size_t>(i)];
  const auto& first = components.first_partner;
  for (std::int32_t p = first[node]; p < first[node + 1]; ++p) {
    const Components::Node& other = components.nodes[components.partners[p].first];
    const int level = population.bodies.level[static_cast<std::size_t>(other.body)];
    if (level > 0 && level != dynamics::kNoLevel && !other.is_along) use(other.body);
  }
}

}  // namespace polynya::simulation
