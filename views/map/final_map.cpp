#include "views/map/final_map.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "io/run/run_folder.hpp"
#include "io/text/child_process.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/output_file.hpp"
#include "io/text/problem.hpp"

namespace polynya::views {
namespace {

using geometry::Box;
using geometry::Point;

/// Pixels per millimetre on paper. Text of 16 px is then 8 pt in print, and text of 18 px is 9 pt.
constexpr double kPixelsPerMm = 16 / (8 * 25.4 / 72);
constexpr double kPageWidth = kPixelsPerMm * 170;   ///< width of a page of a journal [px]
constexpr double kMargin = 24;                      ///< [px]
constexpr double kRoom = kPageWidth - 2 * kMargin;  ///< width of the map [px]
constexpr double kTallest = 1200;                   ///< largest height of the map [px]
constexpr double kFullMarks = 1400;                 ///< on a map of this width or more, marks have their full size [px]
constexpr int kTitle = 18, kWords = 16;             ///< font sizes [px]
constexpr double kLine = 20, kLegendRow = 27,
                 kSwatch = 26;  ///< heights of lines and legend rows, width of samples [px]
/// Width of a character as a fraction of its font size, for DejaVu Sans bold. A title that would be wider than the page
/// is compressed.
constexpr double kWidthOfCharacter = 0.68;

/// Colours: light ice on medium water on white paper, which differ in greyscale. Marks use the Okabe–Ito palette.
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

constexpr std::size_t kLargestConverted = std::size_t{20} << 20;  ///< longest SVG that is passed to a converter [bytes]

struct DrawnFloe {
  geometry::Polygon polygon_in_world;  ///< [m]
  int generation = 0;
  bool came_up = false;  ///< true if it surfaced from under a hull
};

struct DrawnHull {
  geometry::Ring waterline_in_world;   ///< [m]
  std::vector<geometry::Point> track;  ///< track of its centre of gravity [m]; empty for a wall
  bool is_wall = false;
};

class FinalMap {
 public:
  explicit FinalMap(const io::Run& run) : run_(run), time_(run.end_time()) {
    const io::MotionIndex motions(run);
    for_floes_at(run, motions, time_, [&](const io::PlacedFloe& floe) {
      floes_.push_back({transform(floe.world_from_body, *floe.polygon_in_body), floe.birth->generation,
                        run.floe(floe.birth->floe)->came_up});
    });
    for (const io::PlacedFloe& floe : floes_under_hulls_at(run, motions, time_))
      under_hulls_.push_back(transform(floe.world_from_body, *floe.polygon_in_body));
    const simulation::Scene& scene = run.scene.scene;
    for (std::size_t ship = 0; ship < hull_count(scene); ++ship) {
      const geometry::Ring& waterline = hull_of(scene, ship).hull.waterline;
      DrawnHull& hull = hulls_.emplace_back();
      hull.waterline_in_world = transform(ship_pose_at(run, motions, ship, time_), waterline);
      hull.is_wall = kind_of_hull(scene, ship) == simulation::BodyKind::kWall;
      if (hull.is_wall) continue;
      for (const double t : frame_times_until(run, time_))
        hull.track.push_back(ship_pose_at(run, motions, ship, t).position);
    }
    find_extent();
  }

  std::string svg() {
    const std::vector<std::string> caption = caption_lines();
    const double head = 34 + kLine * static_cast<double>(caption.size());
    const std::vector<Key> keys = legend();
    const double rows = std::ceil(static_cast<double>(keys.size()) / 2);
    top_ = head;
    add("<svg xmlns='http://www.w3.org/2000/svg' width='{0:.2f}mm' height='{1:.2f}mm' viewBox='0 0 {2:.2f} {3:.2f}' "
        "font-family='DejaVu Sans, Helvetica, Arial, sans-serif'>\n<rect width='100%' height='100%' fill='#ffffff'/>\n",
        kPageWidth / kPixelsPerMm, (head + height() + kLegendRow * rows + 14) / kPixelsPerMm, kPageWidth,
        head + height() + kLegendRow * rows + 14);
    draw_title();
    double y = 28;
    for (const std::string& line : caption) words(kMargin, y += kLine, line);
    draw_map();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const Point at{i % 2 == 0 ? kMargin : 0.5 * kPageWidth,
                     head + height() + kLegendRow * (1 + std::floor(static_cast<double>(i) / 2))};
      keys[i].draw(at);
      words(at.x + keys[i].width + 10, at.y, keys[i].words);
    }
    return std::move(text_) + "</svg>\n";
  }

