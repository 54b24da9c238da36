#pragma once

#include <map>
#include <set>

#include "analysis/run_check.hpp"
#include "io/run/motion_index.hpp"

namespace polynya::analysis {

/// Measures what the bodies of a run share, exactly, at one instant after the other, into its check.
class OverlapCheck {
 public:
  OverlapCheck(const io::Run& run, RunCheck& check);

  void measure(double time);

 private:
  using BodyKey = std::int64_t;  ///< a floe's id; -1 - the number of a hull

  struct Placed {
    BodyKey body = 0;
    io::Motion motion;
    geometry::Pose world_from_body;
    geometry::Box box_in_world;
    double area = 0;    ///< [m²]
    double radius = 0;  ///< of its box about its middle [m]
  };
  /// What is known of a pair from the last instant it was measured.
  struct Known {
    bool is_set = false;
    io::Motion a, b;
    double area = 0;   ///< [m²]
    double depth = 0;  ///< 0 where they share less than kTouchingArea [m]
  };

  static bool is_hull(BodyKey body) { return body < 0; }
  std::shared_ptr<const geometry::Polygon> polygon_of(BodyKey body) const;
  geometry::Point centre_of(BodyKey body) const;  ///< that a motion is of, in the body's frame
  simulation::ContactState::Body name_of(BodyKey body) const;
  Placed placed(BodyKey body, const io::Motion& motion) const;
  void place_bodies(double time);
  void read_crushed(double time);
  template <class Use>
  void for_near_pairs(Use use) const;
  const Known& shared_by(const Placed& a, const Placed& b);
  fracture::Ice ice_of(BodyKey floe) const;
  double area_of(BodyKey body) const;  ///< [m²]
  double compare_with_work(const simulation::CrushedOverlap& overlap, std::pair<BodyKey, BodyKey> key, double time);
  void compare_with_crushed(const Placed& a, const Placed& b, double shared, double time);

  const io::Run& run_;
  RunCheck& check_;
  io::MotionIndex motions_;
  std::vector<std::shared_ptr<const geometry::Polygon>> hulls_;
  std::vector<Placed> bodies_;                                 ///< living
  std::map<std::pair<BodyKey, BodyKey>, double> crushed_;      ///< at the instant [m²]
  std::set<std::pair<BodyKey, BodyKey>> paid_;                 ///< whose work was compared
  std::map<std::pair<BodyKey, BodyKey>, std::size_t> unpaid_;  ///< in the check's list
  bool is_recorded_ = false;                                   ///< the instant is that of a frame
  std::map<std::pair<BodyKey, BodyKey>, Known> known_;
  std::set<std::pair<BodyKey, BodyKey>> overlapping_;
};

}  // namespace polynya::analysis
