#include "io/text/degrees.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"

namespace polynya::io {
namespace {

constexpr double kPolarLatitude = 40;  ///< [°]
constexpr double kLeastIce = 1;        ///< of a scene in metres [m²]
constexpr double kMostPolarIce = 100;  ///< of a scene in degrees [°²]

/// Codes of EPSG and OGC in common use whose axes are longitude and latitude.
constexpr std::string_view kGeographic[] = {"CRS84", "CRS84H", "CRS83", "CRS27", "4326", "4979", "4258", "4937",
                                            "4267",  "4269",   "4617",  "4619",  "4283", "7844", "4167", "4490",
                                            "4612",  "6668",   "4674",  "4148",  "4162", "4170", "4202", "4203",
                                            "4230",  "4277",   "4284",  "4314",  "4313", "4322"};

}  // namespace

std::string crs_name(const JsonValue& crs) {
  const JsonValue* properties = crs.find("properties");
  if (!properties) return "";
  for (const char* key : {"name", "code"}) {  // of type "name", and of type "EPSG" in older files
    const JsonValue* name = properties->find(key);
    if (name && name->is(JsonValue::Kind::kText)) return name->text();
    if (name && name->is(JsonValue::Kind::kNumber)) return fmt::format("EPSG:{}", name->number());
  }
  return "";
}

std::string geographic_crs(const JsonValue& crs) {
  const std::string name = crs_name(crs);
  std::string code = name.substr(name.find_last_of(":/#") + 1);  // npos + 1 is 0
  std::ranges::transform(code, code.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c & ~0x20) : c; });
  const bool is_known = std::ranges::find(kGeographic, code) != std::end(kGeographic);
  return is_known || code == "WGS 84" || code == "WGS84" || code.find("LONGLAT") != std::string::npos ? name : "";
}

bool is_in_degrees(geometry::Point point) {
  return std::abs(point.x) <= 540 && std::abs(point.y) <= 90;
}

void CoordinateEvidence::add(const geometry::Polygon& polygon) {
  if (polygon.outer.empty()) return;
  geometry::Ring within;
  std::ranges::copy_if(polygon.outer, std::back_inserter(within), is_in_degrees);
  ++floes;
  are_all_whole = are_all_whole && within.size() == polygon.outer.size();
  if (2 * within.size() <= polygon.outer.size()) return;
  const geometry::Box of_floe = bounding_box(within);
  if (++in_range == 1) box = of_floe;
  extend(box, of_floe);
  area += std::abs(geometry::signed_area(within));
}

bool CoordinateEvidence::look_polar() const {
  const bool is_far_north_or_south = box.low.y >= kPolarLatitude || box.high.y <= -kPolarLatitude;
  return 2 * in_range > floes && is_far_north_or_south && area < kMostPolarIce;
}

bool CoordinateEvidence::look_like_degrees() const {
  return (floes > 0 && are_all_whole && area < kLeastIce) || look_polar();
}

std::string how_to_project(const geometry::Box& box_in_degrees, const std::string& file) {
  return fmt::format(
      "ogr2ogr -f GeoJSON -t_srs \"+proj=aeqd +lat_0={:.4g} +lon_0={:.5g}\" metres.geojson {} (its "
      "origin is then in their middle)",
      0.5 * (box_in_degrees.low.y + box_in_degrees.high.y), 0.5 * (box_in_degrees.low.x + box_in_degrees.high.x), file);
}

}  // namespace polynya::io
