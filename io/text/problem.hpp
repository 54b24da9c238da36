#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "geometry/shape/point.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// Returns a JSON array of the problems, one per line: file, line and column (null if there is no place), path (at most
/// kLongestPath bytes), severity and message. Without problems it is an empty array. `polynya validate --json` prints
/// it, so its keys are part of the interface.
std::string to_json_text(const std::vector<Problem>& problems);

/// Returns " at (5, 5), (0, 0)" with the first `most` places of a fault [m], for messages; empty if there are none.
/// That places are left out is not stated.
std::string places_in_words(std::span<const geometry::Point> places, std::size_t most);

/// Returns a count with its noun: "1 floe", "2 floes". `plural` is for nouns whose plural is not formed by an s: "2
/// boxes".
template <std::integral Count>
std::string counted(Count count, std::string_view noun, std::string_view plural = {}) {
  return fmt::format("{} {}{}", count, count == 1 || plural.empty() ? noun : plural,
                     count == 1 || !plural.empty() ? "" : "s");
}

/// Returns a value as messages show it: "-0.5", "\"nevle\"", "true", "null", "a list of 3", "an object". A text is cut
/// to 60 bytes.
std::string show(const JsonValue& value);

/// Returns the candidate with the smallest edit distance from a word, or "" if no candidate is near enough to be meant.
/// A word may differ by a third of its length, but at least by two edits, or by one if it has up to four letters. A
/// forgotten or wrong unit ("thickness" for "thickness_m") counts as one edit. Among equally near candidates the first
/// one is returned. For a word of more than 200 bytes the result is "", because the comparison would take long.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// A text that replaces a part of a source: an option of the command line, or a line of another file.
struct PlacedText {
  std::string name;                          ///< name of the option or the file in messages
  int line = 0;                              ///< line in the file of that name; 0: the name alone is the place
  std::size_t length = 0;                    ///< length of the text [bytes]: so many offsets belong to it
  std::optional<std::string> not_json = {};  ///< value of an option that is not JSON and so is taken as a text, which
                                             ///< the message then explains; nullopt: it is JSON
};

/// Collects all problems of a scene and of the files that it names, so that they are reported together.
class ProblemCollector {
 public:
  /// Largest number of problems that are stored. Further ones are only counted, so that a file with millions of faults
  /// does not fill the memory and the terminal. With a larger value the user sees more of them at once.
  static constexpr std::size_t kMost = 500;

  /// `main` is the first source, the scene's own text, with the index 0.
  explicit ProblemCollector(SourceText main) { sources_.push_back(std::move(main)); }

  /// Adds another source, such as a floe file, and returns its index for add().
  std::size_t add_source(SourceText source) {
    sources_.push_back(std::move(source));
    return sources_.size() - 1;
  }
  /// Adds a text to the first source and returns its offset: the bytes of the text have the offsets from there on.
  std::uint32_t add_overlay(PlacedText text);
  /// The reference is valid until the next add_source().
  const SourceText& source(std::size_t index) const { return sources_[index]; }

  /// Adds a problem at an offset [bytes] of a source, given by its index; an offset of the first source may lie in an
  /// overlay. take() sets the problem's file, line and column from the two.
  void add(std::size_t source, std::uint32_t offset, Problem problem);
  /// Adds an error with these members of Problem, at a place as for add().
  void report(std::size_t source, std::uint32_t offset, std::string path, std::string found, std::string allowed,
              std::string suggestion = {});
  /// Adds the faults that the parser found in a source.
  void add_faults(std::size_t source, const std::vector<JsonFault>& faults);
  /// Number of all problems so far, including those beyond kMost.
  std::size_t count() const { return entries_.size() + beyond_; }

  /// Returns the problems in the order of sources and places; those in overlays follow those of the first source's own
  /// text. If there were more than kMost, the last one states how many are left out. The collector then has none.
  std::vector<Problem> take();

 private:
  struct Entry {
    std::size_t source;    ///< index in sources_
    std::uint32_t offset;  ///< place in the source or an overlay [bytes]
    Problem problem;       ///< without its place
  };
  struct Overlay {
    std::uint32_t begin;  ///< offset of its first byte
    PlacedText text;
  };
  /// Sets file, line and column of a problem.
  void place(const Entry& entry, Problem& problem) const;
  std::vector<SourceText> sources_;
  /// Texts that replace parts of the first source, by their offsets, which lie beyond its text.
  std::vector<Overlay> overlays_;
  std::vector<Entry> entries_;
  std::size_t beyond_ = 0;  ///< number of problems that were not stored
};

/// Reports an error of a member of a value in the first source. The member is given by its key below the value, such as
/// "hull.draught_m"; an empty key means the value itself. If the source does not have the member, the place is that of
/// the innermost value around it.
struct ReportAt {
  ProblemCollector& problems;  ///< where problems are added; must exist longer than this object, as must the value
  const JsonValue& value;
  std::string path;  ///< path of the value; empty: the root

  void operator()(std::string_view key, std::string found, std::string allowed) const {
    std::string place = path.empty() || key.empty() ? path : path + '.';
    problems.report(0, nearest_offset(value, key), place.append(key), std::move(found), std::move(allowed));
  }
};

}  // namespace polynya::io
