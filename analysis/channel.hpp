#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/run/run_reader.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::analysis {

/// The channel behind a ship at an instant of its run (docs/channel.md). The ship's track and the band its
/// hull swept are carried with the water to that instant; floes are where the run has them.

struct ChannelOptions {
  std::size_t ship = 0;
  std::optional<double> time;  ///< [s]; the end of the run if not given
  double spacing = 0;          ///< of stations along the track [m]; 0: the ship's beam
  double reach = 0;            ///< how far to either side ice is searched [m]; 0: four beams
};

/// A cell of the channel: a stretch of the track as long as the spacing, as far as the reach to either side.
struct ChannelStation {
  double along = 0;          ///< of its middle from the track's beginning [m]
  double passed = 0;         ///< when the ship's centre was there [s]
  geometry::Point middle;    ///< on the track, now [m]
  geometry::Vector forward;  ///< unit, along the track
  double length = 0;         ///< of its part of the track, straight from end to end [m]
  double port = 0;           ///< from the track to the nearest ice in the cell that is not brash [m]; the reach where
                             ///< there is none
  double starboard = 0;      ///< [m]
  bool has_port_ice = false;
  bool has_starboard_ice = false;
  double ice_across_beam = 0;  ///< share of the cell within half a beam of the track that ice covers [-]
  double channel_area = 0;     ///< of the cell from ice to ice [m²]; 0 where it is not bounded
  double brash_area = 0;       ///< of it that brash covers [m²]
  /// Whether the ship cut this stretch of the channel, so that pictures show it: ice lies on both sides, at most three
  /// beams apart; the track is nearly straight; the ship moved along the track, not across it, and is not moored.
  /// Elsewhere the width is a property of the ice field, not of the ship.
  bool is_channel = false;

  double brash_cover() const;                        ///< [-]; NaN where there is no channel
  double width() const { return port + starboard; }  ///< [m]
  bool is_bounded() const { return has_port_ice && has_starboard_ice; }
};

/// A floe that reaches into the band the hull swept, or a piece of brash in the channel.
struct ChannelFloe {
  simulation::FloeId floe = 0;
  double size = 0;    ///< √area [m]
  double area = 0;    ///< [m²]
  double inside = 0;  ///< of it in there [m²]
};

struct Channel {
  std::string ship;
  double time = 0;                     ///< [s]
  double beam = 0;                     ///< [m]
  double spacing = 0;                  ///< [m]
  double reach = 0;                    ///< [m]
  std::vector<geometry::Point> track;  ///< of the ship's centre, carried with the water to now [m]
  std::vector<ChannelStation> stations;
  std::vector<geometry::Polygon> swept;       ///< by the hull, carried with the water to now [m]
  double swept_area = 0;                      ///< [m²]
  double swept_ice_at_start = 0;              ///< of it that was ice when the run began [m²]
  std::vector<ChannelFloe> floes;             ///< in the band, the largest first
  std::vector<geometry::Polygon> open_water;  ///< joined to the track by water or brash, from the first to
                                              ///< the last bounded cell [m]
  std::vector<geometry::Polygon> cut_water;   ///< the same in the cells that are a channel [m]
  double open_area = 0;                       ///< [m²]
  // From ice to ice, in the bounded cells. Brash is ice that came up from under a hull, and what it broke into.
  double area = 0;                        ///< of them together [m²]
  std::vector<geometry::Polygon> brash;   ///< in there [m]
  double brash_area = 0;                  ///< [m²]
  std::vector<ChannelFloe> brash_pieces;  ///< that reach in there, the largest first

  double swept_ice() const;    ///< [m²]
  double brash_cover() const;  ///< share of `area` [-]; NaN where there is none
};

/// Widths of the stations with ice on both sides [m]; NaN where there are none.
struct WidthSummary {
  std::size_t count = 0;
  double mean = 0, least = 0, most = 0;
};
WidthSummary widths(const Channel& channel);

/// Sizes √area of the pieces of brash in the channel [m]; NaN where there are none.
struct BrashSizes {
  std::size_t count = 0;
  double mean = 0, median = 0, largest = 0;
};
BrashSizes brash_sizes(const Channel& channel);

/// Fails with words where the ship or the time is not in the run, or geometry refuses.
io::Result<Channel> measure_channel(const io::Run& run, const ChannelOptions& options);

/// The stations of that channel alone, without the shares that ice and brash cover in them: for many instants.
io::Result<std::vector<ChannelStation>> measure_stations(const io::Run& run, const io::MotionIndex& motions,
                                                         const ChannelOptions& options);

/// A channel for people: stations, widths, what is left in the band, with units in the heads.
std::string to_table(const Channel& channel);
/// One row a station.
std::string to_csv(const Channel& channel);
/// Everything but the shapes, one object.
std::string to_json_text(const Channel& channel);
/// Open water, swept band, track and stations as a FeatureCollection in metres of the scene's plane.
std::string to_geojson(const Channel& channel);

// ---- what a channel is measured with: ice as valid polygons, and what moves with the water

/// A valid polygon of ice at some instant, with its box.
struct PlacedIce {
  const simulation::BirthRecord* birth = nullptr;  ///< of the floe; null: of the scene
  geometry::Polygon polygon;                       ///< in the world [m]
  geometry::Box box;
};

/// Adds a floe's polygon in the world. A placed shape is rounded and may not be valid any more: it is then
/// what its rings wind around, in as many polygons as that takes; none where they enclose nothing. Fails with
/// words where a coordinate is not finite.
io::Result<> add_ice(std::vector<PlacedIce>& ice, const simulation::BirthRecord* birth,
                     geometry::Polygon polygon_in_world);

/// The polygons whose boxes meet a box.
std::vector<geometry::Polygon> near(const std::vector<PlacedIce>& ice, const geometry::Box& box);

/// What of a polygon others cover and what not.
struct Parted {
  std::vector<geometry::Polygon> inside;
  std::vector<geometry::Polygon> outside;
  double inside_area = 0;  ///< [m²]
};

/// Exact but for one rounding of vertices. Fails with words where geometry refuses the cut.
io::Result<Parted> part(const geometry::Polygon& polygon, const std::vector<geometry::Polygon>& by);

/// A point that moves with the water (the scene's drift and shear), from one time to another [s]. The map is
/// affine in the plane; the motion of floes does not enter.
geometry::Point carried_by_water(const simulation::WaterSettings& water, geometry::Point point, double from, double to);
geometry::Polygon carried_by_water(const simulation::WaterSettings& water, geometry::Polygon polygon, double from,
                                   double to);

/// The longest pieces of time from the run's start to `time` over which no corner of the hull, carried by the
/// water to `time`, leaves the straight line between its ends by more than `tolerance` [m]: their ends [s].
std::vector<double> straight_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship, double time,
                                    double tolerance);

/// The convex hulls of a ship's waterline at both ends of each straight piece, carried by the water to `time`: together
/// they are what the hull swept, right to the tolerance. A waterline that is not convex is taken as its convex hull.
std::vector<geometry::Polygon> swept_pieces(const io::Run& run, const io::MotionIndex& motions, std::size_t ship,
                                            double time, double tolerance);

}  // namespace polynya::analysis
