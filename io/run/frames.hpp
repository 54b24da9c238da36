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

/// frames.bin contains the positions of all bodies over time (docs/run-folder.md). It is little-endian, and numbers are
/// aligned to their size. "Ships" are all hulls of the scene: ships, structures and walls, in this order.
///
///   file   = "PLYNYFRM" u32:version=1 u32:0 frame*
///   frame  = "FRAM" u32:ships u32:floes u32:0 f64:t_s ship{ships} floe{floes}
///   ship   = f64:x_m f64:y_m f64:heading_rad f64:vx f64:vy f64:yaw_rate
///   floe   = i64:floe_id f64:x_m f64:y_m f64:angle_rad f64:vx f64:vy f64:angular_velocity
///
/// x, y of a floe are its centre of mass, and those of a hull the origin of its frame. A frame contains a floe if no
/// frame before contains it, or if its last recorded motion, extrapolated at constant velocity, deviates from its true
/// motion by more than one of the tolerances below.

// Largest errors of the recorded motion of a floe at a frame. Larger values make frames.bin shorter, because floes that
// hardly accelerate need records less often. Smaller values make it longer. All places of floes that are read from a
// run have these errors: in the player, in exports and in scenes that continue a run. Checkpoints have exact states, so
// resumed runs are not affected.
inline constexpr double kFramePositionTolerance = 1e-3;  ///< for x and for y [m]
inline constexpr double kFrameAngleTolerance = 1e-5;     ///< [rad]
inline constexpr double kFrameSpeedTolerance = 1e-3;     ///< for each component of the velocity [m/s]
inline constexpr double kFrameSpinTolerance = 1e-5;      ///< for the angular velocity [rad/s]

/// Motion of a body at one instant, in the world frame. The bytes of this struct are those of the file.
struct Motion {
  /// Centre of mass of a floe; origin of the frame of a hull, which for a ship is its centre of gravity [m].
  geometry::Point position;
  /// Rotation of the body frame of a floe since the start, or heading of a hull, counter-clockwise [rad]. It counts
  /// full turns, so that it can be interpolated.
  double angle = 0;
  geometry::Vector velocity;    ///< velocity of that point over ground [m/s]
  double angular_velocity = 0;  ///< counter-clockwise [rad/s]
};

/// Writes or reads the members, in the order of the file.
template <class Archive>
void fields(Archive& archive, simulation::Is<Motion> auto& m) {
  archive(m.position, m.angle, m.velocity, m.angular_velocity);
}

/// Returns the motion after `duration` [s] at constant velocity and angular velocity; a negative one goes back.
Motion carried_on(const Motion& motion, double duration);

/// A floe in a frame. The bytes of this struct are those of the file.
struct FloeMotion {
  simulation::FloeId floe = 0;  ///< id of the floe in its run
  Motion motion;
};

/// A motion that a frame recorded.
struct RecordedMotion {
  double time = -1;  ///< time of the frame [s]; < 0: not recorded yet
  Motion motion;
};

/// Returns the bytes of a frame at a time [s] with exactly these ships and floes, without comparing any tolerance. A
/// FrameEncoder does not learn of it.
std::string frame_bytes(double time, std::span<const Motion> ships, std::span<const FloeMotion> floes);

/// Encodes the frames of a run. It stores the last record of each floe to decide which floes the next frame needs.
class FrameEncoder {
 public:
  FrameEncoder() = default;
  /// Continues the encoder of a run that is resumed: `recorded` is recorded() at the checkpoint.
  explicit FrameEncoder(std::vector<RecordedMotion> recorded) : recorded_(std::move(recorded)) {}

  /// Returns the bytes with which the file begins, before the first frame.
  static std::string header();
  /// Begins a frame at a simulated time [s], which must not be before that of the last frame. `ships` are all hulls in
  /// the order of the scene. A frame is encoded by begin(), then add() for each living floe, also those under hulls,
  /// then end().
  void begin(double time, std::span<const Motion> ships);
  /// Adds a floe to the frame if the floe needs a record: its first one, or one because the last one, carried on to the
  /// time of this frame, exceeds a tolerance. Otherwise the last record stays the floe's last one.
  void add(const FloeMotion& floe);
  /// Returns the bytes of the frame. A frame without floes is complete too.
  std::string end();
  /// Returns the last record of each floe by its id, for a checkpoint. Ids that no frame has have a negative time.
  const std::vector<RecordedMotion>& recorded() const { return recorded_; }

 private:
  std::vector<RecordedMotion> recorded_;  ///< by floe id
  simulation::ByteWriter frame_;          ///< current frame, in which the number of floes is not yet written
  std::uint32_t floes_ = 0;               ///< number of floes in the current frame
  double time_ = 0;                       ///< time of the current frame [s]
};

/// A frame read back.
struct Frame {
  double time = 0;                ///< [s]
  std::vector<Motion> ships;      ///< all hulls in the order of the scene
  std::vector<FloeMotion> floes;  ///< only those with a record in this frame
};

/// Reads the bytes of a whole file. A last frame that is cut short, as a killed run may leave, is ignored, or is an
/// error if `is_whole`, as in the file of a run that finished. A file without frames gives an empty list. Fails if the
/// file has another format or version, or if a frame is damaged or has a number that is not finite. The message then
/// has the number of the frame, from 1, and the byte at which it begins.
Result<std::vector<Frame>> decode_frames(std::string_view bytes, bool is_whole = false);

}  // namespace polynya::io
