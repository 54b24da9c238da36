#include "analysis/channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "analysis/run_listing.hpp"
#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/shape/outline.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::analysis {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;
using io::GeojsonLayer;

/// Largest error of the simplified track and hull corners [m]. A larger value makes widths wrong by as much; a smaller
/// one makes bands of more pieces, whose union takes longer.
constexpr double kTrackTolerance = 0.05;

/// Limits of a channel that pictures show. Ice farther apart than the widest channel was not separated by the ship. On
/// a track with a smaller radius of turn, neighbouring cells overlap on the inner side. A ship that moves at a larger
/// angle to its heading is driven by the ice and opens no channel.
constexpr double kWidestChannel = 3;  ///< [beams]
constexpr double kTightestTurn = 4;   ///< radius [beams]
constexpr double kMostDrift = 0.5;    ///< largest angle between the heading and the track [rad]

/// A corner of the track.
struct Waypoint {
  Point point;        ///< carried with the water to the instant [m]
  double along = 0;   ///< distance from the beginning of the track [m]
  double passed = 0;  ///< time at which the ship was there [s]
};

/// Returns the point of the track at a distance from its beginning [m].
Waypoint at_way(const std::vector<Waypoint>& track, double along) {
  const auto next = std::ranges::upper_bound(track, along, {}, &Waypoint::along);
  if (next == track.begin()) return track.front();
  if (next == track.end()) return track.back();
  const Waypoint& a = *(next - 1);
  const double share = (along - a.along) / (next->along - a.along);
  return {a.point + share * (next->point - a.point), along, a.passed + share * (next->passed - a.passed)};
}

std::vector<PlacedIce> with_boxes(const std::vector<Polygon>& polygons) {
  std::vector<PlacedIce> boxed;
  boxed.reserve(polygons.size());
  for (const Polygon& polygon : polygons) boxed.push_back({nullptr, polygon, bounding_box(polygon.outer)});
  return boxed;
}

