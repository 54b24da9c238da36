#include "io/text/source_text.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

namespace polynya::io {

LineAndColumn line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line_start = before.rfind('\n') + 1;  // without a newline, rfind returns npos, and npos + 1 is 0
  const auto is_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return {.line = 1 + static_cast<int>(std::ranges::count(before, '\n')),
          .column = 1 + static_cast<int>(std::ranges::count_if(before.substr(line_start), is_character))};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

LineIndex::LineIndex(std::string_view text) : text_(text) {
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
    ends_.push_back(at);
}

int LineIndex::line_of(std::size_t offset) const {
  return 1 + static_cast<int>(std::ranges::lower_bound(ends_, offset) - ends_.begin());
}

LineAndColumn LineIndex::at(std::size_t offset) const {
  const int line = line_of(offset);
  const std::size_t start = line > 1 ? ends_[static_cast<std::size_t>(line) - 2] + 1 : 0;
  return {line, line_and_column(text_.substr(start), offset - start).column};
}

std::string_view name_of(Severity severity) {
  constexpr std::string_view kNames[]{"error", "warning", "hint"};
  return kNames[static_cast<std::size_t>(severity)];
}

std::string message_of(const Problem& problem) {
  if (!problem.sentence.empty()) return problem.sentence;
  constexpr std::size_t kLongestFound = 1000;  // longest value that a message shows [bytes]
  std::string text = "found " + printable(shortened(problem.found, kLongestFound));
  if (!problem.allowed.empty()) text += ", allowed: " + problem.allowed;
  if (!problem.suggestion.empty()) text += fmt::format("; did you mean \"{}\"?", problem.suggestion);
  return text;
}

std::string to_string(const Problem& problem) {
  std::string text = problem.line > 0 ? fmt::format("{}:{}:{}: ", problem.file, problem.line, problem.column)
                                      : fmt::format("{}: ", problem.file);
  if (problem.severity != Severity::kError) text += fmt::format("{}: ", name_of(problem.severity));
  if (!problem.path.empty()) text += shortened(problem.path, kLongestPath) + ": ";
  return text + message_of(problem);
}

namespace {

/// Returns the length of the UTF-8 character at the start of a text [bytes], or 0 if there is no valid one.
std::size_t character_size(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t size = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  // Overlong encodings, surrogates and code points above U+10FFFF are not valid.
  const bool is_wrong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) > 0x9F) ||
                        (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) > 0x8F);
  return is_wrong ? 0 : size;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t size = character_size(text);
    if (size == 0 || first < 0x20 || first == 0x7F)
      shown += fmt::format("\\x{:02x}", first);
    else
      shown += text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return shown;
}

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return fmt::format("{}…", text.substr(0, end));
}

Result<std::string> read_text_file(const std::filesystem::path& path, std::uint64_t longest) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return fail("no such file");
  if (!std::filesystem::is_regular_file(status)) return fail("not a regular file");
  const auto size = std::filesystem::file_size(path, error);
  if (error) return fail(error.message());
  if (size > longest) return fail(fmt::format("{} bytes, more than the {} allowed", size, longest));
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return fail(std::string(std::strerror(errno)));
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) return fail("it could not be read");
  return text;
}

}  // namespace polynya::io
