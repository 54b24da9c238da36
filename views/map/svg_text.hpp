#pragma once

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

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

}  // namespace polynya::views
