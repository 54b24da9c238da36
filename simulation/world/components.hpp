#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulation/world/population.hpp"

namespace polynya::simulation {

// Which bodies take steps of several ticks. Bodies that may touch within the block of ticks ahead are a component;
// all of one take steps of 2^k ticks, as long as none of them goes farther than its share of the thickness relative
// to another that it may touch. Hulls, and what they may touch with all its component, go by the tick (k = 0). Ice
// that is held, or far heavier than others, joins nothing: its contacts are those of the others' steps.

/// Who takes which steps in a block of ticks, and where it is sought.
struct Components {
  std::array<std::vector<BodyIndex>, kMostLevels + 1> of_level;  ///< awake bodies, ascending
  std::vector<BodyIndex> asleep;                                 ///< that one awake may touch
  struct Node {
    BodyIndex body = 0;
    std::int32_t parent = 0;  ///< towards the component's root
    double longest = 0;       ///< step [s]
    geometry::Box box;        ///< in the water frame
    std::size_t first = 0;    ///< of its vertices
    std::size_t count = 0;    ///< 0 of round plates of many edges: their bounding circle is taken
  };
  std::vector<Node> nodes;               ///< bodies awake, and `asleep`
  std::vector<std::int32_t> node_of;     ///< by body; −1: none
  std::vector<geometry::Point> corners;  ///< of all nodes, in the water frame
};

/// Sorts the bodies by the steps that they take, from a tick to which all have come. Returns the number of ticks
/// for which that holds, at most so many; 1 where all take the next tick together.
std::int64_t begin_block(const Setup& setup, Clock& clock, std::int64_t most, Population& population,
                         Components& components);

/// All bodies have come to the same tick again.
void end_block(Population& population, const Components& components);

/// Takes out contacts of bodies that take different steps: one came farther than by the speeds at the block's begin.
/// Returns whether there were any.
bool drop_across_levels(const dynamics::Bodies& bodies, std::vector<dynamics::Contact>& contacts);

}  // namespace polynya::simulation
