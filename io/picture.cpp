#include "io/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/rows_of.hpp"
#include "io/svg_text.hpp"

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Point;

constexpr double kWidth = 1600;    ///< [px]
constexpr double kHeader = 60;     ///< [px]
constexpr double kFooter = 96;     ///< [px]
constexpr double kMargin = 24;     ///< [px]
constexpr double kHead = 32;       ///< above each map of several [px]
constexpr double kTallest = 1500;  ///< of the map [px]

// Light ice on mid water on paper: apart in greyscale. Marks in the Okabe–Ito palette.
constexpr auto kWater = "#8fb8d0";
constexpr auto kIceAtStart = "#a9cadd";
constexpr auto kChannel = "#5e93b5";
constexpr auto kIce = "#ffffff";
constexpr auto kBrokenIce = "#fbeec2";
constexpr auto kIceEdge = "#3d5261";
constexpr auto kShip = "#2b2b2b";
constexpr auto kTrack = "#d55e00";
constexpr auto kBend = "#0072b2";
constexpr auto kSplit = "#d55e00";

/// All that a picture shows.
std::optional<Box> extent_of(const Picture& picture) {
  std::optional<Box> all;
  const auto include = [&](Point p) {
    if (!all) all = Box{p, p};
    all->low = {std::min(all->low.x, p.x), std::min(all->low.y, p.y)};
    all->high = {std::max(all->high.x, p.x), std::max(all->high.y, p.y)};
  };
  for (const auto& polygon : picture.ice_at_start) std::ranges::for_each(polygon.outer, include);
  for (const auto& ship : picture.ships) std::ranges::for_each(ship.waterline_in_world, include);
  for (const auto& floe : picture.floes) std::ranges::for_each(floe.polygon_in_world.outer, include);
  for (const auto& ship : picture.ships) std::ranges::for_each(ship.track, include);
  return all;
}

