#include "io/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include "io/xml_text.hpp"

extern char** environ;

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Point;

constexpr double kWidth = 1600;    ///< [px]
constexpr double kHeader = 60;     ///< [px]
constexpr double kFooter = 96;     ///< [px]
constexpr double kMargin = 24;     ///< [px]
constexpr double kTallest = 1500;  ///< of the map [px]

// Light ice on mid water on paper: apart in greyscale. Marks in the Okabe–Ito palette.
constexpr auto kWater = "#8fb8d0";
constexpr auto kIceAtStart = "#a9cadd";
constexpr auto kIce = "#ffffff";
constexpr auto kBrokenIce = "#fbeec2";
constexpr auto kIceEdge = "#3d5261";
constexpr auto kShip = "#2b2b2b";
constexpr auto kTrack = "#d55e00";
constexpr auto kBend = "#0072b2";
constexpr auto kSplit = "#d55e00";

class SvgMap {
 public:
  explicit SvgMap(const Picture& picture) : picture_(picture) {
    find_extent();
    const geometry::Vector size = extent_.high - extent_.low;
    scale_ = std::min((kWidth - 2 * kMargin) / size.x, kTallest / size.y);
    map_width_ = scale_ * size.x;
    map_height_ = scale_ * size.y;
    left_ = 0.5 * (kWidth - map_width_);
  }

