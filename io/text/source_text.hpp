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

/// What a problem does to a file: an error refuses it, the others do not. In the order of name_of().
enum class Severity {
  kError,
  kWarning,  ///< it works, and is probably not meant
  kHint,     ///< it is unusual
};

std::string_view name_of(Severity severity);

/// One thing wrong in an input file, with its place.
struct Problem {
  std::string file = {};
  int line = 0;           ///< from 1; 0 where there is no place (an option on the command line)
  int column = 0;         ///< from 1, in characters; a tab is one
  std::string path = {};  ///< of the JSON value: "ships[0].hull.length_m"
  std::string found = {};
  std::string allowed = {};
  std::string suggestion = {};  ///< nearest known key or choice; empty where none is near
  std::string sentence = {};    ///< in place of found and allowed where those do not fit; else empty
  Severity severity = Severity::kError;
};

inline constexpr std::size_t kLongestPath = 160;  ///< in messages [bytes]

/// "found 0, allowed: a number > 0, ≤ 20 [m]"
std::string message_of(const Problem& problem);

/// "scene.json:12:5: ice.thickness_m: found 0, allowed: a number > 0, ≤ 20 [m]"; what is no error has its
/// severity behind the place: "scene.json:9:3: hint: ice.thickness_m: …"
std::string to_string(const Problem& problem);

/// Makes a text from a file printable: writes control characters and bytes that are not UTF-8 as \x8f.
std::string printable(std::string_view text);

/// A text of at most `most` bytes, cut between two characters and then ended by "…".
std::string shortened(std::string_view text, std::size_t most);

/// The whole of a regular file, or what is wrong with it in words. Longer files are refused, not read.
Result<std::string> read_text_file(const std::filesystem::path& path, std::uint64_t longest);

}  // namespace polynya::io
