#include "geometry/exact_text.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <vector>

#include "geometry/internal/exact_polygon.hpp"

namespace polynya::geometry {
namespace {

constexpr std::size_t kLongestNumber =
    1'000'000;  ///< characters of a rational; cuts make them some hundreds long

void append(std::string& text, const exact::Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (i > 0) text += ' ';
    text += ring[i].x.get_str() + ' ' + ring[i].y.get_str();
  }
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// [-]digits[/digits], and no zero below.
std::optional<exact::Rational> read_rational(std::string_view text) {
  const auto is_whole = [](std::string_view digits) {
    return !digits.empty() &&
           std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
  };
  if (text.size() > kLongestNumber) return {};
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string_view above =
      text.substr(text.starts_with('-') ? 1 : 0, slash - (text.starts_with('-') ? 1 : 0));
  if (!is_whole(above)) return {};
  if (slash < text.size()) {
    const std::string_view below = text.substr(slash + 1);
    if (!is_whole(below) || below.find_first_not_of('0') == std::string_view::npos) return {};
  }
  exact::Rational value;
  if (value.set_str(std::string(text), 10) != 0) return {};
  value.canonicalize();
  return value;
}

}  // namespace

std::string exact_text(const Shape& shape) {
  std::string text;
  if (!shape.exact) return text;
  append(text, shape.exact->outer);
  for (const exact::Ring& hole : shape.exact->holes) {
    text += ';';
    append(text, hole);
  }
  return text;
}

tl::expected<std::shared_ptr<const exact::Polygon>, std::string> read_exact_text(std::string_view text,
                                                                                 const Polygon& polygon) {
  if (text.empty()) return nullptr;
  exact::Polygon read;
  bool is_outer = true;
  for (const std::string_view ring_text : split(text, ';')) {
    exact::Ring& ring = is_outer ? read.outer : read.holes.emplace_back();
    is_outer = false;
    const std::vector<std::string_view> numbers = split(ring_text, ' ');
    if (numbers.size() % 2 != 0 || numbers.size() < 6)
      return tl::unexpected(std::string("an exact ring of no points"));
    for (std::size_t i = 0; i < numbers.size(); i += 2) {
      auto x = read_rational(numbers[i]);
      auto y = read_rational(numbers[i + 1]);
      if (!x || !y) return tl::unexpected(std::string("an exact coordinate that is no rational"));
      ring.push_back({std::move(*x), std::move(*y)});
    }
  }
  if (exact::rounded(read) != polygon)
    return tl::unexpected(std::string("exact coordinates that do not round to the polygon's"));
  return std::make_shared<const exact::Polygon>(std::move(read));
}

}  // namespace polynya::geometry
