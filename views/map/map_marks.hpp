#pragma once

#include <functional>
#include <string>
#include <vector>

#include "views/map/svg_layout.hpp"

namespace polynya::views {

/// Light ice on mid water on paper: apart in greyscale. Marks in the Okabe–Ito palette.
namespace map_colour {
inline constexpr auto kWater = "#8fb8d0";
inline constexpr auto kIceAtStart = "#a9cadd";
inline constexpr auto kIce = "#ffffff";
inline constexpr auto kBrokenIce = "#fbeec2";
inline constexpr auto kIceCameUp = "#f0c987";
inline constexpr auto kIceUnderHull = "#56b4e9";
inline constexpr auto kIceEdge = "#3d5261";
inline constexpr auto kShip = "#2b2b2b";
inline constexpr auto kWall = "#8a8a8a";
inline constexpr auto kTrack = "#d55e00";
inline constexpr auto kBend = "#0072b2";
inline constexpr auto kSplit = "#d55e00";
inline constexpr auto kGrind = "#7a5c2e";
}  // namespace map_colour

enum class FractureMark { kBend, kSplit, kGrind };

/// `size` of the mark in the legend is 1.
void draw_fracture_mark(SvgText& svg, FractureMark mark, double x, double y, double size);

/// Attributes of ice under a hull: dashed, pale, so that the hull shows through it.
std::string ice_under_hull_style();

/// An entry of a map's legend: its swatch is drawn with the lower left corner at a point.
struct MapKey {
  Legend::Entry entry;
  std::function<void(SvgText&, geometry::Point)> draw;
};

/// What not every map shows.
struct MapContents {
  bool has_walls = false;
  bool has_ice_under_hulls = false;
  bool has_ice_that_came_up = false;
};

/// The scale bar, the longest of 1, 2, 5 × 10ⁿ metres that fits into `room` [px] at `scale` [px/m], and the
/// keys of all that a map shows.
std::vector<MapKey> map_keys(double scale, double room, const MapContents& contents);

}  // namespace polynya::views
