#include "views/map/picture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "views/map/svg_layout.hpp"

namespace polynya::views {
namespace {

using geometry::Box;
using geometry::Point;

constexpr double kMargin = 24;       ///< [px]
constexpr double kTallest = 1200;    ///< of the map [px]
constexpr double kFullMarks = 1400;  ///< marks have their full size on a map of that width [px]

/// Light ice on mid water on paper: apart in greyscale. Marks in the Okabe–Ito palette.
constexpr auto kWater = "#8fb8d0";
constexpr auto kIceAtStart = "#a9cadd";
constexpr auto kIce = "#ffffff";
constexpr auto kBrokenIce = "#fbeec2";
constexpr auto kIceCameUp = "#f0c987";
constexpr auto kIceUnderHull = "#56b4e9";
constexpr auto kIceEdge = "#3d5261";
constexpr auto kShip = "#2b2b2b";
constexpr auto kWall = "#8a8a8a";
constexpr auto kTrack = "#d55e00";
constexpr auto kBend = "#0072b2";
constexpr auto kSplit = "#d55e00";
constexpr auto kGrind = "#7a5c2e";

/// `size` of the mark in the legend is 1.
void draw_fracture_mark(SvgText& svg, FractureMark mark, double x, double y, double size) {
  if (mark == FractureMark::kSplit)
    svg.add(
        "<path d='M{0:.2f} {1:.2f}l{2:.2f} {3:.2f}h{4:.2f}Z' fill='{5}' stroke='#ffffff' "
        "stroke-width='1.5'/>\n",
        x, y - 9 * size, 8 * size, 14 * size, -16 * size, kSplit);
  else
    svg.add("<circle cx='{:.2f}' cy='{:.2f}' r='{:.2f}' fill='{}' stroke='#ffffff' stroke-width='0.5'/>\n", x, y,
            2.8 * size, mark == FractureMark::kGrind ? kGrind : kBend, size < 0.8 ? "0" : "0.5");
}

/// Attributes of ice under a hull: dashed, pale, so that the hull shows through it.
std::string ice_under_hull_style() {
  return fmt::format(
      "fill='{0}' fill-opacity='0.25' fill-rule='evenodd' stroke='{0}' stroke-dasharray='3 2' "
      "stroke-linejoin='round'",
      kIceUnderHull);
}

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

MapKey area_key(const char* colour, const char* edge, const char* words) {
  return {{words, 26}, [=](SvgText& svg, geometry::Point at) {
            svg.add("<rect x='{:.2f}' y='{:.2f}' width='26' height='16' fill='{}' stroke='{}'/>\n", at.x, at.y - 13,
                    colour, edge);
          }};
}

MapKey mark_key(FractureMark mark, const char* words) {
  return {{words, 18}, [=](SvgText& svg, geometry::Point at) { draw_fracture_mark(svg, mark, at.x + 9, at.y - 6, 1); }};
}

MapKey scale_bar(double scale, double room_on_page) {
  const double room = room_on_page / scale;
  const double decade = std::pow(10, std::floor(std::log10(room)));
  const double length = decade * (room >= 5 * decade ? 5 : room >= 2 * decade ? 2 : 1);
  return {{fmt::format("{:g} m", length), length * scale}, [=](SvgText& svg, geometry::Point at) {
            svg.add("<path d='M{:.2f} {:.2f}v8h{:.2f}v-8' fill='none' stroke='#000000' stroke-width='2'/>\n", at.x,
                    at.y - 10, length * scale);
          }};
}

/// The scale bar, the longest of 1, 2, 5 × 10ⁿ metres that fits into `room` [px] at `scale` [px/m], and the
/// keys of all that a map shows.
std::vector<MapKey> map_keys(double scale, double room, const MapContents& contents) {
  std::vector<MapKey> keys{scale_bar(scale, room), area_key(kIce, kIceEdge, "floe as in the scene"),
                           area_key(kBrokenIce, kIceEdge, "piece of a broken floe"),
                           area_key(kIceAtStart, kIceAtStart, "ice at the start, open now"),
                           area_key(kWater, kWater, "water")};
  if (contents.has_ice_that_came_up)
    keys.push_back(area_key(kIceCameUp, kIceEdge, "piece that came up from under the hull"));
  keys.push_back(area_key(kShip, kShip, "ship"));
  if (contents.has_walls) keys.push_back(area_key(kWall, kWall, "wall"));
  if (contents.has_ice_under_hulls)
    keys.push_back({{"ice under the hull or waiting behind it", 26}, [](SvgText& svg, geometry::Point at) {
                      svg.add("<rect x='{0:.2f}' y='{1:.2f}' width='26' height='16' fill='{2}'/>\n", at.x, at.y - 13,
                              kShip);
                      svg.add("<rect x='{:.2f}' y='{:.2f}' width='18' height='8' {} stroke-width='1.2'/>\n", at.x + 4,
                              at.y - 9, ice_under_hull_style());
                    }});
  keys.push_back({{"its track", 30}, [](SvgText& svg, geometry::Point at) {
                    svg.add("<path d='M{:.2f} {:.2f}h30' stroke='{}' stroke-width='2' stroke-dasharray='8 4'/>\n", at.x,
                            at.y - 5, kTrack);
                  }});
  keys.push_back(mark_key(FractureMark::kBend, "cusp broken by bending"));
  keys.push_back(mark_key(FractureMark::kSplit, "floe split"));
  return keys;
}

/// All that a picture shows.
std::optional<Box> extent_of(const Picture& picture) {
  std::optional<Box> all;
  const auto include = [&](Point p) {
    if (!all) all = Box{p, p};
    extend(*all, p);
  };
  for (const auto& polygon : picture.ice_at_start) std::ranges::for_each(polygon.outer, include);
  for (const auto& ship : picture.ships) std::ranges::for_each(ship.waterline_in_world, include);
  for (const auto& floe : picture.floes) std::ranges::for_each(floe.polygon_in_world.outer, include);
  for (const auto& ship : picture.ships) std::ranges::for_each(ship.track, include);
  return all;
}

/// With some room around it.
Box shown_extent(const Picture& picture) {
  const Box all = extent_of(picture).value_or(Box{{0, 0}, {100, 100}});
  const geometry::Vector size = all.high - all.low;
  return grown(all, std::max(1.0, 0.02 * std::max(size.x, size.y)));
}

/// A map's place on the paper.
struct MapFrame {
  Box extent;        ///< [m]
  double scale = 1;  ///< [px/m]
  double left = 0;   ///< [px]
  double top = 0;    ///< [px]

