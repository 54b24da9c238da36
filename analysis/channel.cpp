#include "analysis/channel.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "analysis/channel_brash.hpp"
#include "analysis/placed_ice.hpp"
#include "analysis/swept_band.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "geometry/shape/outline.hpp"
#include "io/run/placed_floes.hpp"

namespace polynya::analysis {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Vector;

std::string describe(const geometry::CutError& error) {
  return fmt::format("{}: {}", name_of(error.reason), error.detail);
}

/// Of the track and of the hull's corners [m]. Larger, and widths are off by as much; smaller, and bands have
/// more pieces, whose union takes longer.
constexpr double kTrackTolerance = 0.05;

/// The track's corners with the way to them and when they were passed.
struct Waypoint {
  Point point;        ///< carried to now [m]
  double along = 0;   ///< [m]
  double passed = 0;  ///< [s]
};

/// A point of the track by the way to it.
Waypoint at_way(const std::vector<Waypoint>& track, double along) {
  const auto next = std::ranges::upper_bound(track, along, {}, &Waypoint::along);
  if (next == track.begin()) return track.front();
  if (next == track.end()) return track.back();
  const Waypoint& a = *(next - 1);
  const double share = (along - a.along) / (next->along - a.along);
  return {a.point + share * (next->point - a.point), along, a.passed + share * (next->passed - a.passed)};
}

class ChannelMeasure {
 public:
  ChannelMeasure(const io::Run& run, const io::MotionIndex& motions, const ChannelOptions& options)
      : run_(run), motions_(motions), ship_(options.ship), time_(*options.time) {
    const simulation::PlacedHull& spec = hull_of(run.scene.scene, ship_);
    const Box box = geometry::bounding_box(spec.hull.waterline);
    channel_.ship = spec.name;
    channel_.time = time_;
    channel_.beam = box.high.y - box.low.y;
    channel_.spacing = options.spacing > 0 ? options.spacing : channel_.beam;
    channel_.reach = options.reach > 0 ? options.reach : 4 * channel_.beam;
    behind_ = -box.low.x;
  }

  tl::expected<Channel, std::string> measure() {
    find_track();
    return find_ice({})
        .and_then([&] { return find_band(); })
        .and_then([&] { return find_stations(); })
        .and_then([&] { return find_open_water(); })
        .and_then([&] { return measure_brash(channel_, cells_, brash_); })
        .map([&] { return std::move(channel_); });
  }

  tl::expected<std::vector<ChannelStation>, std::string> measure_stations() {
    is_whole_ = false;
    find_track();
    const Box near_track = grown(geometry::bounding_box(channel_.track), channel_.reach + channel_.spacing);
    return find_ice(near_track).and_then([&] { return find_stations(); }).map([&] {
      return std::move(channel_.stations);
    });
  }

 private:
  using Done = tl::expected<void, std::string>;

  Point centre_at(double time) const {
    return carried_by_water(run_.scene.scene.water, ship_pose_at(run_, motions_, ship_, time).position, time,
                            time_);
  }

  void find_track() {
    for (const double t : straight_pieces(run_, motions_, ship_, time_, kTrackTolerance)) {
      const Point p = centre_at(t);
      const double along = track_.empty() ? 0 : track_.back().along + distance(track_.back().point, p);
      if (track_.empty() || along > track_.back().along) track_.push_back({p, along, t});
      channel_.track.push_back(p);
    }
  }

  Done find_ice(const std::optional<Box>& within) {
    for (const io::PlacedFloe& floe : floes_at(run_, motions_, time_)) {
      Polygon polygon = transform(floe.world_from_body, *floe.polygon_in_body);
      if (within && !overlaps(bounding_box(polygon.outer), *within)) continue;
      if (auto done = add_ice(ice_, floe.birth, std::move(polygon)); !done) return done;
    }
    for (const PlacedIce& ice : ice_)
      (run_.floe(ice.birth->floe)->came_up ? brash_ : firm_ice_).push_back(ice);
    return {};
  }

