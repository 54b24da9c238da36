#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include "bench/cut_cases.hpp"

namespace polynya::bench::boost_geometry {
namespace {

namespace bg = boost::geometry;
using BoostPolygon = bg::model::polygon<bg::model::d2::point_xy<double>, false, true>;
using BoostMulti = bg::model::multi_polygon<BoostPolygon>;

BoostPolygon to_boost(const geometry::Ring& ring) {
  BoostPolygon polygon;
  for (const geometry::Point p : ring) polygon.outer().emplace_back(p.x, p.y);
  polygon.outer().push_back(polygon.outer().front());
  return polygon;
}

}  // namespace

Result march(const March& march) {
  BoostPolygon plate = to_boost(march.plate);
  for (const geometry::Ring& cusp : march.cusps) {
    BoostMulti left;
    bg::difference(plate, to_boost(cusp), left);
    const auto largest = std::max_element(left.begin(), left.end(),
                                          [](auto& a, auto& b) { return a.outer().size() < b.outer().size(); });
    plate = std::move(*largest);
  }
  return {bg::area(plate), plate.outer().size() - 1};
}

Result split(const Split& split) {
  const BoostPolygon floe = to_boost(split.floe);
  const BoostPolygon side = to_boost(half_plane(split));
  BoostMulti halves[2];
  bg::intersection(floe, side, halves[0]);
  bg::difference(floe, side, halves[1]);
  Result result;
  for (const BoostMulti& half : halves) {
    result.area += bg::area(half);
    for (const BoostPolygon& polygon : half) result.vertices += polygon.outer().size() - 1;
  }
  return result;
}

}  // namespace polynya::bench::boost_geometry