/// Returns the part of a convex ring where `distance`, a linear function of the point, is not negative.
template <class Distance>
Ring clipped(const Ring& ring, Distance distance) {
  Ring kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    const double at_a = distance(a), at_b = distance(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

/// Returns the part of a station's cell from ice to ice; it has fewer than three corners if there is none.
Polygon from_ice_to_ice(const ChannelStation& station, const Polygon& cell) {
  if (!station.is_bounded() || !(station.width() > 0)) return {};
  const auto to_port = [&](Point p) { return cross(station.forward, p - station.middle); };
  const Ring to_starboard_of_port = clipped(cell.outer, [&](Point p) { return station.port - to_port(p); });
  return {clipped(to_starboard_of_port, [&](Point p) { return station.starboard + to_port(p); }), {}};
}

/// Returns the floes that extend into polygons, with their area inside, the largest floe first.
io::Result<std::vector<ChannelFloe>> floes_in(const std::vector<Polygon>& polygons, const std::vector<PlacedIce>& ice) {
  std::vector<ChannelFloe> floes;
  const std::vector<PlacedIce> boxed = with_boxes(polygons);
  for (const PlacedIce& floe : ice) {
    const auto parted = part(floe.polygon, near(boxed, floe.box));
    if (!parted) return io::fail(parted.error());
    if (parted->inside_area <= 0) continue;
    if (floes.empty() || floes.back().floe != floe.birth->floe)
      floes.push_back({floe.birth->floe, std::sqrt(floe.birth->area), floe.birth->area, 0});
    floes.back().inside += parted->inside_area;
  }
  std::ranges::stable_sort(floes, std::ranges::greater{}, &ChannelFloe::size);
  return floes;
}

/// Measures the brash from ice to ice, in the cells of the stations and for each piece.
io::Result<> measure_brash(Channel& channel, const std::vector<Polygon>& cells, const std::vector<PlacedIce>& brash) {
  std::vector<Polygon> stretches;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ChannelStation& station = channel.stations[i];
    Polygon stretch = from_ice_to_ice(station, cells[i]);
    if (stretch.outer.size() < 3) continue;
    auto parted = part(stretch, near(brash, bounding_box(stretch.outer)));
    if (!parted) return io::fail(parted.error());
    channel.area += station.channel_area = geometry::measure(stretch).area;
    channel.brash_area += station.brash_area = parted->inside_area;
    for (Polygon& covered : parted->inside) channel.brash.push_back(std::move(covered));
    stretches.push_back(std::move(stretch));
  }
  return floes_in(stretches, brash).map([&](std::vector<ChannelFloe>&& pieces) {
    channel.brash_pieces = std::move(pieces);
  });
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

  io::Result<Channel> measure() {
    find_track();
    return find_ice({})
        .and_then([&] { return find_band(); })
        .and_then([&] { return find_stations(); })
        .and_then([&] { return find_open_water(); })
        .and_then([&] { return measure_brash(channel_, cells_, brash_); })
        .map([&] { return std::move(channel_); });
  }

  io::Result<std::vector<ChannelStation>> measure_stations() {
    is_whole_ = false;
    find_track();
    const Box near_track = grown(geometry::bounding_box(channel_.track), channel_.reach + channel_.spacing);
    return find_ice(near_track).and_then([&] { return find_stations(); }).map([&] {
      return std::move(channel_.stations);
    });
  }

 private:
  using Done = io::Result<>;

  Point centre_at(double time) const {
    return carried_by_water(run_.scene.scene.water, ship_pose_at(run_, motions_, ship_, time).position, time, time_);
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
    for (const PlacedIce& ice : ice_) (run_.floe(ice.birth->floe)->came_up ? brash_ : firm_ice_).push_back(ice);
    return {};
  }

  Done find_band() {
    auto band = union_of(swept_pieces(run_, motions_, ship_, time_, kTrackTolerance));
    if (!band) return io::fail(to_string(band.error()));
    channel_.swept = std::move(*band);
    std::vector<PlacedIce> ice_at_start;
    for (const auto& floe : run_.scene.scene.floes) {
      if (auto done = add_ice(ice_at_start, nullptr, floe.polygon_in_world); !done) return done;
    }
    for (const Polygon& piece : channel_.swept) {
      channel_.swept_area += geometry::measure(piece).area;
      const Polygon then = carried_by_water(run_.scene.scene.water, piece, time_, run_.start_time());
      const auto parted = part(then, near(ice_at_start, bounding_box(then.outer)));
      if (!parted) return io::fail(parted.error());
      channel_.swept_ice_at_start += parted->inside_area;
    }
    return floes_in(channel_.swept, ice_).map([&](std::vector<ChannelFloe>&& floes) {
      channel_.floes = std::move(floes);
    });
  }

  /// Makes the cells of the stations. Neighbouring cells have common corners, because the direction at each joint is
  /// the mean of the directions of the two cells.
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
    // A joint at the end of the track has the direction of its only cell. From there to the other joint the direction
    // changes by half of the cell's turn.
    const auto turn_in_cell = [&](std::size_t i) {
      const double between = std::atan2(cross(across[i], across[i + 1]), dot(across[i], across[i + 1]));
      return i == 0 || i + 1 == count ? 2 * between : between;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t before = channel_.stations.size();
      const auto cell = [&](double half) {
        return Polygon{geometry::convex_hull({joints[i].point + half * across[i], joints[i].point - half * across[i],
                                              joints[i + 1].point + half * across[i + 1],
                                              joints[i + 1].point - half * across[i + 1]}),
                       {}};
      };
      if (auto done = add_station(joints[i], joints[i + 1], cell(channel_.reach), cell(0.5 * channel_.beam)); !done)
        return done;
      if (channel_.stations.size() > before)
        channel_.stations.back().is_channel = is_channel(channel_.stations.back(), turn_in_cell(i));
    }
    return {};
  }

  /// Returns true if the ship cut the channel at a station. `turn` is the change of direction of the track in its cell
  /// [rad].
  bool is_channel(const ChannelStation& station, double turn) const {
    const simulation::Scene& scene = run_.scene.scene;
    const bool is_moored = ship_ < scene.ships.size() && scene.ships[ship_].mooring.has_value();
    const Vector ahead = rotate(ship_pose_at(run_, motions_, ship_, station.passed).rotation, Vector{1, 0});
    const double drift = std::atan2(std::abs(cross(ahead, station.forward)), std::abs(dot(ahead, station.forward)));
    return !is_moored && station.is_bounded() && station.width() <= kWidestChannel * channel_.beam &&
           std::abs(turn) * kTightestTurn * channel_.beam <= station.length && drift <= kMostDrift;
  }

  Done add_station(const Waypoint& from, const Waypoint& to, const Polygon& cell, const Polygon& within_beam) {
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
    // Cutting one floe after the other is ten times faster than cutting with all at once, because the local cut can be
    // used.
    for (const Polygon& ice : near(firm_ice_, bounding_box(cell.outer))) {
      const auto parted = part(cell, {ice});
      if (!parted) return io::fail(parted.error());
      for (const Polygon& piece : parted->inside) clear_up_to(piece, station);
    }
    if (is_whole_) {
      const auto beam = part(within_beam, near(ice_, bounding_box(within_beam.outer)));
      if (!beam) return io::fail(beam.error());
      station.ice_across_beam = beam->inside_area / geometry::measure(within_beam).area;
    }
    channel_.stations.push_back(station);
    cells_.push_back(cell);
    return {};
  }

  /// Updates the distances to ice. The point of a polygon nearest to a straight line is a corner, unless the polygon
  /// crosses the line.
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

  /// Finds the open water. Brash does not separate it: water beyond brash belongs to it.
  Done find_open_water() {
    std::vector<Polygon> cells;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto& stations = channel_.stations;
      const auto here = stations.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::any_of(stations.begin(), here + 1, std::mem_fn(&ChannelStation::is_bounded)) &&
          std::any_of(here, stations.end(), std::mem_fn(&ChannelStation::is_bounded)))
        cells.push_back(cells_[i]);
    }
    std::vector<Polygon> cut;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (channel_.stations[i].is_channel) cut.push_back(cells_[i]);
    return open_water_in(cells)
        .and_then([&](std::vector<Polygon> water) {
          for (const Polygon& open : water) channel_.open_area += geometry::measure(open).area;
          channel_.open_water = std::move(water);
          return open_water_in(cut);
        })
        .map([&](std::vector<Polygon> water) { channel_.cut_water = std::move(water); });
  }

  /// Returns the water in these cells that neither floes nor the hull cover, and that water or brash connects to the
  /// track.
  io::Result<std::vector<Polygon>> open_water_in(const std::vector<Polygon>& cells) const {
    std::vector<Polygon> found;
    const auto corridor = union_of(cells);
    if (!corridor) return io::fail(to_string(corridor.error()));
    const auto& waterline = hull_of(run_.scene.scene, ship_).hull.waterline;
    for (const Polygon& piece : *corridor) {
      std::vector<Polygon> taken = near(firm_ice_, bounding_box(piece.outer));
      taken.push_back({transform(ship_pose_at(run_, motions_, ship_, time_), waterline), {}});
      const auto parted = part(piece, taken);
      if (!parted) return io::fail(parted.error());
      for (const Polygon& joined : parted->outside) {
        if (!has_track(joined)) continue;
        const auto water = part(joined, near(brash_, bounding_box(joined.outer)));
        if (!water) return io::fail(water.error());
        for (const Polygon& open : water->outside) found.push_back(open);
      }
    }
    return found;
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
  bool is_whole_ = true;  ///< false: only stations, without the fractions that ice covers
  double behind_ = 0;     ///< distance from the ship's centre to its stern [m]
  std::vector<PlacedIce> ice_;
  std::vector<PlacedIce> brash_, firm_ice_;  ///< ice that surfaced from under a hull, and all other ice
  std::vector<Waypoint> track_;
  std::vector<Polygon> cells_;  ///< cells of the stations
  Channel channel_;
};

