#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/run/run_reader.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::analysis {

/// Measures the channel behind a ship at one instant of its run (docs/channel.md). The water carries the ship's track,
/// and the band that the hull swept, from the time of the passage to that instant. Floes are at their places at that
/// instant.

/// Settings of a measurement.
struct ChannelOptions {
  std::size_t ship = 0;
  std::optional<double> time;  ///< instant [s]; none: the end of the run
  double spacing = 0;          ///< distance between stations along the track [m]; 0: the ship's beam
  double reach = 0;            ///< distance to either side of the track within which ice is searched [m]; 0: four beams
};

/// A cell of the channel. It is as long as the spacing along the track and extends as far as the reach to either side.
struct ChannelStation {
  double along = 0;          ///< distance of its middle from the beginning of the track [m]
  double passed = 0;         ///< time at which the ship's centre was there [s]
  geometry::Point middle;    ///< point of the track at that distance, carried to the instant [m]
  geometry::Vector forward;  ///< unit vector along the track
  double length = 0;         ///< length of its part of the track, as a straight line [m]
  /// Distance from the track to the nearest ice to port that is not brash [m]; the reach if there is none in the cell.
  double port = 0;
  double starboard = 0;  ///< the same to starboard [m]
  bool has_port_ice = false;
  bool has_starboard_ice = false;
  double ice_across_beam = 0;  ///< fraction of the cell within half a beam of the track that ice covers [-]
  double channel_area = 0;     ///< area of the cell from ice to ice [m²]; 0 if the cell has no ice on one of the sides
  double brash_area = 0;       ///< area of brash within channel_area [m²]
  /// True if the ship cut this stretch of the channel, so that pictures show it: there is ice on both sides, at most
  /// three beams apart; the track is nearly straight; and the ship moved along its heading rather than sideways, and is
  /// not moored. Otherwise the width is a property of the ice field, not of the ship.
  bool is_channel = false;

  double brash_cover() const;  ///< fraction of the channel that brash covers [-]; NaN if there is no channel
  double width() const { return port + starboard; }  ///< [m]
  bool is_bounded() const { return has_port_ice && has_starboard_ice; }
};

/// A floe that extends into the band that the hull swept, or a piece of brash in the channel.
struct ChannelFloe {
  simulation::FloeId floe = 0;
  double size = 0;    ///< √area [m]
  double area = 0;    ///< [m²]
  double inside = 0;  ///< area that is in the band or channel [m²]
};

/// Result of a measurement.
struct Channel {
  std::string ship;
  double time = 0;                     ///< [s]
  double beam = 0;                     ///< [m]
  double spacing = 0;                  ///< [m]
  double reach = 0;                    ///< [m]
  std::vector<geometry::Point> track;  ///< track of the ship's centre, carried with the water to the instant [m]
  std::vector<ChannelStation> stations;
  std::vector<geometry::Polygon> swept;  ///< band that the hull swept, carried with the water to the instant [m]
  double swept_area = 0;                 ///< [m²]
  double swept_ice_at_start = 0;         ///< area of the swept band that was ice when the run began [m²]
  std::vector<ChannelFloe> floes;        ///< floes that extend into the band, the largest first
  /// Water without ice that open water or brash connects to the track, from the first to the last bounded cell [m].
  std::vector<geometry::Polygon> open_water;
  std::vector<geometry::Polygon> cut_water;  ///< the part of open_water in cells with is_channel [m]
  double open_area = 0;                      ///< [m²]
  // The following members concern the bounded cells from ice to ice. Brash is ice that surfaced from under a hull, and
  // the pieces into which it broke.
  double area = 0;                        ///< total area of these cells from ice to ice [m²]
  std::vector<geometry::Polygon> brash;   ///< brash in them [m]
  double brash_area = 0;                  ///< [m²]
  std::vector<ChannelFloe> brash_pieces;  ///< pieces of brash that extend into them, the largest first

