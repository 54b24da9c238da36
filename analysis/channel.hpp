#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/run/run_reader.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::analysis {

// Measures the channel behind a ship at one instant of its run (docs/channel.md). The water carries the ship's track,
// and the band that the hull swept, from the time of the passage to that instant. Floes are at their places at that
// instant. Points, tracks and polygons are in the world frame unless a name says otherwise.

/// Settings of a measurement.
struct ChannelOptions {
  std::size_t ship = 0;        ///< index of the hull: ships first, then structures and walls (hull_of())
  std::optional<double> time;  ///< instant [s]; nullopt: the end of the run
  /// Distance between stations along the track [m]; 0 or negative: the ship's beam. A width is the room that a body of
  /// this length has, so a larger spacing gives fewer and smaller widths.
  double spacing = 0;
  /// Distance to either side of the track within which ice is searched [m]; 0 or negative: four beams. A larger reach
  /// finds ice on both sides in more cells, and more open water beside the channel.
  double reach = 0;
};

/// A cell of the channel. It is as long as the spacing along the track and extends as far as the reach to either side.
/// The first cell begins at the beginning of the track; the last one ends at or before the ship's stern. A cell at
/// whose end the ship was back at its beginning has no length, and no station.
struct ChannelStation {
  double along = 0;          ///< distance of its middle from the beginning of the track [m]
  double passed = 0;         ///< time at which the ship's centre was there [s]
  geometry::Point middle;    ///< midpoint of the straight line between the cell's ends on the track [m]
  geometry::Vector forward;  ///< unit vector along that line, in the direction in which the ship passed
  double length = 0;         ///< length of that line [m]
  /// Distance from that line to the nearest ice to port that is not brash, anywhere in the cell, measured at right
  /// angles to `forward` [m]. It is 0 if ice lies across the line, and the reach if the cell has no such ice to port.
  double port = 0;
  double starboard = 0;            ///< the same to starboard [m]
  bool has_port_ice = false;       ///< true if `port` is a distance to ice, false if it is only the reach
  bool has_starboard_ice = false;  ///< the same for `starboard`; ice across the line is on both sides
  /// Fraction of the cell within half a beam of the track that ice covers, brash included [-].
  double ice_across_beam = 0;
  double channel_area = 0;  ///< area of the cell from ice to ice [m²]; 0 if the cell has no ice on one of the sides
  double brash_area = 0;    ///< area of brash within channel_area [m²]
  /// True if the ship cut this stretch of the channel, so that pictures show it: there is ice on both sides, at most
  /// three beams apart; the track is nearly straight; and the ship moved along its heading rather than sideways, and is
  /// not moored. Otherwise the width is a property of the ice field, not of the ship.
  bool is_channel = false;

  double brash_cover() const;  ///< fraction of the channel that brash covers [-]; NaN if there is no channel
  /// Returns the distance from ice to ice [m]. It is only a lower bound if is_bounded() is false.
  double width() const { return port + starboard; }
  /// Returns true if the cell has ice on both sides. Only such stations count in widths() and brash sums.
  bool is_bounded() const { return has_port_ice && has_starboard_ice; }
};

/// A floe that extends into the band that the hull swept, or a piece of brash in the channel.
struct ChannelFloe {
  simulation::FloeId floe = 0;
  double size = 0;    ///< √area [m]
  double area = 0;    ///< [m²]
  double inside = 0;  ///< area that is in the band (Channel::floes) or between the ice (Channel::brash_pieces) [m²]
};

/// Result of a measurement.
struct Channel {
  std::string ship;                      ///< name of the ship or structure
  double time = 0;                       ///< instant of the measurement [s]
  double beam = 0;                       ///< beam of the hull's waterline [m]
  double spacing = 0;                    ///< spacing that was used, never 0 [m]
  double reach = 0;                      ///< reach that was used, never 0 [m]
  std::vector<geometry::Point> track;    ///< track of the ship's centre, carried with the water to the instant [m]
  std::vector<ChannelStation> stations;  ///< in the order of the track; none if it is too short
  std::vector<geometry::Polygon> swept;  ///< band that the hull swept, carried with the water to the instant [m]
  double swept_area = 0;                 ///< area of `swept` [m²]
  double swept_ice_at_start = 0;         ///< area of the swept band that was ice when the run began [m²]
  std::vector<ChannelFloe> floes;        ///< floes that extend into the band, brash included, the largest first
  /// Water that neither ice nor the hull covers, and that open water or brash connects to the track, in the cells from
  /// the first to the last bounded one [m]. It includes leads, so its area grows with the reach.
  std::vector<geometry::Polygon> open_water;
  /// The same, in cells with is_channel only [m]. Water that is connected to the track only through other cells is not
  /// in it.
  std::vector<geometry::Polygon> cut_water;
  double open_area = 0;  ///< area of open_water [m²]
  // The following members concern the bounded cells from ice to ice. Brash is ice that surfaced from under a hull, and
  // the pieces into which it broke.
  double area = 0;                        ///< total area of these cells from ice to ice [m²]
  std::vector<geometry::Polygon> brash;   ///< brash in them [m]
  double brash_area = 0;                  ///< area of brash in them [m²]
  std::vector<ChannelFloe> brash_pieces;  ///< pieces of brash that extend into them, the largest first