/// Checks the options and fills in the time.
io::Result<ChannelOptions> checked_options(const io::Run& run, ChannelOptions options) {
  if (options.ship >= hull_count(run.scene.scene)) return io::fail("the run has no ship or structure");
  if (run.frames.empty()) return io::fail("the run has no frames");
  const double time = options.time.value_or(run.end_time());
  if (!(time >= run.start_time() && time <= run.end_time()))
    return io::fail(
        fmt::format("there is no {:g} s: the run goes from {:g} to {:g} s", time, run.start_time(), run.end_time()));
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

io::Result<Channel> measure_channel(const io::Run& run, const ChannelOptions& options) {
  const auto checked = checked_options(run, options);
  if (!checked) return io::fail(checked.error());
  const io::MotionIndex motions(run);
  return ChannelMeasure(run, motions, *checked).measure();
}

io::Result<std::vector<ChannelStation>> measure_stations(const io::Run& run, const io::MotionIndex& motions,
                                                         const ChannelOptions& options) {
  return checked_options(run, options).and_then([&](const ChannelOptions& checked) {
    return ChannelMeasure(run, motions, checked).measure_stations();
  });
}

double ChannelStation::brash_cover() const {
  return channel_area > 0 ? brash_area / channel_area : std::numeric_limits<double>::quiet_NaN();
}

double Channel::brash_cover() const {
  return area > 0 ? brash_area / area : std::numeric_limits<double>::quiet_NaN();
}

BrashSizes brash_sizes(const Channel& channel) {
  BrashSizes sizes{.count = channel.brash_pieces.size()};
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (sizes.count == 0) return {0, none, none, none};
  for (const ChannelFloe& piece : channel.brash_pieces) sizes.mean += piece.size / static_cast<double>(sizes.count);
  sizes.median = channel.brash_pieces[(sizes.count - 1) / 2].size;
  sizes.largest = channel.brash_pieces.front().size;
  return sizes;
}

namespace {

/// A number of a station in channel.csv and channel.geojson.
struct StationColumn {
  const char* name;
  double (*read)(const ChannelStation& station, double beam);
};
constexpr StationColumn kStationColumns[] = {
    {"along_m", [](const ChannelStation& s, double) { return s.along; }},
    {"passed_s", [](const ChannelStation& s, double) { return s.passed; }},
    {"x_m", [](const ChannelStation& s, double) { return s.middle.x; }},
    {"y_m", [](const ChannelStation& s, double) { return s.middle.y; }},
    {"track_deg",
     [](const ChannelStation& s, double) { return 180 / std::numbers::pi * std::atan2(s.forward.y, s.forward.x); }},
    {"port_m", [](const ChannelStation& s, double) { return s.port; }},
    {"starboard_m", [](const ChannelStation& s, double) { return s.starboard; }},
    {"width_m", [](const ChannelStation& s, double) { return s.width(); }},
    {"width_over_beam", [](const ChannelStation& s, double beam) { return s.width() / beam; }},
    {"has_port_ice", [](const ChannelStation& s, double) { return s.has_port_ice ? 1.0 : 0.0; }},
    {"has_starboard_ice", [](const ChannelStation& s, double) { return s.has_starboard_ice ? 1.0 : 0.0; }},
    {"ice_across_beam", [](const ChannelStation& s, double) { return s.ice_across_beam; }},
    {"channel_area_m2", [](const ChannelStation& s, double) { return s.channel_area; }},
    {"brash_area_m2", [](const ChannelStation& s, double) { return s.brash_area; }},
    {"brash_cover", [](const ChannelStation& s, double) { return s.brash_cover(); }},
    {"is_channel", [](const ChannelStation& s, double) { return s.is_channel ? 1.0 : 0.0; }}};

std::string side(double width, bool has_ice) {
  return has_ice ? fmt::format("{:.2f}", width) : fmt::format(">{:.2f}", width);
}

/// Returns the cell of the table with the brash cover.
std::string brash_cell(const ChannelStation& station) {
  return station.channel_area > 0 ? fmt::format(" {:>10.2f}", 100 * station.brash_cover())
                                  : fmt::format(" {:>10}", "-");
}

std::string size_table(const Channel& channel) {
  if (channel.floes.empty()) return "";
  std::vector<SizedFloe> floes;
  for (const ChannelFloe& floe : channel.floes) floes.push_back({floe.size, floe.inside});
  std::ranges::reverse(floes);
  std::string text =
      fmt::format("{:>10} {:>10} {:>8} {:>16} {:>10}\n", "from_m", "below_m", "floes", "inside_area_m2", "from_on");
  for (const SizeClass& one : size_classes(floes))
    text +=
        fmt::format("{:>10g} {:>10g} {:>8} {:>16.4f} {:>10}\n", one.from, one.below, one.count, one.area, one.from_on);
  return text;
}

std::string summary_lines(const Channel& channel) {
  const WidthSummary width = widths(channel);
  std::string text;
  if (width.count == 0)
    text += "no station has ice on both sides within reach: nothing to call a width\n";
  else
    text += fmt::format("width  mean {:.2f} m, least {:.2f} m, most {:.2f} m; over the beam {:.2f}, {:.2f}, {:.2f}\n",
                        width.mean, width.least, width.most, width.mean / channel.beam, width.least / channel.beam,
                        width.most / channel.beam);
  const double swept = channel.swept_area;
  text += fmt::format(
      "swept by the hull  {:.2f} m2; ice covered {:.2f} % of it at the start, {:.2f} % now ({:.2f} m2)\n", swept,
      100 * channel.swept_ice_at_start / swept, 100 * channel.swept_ice() / swept, channel.swept_ice());
  if (channel.floes.empty())
    text += "no floe is left in it\n";
  else
    text += fmt::format("largest floe in it  floe {}, {:.2f} m (root of its area), {:.2f} m2 of it inside\n",
                        channel.floes.front().floe, channel.floes.front().size, channel.floes.front().inside);
  text += fmt::format("open water joined to the track, up to {:g} m to either side  {:.2f} m2\n", channel.reach,
                      channel.open_area);
  return text;
}

/// Returns lines about brash; empty if no ice surfaced from under a hull.
std::string brash_lines(const Channel& channel) {
  if (channel.brash_pieces.empty()) return "";
  const BrashSizes sizes = brash_sizes(channel);
  return fmt::format(
      "brash covers {:.2f} % of the {:.2f} m2 from ice to ice, {:.2f} % is open water\n"
      "pieces of brash  {}; mean {:.2f} m, median {:.2f} m, largest {:.2f} m (root of the area)\n",
      100 * channel.brash_cover(), channel.area, 100 * (1 - channel.brash_cover()), sizes.count, sizes.mean,
      sizes.median, sizes.largest);
}

void append(io::JsonWriter& json, const Channel& channel) {
  const WidthSummary width = widths(channel);
  json.key("ship").value(channel.ship).key("t_s").value(channel.time);
  json.key("beam_m").value(channel.beam).key("spacing_m").value(channel.spacing);
  json.key("reach_m").value(channel.reach).key("stations").value(channel.stations.size());
  json.key("bounded_stations").value(width.count);
  json.key("mean_width_m").value(width.mean).key("least_width_m").value(width.least);
  json.key("most_width_m").value(width.most);
  json.key("swept_area_m2").value(channel.swept_area);
  json.key("swept_ice_at_start_m2").value(channel.swept_ice_at_start);
  json.key("swept_ice_m2").value(channel.swept_ice());
  json.key("floes_in_band").value(channel.floes.size());
  json.key("largest_floe_m").value(channel.floes.empty() ? 0 : channel.floes.front().size);
  json.key("open_area_m2").value(channel.open_area);
  json.key("channel_area_m2").value(channel.area).key("brash_area_m2").value(channel.brash_area);
  json.key("brash_cover").value(channel.brash_cover());
  const BrashSizes sizes = brash_sizes(channel);
  json.key("brash_pieces").value(sizes.count).key("mean_piece_m").value(sizes.mean);
  json.key("median_piece_m").value(sizes.median).key("largest_piece_m").value(sizes.largest);
}

void append_floe(io::JsonWriter& json, const ChannelFloe& floe) {
  json.key("floe_id").value(floe.floe).key("size_m").value(floe.size);
  json.key("area_m2").value(floe.area).key("inside_m2").value(floe.inside);
}

void append_station(GeojsonLayer& layer, const ChannelStation& s, std::size_t number, double beam) {
  io::JsonWriter& json = layer.start().key("part").value("station").key("station").value(number);
  for (const auto& [name, read] : kStationColumns) json.key(name).value(read(s, beam));
  json.key("is_bounded").value(s.is_bounded());
  const Vector to_port = perpendicular(s.forward);
  layer.end_with(Ring{s.middle + s.port * to_port, s.middle - s.starboard * to_port});
}

}  // namespace

std::string to_table(const Channel& channel) {
  std::string text = fmt::format("channel of {} at {:g} s: {} of {:g} m, {} with ice on both sides within {:g} m\n",
                                 channel.ship, channel.time, io::counted(channel.stations.size(), "station"),
                                 channel.spacing, widths(channel).count, channel.reach);
  const bool has_brash = !channel.brash_pieces.empty();
  text +=
      fmt::format("{:>9} {:>9} {:>9} {:>9} {:>9} {:>11} {:>9} {:>9} {:>10}{}\n", "along_m", "passed_s", "x_m", "y_m",
                  "port_m", "starboard_m", "width_m", "over_beam", "ice_beam_%", has_brash ? "    brash_%" : "");
  for (const ChannelStation& s : channel.stations)
    text += fmt::format("{:>9.1f} {:>9.1f} {:>9.2f} {:>9.2f} {:>9} {:>11} {:>9} {:>9.2f} {:>10.2f}{}\n", s.along,
                        s.passed, s.middle.x, s.middle.y, side(s.port, s.has_port_ice),
                        side(s.starboard, s.has_starboard_ice), side(s.width(), s.is_bounded()),
                        s.width() / channel.beam, 100 * s.ice_across_beam, has_brash ? brash_cell(s) : "");
  return text + summary_lines(channel) + brash_lines(channel) + size_table(channel);
}

std::string to_csv(const Channel& channel) {
  std::string text = "station";
  for (const StationColumn& column : kStationColumns) text += fmt::format(",{}", column.name);
  for (std::size_t i = 0; i < channel.stations.size(); ++i) {
    io::append_number(text += '\n', static_cast<std::int64_t>(i));
    for (const StationColumn& column : kStationColumns)
      io::append_number(text += ',', column.read(channel.stations[i], channel.beam));
  }
  return text + '\n';
}

std::string to_json_text(const Channel& channel) {
  const auto write = [&](io::JsonWriter& json) {
    append(json, channel);
    json.key("floes").objects(channel.floes, [&](const ChannelFloe& floe) { append_floe(json, floe); });
    json.key("brash").objects(channel.brash_pieces, [&](const ChannelFloe& piece) { append_floe(json, piece); });
  };
  return io::json_object(write, io::JsonWriter::Layout::kIndented);
}

std::string to_geojson(const Channel& channel) {
  GeojsonLayer layer(channel.time);
  append(layer.start().key("part").value("open water"), channel);
  layer.end_with(channel.open_water);
  layer.start().key("part").value("channel");
  layer.end_with(channel.cut_water);
  if (!channel.brash.empty()) {
    layer.start().key("part").value("brash").key("area_m2").value(channel.brash_area);
    layer.end_with(channel.brash);
  }
  layer.start().key("part").value("swept band").key("area_m2").value(channel.swept_area);
  layer.end_with(channel.swept);
  if (channel.track.size() > 1) {
    layer.start().key("part").value("track");
    layer.end_with(geometry::Ring(channel.track));
  }
  for (std::size_t i = 0; i < channel.stations.size(); ++i) append_station(layer, channel.stations[i], i, channel.beam);
  return layer.finish();
}

}  // namespace polynya::analysis