  Done find_band() {
    auto band = union_of(swept_pieces(run_, motions_, ship_, time_, kTrackTolerance));
    if (!band) return tl::unexpected(describe(band.error()));
    channel_.swept = std::move(*band);
    std::vector<PlacedIce> ice_at_start;
    for (const auto& floe : run_.scene.scene.floes) {
      if (auto done = add_ice(ice_at_start, nullptr, floe.polygon_in_world); !done) return done;
    }
    for (const Polygon& piece : channel_.swept) {
      channel_.swept_area += geometry::measure(piece).area;
      const Polygon then = carried_by_water(run_.scene.scene.water, piece, time_, run_.start_time());
      const auto parted = part(then, near(ice_at_start, bounding_box(then.outer)));
      if (!parted) return tl::unexpected(parted.error());
      channel_.swept_ice_at_start += parted->inside_area;
    }
    return floes_in(channel_.swept, ice_).map([&](std::vector<ChannelFloe>&& floes) {
      channel_.floes = std::move(floes);
    });
  }

  /// Neighbouring cells share the corners between them: each joint has the mean of the directions
  /// beside it.
  Done find_stations() {
    const double behind_ship = track_.back().along - behind_;
    const auto count = static_cast<std::size_t>(std::max(0.0, std::floor(behind_ship / channel_.spacing)));
    std::vector<Waypoint> joints;
    for (std::size_t i = 0; i <= count; ++i)
      joints.push_back(at_way(track_, channel_.spacing * static_cast<double>(i)));
    std::vector<Vector> across;
    for (std::size_t i = 0; i <= count && count > 0; ++i) {
      const Vector chord = joints[std::min(i + 1, count)].point - joints[i == 0 ? 0 : i - 1].point;
      across.push_back(perpendicular(length(chord) > 0 ? chord / length(chord) : Vector{1, 0}));
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto cell = [&](double half) {
        return Polygon{
            geometry::convex_hull({joints[i].point + half * across[i], joints[i].point - half * across[i],
                                   joints[i + 1].point + half * across[i + 1],
                                   joints[i + 1].point - half * across[i + 1]}),
            {}};
      };
      if (auto done = add_station(joints[i], joints[i + 1], cell(channel_.reach), cell(0.5 * channel_.beam));
          !done)
        return done;
    }
    return {};
  }

  Done add_station(const Waypoint& from, const Waypoint& to, const Polygon& cell,
                   const Polygon& within_beam) {
    const Vector chord = to.point - from.point;
    if (cell.outer.size() < 3 || within_beam.outer.size() < 3 || !(length(chord) > 0)) return {};
    const Waypoint middle = at_way(track_, 0.5 * (from.along + to.along));
    ChannelStation station{.along = middle.along,
                           .passed = middle.passed,
                           .middle = midpoint(from.point, to.point),
                           .forward = chord / length(chord),
                           .length = length(chord),
                           .port = channel_.reach,
                           .starboard = channel_.reach};
    // Floe by floe, which the local cut covers: ten times faster than all of them in one arrangement.
    for (const Polygon& ice : near(firm_ice_, bounding_box(cell.outer))) {
      const auto parted = part(cell, {ice});
      if (!parted) return tl::unexpected(parted.error());
      for (const Polygon& piece : parted->inside) clear_up_to(piece, station);
    }
    if (is_whole_) {
      const auto beam = part(within_beam, near(ice_, bounding_box(within_beam.outer)));
      if (!beam) return tl::unexpected(beam.error());
      station.ice_across_beam = beam->inside_area / geometry::measure(within_beam).area;
    }
    channel_.stations.push_back(station);
    cells_.push_back(cell);
    return {};
  }