  double x(Point p) const { return left + scale * (p.x - extent.low.x); }
  double y(Point p) const { return top + scale * (extent.high.y - p.y); }
  double width() const { return scale * (extent.high.x - extent.low.x); }
  double height() const { return scale * (extent.high.y - extent.low.y); }
};

class SvgMap {
 public:
  SvgMap(SvgText& svg, const Picture& picture, const MapFrame& frame) : svg_(svg), picture_(picture), frame_(frame) {}

  void draw() {
    svg_.add(
        "<clipPath id='map'><rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}'/></clipPath>\n"
        "<rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}' fill='{4}'/>\n<g "
        "clip-path='url(#map)'>\n",
        frame_.left, frame_.top, frame_.width(), frame_.height(), kWater);
    draw_water();
    draw_ice([](const Picture::Floe& floe) { return floe.generation == 0; }, kIce);
    draw_ice([](const Picture::Floe& floe) { return floe.generation > 0 && !floe.came_up; }, kBrokenIce);
    draw_fractures(FractureMark::kBend);
    draw_fractures(FractureMark::kGrind);
    draw_ice(std::mem_fn(&Picture::Floe::came_up), kIceCameUp);
    draw_ships();
    draw_ice_under_hulls();
    draw_fractures(FractureMark::kSplit);
    svg_.add("</g>\n");
  }

 private:
  void path(const geometry::Polygon& polygon) {
    svg_.add("<path d='");
    ring(polygon.outer);
    for (const auto& hole : polygon.holes) ring(hole);
    svg_.add("'/>\n");
  }
  void ring(const geometry::Ring& points) {
    char command = 'M';
    for (const Point p : points) {
      svg_.add("{}{:.2f} {:.2f}", command, frame_.x(p), frame_.y(p));
      command = 'L';
    }
    svg_.add("Z");
  }

