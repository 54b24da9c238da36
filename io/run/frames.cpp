#include "io/run/frames.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "simulation/state/state_fields.hpp"

namespace polynya::io {
namespace {

constexpr std::string_view kFileMark = "PLYNYFRM";
constexpr std::string_view kFrameMark = "FRAM";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderSize = 16;
constexpr std::size_t kFrameHeadSize = 24;
// What the file has of them is what they are.
static_assert(sizeof(Motion) == 48 && sizeof(FloeMotion) == 56 && std::is_trivially_copyable_v<FloeMotion>);

template <class Value>
Value take(std::string_view& bytes) {
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

/// All of a frame but its floes.
void write_head(simulation::ByteWriter& frame, double time, std::span<const Motion> ships, std::uint32_t floes) {
  for (const char letter : kFrameMark) frame(letter);
  frame(static_cast<std::uint32_t>(ships.size()), floes, std::uint32_t{0}, time);
  for (const Motion& ship : ships) frame(ship);
}

bool is_close(const Motion& a, const Motion& b) {
  return std::abs(a.position.x - b.position.x) <= kFramePositionTolerance &&
         std::abs(a.position.y - b.position.y) <= kFramePositionTolerance &&
         std::abs(a.angle - b.angle) <= kFrameAngleTolerance &&
         std::abs(a.velocity.x - b.velocity.x) <= kFrameSpeedTolerance &&
         std::abs(a.velocity.y - b.velocity.y) <= kFrameSpeedTolerance &&
         std::abs(a.angular_velocity - b.angular_velocity) <= kFrameSpinTolerance;
}

}  // namespace

Motion carried_on(const Motion& motion, double duration) {
  Motion later = motion;
  later.position += duration * motion.velocity;
  later.angle += duration * motion.angular_velocity;
  return later;
}

std::string FrameEncoder::header() {
  simulation::ByteWriter head;
  head(kVersion, std::uint32_t{0});
  return std::string(kFileMark) + head.take();
}

std::string frame_bytes(double time, std::span<const Motion> ships, std::span<const FloeMotion> floes) {
  simulation::ByteWriter frame;
  write_head(frame, time, ships, static_cast<std::uint32_t>(floes.size()));
  for (const FloeMotion& floe : floes) frame(floe.floe, floe.motion);
  return frame.take();
}

void FrameEncoder::begin(double time, std::span<const Motion> ships) {
  frame_ = {};
  floes_ = 0;
  time_ = time;
  write_head(frame_, time, ships, 0);
}

void FrameEncoder::add(const FloeMotion& floe) {
  const auto id = static_cast<std::size_t>(floe.floe);
  if (id >= recorded_.size()) recorded_.resize(id + 1);
  RecordedMotion& last = recorded_[id];
  if (last.time >= 0 && is_close(carried_on(last.motion, time_ - last.time), floe.motion)) return;
  last = {time_, floe.motion};
  frame_(floe.floe, floe.motion);
  ++floes_;
}

std::string FrameEncoder::end() {
  std::string bytes = frame_.take();
  std::memcpy(bytes.data() + kFrameMark.size() + sizeof(std::uint32_t), &floes_, sizeof floes_);
  return bytes;
}

Result<std::vector<Frame>> decode_frames(std::string_view bytes) {
  if (bytes.size() < kHeaderSize || !bytes.starts_with(kFileMark)) return fail("not a file of frames");
  bytes.remove_prefix(kFileMark.size());
  if (take<std::uint32_t>(bytes) != kVersion) return fail("frames of another version");
  bytes.remove_prefix(4);
  std::vector<Frame> frames;
  while (bytes.size() >= kFrameHeadSize) {
    if (!bytes.starts_with(kFrameMark)) return fail("a damaged frame");
    bytes.remove_prefix(kFrameMark.size());
    const std::size_t ships = take<std::uint32_t>(bytes);
    const std::size_t floes = take<std::uint32_t>(bytes);
    bytes.remove_prefix(4);
    Frame frame{.time = take<double>(bytes), .ships = {}, .floes = {}};
    if (bytes.size() < ships * sizeof(Motion) + floes * sizeof(FloeMotion)) break;
    for (std::size_t i = 0; i < ships; ++i) frame.ships.push_back(take<Motion>(bytes));
    for (std::size_t i = 0; i < floes; ++i) frame.floes.push_back(take<FloeMotion>(bytes));
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace polynya::io
