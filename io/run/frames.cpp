#include "io/run/frames.hpp"

#include <cmath>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>

#include "simulation/state/state_fields.hpp"

namespace polynya::io {
namespace {

constexpr std::string_view kFileMark = "PLYNYFRM";
constexpr std::string_view kFrameMark = "FRAM";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeaderSize = 16;     ///< length of the file's header [bytes]
constexpr std::size_t kFrameHeadSize = 24;  ///< length of a frame before its ships [bytes]
// The bytes of these structs in memory are those of the file.
static_assert(sizeof(Motion) == 48 && sizeof(FloeMotion) == 56 && std::is_trivially_copyable_v<FloeMotion>);

template <class Value>
Value take(std::string_view& bytes) {
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

/// Writes a frame except its floes.
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

namespace {

bool is_finite(const Motion& m) {
  // 0 times a sum is finite only if every term is finite.
  return std::isfinite(0 * (m.position.x + m.position.y + m.angle + m.velocity.x + m.velocity.y + m.angular_velocity));
}

/// Removes `count` bodies from the bytes, which must be long enough. Returns false if one of their numbers is not
/// finite.
template <class Body>
bool take_bodies(std::string_view& bytes, std::size_t count, std::vector<Body>& bodies) {
  bodies.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    bodies.push_back(take<Body>(bytes));
    if constexpr (std::is_same_v<Body, FloeMotion>) {
      if (!is_finite(bodies.back().motion)) return false;
    } else if (!is_finite(bodies.back())) {
      return false;
    }
  }
  return true;
}

}  // namespace

Result<std::vector<Frame>> decode_frames(std::string_view bytes, bool is_whole) {
  const std::size_t size = bytes.size();
  if (size < kHeaderSize || !bytes.starts_with(kFileMark)) return fail("not a file of frames");
  bytes.remove_prefix(kFileMark.size());
  if (take<std::uint32_t>(bytes) != kVersion || take<std::uint32_t>(bytes) != 0)
    return fail("frames of another version");
  std::vector<Frame> frames;
  while (!bytes.empty()) {
    const std::size_t start = size - bytes.size();
    const auto refuse = [&](std::string_view what) {
      return fail(fmt::format("frame {}, which begins at byte {}: {}", frames.size() + 1, start, what));
    };
    const bool has_head = bytes.size() >= kFrameHeadSize;
    if (has_head && !bytes.starts_with(kFrameMark)) return refuse("damaged");
    bytes.remove_prefix(has_head ? kFrameMark.size() : 0);
    const std::size_t ships = has_head ? take<std::uint32_t>(bytes) : 0;
    const std::size_t floes = has_head ? take<std::uint32_t>(bytes) : 0;
    if (has_head && take<std::uint32_t>(bytes) != 0) return refuse("damaged");
    Frame frame{.time = has_head ? take<double>(bytes) : 0, .ships = {}, .floes = {}};
    if (!has_head || bytes.size() < ships * sizeof(Motion) + floes * sizeof(FloeMotion)) {
      if (is_whole) return refuse("cut short, of a run that finished");
      break;
    }
    if (!std::isfinite(frame.time) || !take_bodies(bytes, ships, frame.ships) ||
        !take_bodies(bytes, floes, frame.floes))
      return refuse("damaged, a number in it is none");
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace polynya::io
