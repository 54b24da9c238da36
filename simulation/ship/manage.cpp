#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "elementary/elementary.hpp"
#include "simulation/ship/pattern.hpp"
#include "simulation/ship/pilot.hpp"

namespace polynya::simulation {

using geometry::Point;
using geometry::Vector;

// ---- lines of patterns

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kCorners = 32;  ///< number of legs of a full turn; fewer make arcs angular

/// Range of angles of an arc, and the number of its legs.
struct ArcSpan {
  double from = 0;  ///< angle of the first corner from the x axis [rad]
  double to = 0;    ///< angle of the last corner [rad]
  int legs = kCorners;
};

/// Appends the corners of an arc of an ellipse to a ring. `half_axes` are the half-axes along x and y [m].
void add_arc(Point centre, Vector half_axes, const ArcSpan& arc, geometry::Ring& ring) {
  for (int i = 0; i <= arc.legs; ++i) {
    const double angle = arc.from + (arc.to - arc.from) * i / arc.legs;
    ring.push_back(centre + Vector{half_axes.x * elementary::cos(angle), half_axes.y * elementary::sin(angle)});
  }
}

/// Returns the corners of a pattern in its frame.
geometry::Ring corners_of(const ManagingPilot& pilot) {
  const double far = pilot.distance + 0.5 * pilot.depth;
  const double near = pilot.distance - 0.5 * pilot.depth;
  const double half = 0.5 * pilot.width;
  geometry::Ring ring;
  switch (pilot.pattern) {
    case ManagementPattern::kLinear:
      ring = {{far, -half}, {far, half}, {near, half}, {near, -half}};
      break;
    case ManagementPattern::kSector: {
      const double angle = half / pilot.distance;
      add_arc({}, {far, far}, {-angle, angle, kCorners / 2}, ring);
      add_arc({}, {near, near}, {angle, -angle, kCorners / 2}, ring);
      break;
    }
    case ManagementPattern::kRacetrack: {
      const double radius = 0.5 * pilot.depth;
      add_arc({pilot.distance, half - radius}, {radius, radius}, {0, kPi, kCorners / 2}, ring);
      add_arc({pilot.distance, radius - half}, {radius, radius}, {kPi, 2 * kPi, kCorners / 2}, ring);
      break;
    }
    case ManagementPattern::kCircular:
    case ManagementPattern::kLargestFloe:
      add_arc({pilot.distance, 0}, {0.5 * pilot.depth, half}, {0, 2 * kPi, kCorners}, ring);
      break;
  }
  return ring;
}

}  // namespace

std::size_t PatternLine::leg_at(double place) const {
  const auto after = std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, place);
  return static_cast<std::size_t>(after - arc_length.begin()) - 1;
}

Point PatternLine::at(double place) const {
  const std::size_t leg = leg_at(place);
  return corners[leg] + (place - arc_length[leg]) * direction(leg);
}

Vector PatternLine::direction(std::size_t leg) const {
  return (corners[next(leg)] - corners[leg]) / (arc_length[leg + 1] - arc_length[leg]);
}

bool PatternLine::is_sharp_after(std::size_t leg) const {
  return dot(direction(leg), direction(next(leg))) < 0.5;
}

PatternLine line_of(const ManagingPilot& pilot) {
  constexpr double kShortest = 1e-3;  // shortest leg; nearer corners are merged [m]
  PatternLine line;
  for (const Point corner : corners_of(pilot))
    if (line.corners.empty() || distance(line.corners.back(), corner) > kShortest) line.corners.push_back(corner);
  while (line.corners.size() > 2 && distance(line.corners.back(), line.corners.front()) <= kShortest)
    line.corners.pop_back();
  line.arc_length.push_back(0);
  for (std::size_t i = 0; i < line.corners.size(); ++i)
    line.arc_length.push_back(line.arc_length.back() + distance(line.corners[i], line.corners[line.next(i)]));
  return line;
}

double least_distance(const PatternLine& line, double ahead) {
  // Number of places on a lap that are compared; fewer may miss a near approach between two of them.
  constexpr int kPlacesOnLap = 360;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPlacesOnLap; ++i) {
    const double place = line.lap() * i / kPlacesOnLap;
    least = std::min(least, distance(line.at(place), line.at(std::fmod(place + ahead * line.lap(), line.lap()))));
  }
  return least;
}