  void draw_water() {
    svg_.add("<g fill='{}'>\n", kIceAtStart);
    for (const auto& polygon : picture_.ice_at_start) path(polygon);
    svg_.add("</g>\n");
  }

  double ice_edge() const { return std::clamp(0.4 * frame_.scale, 0.4, 1.2); }  ///< [px]

  template <class Condition>
  void draw_ice(Condition condition, const char* colour) {
    svg_.add("<g fill='{}' fill-rule='evenodd' stroke='{}' stroke-width='{:.2f}' stroke-linejoin='round'>\n", colour,
             kIceEdge, ice_edge());
    for (const auto& floe : picture_.floes) {
      if (condition(floe)) path(floe.polygon_in_world);
    }
    svg_.add("</g>\n");
  }

  void draw_ice_under_hulls() {
    if (picture_.ice_under_hulls.empty()) return;
    svg_.add("<g {} stroke-width='{:.2f}'>\n", ice_under_hull_style(), ice_edge());
    for (const auto& polygon : picture_.ice_under_hulls) path(polygon);
    svg_.add("</g>\n");
  }

  void draw_ships() {
    for (const auto& ship : picture_.ships) {
      if (!ship.is_wall) draw_track(ship);
      svg_.add("<g fill='{}' fill-opacity='0.88' stroke='#ffffff' stroke-width='1.5'>\n", ship.is_wall ? kWall : kShip);
      path({ship.waterline_in_world, {}});
      svg_.add("</g>\n");
    }
  }

  void draw_track(const Picture::Ship& ship) {
    svg_.add("<polyline fill='none' stroke='{}' stroke-width='2' stroke-dasharray='8 4' points='", kTrack);
    for (const Point p : ship.track) svg_.add("{:.2f},{:.2f} ", frame_.x(p), frame_.y(p));
    svg_.add("'/>\n");
  }

  void draw_fractures(FractureMark mark) {
    const double share = std::clamp(frame_.width() / kFullMarks, 0.45, 1.0);
    const bool is_crowded = mark == FractureMark::kBend && picture_.fractures.size() > 400;
    for (const auto& fracture : picture_.fractures) {
      if (fracture.mark == mark)
        draw_fracture_mark(svg_, mark, frame_.x(fracture.point_in_world), frame_.y(fracture.point_in_world),
                           share * (is_crowded ? 0.65 : 1));
    }
  }

  SvgText& svg_;
  const Picture& picture_;
  const MapFrame& frame_;
};

}  // namespace

std::string to_svg(const Picture& picture) {
  const Heading heading(kMargin, picture.title, picture.caption);
  MapFrame frame{shown_extent(picture), 1, 0, 0};
  const geometry::Vector size = frame.extent.high - frame.extent.low;
  constexpr double kRoom = kPageWidth - 2 * kMargin;
  frame.scale = std::min(kRoom / size.x, kTallest / size.y);
  frame.left = kMargin + 0.5 * (kRoom - frame.width());
  frame.top = heading.height();
  const MapContents contents{.has_walls = std::ranges::any_of(picture.ships, &Picture::Ship::is_wall),
                             .has_ice_under_hulls = !picture.ice_under_hulls.empty(),
                             .has_ice_that_came_up = std::ranges::any_of(picture.floes, &Picture::Floe::came_up)};
  const std::vector<MapKey> keys = map_keys(frame.scale, kRoom / 6, contents);
  std::vector<Legend::Entry> entries;
  entries.reserve(keys.size());
  for (const MapKey& key : keys) entries.push_back(key.entry);
  const Legend legend(entries, kMargin, kPageWidth - kMargin);
  const double below = frame.top + frame.height() + 10;
  SvgText svg(kPageWidth, below + legend.height());
  heading.draw(svg);
  SvgMap(svg, picture, frame).draw();
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i].draw(svg, legend.draw(svg, i, below));
  return svg.finish();
}

}  // namespace polynya::views
