#pragma once

#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "io/xml_text.hpp"

namespace polynya::io {

/// The text of an SVG while it is written.
class SvgText {
 public:
  /// A white page of that many pixels.
  SvgText(double width, double height) {
    add("<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
        "{1:.0f}' "
        "font-family='DejaVu Sans, Helvetica, Arial, sans-serif'>\n"
        "<rect width='100%' height='100%' fill='#ffffff'/>\n",
        width, height);
  }

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  /// Words that begin at a point, or end or are centred there (anchor "end", "middle").
  void words(double x, double y, int size, const std::string& text, const char* anchor = "start") {
    add("<text x='{:.2f}' y='{:.2f}' font-size='{}' text-anchor='{}'>{}</text>\n", x, y, size, anchor,
        escaped(text));
  }
  void title(double x, const std::string& title, const std::string& caption) {
    add("<text x='{:.0f}' y='30' font-size='24' font-weight='bold'>{}</text>\n", x, escaped(title));
    add("<text x='{:.0f}' y='52' font-size='16' fill='#333333'>{}</text>\n", x, escaped(caption));
  }

  std::string finish() {
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  std::string text_;
};

}  // namespace polynya::io
