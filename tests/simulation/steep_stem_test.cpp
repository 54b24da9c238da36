// Ships whose stems hardly lean, in fast ice (docs/theory/bow.md, "Steep stems").
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kIceLineLoad = 2.8e6 * 0.5;  // σ_c h [N/m]
constexpr double kBeam = 24;                  // [m]

struct Passage {
  double mean = 0, largest = 0;  ///< [N]
  std::int64_t bends = 0;
};

/// 30 m at 1 m/s, once the bow is in the ice.
Passage passage(double stem_degrees) {
  Ship ship = icebreaker({0, 0}, ConstantSpeed{1});
  ship.hull.stem_angle = stem_degrees * kDegree;
  const Trial done = run(Build()
                             .without_splits()
                             .step(0.1)
                             .recorded_every(0.1)
                             .cusps(CuspFate::kSubmerge)
                             .ship(ship)
                             .floe(fast(rectangle(0.01, -50, 120, 50))),
                         60);
  EXPECT_FALSE(done.simulation.numerical_failure().has_value());
  Passage found{-mean(done.story, &HullSample::from_ice, 0, 30), 0, done.simulation.counts().bends};
  for (const HullSample& sample : done.story.samples)
    found.largest = std::max(found.largest, std::abs(sample.from_ice_largest.surge));
  return found;
}

/// V/H falls with 1/tan φ and is never 0 below 90°. The load therefore rises without a step, also past 90° - atan μ =
/// 78.7°, where friction would hold up ice that meets the stem head on.
TEST(SteepStems, LoadRisesWithoutAStep) {
  double last = passage(72).mean;
  for (double stem = 74; stem <= 86; stem += 2) {
    const Passage found = passage(stem);
    SCOPED_TRACE(testing::Message() << stem << " deg: " << found.mean << " N after " << last);
    EXPECT_GT(found.bends, 0);
    EXPECT_LT(found.mean, 2.5 * last);
    EXPECT_GT(found.mean, 0.5 * last);
    EXPECT_LT(found.largest, 0.5 * kIceLineLoad * kBeam);
    last = found.mean;
  }
}

/// If crushing along the beam takes less force than bending, the ice only crushes, at σ_c h B (1 + μ tan θ).
TEST(SteepStems, CrushWhatTheyCannotBend) {
  const Passage found = passage(89.95);
  EXPECT_EQ(found.bends, 0);
  EXPECT_NEAR(found.mean / (kIceLineLoad * kBeam), 1, 0.01);
}

}  // namespace
}  // namespace polynya::simulation