 private:
  /// An entry of the legend. Its sample is drawn with its lower left corner at a point [px].
  struct Key {
    std::string words;
    std::function<void(Point)> draw;
    double width = kSwatch;  ///< width of the sample [px]
  };

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }
  void words(double x, double y, const std::string& text) {
    add("<text x='{:.2f}' y='{:.2f}' font-size='{}'>{}</text>\n", x, y, kWords, io::escaped(text));
  }

  double x(Point p) const { return left_ + scale_ * (p.x - extent_.low.x); }
  double y(Point p) const { return top_ + scale_ * (extent_.high.y - p.y); }
  double width() const { return scale_ * (extent_.high.x - extent_.low.x); }
  double height() const { return scale_ * (extent_.high.y - extent_.low.y); }
  double ice_edge() const { return std::clamp(0.4 * scale_, 0.4, 1.2); }  ///< width of the line around ice [px]

  /// Finds the extent of everything that is shown, with a margin.
  void find_extent() {
    std::optional<Box> all;
    const auto include = [&](Point p) {
      if (!all) all = Box{p, p};
      extend(*all, p);
    };
    for (const auto& floe : run_.scene.scene.floes) std::ranges::for_each(floe.polygon_in_world.outer, include);
    for (const DrawnFloe& floe : floes_) std::ranges::for_each(floe.polygon_in_world.outer, include);
    for (const DrawnHull& hull : hulls_) {
      std::ranges::for_each(hull.waterline_in_world, include);
      std::ranges::for_each(hull.track, include);
    }
    const Box shown = all.value_or(Box{{0, 0}, {100, 100}});
    const geometry::Vector size = shown.high - shown.low;
    extent_ = grown(shown, std::max(1.0, 0.02 * std::max(size.x, size.y)));
    const geometry::Vector grown_size = extent_.high - extent_.low;
    scale_ = std::min(kRoom / grown_size.x, kTallest / grown_size.y);
    left_ = kMargin + 0.5 * (kRoom - width());
  }

  template <class Kind>
  std::int64_t count() const {
    return std::ranges::count_if(
        run_.events, [&](const simulation::Event& event) { return event.is<Kind>() && event.time <= time_; });
  }

  std::vector<std::string> caption_lines() const {
    std::vector<std::string> lines{fmt::format("{} broken by bending, {}, {}, {} at the start",
                                               io::counted(count<simulation::Bend>(), "cusp"),
                                               io::counted(count<simulation::Split>(), "split"),
                                               io::counted(std::ssize(floes_), "floe"), run_.scene.scene.floes.size())};
    if (const auto went = count<simulation::Submerge>(); went > 0)
      lines.push_back(fmt::format("{} went under the hull, {} came up", io::counted(went, "piece"),
                                  count<simulation::Resurface>()));
    return lines;
  }

  void draw_title() {
    const std::string title = fmt::format("{} at {:.6g} s", run_.label, time_);
    const bool is_long = kWidthOfCharacter * kTitle * static_cast<double>(title.size()) > kRoom;
    add("<text x='{:.2f}' y='28' font-size='{}' font-weight='bold'{}>{}</text>\n", kMargin, kTitle,
        is_long ? fmt::format(" textLength='{:.2f}' lengthAdjust='spacingAndGlyphs'", kRoom) : "", io::escaped(title));
  }

  void draw_map() {
    add("<clipPath id='map'><rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}'/></clipPath>\n"
        "<rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}' fill='{4}'/>\n<g clip-path='url(#map)'>\n",
        left_, top_, width(), height(), kWater);
    add("<g fill='{}'>\n", kIceAtStart);
    for (const auto& floe : run_.scene.scene.floes) path(floe.polygon_in_world);
    add("</g>\n");
    draw_ice([](const DrawnFloe& floe) { return floe.generation == 0; }, kIce);
    draw_ice([](const DrawnFloe& floe) { return floe.generation > 0 && !floe.came_up; }, kBrokenIce);
    const bool is_crowded = count<simulation::Bend>() > 400;
    draw_fractures<simulation::Bend>(kBend, is_crowded ? 0.65 : 1);
    draw_fractures<simulation::Grind>(kGrind, 1);
    draw_ice(std::mem_fn(&DrawnFloe::came_up), kIceCameUp);
    draw_hulls();
    add("<g {} stroke-width='{:.2f}'>\n", under_hull_style(), ice_edge());
    for (const auto& polygon : under_hulls_) path(polygon);
    add("</g>\n");
    draw_fractures<simulation::Split>(kSplit, 1);
    add("</g>\n");
  }