  double swept_ice() const;    ///< area of the swept band that ice covers [m²]
  double brash_cover() const;  ///< fraction of `area` that brash covers [-]; NaN if the area is 0
};

/// Widths of the stations with ice on both sides [m]: mean, smallest and largest; NaN if there are none.
struct WidthSummary {
  std::size_t count = 0;  ///< number of these stations
  double mean = 0, least = 0, most = 0;
};
WidthSummary widths(const Channel& channel);

/// Sizes √area of the pieces of brash in the channel [m]; NaN if there are none.
struct BrashSizes {
  std::size_t count = 0;                     ///< number of pieces
  double mean = 0, median = 0, largest = 0;  ///< of an even number, the median is the larger of the two middle sizes
};
BrashSizes brash_sizes(const Channel& channel);

/// Measures a channel. Fails with a message if the run has no frames, no hull with that index, or does not reach to
/// that time, or if a cut of polygons fails. A ship that has hardly moved is no failure: the result has no stations.
io::Result<Channel> measure_channel(const io::Run& run, const ChannelOptions& options);

/// Returns only the stations of the same channel: places, distances to ice and is_channel. Their members about covered
/// fractions and areas stay 0. This is much faster, and the page of a run uses it for many instants. Fails as
/// measure_channel() does.
io::Result<std::vector<ChannelStation>> measure_stations(const io::Run& run, const io::MotionIndex& motions,
                                                         const ChannelOptions& options);

/// Returns a table for people, with units in the headers: the stations, then widths, ice and brash in the channel, and
/// the sizes of the floes that are left in the band.
std::string to_table(const Channel& channel);
/// Returns a CSV table with one row per station (channel.csv), the beginning of the track first. Its columns are part
/// of the file format. A brash cover that is NaN becomes null.
std::string to_csv(const Channel& channel);
/// Returns the sums and the lists of floes as one JSON object, without shapes and without stations. A value that is NaN
/// becomes null. The keys are part of the interface (`polynya channel --json`).
std::string to_json_text(const Channel& channel);
/// Returns open water, channel, brash, swept band, track and stations as a GeoJSON FeatureCollection (channel.geojson).
/// Coordinates are in metres in the scene's plane.
std::string to_geojson(const Channel& channel);

// ---- parts of the measurement: ice as valid polygons, and points that move with the water

/// A valid polygon of ice at an instant, with its bounding box.
struct PlacedIce {
  const simulation::BirthRecord* birth = nullptr;  ///< floe of the run; null: ice of the scene at its start
  geometry::Polygon polygon;                       ///< in the world [m]
  geometry::Box box;
};

/// Adds the polygon of a floe in the world to `ice`. Rounding may make the placed shape invalid. It is then replaced by
/// the area around which its rings wind, as one or more polygons, or by none if they enclose no area. Fails with a
/// message if a coordinate is not finite.
io::Result<> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth,
                     geometry::Polygon polygon_in_world);

/// Returns copies of the polygons whose bounding boxes overlap a box [m], in their order. It limits a cut to the ice
/// that can matter.
std::vector<geometry::Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box);

/// The parts of a polygon that other polygons cover and do not cover.
struct Parted {
  std::vector<geometry::Polygon> inside;   ///< covered by at least one of the others [m]
  std::vector<geometry::Polygon> outside;  ///< covered by none [m]
  double inside_area = 0;                  ///< area of `inside`, where others overlap counted once [m²]
};

/// Divides a polygon into the parts inside and outside of others. The result is exact except for one rounding of
/// vertices. Without others, or if none of them reaches the polygon, all of it is outside. Fails if geometry refuses
/// the cut.
io::Result<Parted> part(const geometry::Polygon& polygon, const std::vector<geometry::Polygon>& by);

/// Returns the place at the time `to` [s] of a point that moves with the water from the time `from` [s], with the
/// scene's drift, tide and shear, without the wind. `to` may be before `from`. The map is affine in the plane; it does
/// not depend on the motion of floes.
geometry::Point carried_by_water(const simulation::WaterSettings& water, geometry::Point point, double from, double to);
geometry::Polygon carried_by_water(const simulation::WaterSettings& water, geometry::Polygon polygon, double from,
                                   double to);

/// Divides the time from the run's start to `time` [s] into pieces and returns the start and the ends of the pieces
/// [s]. Pieces end at frames, and the last one at `time`. A piece is as long as possible, up to 256 frames: at each
/// frame in it, every corner of the hull, carried by the water to `time`, is within `tolerance` [m] of the straight
/// line between the corner's places at the ends of the piece. A smaller tolerance gives more pieces. If `time` is the
/// run's start, the result is that time alone.
std::vector<double> straight_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time,
                                    double tolerance);

/// Returns, for each straight piece, the convex hull of the ship's waterline at both of its ends, carried by the water
/// to `time` [s]. Their union is the band that the hull swept, to within the tolerance [m]. A waterline that is not
/// convex is replaced by its convex hull. At the run's start the only piece is the hull itself.
std::vector<geometry::Polygon> swept_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship,
                                            double time, double tolerance);

}  // namespace polynya::analysis
