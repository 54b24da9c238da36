#include "app/read_input.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "io/output_file.hpp"
#include "io/source_text.hpp"

namespace polynya::app {
namespace {

tl::expected<std::string, std::string> read_all(std::FILE* stream, std::size_t longest) {
  std::string text;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, stream)) {
    text.append(block, count);
    if (text.size() > longest) return tl::unexpected(fmt::format("more than the {} bytes allowed", longest));
  }
  if (std::ferror(stream)) return tl::unexpected(std::string(std::strerror(errno)));
  return text;
}

bool write_to(std::FILE* stream, const std::string& text) {
  return std::fwrite(text.data(), 1, text.size(), stream) == text.size() && std::fflush(stream) == 0;
}

}  // namespace

tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest) {
  if (file == "-") return read_all(stdin, longest);
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!is_fifo(status) && !is_character_file(status)) return io::read_text_file(file, longest);
  std::FILE* const stream = std::fopen(file.c_str(), "r");  // as `<(command)` gives
  if (!stream) return tl::unexpected(std::string(std::strerror(errno)));
  auto text = read_all(stream, longest);
  std::fclose(stream);
  return text;
}

std::string write_output(const std::string& file, const std::string& text) {
  if (file == "-") return write_to(stdout, text) ? "" : fmt::format("stdout: {}", std::strerror(errno));
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return io::write_whole_file(file, text);
  // A pipe or a device is written to; only a regular file is replaced, and behind a link, that one.
  if (std::filesystem::is_regular_file(status))
    return io::write_whole_file(std::filesystem::canonical(file, error), text);
  std::FILE* const stream = std::fopen(file.c_str(), "w");
  if (!stream) return fmt::format("{}: {}", file, std::strerror(errno));
  const int reason = write_to(stream, text) ? 0 : errno;
  const bool is_closed = std::fclose(stream) == 0;
  if (reason == 0 && is_closed) return "";
  return fmt::format("{}: {}", file, std::strerror(reason != 0 ? reason : errno));
}

}  // namespace polynya::app
