#pragma once

#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "geometry/shape/point.hpp"
#include "io/text/encoding.hpp"

namespace polynya::views {

/// The unit of pictures for print: 16 px are 8 pt, at any width of the page. So words of 14 to 18 px have 7
/// to 9 pt on paper.
inline constexpr double kPixelsPerMm = 16 / (8 * 25.4 / 72);

/// The text of an SVG while it is written.
class SvgText {
 public:
  /// A white page of that many pixels.
  SvgText(double width, double height) {
    add("<svg xmlns='http://www.w3.org/2000/svg' width='{0:.2f}mm' height='{1:.2f}mm' viewBox='0 0 {2:.2f} "
        "{3:.2f}' "
        "font-family='DejaVu Sans, Helvetica, Arial, sans-serif'>\n"
        "<rect width='100%' height='100%' fill='#ffffff'/>\n",
        width / kPixelsPerMm, height / kPixelsPerMm, width, height);
  }

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  /// Words that begin at a point, or end or are centred there (anchor "end", "middle").
  void words(double x, double y, int size, const std::string& text, const char* anchor = "start") {
    add("<text x='{:.2f}' y='{:.2f}' font-size='{}' text-anchor='{}'>{}</text>\n", x, y, size, anchor,
        io::escaped(text));
  }

  std::string finish() {
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  std::string text_;
};

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
