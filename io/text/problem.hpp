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

/// A JSON array of them, one a line: file, line and column (null where there is no place), path, severity and
/// message.
std::string to_json_text(const std::vector<Problem>& problems);

/// " at (5, 5), (0, 0)": the first few of what is wrong, for messages; empty where there are none.
std::string places_in_words(std::span<const geometry::Point> places, std::size_t most);

/// "1 floe", "2 floes"; "1 box", "2 boxes" where the plural is given.
template <std::integral Count>
std::string counted(Count count, std::string_view noun, std::string_view plural = {}) {
  return fmt::format("{} {}{}", count, count == 1 || plural.empty() ? noun : plural,
                     count == 1 || !plural.empty() ? "" : "s");
}

/// A value as messages show it: "-0.5", "\"nevle\"", "a list of 3".
std::string show(const JsonValue& value);

/// The candidate fewest edits away from a word, or "" where none is near enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// A text beside a source, put in place of a part of it: an option of the command line, or a line of a file.
struct PlacedText {
  std::string name;                          ///< as shown to people
  int line = 0;                              ///< in the file of that name; 0: the name alone is the place
  std::size_t length = 0;                    ///< [bytes]
  std::optional<std::string> not_json = {};  ///< a value that is taken as a text because it is not JSON
};

/// Gathers everything wrong in a scene and in the files it names, so that it can be reported at once.
class ProblemCollector {
 public:
  static constexpr std::size_t kMost = 500;  ///< what comes after these is only counted

  explicit ProblemCollector(SourceText main) { sources_.push_back(std::move(main)); }

  /// Adds a further source; its index is for add().
  std::size_t add_source(SourceText source) {
    sources_.push_back(std::move(source));
    return sources_.size() - 1;
  }
  /// Adds a text to the first source; its bytes have the offsets from the returned one on.
  std::uint32_t add_overlay(PlacedText text);
  const SourceText& source(std::size_t index) const { return sources_[index]; }

  void add(std::size_t source, std::uint32_t offset, Problem problem);
  void report(std::size_t source, std::uint32_t offset, std::string path, std::string found, std::string allowed,
              std::string suggestion = {});
  /// What the parser found in a source.
  void add_faults(std::size_t source, const std::vector<JsonFault>& faults);
  std::size_t count() const { return entries_.size() + beyond_; }

  /// In the order of sources and places. Where there were too many, a last one has how many are left out.
  std::vector<Problem> take();

 private:
  struct Entry {
    std::size_t source;
    std::uint32_t offset;
    Problem problem;
  };
  struct Overlay {
    std::uint32_t begin;
    PlacedText text;
  };
  void place(const Entry& entry, Problem& problem) const;
  std::vector<SourceText> sources_;
  std::vector<Overlay> overlays_;  ///< of the first source, by their offsets, all behind its text
  std::vector<Entry> entries_;
  std::size_t beyond_ = 0;
};

/// Reports what is wrong with a member of a value of the first source, by the member's key: "hull.draught_m".
struct ReportAt {
  ProblemCollector& problems;
  const JsonValue& value;
  std::string path;  ///< of the value; empty: the root

  void operator()(std::string_view key, std::string found, std::string allowed) const {
    std::string place = path.empty() || key.empty() ? path : path + '.';
    problems.report(0, nearest_offset(value, key), place.append(key), std::move(found), std::move(allowed));
  }
};

}  // namespace polynya::io
