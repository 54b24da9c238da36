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

/// A value, or the reason in words why there is none. The reason is a message for the user, with file, place and number
/// as far as the function that fails knows them.
template <class Value = void>
using Result = tl::expected<Value, std::string>;

/// Returns the failure of a Result.
inline tl::unexpected<std::string> fail(std::string reason) {
  return tl::unexpected<std::string>(std::move(reason));
}

/// Thrown by functions that read a line or a file if it is wrong. Their callers turn it into a Result, mostly after
/// adding the file and the line to its text.
struct ReadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text with its name. Messages need both to state a place.
struct SourceText {
  std::string name;  ///< name for messages, usually the path of the file
  std::string text;
};

/// Place in a text.
struct LineAndColumn {
  int line = 1;    ///< from 1
  int column = 1;  ///< from 1, in characters (code points); a tab counts as one
};

/// Returns the place of a byte of a text by its position [bytes]; a position beyond the text gives its end. Takes time
/// in proportion to the position; LineIndex is faster for many places.
LineAndColumn line_and_column(std::string_view text, std::size_t offset);

/// Calls use(piece, offset) for each piece of a text between separators `sign`, such as lines. `offset` is the position
/// of the piece [bytes]. Pieces may be empty, but there is no piece behind a separator at the end of the text.
template <class Use>
void for_pieces(std::string_view text, char sign, Use use) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(sign, start), text.size());
    use(text.substr(start, end - start), start);
    start = end + 1;
  }
}

/// Returns the part of a text without blanks (kBlanks) at both ends; empty if the text has only blanks. It is a view of
/// the same text.
std::string_view trimmed(std::string_view text);
/// Characters that trimmed() removes: those between the words of JSON.
inline constexpr std::string_view kBlanks = " \t\r\n";

/// Stores where lines end, so that many places in a long text are found quickly. The text must outlive it.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);
  /// Returns the line, from 1, of a position in the text [bytes]. A line break belongs to the line that it ends. A
  /// position beyond the text is in the last line.
  int line_of(std::size_t offset) const;
  /// Returns the place of a position in the text [bytes], as line_and_column() does.
  LineAndColumn at(std::size_t offset) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> ends_;  ///< positions of the line breaks [bytes]
};

/// Effect of a problem: an error refuses the file, the others do not. name_of() depends on this order.
enum class Severity {
  kError,    ///< the file cannot be used
  kWarning,  ///< the file works, but it is probably not as intended
  kHint,     ///< the value is unusual
};

/// Returns the word for messages: "error", "warning" or "hint".
std::string_view name_of(Severity severity);

/// One problem of an input file, with its place.
struct Problem {
  std::string file = {};        ///< name of the file or of the option, as messages show it
  int line = 0;                 ///< from 1; 0: there is no place, as for an option on the command line
  int column = 0;               ///< from 1, in characters; a tab counts as one; 0: there is no place
  std::string path = {};        ///< path of the JSON value: "ships[0].hull.length_m"; empty: the whole file
  std::string found = {};       ///< what the file has, in words or as written
  std::string allowed = {};     ///< what is allowed there, in words; empty: the message does not state it
  std::string suggestion = {};  ///< nearest known key or choice; empty: none is near
  std::string sentence = {};    ///< message that replaces found and allowed if these do not fit; empty: they fit
  Severity severity = Severity::kError;
};

/// Longest path of a value that messages show [bytes]. A longer one, which a wrong file may have, is shortened at its
/// end. Paths of a correct scene are shorter; with a much smaller value they would be cut too.
inline constexpr std::size_t kLongestPath = 160;

/// Returns the message without its place: "found 0, allowed: a number > 0, ≤ 20 [m]". More than 1000 bytes of `found`
/// are not shown, and what a terminal cannot show is escaped (printable()). `sentence` is returned as it is.
std::string message_of(const Problem& problem);

/// Returns the message with its place: "scene.json:12:5: ice.thickness_m: found 0, allowed: a number > 0, ≤ 20 [m]".
/// The severity follows the place if it is not an error: "scene.json:9:3: hint: ice.thickness_m: …".
std::string to_string(const Problem& problem);

/// Returns a text from a file so that a terminal can show it safely: control characters of ASCII, also line breaks and
/// tabs, and bytes that are not UTF-8 are written in hexadecimal, such as \x1b.
std::string printable(std::string_view text);

/// Returns a text of at most `most` bytes as it is. A longer one is cut to that length between two characters, and "…"
/// is appended.
std::string shortened(std::string_view text, std::size_t most);

/// Returns the contents of a regular file, also one to which a link leads. Fails if there is none, if it is a folder, a
/// pipe or a device, if it cannot be read, or if it is longer than `longest` [bytes]. The message does not have the
/// file's name, which the caller adds. Whether the text is UTF-8 is not checked.
Result<std::string> read_text_file(const std::filesystem::path& path, std::uint64_t longest);

}  // namespace polynya::io
