#include "views/map/picture.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "views/map/map_marks.hpp"
#include "views/map/svg_layout.hpp"

namespace polynya::views {
namespace {

using geometry::Box;
using geometry::Point;

constexpr double kMargin = 24;       ///< [px]
constexpr double kTallest = 1200;    ///< of the map [px]
constexpr double kFullMarks = 1400;  ///< marks have their full size on a map of that width [px]

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
        frame_.left, frame_.top, frame_.width(), frame_.height(), map_colour::kWater);
    draw_water();
    draw_ice([](const Picture::Floe& floe) { return floe.generation == 0; }, map_colour::kIce);
    draw_ice([](const Picture::Floe& floe) { return floe.generation > 0 && !floe.came_up; }, map_colour::kBrokenIce);
    draw_fractures(FractureMark::kBend);
    draw_fractures(FractureMark::kGrind);
    draw_ice(std::mem_fn(&Picture::Floe::came_up), map_colour::kIceCameUp);
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
    svg_.add("<g fill='{}'>\n", map_colour::kIceAtStart);
    for (const auto& polygon : picture_.ice_at_start) path(polygon);
    svg_.add("</g>\n");
  }

  double ice_edge() const { return std::clamp(0.4 * frame_.scale, 0.4, 1.2); }  ///< [px]

  template <class Condition>
  void draw_ice(Condition condition, const char* colour) {
    svg_.add("<g fill='{}' fill-rule='evenodd' stroke='{}' stroke-width='{:.2f}' stroke-linejoin='round'>\n", colour,
             map_colour::kIceEdge, ice_edge());
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
      svg_.add("<g fill='{}' fill-opacity='0.88' stroke='#ffffff' stroke-width='1.5'>\n",
               ship.is_wall ? map_colour::kWall : map_colour::kShip);
      path({ship.waterline_in_world, {}});
      svg_.add("</g>\n");
    }
  }

  void draw_track(const Picture::Ship& ship) {
    svg_.add("<polyline fill='none' stroke='{}' stroke-width='2' stroke-dasharray='8 4' points='", map_colour::kTrack);
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
