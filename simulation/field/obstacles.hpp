#pragma once

#include <vector>

#include "simulation/floe_field.hpp"

namespace polynya::simulation {

/// Where floes may not be: nearer than the gap to what is kept clear, and across an outline.
class Obstacles {
 public:
  explicit Obstacles(const FloeField& field);  ///< which outlives it

  bool forbid(const geometry::Ring& floe) const;

 private:
  const FloeField& field_;
  std::vector<geometry::Box> boxes_;
};

}  // namespace polynya::simulation