  double swept_ice() const;    ///< area of the swept band that ice covers [m²]
  double brash_cover() const;  ///< fraction of `area` that brash covers [-]; NaN if the area is 0
};

/// Widths of the stations with ice on both sides [m]; NaN if there are none.
struct WidthSummary {
  std::size_t count = 0;
  double mean = 0, least = 0, most = 0;
};
WidthSummary widths(const Channel& channel);

/// Sizes √area of the pieces of brash in the channel [m]; NaN if there are none.
struct BrashSizes {
  std::size_t count = 0;
  double mean = 0, median = 0, largest = 0;
};
BrashSizes brash_sizes(const Channel& channel);

/// Measures a channel. Fails with a message if the run does not have the ship or the time, or if geometry fails.
io::Result<Channel> measure_channel(const io::Run& run, const ChannelOptions& options);

/// Returns only the stations of the same channel, without the fractions that ice and brash cover. This is much faster
/// and is used for many instants.
io::Result<std::vector<ChannelStation>> measure_stations(const io::Run& run, const io::MotionIndex& motions,
                                                         const ChannelOptions& options);

/// Returns a table for people: stations, widths, and ice that is left in the band, with units in the headers.
std::string to_table(const Channel& channel);
/// Returns a CSV table with one row per station.
std::string to_csv(const Channel& channel);
/// Returns all results except shapes as one JSON object.
std::string to_json_text(const Channel& channel);
/// Returns open water, swept band, track and stations as a GeoJSON FeatureCollection in metres of the scene's plane.
std::string to_geojson(const Channel& channel);

// ---- parts of the measurement: ice as valid polygons, and points that move with the water

/// A valid polygon of ice at an instant, with its box.
struct PlacedIce {
  const simulation::BirthRecord* birth = nullptr;  ///< floe of the run; null: ice of the scene at its start
  geometry::Polygon polygon;                       ///< in the world [m]
  geometry::Box box;
};

/// Adds the polygon of a floe in the world. Rounding may make the placed shape invalid. It is then replaced by the area
/// around which its rings wind, as one or more polygons, or by none if they enclose no area. Fails with a message if a
/// coordinate is not finite.
io::Result<> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth,
                     geometry::Polygon polygon_in_world);

/// Returns the polygons whose boxes overlap a box.
std::vector<geometry::Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box);

/// The parts of a polygon that other polygons cover and do not cover.
struct Parted {
  std::vector<geometry::Polygon> inside;
  std::vector<geometry::Polygon> outside;
  double inside_area = 0;  ///< [m²]
};

/// Divides a polygon by others. The result is exact except for one rounding of vertices. Fails if geometry refuses the
/// cut.
io::Result<Parted> part(const geometry::Polygon& polygon, const std::vector<geometry::Polygon>& by);

/// Returns the place at the time `to` [s] of a point that moves with the water from the time `from` [s], with the
/// scene's drift and shear. The map is affine in the plane; it does not depend on the motion of floes.
geometry::Point carried_by_water(const simulation::WaterSettings& water, geometry::Point point, double from, double to);
geometry::Polygon carried_by_water(const simulation::WaterSettings& water, geometry::Polygon polygon, double from,
                                   double to);

/// Divides the time from the run's start to `time` [s] into pieces, as long as possible, and returns their ends [s]. In
/// each piece no corner of the hull, carried by the water to `time`, leaves the straight line between its ends by more
/// than `tolerance` [m].
std::vector<double> straight_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time,
                                    double tolerance);

/// Returns, for each straight piece, the convex hull of the ship's waterline at both of its ends, carried by the water
/// to `time` [s]. Their union is the band that the hull swept, to within the tolerance [m]. A waterline that is not
/// convex is replaced by its convex hull.
std::vector<geometry::Polygon> swept_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship,
                                            double time, double tolerance);

}  // namespace polynya::analysis