Box extent_of(const PictureSheet& sheet) {
  std::vector<Point> corners;
  for (const Picture& picture : sheet.pictures) {
    if (const auto box = extent_of(picture)) corners.insert(corners.end(), {box->low, box->high});
  }
  const Box all = corners.empty() ? Box{{0, 0}, {100, 100}} : geometry::bounding_box(corners);
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

/// The mark of a fracture; `size` of the one on a map that has the page to itself is 1.
void draw_mark(SvgText& svg, simulation::EventKind kind, double x, double y, double size) {
  if (kind == simulation::EventKind::kSplit)
    svg.add(
        "<path d='M{0:.2f} {1:.2f}l{2:.2f} {3:.2f}h{4:.2f}Z' fill='{5}' stroke='#ffffff' "
        "stroke-width='1.5'/>\n",
        x, y - 9 * size, 8 * size, 14 * size, -16 * size, kSplit);
  else
    svg.add("<circle cx='{:.2f}' cy='{:.2f}' r='{:.2f}' fill='{}' stroke='#ffffff' stroke-width='0.5'/>\n", x,
            y, 2.8 * size, kBend, size < 0.8 ? "0" : "0.5");
}

class SvgMap {
 public:
  SvgMap(SvgText& svg, const Picture& picture, const MapFrame& frame, std::size_t number)
      : svg_(svg), picture_(picture), frame_(frame), number_(number) {}

  void draw() {
    svg_.add(
        "<clipPath id='map{5}'><rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}'/></clipPath>\n"
        "<rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}' fill='{4}'/>\n<g "
        "clip-path='url(#map{5})'>\n",
        frame_.left, frame_.top, frame_.width(), frame_.height(), kWater, number_);
    draw_water();
    draw_ice();
    draw_fractures(simulation::EventKind::kBend);
    draw_ships();
    draw_fractures(simulation::EventKind::kSplit);
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
    svg_.add("</g>\n<g fill='{}' fill-rule='evenodd'>\n", kChannel);
    for (const auto& polygon : picture_.channel) path(polygon);
    svg_.add("</g>\n");
  }

  void draw_ice() {
    const double line = std::clamp(0.4 * frame_.scale, 0.4, 1.2);
    for (const bool is_broken : {false, true}) {
      svg_.add(
          "<g fill='{}' fill-rule='evenodd' stroke='{}' stroke-width='{:.2f}' stroke-linejoin='round'>\n",
          is_broken ? kBrokenIce : kIce, kIceEdge, line);
      for (const auto& floe : picture_.floes) {
        if ((floe.generation > 0) == is_broken) path(floe.polygon_in_world);
      }
      svg_.add("</g>\n");
    }
  }

  void draw_ships() {
    for (const auto& ship : picture_.ships) {
      svg_.add("<polyline fill='none' stroke='{}' stroke-width='2.5' stroke-dasharray='10 5' points='",
               kTrack);
      for (const Point p : ship.track) svg_.add("{:.2f},{:.2f} ", frame_.x(p), frame_.y(p));
      svg_.add("'/>\n<g fill='{}' fill-opacity='0.88' stroke='#ffffff' stroke-width='1.5'>\n", kShip);
      path({ship.waterline_in_world, {}});
      svg_.add("</g>\n");
    }
  }

  void draw_fractures(simulation::EventKind kind) {
    const double share = std::clamp(frame_.width() / kWidth, 0.5, 1.0);
    const bool is_crowded = kind == simulation::EventKind::kBend && picture_.fractures.size() > 400;
    for (const auto& fracture : picture_.fractures) {
      if (fracture.kind == kind)
        draw_mark(svg_, kind, frame_.x(fracture.point_in_world), frame_.y(fracture.point_in_world),
                  share * (is_crowded ? 0.65 : 1));
    }
  }

  SvgText& svg_;
  const Picture& picture_;
  const MapFrame& frame_;
  std::size_t number_;
};

class SvgSheet {
 public:
  explicit SvgSheet(const PictureSheet& sheet)
      : sheet_(sheet), columns_(std::max<std::size_t>(1, std::min(sheet.columns, sheet.pictures.size()))) {
    const Box extent = extent_of(sheet);
    const geometry::Vector size = extent.high - extent.low;
    const auto across = static_cast<double>(columns_);
    const double scale =
        std::min((kWidth - (across + 1) * kMargin) / across / size.x, kTallest / across / size.y);
    has_heads_ = std::ranges::any_of(sheet.pictures, [](const Picture& p) { return !p.title.empty(); });
    frame_ = {extent, scale, 0, 0};
    left_ = 0.5 * (kWidth - across * frame_.width() - (across - 1) * kMargin);
  }

  std::string draw() {
    const std::size_t rows = rows_of(sheet_.pictures.size(), columns_);
    const double pitch = frame_.height() + (has_heads_ ? kHead : 0) + (rows > 1 ? 8 : 0);
    const double below = kHeader + pitch * static_cast<double>(rows);
    SvgText svg(kWidth, below + kFooter);
    svg.title(left_, sheet_.title, sheet_.caption);
    for (std::size_t i = 0; i < sheet_.pictures.size(); ++i) {
      const Picture& picture = sheet_.pictures[i];
      frame_.left = left_ + static_cast<double>(i % columns_) * (frame_.width() + kMargin);
      frame_.top = kHeader + static_cast<double>(row_of(i, columns_)) * pitch + (has_heads_ ? kHead : 0);
      if (has_heads_) {
        svg.add(
            "<text x='{:.0f}' y='{:.0f}' font-size='17'><tspan font-weight='bold'>{}</tspan>  {}</text>\n",
            frame_.left, frame_.top - 9, escaped(picture.title), escaped(picture.caption));
      }
      SvgMap(svg, picture, frame_, i).draw();
    }
    draw_legend(svg, below + 34);
    return svg.finish();
  }

 private:
  template <class Has>
  bool any(Has has) const {
    return std::ranges::any_of(sheet_.pictures, has);
  }

  void draw_scale_bar(SvgText& svg, double line) const {
    // The longest of 1, 2, 5 × 10ⁿ metres that fits into a sixth of the page.
    const double room = (kWidth - 2 * kMargin) / frame_.scale / 6;
    const double decade = std::pow(10, std::floor(std::log10(room)));
    const double length = decade * (room >= 5 * decade ? 5 : room >= 2 * decade ? 2 : 1);
    svg.add("<path d='M{0:.1f} {1:.1f}v8h{2:.1f}v-8' fill='none' stroke='#000000' stroke-width='2'/>\n",
            kMargin, line - 8, length * frame_.scale);
    svg.words(kMargin, line + 28, 16, fmt::format("{:g} m", length));
  }

  static void swatch(SvgText& svg, double at, double line, const char* colour, const char* edge,
                     const char* words) {
    svg.add("<rect x='{:.0f}' y='{:.0f}' width='26' height='16' fill='{}' stroke='{}'/>\n", at, line - 13,
            colour, edge);
    svg.words(at + 34, line, 16, words);
  }

  void draw_legend(SvgText& svg, double first) const {
    const double second = first + 34;
    const double left = kMargin + 300;
    draw_scale_bar(svg, first);
    swatch(svg, left, first, kIce, kIceEdge, "floe as in the scene");
    swatch(svg, left + 260, first, kBrokenIce, kIceEdge, "piece of a broken floe");
    swatch(svg, left + 540, first, kIceAtStart, kIceAtStart, "ice at the start, open now");
    swatch(svg, left + 830, first, kWater, kWater, "water");
    if (any([](const Picture& p) { return !p.channel.empty(); }))
      swatch(svg, left + 960, first, kChannel, kChannel, "channel: open water");
    swatch(svg, left, second, kShip, kShip, "ship");
    svg.add("<path d='M{:.0f} {:.0f}h26' stroke='{}' stroke-width='2.5' stroke-dasharray='10 5'/>\n",
            left + 260, second - 5, kTrack);
    svg.words(left + 294, second, 16, "its track");
    draw_mark(svg, simulation::EventKind::kBend, left + 553, second - 5, 1);
    svg.words(left + 574, second, 16, "cusp broken by bending");
    draw_mark(svg, simulation::EventKind::kSplit, left + 843, second - 7, 1);
    svg.words(left + 864, second, 16, "floe split");
    if (any([](const Picture& p) { return !p.channel.empty(); }))
      svg.words(left + 994, second, 16, "joined to the track");
  }

  const PictureSheet& sheet_;
  std::size_t columns_;
  bool has_heads_ = false;
  MapFrame frame_;   ///< of the map being drawn
  double left_ = 0;  ///< of the first column [px]
};

}  // namespace

std::string to_svg(const Picture& picture) {
  PictureSheet sheet{picture.title, picture.caption, {picture}, 1};
  sheet.pictures.front().title.clear();
  return to_svg(sheet);
}

std::string to_svg(const PictureSheet& sheet) {
  return SvgSheet(sheet).draw();
}

bool convert_to_png(const std::filesystem::path& svg, const std::filesystem::path& png) {
  std::error_code error_of_file;
  const auto there = std::filesystem::symlink_status(png, error_of_file);
  if (exists(there) && !is_regular_file(there) && !is_symlink(there)) return false;
  std::filesystem::path part = png;  // what is at `png`, or is linked there, is never opened
  part += ".part";
  std::filesystem::remove(part, error_of_file);
  std::array<std::string, 4> words{"rsvg-convert", "--output", part.string(), svg.string()};
  std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 1;
  bool is_made = error == 0 && waitpid(child, &status, 0) == child && status == 0;
  if (is_made) std::filesystem::rename(part, png, error_of_file);
  is_made = is_made && !error_of_file;
  if (!is_made) std::filesystem::remove(part, error_of_file);
  if (!is_made) std::filesystem::remove(png, error_of_file);  // of an earlier picture
  return is_made;
}

}  // namespace polynya::io