  /// The nearest point of a polygon to a straight line is at a corner, or the polygon lies across it.
  void clear_up_to(const Polygon& ice, ChannelStation& station) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point p : ice.outer) {
      const double offset = cross(station.forward, p - station.middle);
      low = std::min(low, offset);
      high = std::max(high, offset);
    }
    if (high > 0) {
      station.port = std::min(station.port, std::max(0.0, low));
      station.has_port_ice = true;
    }
    if (low < 0) {
      station.starboard = std::min(station.starboard, std::max(0.0, -high));
      station.has_starboard_ice = true;
    }
  }

  /// Brash does not part it: water beyond brash is joined to the track by it.
  Done find_open_water() {
    std::vector<Polygon> cells;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto& stations = channel_.stations;
      const auto here = stations.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::any_of(stations.begin(), here + 1, std::mem_fn(&ChannelStation::is_bounded)) &&
          std::any_of(here, stations.end(), std::mem_fn(&ChannelStation::is_bounded)))
        cells.push_back(cells_[i]);
    }
    const auto corridor = union_of(cells);
    if (!corridor) return tl::unexpected(describe(corridor.error()));
    const auto& waterline = hull_of(run_.scene.scene, ship_).hull.waterline;
    for (const Polygon& piece : *corridor) {
      std::vector<Polygon> taken = near(firm_ice_, bounding_box(piece.outer));
      taken.push_back({transform(ship_pose_at(run_, motions_, ship_, time_), waterline), {}});
      const auto parted = part(piece, taken);
      if (!parted) return tl::unexpected(parted.error());
      for (const Polygon& joined : parted->outside) {
        if (!has_track(joined)) continue;
        const auto water = part(joined, near(brash_, bounding_box(joined.outer)));
        if (!water) return tl::unexpected(water.error());
        for (const Polygon& open : water->outside) {
          channel_.open_area += geometry::measure(open).area;
          channel_.open_water.push_back(open);
        }
      }
    }
    return {};
  }

  bool has_track(const Polygon& piece) const {
    const Box box = bounding_box(piece.outer);
    const double step = channel_.spacing / 16;
    const auto points = static_cast<std::size_t>(std::ceil(track_.back().along / step - 0.5));
    for (std::size_t i = 0; i < points; ++i) {
      const Point p = at_way(track_, (static_cast<double>(i) + 0.5) * step).point;
      if (overlaps(box, {p, p}) && contains(piece, p)) return true;
    }
    return false;
  }

  const io::Run& run_;
  const io::MotionIndex& motions_;
  std::size_t ship_;
  double time_;           ///< [s]
  bool is_whole_ = true;  ///< else stations alone, without the shares that ice covers
  double behind_ = 0;     ///< from the ship's centre to its stern [m]
  std::vector<PlacedIce> ice_;
  std::vector<PlacedIce> brash_, firm_ice_;  ///< of it what came up from under a hull, and the rest
  std::vector<Waypoint> track_;
  std::vector<Polygon> cells_;  ///< of the stations
  Channel channel_;
};

/// With the time.
tl::expected<ChannelOptions, std::string> checked_options(const io::Run& run, ChannelOptions options) {
  if (options.ship >= hull_count(run.scene.scene))
    return tl::unexpected(std::string("the run has no such ship"));
  if (run.frames.empty()) return tl::unexpected(std::string("the run has no frames"));
  const double time = options.time.value_or(run.end_time());
  if (!(time >= run.start_time() && time <= run.end_time()))
    return tl::unexpected(fmt::format("there is no {:g} s: the run goes from {:g} to {:g} s", time,
                                      run.start_time(), run.end_time()));
  options.time = time;
  return options;
}

}  // namespace

double Channel::swept_ice() const {
  double sum = 0;
  for (const ChannelFloe& floe : floes) sum += floe.inside;
  return sum;
}

WidthSummary widths(const Channel& channel) {
  WidthSummary summary{0, 0, std::numeric_limits<double>::infinity(), 0};
  for (const ChannelStation& station : channel.stations) {
    if (!station.is_bounded()) continue;
    ++summary.count;
    summary.mean += station.width();
    summary.least = std::min(summary.least, station.width());
    summary.most = std::max(summary.most, station.width());
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (summary.count == 0) return {0, none, none, none};
  summary.mean /= static_cast<double>(summary.count);
  return summary;
}

tl::expected<Channel, std::string> measure_channel(const io::Run& run, const ChannelOptions& options) {
  const auto checked = checked_options(run, options);
  if (!checked) return tl::unexpected(checked.error());
  const io::MotionIndex motions(run);
  return ChannelMeasure(run, motions, *checked).measure();
}

tl::expected<std::vector<ChannelStation>, std::string> measure_stations(const io::Run& run,
                                                                        const io::MotionIndex& motions,
                                                                        const ChannelOptions& options) {
  return checked_options(run, options).and_then([&](const ChannelOptions& checked) {
    return ChannelMeasure(run, motions, checked).measure_stations();
  });
}

}  // namespace polynya::analysis
