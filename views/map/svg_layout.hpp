#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/point.hpp"
#include "views/map/svg_text.hpp"

namespace polynya::views {

/// How a figure's page is made.
struct PageStyle {
  double width = 170;                     ///< on paper: across a journal's page [mm]
  std::optional<std::string> title = {};  ///< instead of the figure's own; empty: neither title nor caption

  double pixels() const { return kPixelsPerMm * width; }
};

/// How wide words of a size are [px], rather more than less.
double width_of(const std::string& words, double size);

/// Words in lines that are no wider than that [px], broken at spaces; a longer word has a line of its own.
std::vector<std::string> wrapped(const std::string& words, double size, double width);

/// Title and caption at the top of a page.
class Heading {
 public:
  Heading(const PageStyle& page, double left, const std::string& title, const std::string& caption);
  double height() const;  ///< [px]
  void draw(SvgText& svg) const;

 private:
  double left_;  ///< [px]
  std::vector<std::string> title_, caption_;
};

/// The entries of a legend, row by row; each keeps its swatch, also where its words take several lines.
class Legend {
 public:
  struct Entry {
    std::string words;
    double swatch = 48;  ///< its width [px]
  };
  Legend(const std::vector<Entry>& entries, double left, double right);
  double height() const { return height_; }  ///< [px]
  /// Writes the words of the entry, the legend's top being at `top`; the swatch belongs to the left of them,
  /// its lower left corner at the point returned [px].
  geometry::Point draw(SvgText& svg, std::size_t entry, double top) const;

 private:
  struct Place {
    geometry::Point at;  ///< baseline, from the legend's top [px]
    double swatch;       ///< [px]
    std::vector<std::string> lines;
  };
  std::vector<Place> places_;
  double height_ = 0;
};

/// Entries set row by row, an equal number a row: where the one at a place goes, and how many rows they fill.
constexpr std::size_t row_of(std::size_t place, std::size_t columns) {
  return place / columns;
}
constexpr std::size_t rows_of(std::size_t count, std::size_t columns) {
  return (count + columns - 1) / columns;
}

/// "(a) ", "(b) ", … of several panels; empty of a single one.
std::string letter_of(std::size_t panel, std::size_t panels);

}  // namespace polynya::views