  void path(const geometry::Polygon& polygon) {
    add("<path d='");
    const auto ring = [&](const geometry::Ring& points) {
      char command = 'M';
      for (const Point p : points) add("{}{:.2f} {:.2f}", std::exchange(command, 'L'), x(p), y(p));
      add("Z");
    };
    ring(polygon.outer);
    std::ranges::for_each(polygon.holes, ring);
    add("'/>\n");
  }

  template <class Condition>
  void draw_ice(Condition condition, const char* colour) {
    add("<g fill='{}' fill-rule='evenodd' stroke='{}' stroke-width='{:.2f}' stroke-linejoin='round'>\n", colour,
        kIceEdge, ice_edge());
    for (const DrawnFloe& floe : floes_) {
      if (condition(floe)) path(floe.polygon_in_world);
    }
    add("</g>\n");
  }

  /// Style of ice under hulls: dashed and pale, so that the hull remains visible through it.
  static std::string under_hull_style() {
    return fmt::format(
        "fill='{0}' fill-opacity='0.25' fill-rule='evenodd' stroke='{0}' stroke-dasharray='3 2' "
        "stroke-linejoin='round'",
        kIceUnderHull);
  }

  void draw_hulls() {
    for (const DrawnHull& hull : hulls_) {
      if (!hull.track.empty()) {
        add("<polyline fill='none' stroke='{}' stroke-width='2' stroke-dasharray='8 4' points='", kTrack);
        for (const Point p : hull.track) add("{:.2f},{:.2f} ", x(p), y(p));
        add("'/>\n");
      }
      add("<g fill='{}' fill-opacity='0.88' stroke='#ffffff' stroke-width='1.5'>\n", hull.is_wall ? kWall : kShip);
      path({hull.waterline_in_world, {}});
      add("</g>\n");
    }
  }

  template <class Kind>
  void draw_fractures(const char* colour, double share) {
    const double size = share * std::clamp(width() / kFullMarks, 0.45, 1.0);
    for (const simulation::Event& event : run_.events) {
      if (!event.is<Kind>() || event.time > time_) continue;
      const Point at{x(event.point_in_world), y(event.point_in_world)};
      std::is_same_v<Kind, simulation::Split> ? triangle(at, colour, size) : disc(at, colour, size);
    }
  }
  void disc(Point at, const char* colour, double size) {
    add("<circle cx='{:.2f}' cy='{:.2f}' r='{:.2f}' fill='{}' stroke='#ffffff' stroke-width='{}'/>\n", at.x, at.y,
        2.8 * size, colour, size < 0.8 ? 0.0 : 0.5);
  }
  void triangle(Point at, const char* colour, double size) {
    add("<path d='M{:.2f} {:.2f}l{:.2f} {:.2f}h{:.2f}Z' fill='{}' stroke='#ffffff' stroke-width='1.5'/>\n", at.x,
        at.y - 9 * size, 8 * size, 14 * size, -16 * size, colour);
  }
  void box(Point at, const char* fill, const char* edge) {
    add("<rect x='{:.2f}' y='{:.2f}' width='{}' height='16' fill='{}' stroke='{}'/>\n", at.x, at.y - 13, kSwatch, fill,
        edge);
  }

