#include "analysis/channel_text.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "analysis/floe_sizes.hpp"
#include "io/text/csv_row.hpp"
#include "io/text/geojson_layer.hpp"

namespace polynya::analysis {
namespace {

using io::GeojsonLayer;

double heading_deg(const ChannelStation& station) {
  return 180 / std::numbers::pi * std::atan2(station.forward.y, station.forward.x);
}

std::string side(double width, bool has_ice) {
  return has_ice ? fmt::format("{:.2f}", width) : fmt::format(">{:.2f}", width);
}

/// The cell of the table.
std::string brash_cell(const ChannelStation& station) {
  return station.channel_area > 0 ? fmt::format(" {:>10.2f}", 100 * station.brash_cover())
                                  : fmt::format(" {:>10}", "-");
}

std::string size_table(const Channel& channel) {
  if (channel.floes.empty()) return "";
  std::vector<SizedFloe> floes;
  for (const ChannelFloe& floe : channel.floes) floes.push_back({floe.size, floe.inside});
  std::ranges::reverse(floes);
  std::string text = fmt::format("{:>10} {:>10} {:>8} {:>16} {:>10}\n", "from_m", "below_m", "floes",
                                 "inside_area_m2", "from_on");
  for (const SizeClass& one : size_classes(floes))
    text += fmt::format("{:>10g} {:>10g} {:>8} {:>16.4f} {:>10}\n", one.from, one.below, one.count, one.area,
                        one.from_on);
  return text;
}

std::string summary_lines(const Channel& channel) {
  const WidthSummary width = widths(channel);
  std::string text;
  if (width.count == 0)
    text += "no station has ice on both sides within reach: nothing to call a width\n";
  else
    text += fmt::format(
        "width  mean {:.2f} m, least {:.2f} m, most {:.2f} m; over the beam {:.2f}, {:.2f}, {:.2f}\n",
        width.mean, width.least, width.most, width.mean / channel.beam, width.least / channel.beam,
        width.most / channel.beam);
  const double swept = channel.swept_area;
  text += fmt::format(
      "swept by the hull  {:.2f} m2; ice covered {:.2f} % of it at the start, {:.2f} % now ({:.2f} m2)\n",
      swept, 100 * channel.swept_ice_at_start / swept, 100 * channel.swept_ice() / swept,
      channel.swept_ice());
  if (channel.floes.empty())
    text += "no floe is left in it\n";
  else
    text += fmt::format("largest floe in it  floe {}, {:.2f} m (root of its area), {:.2f} m2 of it inside\n",
                        channel.floes.front().floe, channel.floes.front().size, channel.floes.front().inside);
  text += fmt::format("open water joined to the track, up to {:g} m to either side  {:.2f} m2\n",
                      channel.reach, channel.open_area);
  return text;
}

/// Empty where nothing came up from under a hull.
std::string brash_lines(const Channel& channel) {
  if (channel.brash_pieces.empty()) return "";
  const BrashSizes sizes = brash_sizes(channel);
  return fmt::format(
      "brash covers {:.2f} % of the {:.2f} m2 from ice to ice, {:.2f} % is open water\n"
      "pieces of brash  {}; mean {:.2f} m, median {:.2f} m, largest {:.2f} m (root of the area)\n",
      100 * channel.brash_cover(), channel.area, 100 * (1 - channel.brash_cover()), sizes.count, sizes.mean,
      sizes.median, sizes.largest);
}

void append(io::JsonWriter& json, const Channel& channel) {
  const WidthSummary width = widths(channel);
  json.key("ship").value(channel.ship).key("t_s").value(channel.time);
  json.key("beam_m").value(channel.beam).key("spacing_m").value(channel.spacing);
  json.key("reach_m").value(channel.reach).key("stations").value(channel.stations.size());
  json.key("bounded_stations").value(width.count);
  json.key("mean_width_m").value(width.mean).key("least_width_m").value(width.least);
  json.key("most_width_m").value(width.most);
  json.key("swept_area_m2").value(channel.swept_area);
  json.key("swept_ice_at_start_m2").value(channel.swept_ice_at_start);
  json.key("swept_ice_m2").value(channel.swept_ice());
  json.key("floes_in_band").value(channel.floes.size());
  json.key("largest_floe_m").value(channel.floes.empty() ? 0 : channel.floes.front().size);
  json.key("open_area_m2").value(channel.open_area);
  json.key("channel_area_m2").value(channel.area).key("brash_area_m2").value(channel.brash_area);
  json.key("brash_cover").value(channel.brash_cover());
  const BrashSizes sizes = brash_sizes(channel);
  json.key("brash_pieces").value(sizes.count).key("mean_piece_m").value(sizes.mean);
  json.key("median_piece_m").value(sizes.median).key("largest_piece_m").value(sizes.largest);
}

void append_floe(io::JsonWriter& json, const ChannelFloe& floe) {
  json.open('{').key("floe_id").value(floe.floe).key("size_m").value(floe.size);
  json.key("area_m2").value(floe.area).key("inside_m2").value(floe.inside).close('}');
}

void append_station(GeojsonLayer& layer, const ChannelStation& s, std::size_t number) {
  io::JsonWriter& json = layer.start().key("part").value("station");
  json.key("station")
      .value(number)
      .key("along_m")
      .value(s.along)
      .key("passed_s")
      .value(s.passed)
      .key("port_m")
      .value(s.port);
  json.key("starboard_m").value(s.starboard).key("width_m").value(s.width());
  json.key("is_bounded").value(s.is_bounded()).key("ice_across_beam").value(s.ice_across_beam);
  json.key("channel_area_m2").value(s.channel_area).key("brash_area_m2").value(s.brash_area);
  json.key("brash_cover").value(s.brash_cover());
  const geometry::Vector to_port = perpendicular(s.forward);
  layer.end_with(geometry::Ring{s.middle + s.port * to_port, s.middle - s.starboard * to_port});
}

}  // namespace

std::string to_table(const Channel& channel) {
  std::string text =
      fmt::format("channel of {} at {:g} s: {} of {:g} m, {} with ice on both sides within {:g} m\n",
                  channel.ship, channel.time, io::counted(channel.stations.size(), "station"),
                  channel.spacing, widths(channel).count, channel.reach);
  const bool has_brash = !channel.brash_pieces.empty();
  text += fmt::format("{:>9} {:>9} {:>9} {:>9} {:>9} {:>11} {:>9} {:>9} {:>10}{}\n", "along_m", "passed_s",
                      "x_m", "y_m", "port_m", "starboard_m", "width_m", "over_beam", "ice_beam_%",
                      has_brash ? "    brash_%" : "");
  for (const ChannelStation& s : channel.stations)
    text += fmt::format("{:>9.1f} {:>9.1f} {:>9.2f} {:>9.2f} {:>9} {:>11} {:>9} {:>9.2f} {:>10.2f}{}\n",
                        s.along, s.passed, s.middle.x, s.middle.y, side(s.port, s.has_port_ice),
                        side(s.starboard, s.has_starboard_ice), side(s.width(), s.is_bounded()),
                        s.width() / channel.beam, 100 * s.ice_across_beam, has_brash ? brash_cell(s) : "");
  return text + summary_lines(channel) + brash_lines(channel) + size_table(channel);
}

std::string to_csv(const Channel& channel) {
  std::string text =
      "station,along_m,passed_s,x_m,y_m,track_deg,port_m,starboard_m,width_m,width_over_beam,has_port_ice,"
      "has_starboard_ice,ice_across_beam,channel_area_m2,brash_area_m2,brash_cover\n";
  for (std::size_t i = 0; i < channel.stations.size(); ++i) {
    const ChannelStation& s = channel.stations[i];
    io::append_number(text, static_cast<std::int64_t>(i));
    io::append_csv(text,
                   {s.along, s.passed, s.middle.x, s.middle.y, heading_deg(s), s.port, s.starboard, s.width(),
                    s.width() / channel.beam, s.has_port_ice ? 1.0 : 0.0, s.has_starboard_ice ? 1.0 : 0.0,
                    s.ice_across_beam, s.channel_area, s.brash_area, s.brash_cover()});
    text += '\n';
  }
  return text;
}

std::string to_json_text(const Channel& channel) {
  std::string text;
  io::JsonWriter json(text, io::JsonWriter::Layout::kIndented);
  json.open('{');
  append(json, channel);
  json.key("floes").open('[');
  for (const ChannelFloe& floe : channel.floes) append_floe(json, floe);
  json.close(']').key("brash").open('[');
  for (const ChannelFloe& piece : channel.brash_pieces) append_floe(json, piece);
  json.close(']').close('}');
  return text + "\n";
}

std::string to_geojson(const Channel& channel) {
  GeojsonLayer layer(channel.time);
  append(layer.start().key("part").value("open water"), channel);
  layer.end_with(channel.open_water);
  if (!channel.brash.empty()) {
    layer.start().key("part").value("brash").key("area_m2").value(channel.brash_area);
    layer.end_with(channel.brash);
  }
  layer.start().key("part").value("swept band").key("area_m2").value(channel.swept_area);
  layer.end_with(channel.swept);
  if (channel.track.size() > 1) {
    layer.start().key("part").value("track");
    layer.end_with(geometry::Ring(channel.track));
  }
  for (std::size_t i = 0; i < channel.stations.size(); ++i) append_station(layer, channel.stations[i], i);
  return layer.finish();
}

}  // namespace polynya::analysis
