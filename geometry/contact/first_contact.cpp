#include "geometry/contact/first_contact.hpp"

#include <algorithm>
#include <vector>

#include "geometry/cut/overlap.hpp"

namespace polynya::geometry {
namespace {

/// Of an edge's length: a vertex that meets the edge's end meets it. Without it two corners may pass each
/// other.
constexpr double kSlack = 1e-9;
/// After so much of the way a touch has become an overlap [m]. Larger, thin tips pass through and their touch
/// is found; smaller, the overlap is less than kLeastShared (their ratio is a contact 1 µm wide).
constexpr double kFurtherOn = 1e-3;
/// Less is the rounding of outlines that slide along each other [m²]: with 0 these touch at once.
constexpr double kLeastShared = 1e-9;

Vector outward_of(const Ring& ring, std::size_t edge) {
  const Vector along = ring[(edge + 1) % ring.size()] - ring[edge];
  return -perpendicular(along) / length(along);
}

/// When a vertex moving at `velocity` meets an edge of a counter-clockwise ring from outside, if it does [s].
std::optional<double> entry_time(Point vertex, Vector velocity, const Ring& ring, std::size_t edge) {
  const Point start = ring[edge];
  const Vector outward = outward_of(ring, edge);
  const double speed_in = -dot(velocity, outward);
  if (!(speed_in > 0)) return {};
  const double time = dot(vertex - start, outward) / speed_in;
  const double along = dot(vertex + time * velocity - start, perpendicular(outward));
  const double size = distance(start, ring[(edge + 1) % ring.size()]);
  if (along < -kSlack * size || along > (1 + kSlack) * size) return {};
  return time;
}

/// Every vertex of one ring on every edge of the other.
std::vector<FirstContact> meetings(const Ring& a, const Ring& b, Vector velocity, double from, double until) {
  std::vector<FirstContact> found;
  const auto collect = [&](const Ring& moving, const Ring& resting, Vector relative, bool is_b_resting) {
    for (std::size_t i = 0; i < resting.size(); ++i) {
      for (const Point vertex : moving) {
        const auto time = entry_time(vertex, relative, resting, i);
        if (!time || *time < from || *time > until) continue;
        if (is_b_resting)
          found.push_back({*time, vertex, -outward_of(resting, i)});
        else
          found.push_back({*time, vertex + *time * relative, outward_of(resting, i)});
      }
    }
  };
  collect(b, a, velocity, false);
  collect(a, b, -velocity, true);
  std::ranges::stable_sort(found, {}, &FirstContact::time);
  return found;
}

bool overlap_at(const Ring& a, const Ring& b, Vector shift_of_b) {
  const auto shared = overlap({{a, {}}}, {}, {{b, {}}}, {Point{} + shift_of_b, {}});
  return !shared || shared->area > kLeastShared;
}

}  // namespace

std::optional<FirstContact> first_contact(const Ring& a, const Ring& b, Vector velocity, double from, double until) {
  if (velocity == Vector{}) return {};
  for (const FirstContact& touch : meetings(a, b, velocity, from, until)) {
    const double later = touch.time + kFurtherOn / length(velocity);
    if (overlap_at(a, b, later * velocity)) return touch;
  }
  return {};
}

}  // namespace polynya::geometry
