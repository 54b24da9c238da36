#include "io/run/frames.hpp"

#include <cmath>
#include <random>

#include "expect_text.hpp"

namespace polynya::io {
namespace {

std::string encoded(FrameEncoder& encoder, double time, std::span<const Motion> ships,
                    std::span<const FloeMotion> floes) {
  encoder.begin(time, ships);
  for (const FloeMotion& floe : floes) encoder.add(floe);
  return encoder.end();
}

TEST(Frames, CarryOnFloesThatKeepTheirMotion) {
  FrameEncoder encoder;
  std::string bytes = FrameEncoder::header();
  const Motion drifting{{10, 20}, 0.5, {-0.05, -0.05}, 0};
  for (int k = 0; k <= 100; ++k) {
    const FloeMotion floe{3, carried_on(drifting, 2.0 * k)};
    bytes += encoded(encoder, 2.0 * k, {}, {&floe, 1});
  }
  const auto frames = tests::checked(decode_frames(bytes));
  ASSERT_EQ(frames->size(), 101U);
  EXPECT_EQ((*frames)[0].floes.size(), 1U);
  for (std::size_t k = 1; k < frames->size(); ++k) EXPECT_TRUE((*frames)[k].floes.empty());
}

TEST(Frames, TellEveryMotionWithinTheTolerances) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> kick(0, 3e-4);
  constexpr std::size_t kFloes = 20;
  std::vector<FloeMotion> floes(kFloes);
  for (std::size_t i = 0; i < kFloes; ++i) floes[i].floe = static_cast<simulation::FloeId>(2 * i);
  FrameEncoder encoder;
  std::string bytes = FrameEncoder::header();
  std::vector<std::vector<FloeMotion>> truth;
  std::vector<Motion> ships{{{1, 2}, 3, {4, 5}, 6}};
  for (int k = 0; k < 200; ++k) {
    for (FloeMotion& floe : floes) {
      floe.motion = carried_on(floe.motion, 0.5);
      floe.motion.velocity += geometry::Vector{kick(random), kick(random)};
      floe.motion.angular_velocity += 0.01 * kick(random);
    }
    truth.push_back(floes);
    bytes += encoded(encoder, 0.5 * k, ships, floes);
  }
  const auto frames = tests::checked(decode_frames(bytes));
  std::vector<std::pair<double, Motion>> told(2 * kFloes);
  std::size_t records = 0;
  for (std::size_t k = 0; k < frames->size(); ++k) {
    const Frame& frame = (*frames)[k];
    ASSERT_EQ(frame.ships.size(), 1U);
    EXPECT_EQ(frame.ships[0].velocity.y, 5);
    for (const FloeMotion& floe : frame.floes) told[static_cast<std::size_t>(floe.floe)] = {frame.time, floe.motion};
    records += frame.floes.size();
    for (const FloeMotion& floe : truth[k]) {
      const auto& [time, motion] = told[static_cast<std::size_t>(floe.floe)];
      const Motion carried = carried_on(motion, frame.time - time);
      EXPECT_LE(std::abs(carried.position.x - floe.motion.position.x), kFramePositionTolerance);
      EXPECT_LE(std::abs(carried.angle - floe.motion.angle), kFrameAngleTolerance);
      EXPECT_LE(std::abs(carried.velocity.y - floe.motion.velocity.y), kFrameSpeedTolerance);
    }
  }
  EXPECT_LT(records, 200 * kFloes);
}

TEST(Frames, LeaveOutALastFrameThatIsCutShort) {
  FrameEncoder encoder;
  const FloeMotion floe{0, {{1, 2}, 3, {4, 5}, 6}};
  const std::string head = FrameEncoder::header();
  const std::string first = encoded(encoder, 0, {}, {&floe, 1});
  const std::string second = encoded(encoder, 9, {}, {&floe, 1});
  for (std::size_t length = 0; length <= second.size(); ++length) {
    const auto frames = tests::checked(decode_frames(head + first + second.substr(0, length)));
    EXPECT_EQ(frames->size(), length == second.size() ? 2U : 1U);
  }
  EXPECT_FALSE(decode_frames("PLYNYFRMxxxx").has_value());
  EXPECT_FALSE(decode_frames(head + "GARBAGEGARBAGEGARBAGEGARBAGE").has_value());
}

}  // namespace
}  // namespace polynya::io