  std::string draw() {
    add("<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
        "{1:.0f}' "
        "font-family='DejaVu Sans, Helvetica, Arial, sans-serif'>\n",
        kWidth, kHeader + map_height_ + kFooter);
    add("<rect width='100%' height='100%' fill='#ffffff'/>\n");
    add("<text x='{:.0f}' y='30' font-size='24' font-weight='bold'>{}</text>\n", left_,
        escaped(picture_.title));
    add("<text x='{:.0f}' y='52' font-size='16' fill='#333333'>{}</text>\n", left_,
        escaped(picture_.caption));
    add("<clipPath id='map'><rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}'/></clipPath>\n"
        "<rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}' fill='{4}'/>\n<g "
        "clip-path='url(#map)'>\n",
        left_, kHeader, map_width_, map_height_, kWater);
    draw_ice();
    draw_fractures(simulation::EventKind::kBend);
    draw_ships();
    draw_fractures(simulation::EventKind::kSplit);
    add("</g>\n");
    draw_legend();
    add("</svg>\n");
    return std::move(svg_);
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(svg_), format, std::forward<Values>(values)...);
  }

  double x(Point p) const { return left_ + scale_ * (p.x - extent_.low.x); }
  double y(Point p) const { return kHeader + scale_ * (extent_.high.y - p.y); }

  void find_extent() {
    std::optional<Box> all;
    const auto include = [&](Point p) {
      if (!all) all = Box{p, p};
      all->low = {std::min(all->low.x, p.x), std::min(all->low.y, p.y)};
      all->high = {std::max(all->high.x, p.x), std::max(all->high.y, p.y)};
    };
    for (const auto& polygon : picture_.ice_at_start) std::ranges::for_each(polygon.outer, include);
    for (const auto& ship : picture_.ships) std::ranges::for_each(ship.waterline_in_world, include);
    for (const auto& floe : picture_.floes) std::ranges::for_each(floe.polygon_in_world.outer, include);
    for (const auto& ship : picture_.ships) std::ranges::for_each(ship.track, include);
    if (!all) all = Box{{0, 0}, {100, 100}};
    const geometry::Vector size = all->high - all->low;
    extent_ = grown(*all, std::max(1.0, 0.02 * std::max(size.x, size.y)));
  }

  void path(const geometry::Polygon& polygon) {
    add("<path d='");
    ring(polygon.outer);
    for (const auto& hole : polygon.holes) ring(hole);
    add("'/>\n");
  }
  void ring(const geometry::Ring& points) {
    char command = 'M';
    for (const Point p : points) {
      add("{}{:.2f} {:.2f}", command, x(p), y(p));
      command = 'L';
    }
    add("Z");
  }

  void draw_ice() {
    add("<g fill='{}'>\n", kIceAtStart);
    for (const auto& polygon : picture_.ice_at_start) path(polygon);
    add("</g>\n");
    const double line = std::clamp(0.4 * scale_, 0.4, 1.2);
    for (const bool is_broken : {false, true}) {
      add("<g fill='{}' fill-rule='evenodd' stroke='{}' stroke-width='{:.2f}' stroke-linejoin='round'>\n",
          is_broken ? kBrokenIce : kIce, kIceEdge, line);
      for (const auto& floe : picture_.floes) {
        if ((floe.generation > 0) == is_broken) path(floe.polygon_in_world);
      }
      add("</g>\n");
    }
  }

  void draw_ships() {
    for (const auto& ship : picture_.ships) {
      add("<polyline fill='none' stroke='{}' stroke-width='2.5' stroke-dasharray='10 5' points='", kTrack);
      for (const Point p : ship.track) add("{:.2f},{:.2f} ", x(p), y(p));
      add("'/>\n<g fill='{}' fill-opacity='0.88' stroke='#ffffff' stroke-width='1.5'>\n", kShip);
      path({ship.waterline_in_world, {}});
      add("</g>\n");
    }
  }

  void mark(simulation::EventKind kind, double at_x, double at_y) {
    if (kind == simulation::EventKind::kSplit) {
      add("<path d='M{0:.2f} {1:.2f}l8 14h-16Z' fill='{2}' stroke='#ffffff' stroke-width='1.5'/>\n", at_x,
          at_y - 9, kSplit);
    } else {
      add("<circle cx='{:.2f}' cy='{:.2f}' r='{}' fill='{}' stroke='#ffffff' stroke-width='0.5'/>\n", at_x,
          at_y, picture_.fractures.size() > 400 ? "1.8" : "2.8", kBend);
    }
  }

  void draw_fractures(simulation::EventKind kind) {
    for (const auto& fracture : picture_.fractures) {
      if (fracture.kind == kind) mark(kind, x(fracture.point_in_world), y(fracture.point_in_world));
    }
  }

  void swatch(double at, double line, const char* colour, const char* edge, const char* words) {
    add("<rect x='{:.0f}' y='{:.0f}' width='26' height='16' fill='{}' stroke='{}'/>\n", at, line - 13, colour,
        edge);
    add("<text x='{:.0f}' y='{:.0f}' font-size='16'>{}</text>\n", at + 34, line, words);
  }

  void draw_legend() {
    const double first = kHeader + map_height_ + 34;
    const double second = first + 34;
    // The longest of 1, 2, 5 × 10ⁿ metres that fits into a sixth of the map.
    const double room = map_width_ / scale_ / 6;
    const double decade = std::pow(10, std::floor(std::log10(room)));
    const double length = decade * (room >= 5 * decade ? 5 : room >= 2 * decade ? 2 : 1);
    add("<path d='M{0:.1f} {1:.1f}v8h{2:.1f}v-8' fill='none' stroke='#000000' stroke-width='2'/>\n", left_,
        first - 8, length * scale_);
    add("<text x='{:.1f}' y='{:.1f}' font-size='16'>{:g} m</text>\n", left_, second - 6, length);
    const double left = left_ + std::max(300.0, length * scale_ + 40);
    swatch(left, first, kIce, kIceEdge, "floe as in the scene");
    swatch(left + 260, first, kBrokenIce, kIceEdge, "piece of a broken floe");
    swatch(left + 540, first, kIceAtStart, kIceAtStart, "ice at the start, open now");
    swatch(left + 830, first, kWater, kWater, "water");
    swatch(left, second, kShip, kShip, "ship");
    add("<path d='M{:.0f} {:.0f}h26' stroke='{}' stroke-width='2.5' stroke-dasharray='10 5'/>\n", left + 260,
        second - 5, kTrack);
    add("<text x='{:.0f}' y='{:.0f}' font-size='16'>its track</text>\n", left + 294, second);
    mark(simulation::EventKind::kBend, left + 553, second - 5);
    add("<text x='{:.0f}' y='{:.0f}' font-size='16'>cusp broken by bending</text>\n", left + 574, second);
    mark(simulation::EventKind::kSplit, left + 843, second - 7);
    add("<text x='{:.0f}' y='{:.0f}' font-size='16'>floe split</text>\n", left + 864, second);
  }

  const Picture& picture_;
  Box extent_;
  double scale_ = 1;  ///< [px/m]
  double map_width_ = 0;
  double map_height_ = 0;
  double left_ = 0;
  std::string svg_;
};

}  // namespace

std::string to_svg(const Picture& picture) {
  return SvgMap(picture).draw();
}

bool convert_to_png(const std::filesystem::path& svg, const std::filesystem::path& png) {
  std::array<std::string, 4> words{"rsvg-convert", "--output", png.string(), svg.string()};
  std::array<char*, 5> arguments{words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 1;
  if (error != 0 || waitpid(child, &status, 0) != child || status != 0) {
    std::error_code ignored;
    std::filesystem::remove(png, ignored);
    return false;
  }
  return true;
}

}  // namespace polynya::io
