#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "io/scene/channel_region.hpp"
#include "io/scene/floe_list_reader.hpp"
#include "simulation/field/brash_layer.hpp"

namespace polynya::io {
namespace {

using geometry::Polygon;
using geometry::Ring;
using simulation::BrashLayer;

constexpr double kMostDefaultCover = 0.9;  ///< denser layers leave pieces of some gaps no room [-]
constexpr double kThickestPiece = 20;      ///< as every floe's [m]
constexpr double kLeastDensity = 100;      ///< as every floe's [kg/m³]

/// The channel's region; the reader made it one before.
const FieldChannel& region_of(const ChannelInput& channel) {
  return std::get<FieldChannel>(channel.brash.region);
}

FloeProperties of_thickness(double thickness) {
  FloeProperties ice;
  ice.thickness = thickness;
  return ice;
}

BrashLayer layer_of(const ChannelInput& channel) {
  return {.width = region_of(channel).width,
          .thickness = channel.thickness,
          .side_thickness = channel.side_thickness.value_or(channel.thickness),
          .porosity = channel.porosity};
}

}  // namespace

/// Completes the keys that are not given, and reports keys that exclude each other. Returns true if there is no
/// problem.
bool FloeListReader::check_channel(ChannelInput& channel, const ReportAt& report_channel) {
  const std::size_t before = problems_.count();
  const bool is_consolidated = channel.consolidated_thickness.has_value();
  if (!channel.side_thickness) channel.side_thickness = channel.thickness;
  if (!channel.fast_ice_thickness) channel.fast_ice_thickness = draft_.scene.ice.thickness;
  if (group_.is_fast) report("fast_ice", "true, of a channel", "false: its sides are fast ice, its pieces are free");
  if (group_.ice && group_.ice->properties[0])
    report("ice.thickness_m", "the thickness of a channel's ice", "channel.thickness_m and fast_ice_thickness_m");
  if (is_consolidated && group_.ice && group_.ice->properties[1])
    report("ice.density_kg_per_m3", "the density of consolidated brash, which follows from its buoyancy", "nothing");
  if (is_consolidated && (group_.velocity != geometry::Vector{} || group_.angular_velocity != 0))
    report("velocity_m_per_s", "a velocity of consolidated brash", "none: a frozen channel is fast ice");
  if (is_consolidated && channel.brash.field.law)
    report_channel("sizes", "sizes beside consolidated_thickness_m", "one of them: a consolidated layer is one plate");
  if (is_consolidated && channel.cover)
    report_channel("cover", "cover beside consolidated_thickness_m", "one of them: a consolidated layer covers all");
  if (!is_consolidated && !channel.brash.field.law)
    report_channel("sizes", "nothing", "a law of the pieces' sizes, or consolidated_thickness_m");
  if (is_consolidated) return problems_.count() == before;
  if (!channel.cover) channel.cover = std::min(kMostDefaultCover, 1 - channel.porosity);
  const BrashLayer layer = layer_of(channel);
  const double thickest =
      std::max(layer.piece_thickness(0, *channel.cover), layer.piece_thickness(0.5 * layer.width, *channel.cover));
  if (thickest > kThickestPiece)
    report_channel("cover", fmt::format("{:g}, which makes pieces {:.3g} m thick", *channel.cover, thickest),
                   fmt::format("pieces at most {:g} m thick: a larger cover, or thinner brash", kThickestPiece));
  return problems_.count() == before;
}

void FloeListReader::add_brash(ChannelInput& channel, const ReportAt& report_channel) {
  channel.brash.field.concentration = *channel.cover;
  auto outcome = make_field(channel.brash, report_channel);
  if (!outcome) return;
  const BrashLayer layer = layer_of(channel);
  BrashReport brash{.least_thickness = kThickestPiece, .asked_volume = layer.mean_ice() * outcome->region_area};
  for (Polygon& piece : std::exchange(outcome->floes, {})) {
    const geometry::Measures measures = geometry::measure(piece);
    const double from_middle = simulation::distance_to_line(measures.centroid, region_of(channel).centreline);
    const double thickness = layer.piece_thickness(from_middle, *channel.cover);
    brash.volume += thickness * measures.area;
    brash.least_thickness = std::min(brash.least_thickness, thickness);
    brash.largest_thickness = std::max(brash.largest_thickness, thickness);
    add_floe(group_, std::move(piece), of_thickness(thickness),
             {.offset = item_->offset, .group = index_, .member = member_++, .is_known_valid = true});
  }
  loaded_.fields.push_back({index_, channel.brash.field.gap, *std::move(outcome), brash});
}

/// One plate of fast ice with the thickness of the frozen layer, and with the buoyancy of that layer and of the brash
/// below it.
void FloeListReader::add_consolidated(const ChannelInput& channel, const ReportAt& report_channel) {
  const double thickness = *channel.consolidated_thickness;
  const double density =
      simulation::consolidated_density(layer_of(channel), thickness, draft_.scene.ice, draft_.scene.water.water);
  if (density < kLeastDensity) {
    const double lighter = draft_.scene.water.water.density - draft_.scene.ice.density;
    const double room = (draft_.scene.water.water.density - kLeastDensity) / lighter - 1;
    return report_channel("consolidated_thickness_m", fmt::format("{:g}", thickness),
                          fmt::format("at least {:.3g}: a thinner layer cannot have the buoyancy of the brash below it",
                                      layer_of(channel).mean_ice() / room));
  }
  const FieldChannel& region = region_of(channel);
  FloeProperties ice = of_thickness(thickness);
  ice.density = density;
  add_fast({channel_region(region.centreline, region.width).outline}, ice);
}

void FloeListReader::add_fast(std::vector<Ring> rings, const FloeProperties& ice) {
  FloeGroup fast = group_;
  fast.is_fast = true;
  fast.velocity = {};
  fast.angular_velocity = 0;
  for (Ring& ring : rings)
    add_floe(fast, {std::move(ring), {}}, ice, {.offset = item_->offset, .group = index_, .member = member_++});
}

void FloeListReader::add_fast_ice(const ChannelInput& channel) {
  if (channel.fast_ice_width == 0) return;
  const FieldChannel& region = region_of(channel);
  const double wider = region.width + 2 * channel.fast_ice_width;
  add_fast(strips_beside(region.centreline, region.width, wider), of_thickness(*channel.fast_ice_thickness));
}

void FloeListReader::add_floes(ChannelInput& channel) {
  const ReportAt report_channel{problems_, *item_->find("channel"), path_ + ".channel"};
  if (!check_channel(channel, report_channel)) return;
  const bool is_consolidated = channel.consolidated_thickness.has_value();
  if (draft_.scene.contact.law == simulation::ContactLaw::kImpulse && (is_consolidated || channel.fast_ice_width > 0))
    return report_channel(is_consolidated ? "consolidated_thickness_m" : "fast_ice_width_m",
                          "fast ice with contact.law impulse", "contact.law crush, or pieces and fast_ice_width_m 0");
  const FieldChannel& region = region_of(channel);
  for (std::size_t i = 1; i < region.centreline.size(); ++i)
    if (region.centreline[i] == region.centreline[i - 1])
      return report_channel("centreline_m", fmt::format("point {} a second time", i), "points that differ");
  const double wider = region.width + 2 * channel.fast_ice_width;
  if (const int point = channel_region(region.centreline, wider).too_sharp; point >= 0)
    return report_channel(
        "centreline_m",
        fmt::format("a bend at point {} that is too sharp for {:g} m of channel and fast ice", point + 1, wider),
        "longer legs, wider angles or less width");
  if (!has_room_for(2, path_)) return;
  const std::size_t before = draft_.scene.floes.size();
  is_consolidated ? add_consolidated(channel, report_channel) : add_brash(channel, report_channel);
  if (draft_.scene.floes.size() == before) return;
  add_fast_ice(channel);
  written.items().push_back(write(kFloesDescription, group_));
}

}  // namespace polynya::io
