#pragma once

#include <string>
#include <vector>

#include "geometry/shape/point.hpp"
#include "views/map/svg_text.hpp"

namespace polynya::views {

inline constexpr double kPageWidth = kPixelsPerMm * 170;  ///< across a journal's page [px]

/// How wide words of a size are [px], rather more than less.
double width_of(const std::string& words, double size);

/// Words in lines that are no wider than that [px], broken at spaces; a longer word has a line of its own.
std::vector<std::string> wrapped(const std::string& words, double size, double width);

/// Title and caption at the top of a page.
class Heading {
 public:
  Heading(double left, const std::string& title, const std::string& caption);
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

}  // namespace polynya::views
