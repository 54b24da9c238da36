#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/shape/point.hpp"
#include "io/text/source_text.hpp"
#include "simulation/simulation.hpp"
#include "simulation/state/archive.hpp"

namespace polynya::io {

/// frames.bin: positions of all bodies over time. Little-endian; numbers are aligned to their size
/// (docs/run-folder.md).
///
///   file   = "PLYNYFRM" u32:version=1 u32:0 frame*
///   frame  = "FRAM" u32:ships u32:floes u32:0 f64:t_s ship{ships} floe{floes}
///   ship   = f64:x_m f64:y_m f64:heading_rad f64:vx f64:vy f64:yaw_rate
///   floe   = i64:floe_id f64:x_m f64:y_m f64:angle_rad f64:vx f64:vy f64:angular_velocity
///
/// x, y of a floe are its centre of mass. A frame contains a floe only if its last recorded motion, extrapolated at
/// constant velocity, deviates from its true motion by more than one of the tolerances below.

// Largest errors of the recorded motion of a floe. Smaller values make frames.bin longer.
inline constexpr double kFramePositionTolerance = 1e-3;  ///< [m]
inline constexpr double kFrameAngleTolerance = 1e-5;     ///< [rad]
inline constexpr double kFrameSpeedTolerance = 1e-3;     ///< [m/s]
inline constexpr double kFrameSpinTolerance = 1e-5;      ///< [rad/s]

/// Motion of a body at one instant. Angles count full turns.
struct Motion {
  geometry::Point position;     ///< of the centre of mass in the world [m]
  double angle = 0;             ///< [rad]
  geometry::Vector velocity;    ///< over ground [m/s]
  double angular_velocity = 0;  ///< [rad/s]
};

template <class Archive>
void fields(Archive& archive, simulation::Is<Motion> auto& m) {
  archive(m.position, m.angle, m.velocity, m.angular_velocity);
}

/// Returns the motion after a time [s] at constant velocity.
Motion carried_on(const Motion& motion, double duration);

struct FloeMotion {
  simulation::FloeId floe = 0;
  Motion motion;
};

/// A motion that a frame recorded.
struct RecordedMotion {
  double time = -1;  ///< time of the frame [s]; < 0: not recorded yet
  Motion motion;
};

/// Returns the bytes of a frame with exactly these ships and floes.
std::string frame_bytes(double time, std::span<const Motion> ships, std::span<const FloeMotion> floes);

/// Encodes frames. It stores the last record of each floe to decide which floes the next frame needs.
class FrameEncoder {
 public:
  FrameEncoder() = default;
  /// Continues an encoder with these last records.
  explicit FrameEncoder(std::vector<RecordedMotion> recorded) : recorded_(std::move(recorded)) {}

  static std::string header();
  /// Encode one frame: begin(), then add() for each living floe, then end(). Only floes that need a record are written.
  void begin(double time, std::span<const Motion> ships);
  void add(const FloeMotion& floe);
  std::string end();
  const std::vector<RecordedMotion>& recorded() const { return recorded_; }

 private:
  std::vector<RecordedMotion> recorded_;  ///< by floe id
  simulation::ByteWriter frame_;          ///< current frame, in which the number of floes is not yet written
  std::uint32_t floes_ = 0;               ///< number of floes in the current frame
  double time_ = 0;                       ///< time of the current frame [s]
};

/// A frame read back.
struct Frame {
  double time = 0;  ///< [s]
  std::vector<Motion> ships;
  std::vector<FloeMotion> floes;  ///< only those with a record in this frame
};

/// Reads frames. A last frame that is cut short is ignored, or an error if `is_whole` (the run finished). The error
/// message has the number of the frame and the byte at which it begins.
Result<std::vector<Frame>> decode_frames(std::string_view bytes, bool is_whole = false);

}  // namespace polynya::io
