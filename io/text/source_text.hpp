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

/// A value, or the reason in words why there is none, with the file, the place and the number if there are any.
template <class Value = void>
using Result = tl::expected<Value, std::string>;

/// Makes the failure of a Result.
inline tl::unexpected<std::string> fail(std::string reason) {
  return tl::unexpected<std::string>(std::move(reason));
}

/// Thrown by functions that read a line or a file if it is wrong. Their callers turn it into a Result.
struct ReadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text with its name. Messages use both to state a place.
struct SourceText {
  std::string name;  ///< name for messages, usually the path of the file
  std::string text;
};

struct LineAndColumn {
  int line = 1;    ///< from 1
  int column = 1;  ///< from 1, in characters (code points); a tab counts as one
};

LineAndColumn line_and_column(std::string_view text, std::size_t offset);

/// Calls use(piece, offset) for each piece of a text between separators, such as lines.
template <class Use>
void for_pieces(std::string_view text, char sign, Use use) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(sign, start), text.size());
    use(text.substr(start, end - start), start);
    start = end + 1;
  }
}

/// Returns the text without blanks at both ends.
std::string_view trimmed(std::string_view text);
inline constexpr std::string_view kBlanks = " \t\r\n";

/// Stores where lines start, so that many places in a long text are found quickly.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);
  int line_of(std::size_t offset) const;
  LineAndColumn at(std::size_t offset) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> ends_;
};

/// Effect of a problem: an error refuses the file, the others do not. In the order of name_of().
enum class Severity {
  kError,
  kWarning,  ///< the file works, but it is probably not as intended
  kHint,     ///< the value is unusual
};

std::string_view name_of(Severity severity);

/// One problem of an input file, with its place.
struct Problem {
  std::string file = {};
  int line = 0;           ///< from 1; 0: there is no place, as for an option on the command line
  int column = 0;         ///< from 1, in characters; a tab counts as one
  std::string path = {};  ///< path of the JSON value: "ships[0].hull.length_m"
  std::string found = {};
  std::string allowed = {};
  std::string suggestion = {};  ///< nearest known key or choice; empty: none is near
  std::string sentence = {};    ///< message that replaces found and allowed if these do not fit; empty: they fit
  Severity severity = Severity::kError;
};

/// Longest path of a value that messages show [bytes]. A longer one is shortened.
inline constexpr std::size_t kLongestPath = 160;

/// Returns the message: "found 0, allowed: a number > 0, ≤ 20 [m]".
std::string message_of(const Problem& problem);

/// Returns the message with its place: "scene.json:12:5: ice.thickness_m: found 0, allowed: a number > 0, ≤ 20 [m]".
/// The severity follows the place if it is not an error: "scene.json:9:3: hint: ice.thickness_m: …".
std::string to_string(const Problem& problem);

/// Makes a text from a file printable: control characters and bytes that are not UTF-8 are written as \x8f.
std::string printable(std::string_view text);

/// Shortens a text to at most `most` bytes. It is cut between two characters, and "…" is appended.
std::string shortened(std::string_view text, std::size_t most);

/// Returns the contents of a regular file. Fails with a message if it cannot be read or is longer than `longest`
/// [bytes].
Result<std::string> read_text_file(const std::filesystem::path& path, std::uint64_t longest);

}  // namespace polynya::io
