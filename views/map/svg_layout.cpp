#include "views/map/svg_layout.hpp"

#include <algorithm>

namespace polynya::views {
namespace {

constexpr double kWidthOfCharacter = 0.62;                      ///< DejaVu Sans, on average, of the size [-]
constexpr int kTitle = 18, kWords = 16;                         ///< 9 and 8 pt [px]
constexpr double kTitleLine = 24, kLine = 20, kLegendRow = 27;  ///< [px]
constexpr double kSwatchGap = 10, kEntryGap = 26;               ///< [px]

}  // namespace

double width_of(const std::string& words, double size) {
  const auto begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
  return kWidthOfCharacter * size * static_cast<double>(std::ranges::count_if(words, begins_character));
}

std::vector<std::string> wrapped(const std::string& words, double size, double width) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (lines.empty() || width_of(lines.back() + ' ' + word, size) > width)
      lines.push_back(word);
    else
      lines.back() += ' ' + word;
    at = end + 1;
  }
  return lines;
}

Heading::Heading(double left, const std::string& title, const std::string& caption)
    : left_(left),
      title_(wrapped(title, kTitle * 1.1, kPageWidth - 2 * left)),  // bold is wider
      caption_(wrapped(caption, kWords, kPageWidth - 2 * left)) {}

double Heading::height() const {
  return 10 + kTitleLine * static_cast<double>(title_.size()) + kLine * static_cast<double>(caption_.size());
}

void Heading::draw(SvgText& svg) const {
  double y = 4;
  for (const std::string& line : title_)
    svg.add("<text x='{:.2f}' y='{:.2f}' font-size='{}' font-weight='bold'>{}</text>\n", left_, y += kTitleLine, kTitle,
            io::escaped(line));
  for (const std::string& line : caption_) svg.words(left_, y += kLine, kWords, line);
}

Legend::Legend(const std::vector<Entry>& entries, double left, double right) {
  geometry::Point at{left, kLine};
  for (const Entry& entry : entries) {
    const double before = entry.swatch + kSwatchGap;
    std::vector<std::string> lines = wrapped(entry.words, kWords, right - left - before);
    double width = 0;
    for (const std::string& line : lines) width = std::max(width, width_of(line, kWords));
    if (at.x > left && (at.x + before + width > right || lines.size() > 1)) at = {left, at.y + kLegendRow};
    height_ = at.y + kLine * static_cast<double>(lines.size());
    at.x += before + width + kEntryGap;
    places_.push_back({{at.x - before - width - kEntryGap, at.y}, entry.swatch, lines});
    if (lines.size() > 1) at = {left, height_ + kLegendRow - kLine};
  }
}

geometry::Point Legend::draw(SvgText& svg, std::size_t entry, double top) const {
  const Place& place = places_[entry];
  double y = top + place.at.y;
  for (const std::string& line : place.lines) {
    svg.words(place.at.x + place.swatch + kSwatchGap, y, kWords, line);
    y += kLine;
  }
  return {place.at.x, top + place.at.y};
}

}  // namespace polynya::views
