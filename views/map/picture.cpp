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
constexpr double kLeastMap = 220;    ///< as wide as maps beside each other are at least [px]
constexpr double kTallest = 1200;    ///< of the map [px]
constexpr double kHeadLine = 20;     ///< of the words above each map of several [px]
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

Box extent_of(const PictureSheet& sheet) {
  if (sheet.window) return *sheet.window;
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

class SvgMap {
 public:
  SvgMap(SvgText& svg, const Picture& picture, const MapFrame& frame, std::size_t number)
      : svg_(svg), picture_(picture), frame_(frame), number_(number) {}

  void draw() {
    svg_.add(
        "<clipPath id='map{5}'><rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}'/></clipPath>\n"
        "<rect x='{0:.2f}' y='{1:.2f}' width='{2:.2f}' height='{3:.2f}' fill='{4}'/>\n<g "
        "clip-path='url(#map{5})'>\n",
        frame_.left, frame_.top, frame_.width(), frame_.height(), map_colour::kWater, number_);
    draw_water();
    draw_ice([](const Picture::Floe& floe) { return floe.generation == 0; }, map_colour::kIce);
    draw_ice([](const Picture::Floe& floe) { return floe.generation > 0 && !floe.came_up; },
             map_colour::kBrokenIce);
    draw_fractures(simulation::EventKind::kBend);
    draw_fractures(simulation::EventKind::kGrind);
    draw_ice(std::mem_fn(&Picture::Floe::came_up), map_colour::kIceCameUp);
    draw_ships();
    draw_ice_under_hulls();
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
    svg_.add("<g fill='{}'>\n", map_colour::kIceAtStart);
    for (const auto& polygon : picture_.ice_at_start) path(polygon);
    svg_.add("</g>\n<g fill='{}' fill-rule='evenodd'>\n", map_colour::kChannel);
    for (const auto& polygon : picture_.channel) path(polygon);
    svg_.add("</g>\n");
  }

  double ice_edge() const { return std::clamp(0.4 * frame_.scale, 0.4, 1.2); }  ///< [px]

  template <class Condition>
  void draw_ice(Condition condition, const char* colour) {
    svg_.add("<g fill='{}' fill-rule='evenodd' stroke='{}' stroke-width='{:.2f}' stroke-linejoin='round'>\n",
             colour, map_colour::kIceEdge, ice_edge());
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
    svg_.add("<polyline fill='none' stroke='{}' stroke-width='2' stroke-dasharray='8 4' points='",
             map_colour::kTrack);
    for (const Point p : ship.track) svg_.add("{:.2f},{:.2f} ", frame_.x(p), frame_.y(p));
    svg_.add("'/>\n");
  }

  void draw_fractures(simulation::EventKind kind) {
    const double share = std::clamp(frame_.width() / kFullMarks, 0.45, 1.0);
    const bool is_crowded = kind == simulation::EventKind::kBend && picture_.fractures.size() > 400;
    for (const auto& fracture : picture_.fractures) {
      if (fracture.kind == kind)
        draw_fracture_mark(svg_, kind, frame_.x(fracture.point_in_world), frame_.y(fracture.point_in_world),
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
      : sheet_(sheet),
        width_(sheet.page.pixels()),
        heading_(sheet.page, kMargin, sheet.title, sheet.caption) {
    const auto most = static_cast<std::size_t>(std::max(1.0, (width_ - kMargin) / (kLeastMap + kMargin)));
    columns_ = std::max<std::size_t>(1, std::min({sheet.columns, sheet.pictures.size(), most}));
    const auto across = static_cast<double>(columns_);
    cell_ = (width_ - (across + 1) * kMargin) / across;
    const Box extent = extent_of(sheet);
    const geometry::Vector size = extent.high - extent.low;
    frame_ = {extent, std::min(cell_ / size.x, kTallest / across / size.y), 0, 0};
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) heads_.push_back(head_of(i));
  }

  std::string draw() {
    std::size_t lines = 0;
    for (const auto& head : heads_) lines = std::max(lines, head.size());
    const double head = kHeadLine * static_cast<double>(lines) + (lines > 0 ? 8 : 0);
    const std::size_t rows = rows_of(sheet_.pictures.size(), columns_);
    const double pitch = head + frame_.height() + 10;
    const double below = heading_.height() + pitch * static_cast<double>(rows);
    const auto any = [&](auto condition) { return std::ranges::any_of(sheet_.pictures, condition); };
    const MapContents contents{
        .has_channel = any([](const Picture& p) { return !p.channel.empty(); }),
        .has_walls =
            any([](const Picture& p) { return std::ranges::any_of(p.ships, &Picture::Ship::is_wall); }),
        .has_ice_under_hulls = any([](const Picture& p) { return !p.ice_under_hulls.empty(); }),
        .has_ice_that_came_up =
            any([](const Picture& p) { return std::ranges::any_of(p.floes, &Picture::Floe::came_up); })};
    const std::vector<MapKey> keys = map_keys(frame_.scale, (width_ - 2 * kMargin) / 6, contents);
    std::vector<Legend::Entry> entries;
    entries.reserve(keys.size());
    for (const MapKey& key : keys) entries.push_back(key.entry);
    const Legend legend(entries, kMargin, width_ - kMargin);
    SvgText svg(width_, below + legend.height());
    heading_.draw(svg);
    for (std::size_t i = 0; i < sheet_.pictures.size(); ++i) {
      frame_.left = left_of_cell(i % columns_) + 0.5 * (cell_ - frame_.width());
      frame_.top = heading_.height() + static_cast<double>(row_of(i, columns_)) * pitch + head;
      draw_head(svg, i, frame_.top - head);
      SvgMap(svg, sheet_.pictures[i], frame_, i).draw();
    }
    for (std::size_t i = 0; i < keys.size(); ++i) keys[i].draw(svg, legend.draw(svg, i, below));
    return svg.finish();
  }

 private:
  double left_of_cell(std::size_t column) const {
    return kMargin + static_cast<double>(column) * (cell_ + kMargin);
  }

  /// The words above a map, in lines: its title, then its caption.
  std::vector<std::string> head_of(std::size_t picture) const {
    const Picture& p = sheet_.pictures[picture];
    if (p.title.empty()) return {};
    const std::string letter = letter_of(picture, sheet_.pictures.size());
    std::vector<std::string> lines = wrapped(letter + p.title, 17.6, cell_);
    for (std::string& line : wrapped(p.caption, 14, cell_)) lines.push_back(std::move(line));
    return lines;
  }

  void draw_head(SvgText& svg, std::size_t picture, double y) const {
    const std::size_t bold =
        wrapped(letter_of(picture, sheet_.pictures.size()) + sheet_.pictures[picture].title, 17.6, cell_)
            .size();
    for (std::size_t i = 0; i < heads_[picture].size(); ++i) {
      y += kHeadLine;
      svg.add("<text x='{:.2f}' y='{:.2f}' font-size='{}' font-weight='{}'>{}</text>\n",
              left_of_cell(picture % columns_), y, i < bold ? 16 : 14, i < bold ? "bold" : "normal",
              io::escaped(heads_[picture][i]));
    }
  }

  const PictureSheet& sheet_;
  double width_;  ///< of the page [px]
  Heading heading_;
  std::size_t columns_ = 1;
  double cell_ = 0;  ///< room for a map, as wide [px]
  std::vector<std::vector<std::string>> heads_;
  MapFrame frame_;  ///< of the map being drawn
};

}  // namespace

std::string to_svg(const Picture& picture) {
  PictureSheet sheet{picture.title, picture.caption, {picture}};
  sheet.pictures.front().title.clear();
  return to_svg(sheet);
}

std::string to_svg(const PictureSheet& sheet) {
  return SvgSheet(sheet).draw();
}

}  // namespace polynya::views
