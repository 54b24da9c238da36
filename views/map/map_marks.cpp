#include "views/map/map_marks.hpp"

#include <cmath>

#include <fmt/format.h>

namespace polynya::views {

using namespace map_colour;

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

std::string ice_under_hull_style() {
  return fmt::format(
      "fill='{0}' fill-opacity='0.25' fill-rule='evenodd' stroke='{0}' stroke-dasharray='3 2' "
      "stroke-linejoin='round'",
      kIceUnderHull);
}

namespace {

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

}  // namespace

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

}  // namespace polynya::views
