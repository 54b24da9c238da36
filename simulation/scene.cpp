#include "simulation/scene.hpp"

#include <cmath>

namespace polynya::simulation {

geometry::Ring wedge_bow_waterline(double length, double beam, double entrance_angle) {
  const double bow = 0.5 * beam / std::tan(entrance_angle);
  return {{0.5 * length, 0},
          {0.5 * length - bow, 0.5 * beam},
          {-0.5 * length, 0.5 * beam},
          {-0.5 * length, -0.5 * beam},
          {0.5 * length - bow, -0.5 * beam}};
}

}  // namespace polynya::simulation
