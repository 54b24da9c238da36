#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/result.hpp"

namespace polynya::io {

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
