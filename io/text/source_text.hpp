#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace polynya::io {

/// A value, or in words why there is none: with the file, the place and the number where there are any.
template <class Value = void>
using Result = tl::expected<Value, std::string>;

inline tl::unexpected<std::string> fail(std::string reason) {
  return tl::unexpected<std::string>(std::move(reason));
}

/// What is wrong with a line or a file: thrown by what reads one, and a Result where that ends.
struct ReadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text with its name, for messages with a place in it.
struct SourceText {
  std::string name;  ///< as shown to people, usually the file's path
  std::string text;
};

struct LineAndColumn {
  int line = 1;    ///< from 1
  int column = 1;  ///< from 1, in characters (code points); a tab is one
};

LineAndColumn line_and_column(std::string_view text, std::size_t offset);

/// Calls use(piece, offset) for each piece of a text between signs, lines for example.
template <class Use>
void for_pieces(std::string_view text, char sign, Use use) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(sign, start), text.size());
    use(text.substr(start, end - start), start);
    start = end + 1;
  }
}

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);
inline constexpr std::string_view kBlanks = " \t\r\n";

/// Where lines start, so that many places in a long text are found quickly.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);
  int line_of(std::size_t offset) const;
  LineAndColumn at(std::size_t offset) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> ends_;
};

/// The whole of a regular file, or what is wrong with it in words. Longer files are refused, not read.
Result<std::string> read_text_file(const std::filesystem::path& path, std::size_t longest);

}  // namespace polynya::io