  /// Returns the scale bar, which is the longest of 1, 2, 5 × 10ⁿ metres that fits, and entries for everything that the
  /// map shows.
  std::vector<Key> legend() {
    const double room = kRoom / 6 / scale_;
    const double decade = std::pow(10, std::floor(std::log10(room)));
    const double bar = scale_ * decade * (room >= 5 * decade ? 5 : room >= 2 * decade ? 2 : 1);
    std::vector<Key> keys{{fmt::format("{:g} m", bar / scale_),
                           [this, bar](Point at) {
                             add("<path d='M{:.2f} {:.2f}v8h{:.2f}v-8' fill='none' stroke='#000000' "
                                 "stroke-width='2'/>\n",
                                 at.x, at.y - 10, bar);
                           },
                           bar}};
    const auto area = [&](bool is_shown, const char* what, const char* fill, const char* edge) {
      if (is_shown) keys.push_back({what, [=, this](Point at) { box(at, fill, edge); }});
    };
    area(true, "floe as in the scene", kIce, kIceEdge);
    area(true, "piece of a broken floe", kBrokenIce, kIceEdge);
    area(true, "ice at the start, open now", kIceAtStart, kIceAtStart);
    area(true, "water", kWater, kWater);
    area(std::ranges::any_of(floes_, &DrawnFloe::came_up), "piece that came up from under the hull", kIceCameUp,
         kIceEdge);
    const bool has_ships = std::ranges::any_of(hulls_, std::not_fn(&DrawnHull::is_wall));
    area(has_ships, "ship", kShip, kShip);
    area(std::ranges::any_of(hulls_, &DrawnHull::is_wall), "wall", kWall, kWall);
    if (!under_hulls_.empty())
      keys.push_back({"ice under the hull or waiting behind it", [this](Point at) {
                        box(at, kShip, kShip);
                        add("<rect x='{:.2f}' y='{:.2f}' width='18' height='8' {} stroke-width='1.2'/>\n", at.x + 4,
                            at.y - 9, under_hull_style());
                      }});
    if (has_ships)
      keys.push_back({"its track", [this](Point at) {
                        add("<path d='M{:.2f} {:.2f}h{}' stroke='{}' stroke-width='2' stroke-dasharray='8 4'/>\n", at.x,
                            at.y - 5, kSwatch, kTrack);
                      }});
    keys.push_back({"cusp broken by bending", [this](Point at) { disc({at.x + 9, at.y - 6}, kBend, 1); }});
    if (count<simulation::Grind>() > 0)
      keys.push_back({"overlap ground off", [this](Point at) { disc({at.x + 9, at.y - 6}, kGrind, 1); }});
    keys.push_back({"floe split", [this](Point at) { triangle({at.x + 9, at.y - 6}, kSplit, 1); }});
    return keys;
  }

  const io::Run& run_;
  double time_;  ///< time of the map [s]
  std::vector<DrawnFloe> floes_;
  std::vector<geometry::Polygon> under_hulls_;  ///< ice under hulls in the world [m]
  std::vector<DrawnHull> hulls_;
  Box extent_;                             ///< extent of the map in the world [m]
  double scale_ = 1, left_ = 0, top_ = 0;  ///< scale [px/m] and corner of the map [px]
  std::string text_;
};

/// Converts an SVG file of a size [bytes] to a PNG with 240 dots per inch by rsvg-convert. Returns false, and removes
/// the PNG of an earlier picture, if the file is larger than kLargestConverted or the program is not installed or
/// fails.
bool convert_to_png(const std::filesystem::path& svg, std::size_t size, const std::filesystem::path& png) {
  constexpr std::size_t kLongest = std::size_t{1} << 30;  // [bytes]
  std::error_code error;
  const auto there = std::filesystem::symlink_status(png, error);
  if (exists(there) && !is_regular_file(there) && !is_symlink(there)) return false;
  if (size <= kLargestConverted) {
    // It writes to a pipe, because a program that may outlive this one should not write to the folder.
    const auto output =
        io::run_child({"rsvg-convert", "--format=png", "--dpi-x=240", "--dpi-y=240", svg.string()}, kLongest);
    const bool is_made = output && output->code == 0 && !output->out.empty();
    if (is_made && io::write_whole_file(png, output->out, io::Durability::kSynced)) return true;
  }
  std::filesystem::remove(png, error);
  return false;
}

}  // namespace

std::string final_map(const io::Run& run) {
  return FinalMap(run).svg();
}

io::Result<std::string> draw_final_map(const io::Run& run) {
  const std::string svg = final_map(run);
  const auto file = run.folder / io::run_file::kFinalSvg;
  if (const auto written = io::write_whole_file(file, svg, io::Durability::kSynced); !written)
    return io::fail(written.error());
  const auto png = run.folder / io::run_file::kFinalPng;
  const bool is_converted = convert_to_png(file, svg.size(), png);
  return std::string(is_converted ? io::run_file::kFinalPng : io::run_file::kFinalSvg);
}

}  // namespace polynya::views