// ---- motion of ships on patterns

namespace {

/// Distance ahead on the pattern to which a ship steers, in ship lengths [-]. Smaller: the ship oscillates about the
/// line. Larger: it cuts corners.
constexpr double kLookAhead = 1.5;
/// Distance before a sharp corner at which a ship begins to turn, in ship lengths [-]. Larger: it cuts the corner.
/// Smaller: it overshoots the corner. Within the same distance of the floe to which it sails, the floe is reached.
constexpr double kTurnBefore = 0.5;
/// Smallest drift of the ice from which the upstream direction is computed [m/s]. With a slower drift the last
/// direction is kept.
constexpr double kLeastDrift = 0.02;
/// Smallest factor on its speed by which a ship waits for the other ships of its pattern [-]. Closer to 1: phases are
/// corrected more slowly.
constexpr double kSlowestInPattern = 0.5;
/// Largest factor on its speed by which a ship catches up with the other ships [-]. Closer to 1: phases are corrected
/// more slowly.
constexpr double kFastestInPattern = 1.3;
/// Change of that factor per error of the phase in laps [-]. Larger: phases are corrected sooner, and speeds vary more.
constexpr double kPhaseGain = 4;
/// Smallest speed through the water that is assumed of a ship whose lever is given [m/s]. It keeps the course defined
/// for a ship that is stopped.
constexpr double kLeastWayThrough = 1;
/// Time ahead within which a ship gives way to another [s]. Longer: it also turns for ships that are far away. Shorter:
/// it turns later and more sharply.
constexpr double kHorizon = 120;
/// Time between two choices of a floe [s]. Longer: a ship goes on to the next floe later. Shorter: costs time, because
/// all floes are examined.
constexpr double kChoiceInterval = 10;
/// Time constant of approaching the station while there is no floe [s]. Shorter: the ship arrives faster and may
/// overshoot.
constexpr double kStationTime = 60;

/// Position and motion of the protected body and the pattern at an instant.
struct Frame {
  Point body;       ///< position of the body; of a pattern that drifts, displaced with it [m]
  Vector upstream;  ///< unit vector against the drift of the ice
  Vector velocity;  ///< velocity of the pattern's frame over ground [m/s]
  Vector water;     ///< velocity of the water at the ship over ground [m/s]
  Vector in_pattern(Vector v) const { return {dot(v, upstream), cross(upstream, v)}; }
  Vector over_ground(Vector v) const { return v.x * upstream + v.y * perpendicular(upstream); }
};

/// Returns the frame of a pattern, and stores its upstream direction.
Frame frame_of(const ManagingPilot& pilot, const PilotView& view, PatternMemory& memory) {
  if (length(view.ice_drift) >= kLeastDrift) memory.upstream = angle_of(-view.ice_drift);
  const SeenHull& body = view.hulls[static_cast<std::size_t>(pilot.body_index)];
  Frame frame;
  frame.body = body.position_in_world + memory.carried;
  frame.upstream = unit(memory.upstream);
  frame.velocity = pilot.drifts_with_ice ? view.ice_drift : body.velocity;
  const Vector ahead = unit(view.own().heading);
  frame.water = view.own().velocity - view.through_water.surge * ahead - view.through_water.sway * perpendicular(ahead);
  return frame;
}

/// Advances the ship's place on the lap to the point of its leg that is abreast of it, and to the next leg near the end
/// of the leg. `place` is in metres from the first corner; it becomes 0 when a lap is completed.
void go_on(const PatternLine& line, Point ship, double own_length, double& place) {
  for (std::size_t legs = 0; legs < line.corners.size(); ++legs) {
    const std::size_t leg = line.leg_at(place);
    const double length = line.arc_length[leg + 1] - line.arc_length[leg];
    const double along = dot(ship - line.corners[leg], line.direction(leg));
    const double before = line.is_sharp_after(leg) ? std::min(kTurnBefore * own_length, 0.5 * length) : 0;
    if (along < length - before) {
      place = std::max(place, line.arc_length[leg] + along);
      return;
    }
    place = leg + 1 < line.corners.size() ? line.arc_length[leg + 1] : 0;
    if (place == 0) return;
  }
}

/// Returns the point of the line to which a ship steers, at a distance ahead of its place [m]. Beyond a sharp corner
/// the leg is extended straight.
Point point_ahead(const PatternLine& line, double place, double ahead) {
  std::size_t leg = line.leg_at(place);
  double left = line.arc_length[leg + 1] - place;
  while (ahead > left && !line.is_sharp_after(leg)) {
    ahead -= left;
    leg = line.next(leg);
    left = line.arc_length[leg + 1] - line.arc_length[leg];
  }
  return line.corners[line.next(leg)] + (ahead - left) * line.direction(leg);
}

/// Returns the factor on the speed of a ship that keeps its phase relative to the other ships of its pattern [-]. It is
/// above 1 if the others are ahead of their phases on average.
double pace(const ManagingPilot& pilot, const PilotView& view, double own_place) {
  double error = 0;
  for (const PatternPartner& partner : pilot.partners) {
    const double place = view.hulls[static_cast<std::size_t>(partner.ship)].lap_share - partner.phase;
    error += std::remainder(place - (own_place - pilot.phase), 1.0);
  }
  if (!pilot.partners.empty()) error /= static_cast<double>(pilot.partners.size());
  return std::clamp(1 + kPhaseGain * error, kSlowestInPattern, kFastestInPattern);
}

/// Returns the velocity over ground of a ship that moves along a direction in the frame of the pattern: at `share` of
/// the speed given for that frame, or at its own speed through the water if the lever is given.
Vector along(Vector direction, double share, const ManagingPilot& pilot, const PilotView& view, const Frame& frame) {
  if (pilot.speed > 0) return frame.velocity + share * pilot.speed * direction;
  const double through = std::max(view.through_water.surge, kLeastWayThrough);
  const Vector against = frame.water - frame.velocity;
  const double across = std::clamp(cross(direction, against), -through, through);
  return frame.velocity + (dot(against, direction) + std::sqrt(through * through - across * across)) * direction;
}

/// Returns the velocity over ground of a ship that follows the line of a pattern, and updates its place on the lap.
Vector on_pattern(const ManagingPilot& pilot, const PilotView& view, Frame& frame, PatternMemory& memory) {
  const PatternLine line = line_of(pilot);
  if (memory.lap_share < 0) memory.lap_share = pilot.phase;
  const auto ship = [&] { return Point{} + frame.in_pattern(view.own().position_in_world - frame.body); };
  double place = memory.lap_share * line.lap();
  go_on(line, ship(), view.own().length, place);
  const double share = place / line.lap();
  const bool is_new_lap = share - memory.lap_share < -0.5;
  memory.lap_share = share;
  if (pilot.drifts_with_ice) {
    if (is_new_lap) {
      frame.body = frame.body - memory.carried;
      memory.carried = {};
    }
    memory.carried += view.step * view.ice_drift;
  }
  const Vector course = point_ahead(line, place, kLookAhead * view.own().length) - ship();
  return along(frame.over_ground(course / std::max(length(course), 1e-9)), pace(pilot, view, share), pilot, view,
               frame);
}

/// Returns true if another ship sails to a floe.
bool is_taken(const PilotView& view, FloeId floe) {
  for (std::size_t i = 0; i < view.hulls.size(); ++i)
    if (static_cast<int>(i) != view.ship && view.hulls[i].target_floe == floe) return true;
  return false;
}

/// Chooses the largest floe in the box of the pattern to which no other ship sails. The present floe is kept until it
/// has broken, or has been reached, or has drifted out of the box.
void choose_floe(const ManagingPilot& pilot, const PilotView& view, const Frame& frame, PatternMemory& memory) {
  const FloeId before = memory.target;
  const bool is_reached = length(memory.target_at - view.own().position_in_world) < kTurnBefore * view.own().length;
  memory.target = kNoFloe;
  double largest = 0;
  for (const SeenFloe& floe : view.floes()) {
    const Vector place = frame.in_pattern(floe.position_in_world - frame.body);
    const bool is_ahead = std::abs(place.x - pilot.distance) <= 0.5 * pilot.depth;
    const double half_floe = 0.5 * std::sqrt(floe.area);
    if (!is_ahead || std::abs(place.y) > 0.5 * pilot.width + half_floe || floe.area < pilot.least_floe) continue;
    if (floe.floe == before ? is_reached : is_taken(view, floe.floe)) continue;
    if (floe.floe != before && floe.area <= largest) continue;
    memory.target = floe.floe;
    memory.target_at = floe.position_in_world;
    largest = floe.area;
    if (floe.floe == before) return;
  }
}

/// Returns the velocity over ground of a ship that sails to the largest floe, or to its station while there is none.
Vector to_largest_floe(const ManagingPilot& pilot, const PilotView& view, const Frame& frame, PatternMemory& memory) {
  memory.target_at += view.step * view.ice_drift;
  if (view.time >= memory.next_choice && view.floes) {
    choose_floe(pilot, view, frame, memory);
    memory.next_choice = view.time + kChoiceInterval;
  }
  const bool is_waiting = memory.target == kNoFloe;
  const Point station = frame.body + pilot.distance * frame.upstream;
  const Vector course = (is_waiting ? station : memory.target_at) - view.own().position_in_world;
  const double far = length(course);
  const double speed = pilot.speed > 0 ? pilot.speed : std::max(view.through_water.surge, kLeastWayThrough);
  const double share = is_waiting ? std::min(1.0, far / (kStationTime * speed)) : 1;
  return along(course / std::max(far, 1e-9), share, pilot, view, frame);
}

/// Returns a velocity over ground that passes another hull at a distance of at least `distance` [m], turned as little
/// as the rule of passing allows. The ship leaves another ship to port, as both do. It passes a hull that stands
/// (`stands`) on the side on which it would pass anyway. Within the distance, it moves away.
Vector clear_of(const SeenHull& other, bool stands, double distance, const PilotView& view, Vector velocity) {
  const Vector to_other = other.position_in_world - view.own().position_in_world;
  const double far = length(to_other);
  const Vector towards = to_other / std::max(far, 1e-9);
  const Vector relative = velocity - other.velocity;
  const double closing = dot(relative, towards);
  const double speed = length(relative);
  if (far <= distance) return velocity + (std::max(closing, 0.0) + 0.5 * speed) * -towards;
  if (closing <= 0 || far > distance + kHorizon * speed) return velocity;
  const double passes = elementary::asin(std::min(1.0, distance / far));
  const double off = elementary::atan2(cross(towards, relative), closing);
  if (std::abs(off) >= passes) return velocity;
  const double side = stands && off > 0 ? 1 : -1;
  return other.velocity + speed * unit(angle_of(towards) + side * passes);
}

/// Returns a velocity over ground that keeps clear of all ships, of all structures and of the protected body, which is
/// considered last and has therefore priority. Distances are between centres (ManagingPilot::safety_radius).
Vector clear_of_all(const ManagingPilot& pilot, const PilotView& view, Vector velocity) {
  const auto distance_to = [&](const SeenHull& other) {
    return pilot.safety_radius > 0 ? pilot.safety_radius : view.own().length + other.length;
  };
  for (std::size_t i = 0; i < view.hulls.size(); ++i) {
    const bool is_other = static_cast<int>(i) != view.ship && static_cast<int>(i) != pilot.body_index;
    if (is_other && !view.hulls[i].is_wall)
      velocity = clear_of(view.hulls[i], view.hulls[i].is_fixed, distance_to(view.hulls[i]), view, velocity);
  }
  const SeenHull& body = view.hulls[static_cast<std::size_t>(pilot.body_index)];
  return clear_of(body, true, distance_to(body), view, velocity);
}

}  // namespace

Command steer(const ManagingPilot& pilot, const PilotView& view, PilotMemory& memory) {
  Frame frame = frame_of(pilot, view, memory.pattern);
  const bool is_on_line = pilot.pattern != ManagementPattern::kLargestFloe;
  Vector velocity =
      is_on_line ? on_pattern(pilot, view, frame, memory.pattern) : to_largest_floe(pilot, view, frame, memory.pattern);
  velocity = clear_of_all(pilot, view, velocity);
  const Vector through_water = velocity - frame.water;
  const double lever = pilot.speed > 0 ? lever_to_hold(length(through_water), view, memory) : pilot.lever;
  return {lever, steering_to_hold(angle_of(through_water), view)};
}

}  // namespace polynya::simulation
