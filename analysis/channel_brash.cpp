#include "analysis/channel_brash.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "geometry/exact/measures.hpp"

namespace polynya::analysis {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

std::vector<PlacedIce> with_boxes(const std::vector<Polygon>& polygons) {
  std::vector<PlacedIce> boxed;
  boxed.reserve(polygons.size());
  for (const Polygon& polygon : polygons) boxed.push_back({nullptr, polygon, bounding_box(polygon.outer)});
  return boxed;
}

/// The part of a convex ring where `distance` is not negative; it is linear.
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

/// The part of a station's cell from ice to ice; of fewer than three corners where there is none.
Polygon from_ice_to_ice(const ChannelStation& station, const Polygon& cell) {
  if (!station.is_bounded() || !(station.width() > 0)) return {};
  const auto to_port = [&](Point p) { return cross(station.forward, p - station.middle); };
  const Ring to_starboard_of_port = clipped(cell.outer, [&](Point p) { return station.port - to_port(p); });
  return {clipped(to_starboard_of_port, [&](Point p) { return station.starboard + to_port(p); }), {}};
}

double share(double part, double whole) {
  return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

tl::expected<std::vector<ChannelFloe>, std::string> floes_in(const std::vector<Polygon>& polygons,
                                                             const std::vector<PlacedIce>& ice) {
  std::vector<ChannelFloe> floes;
  const std::vector<PlacedIce> boxed = with_boxes(polygons);
  for (const PlacedIce& floe : ice) {
    const auto parted = part(floe.polygon, near(boxed, floe.box));
    if (!parted) return tl::unexpected(parted.error());
    if (parted->inside_area <= 0) continue;
    if (floes.empty() || floes.back().floe != floe.birth->floe)
      floes.push_back({floe.birth->floe, std::sqrt(floe.birth->area), floe.birth->area, 0});
    floes.back().inside += parted->inside_area;
  }
  std::ranges::stable_sort(floes, std::ranges::greater{}, &ChannelFloe::size);
  return floes;
}

tl::expected<void, std::string> measure_brash(Channel& channel, const std::vector<Polygon>& cells,
                                              const std::vector<PlacedIce>& brash) {
  std::vector<Polygon> stretches;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ChannelStation& station = channel.stations[i];
    Polygon stretch = from_ice_to_ice(station, cells[i]);
    if (stretch.outer.size() < 3) continue;
    auto parted = part(stretch, near(brash, bounding_box(stretch.outer)));
    if (!parted) return tl::unexpected(parted.error());
    channel.area += station.channel_area = geometry::measure(stretch).area;
    channel.brash_area += station.brash_area = parted->inside_area;
    for (Polygon& covered : parted->inside) channel.brash.push_back(std::move(covered));
    stretches.push_back(std::move(stretch));
  }
  return floes_in(stretches, brash).map([&](std::vector<ChannelFloe>&& pieces) {
    channel.brash_pieces = std::move(pieces);
  });
}

double ChannelStation::brash_cover() const {
  return share(brash_area, channel_area);
}

double Channel::brash_cover() const {
  return share(brash_area, area);
}

BrashSizes brash_sizes(const Channel& channel) {
  BrashSizes sizes{.count = channel.brash_pieces.size()};
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (sizes.count == 0) return {0, none, none, none};
  for (const ChannelFloe& piece : channel.brash_pieces)
    sizes.mean += piece.size / static_cast<double>(sizes.count);
  sizes.median = channel.brash_pieces[(sizes.count - 1) / 2].size;
  sizes.largest = channel.brash_pieces.front().size;
  return sizes;
}

}  // namespace polynya::analysis
