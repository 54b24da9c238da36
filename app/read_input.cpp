#include "app/read_input.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "io/text/source_text.hpp"

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

/// Whether it is a pipe that the shell made and writes to, as `<(command)` does. Opening any other one would
/// wait for its writer, for ever where there is none.
bool is_of_shell(const std::string& file) {
  return file.starts_with("/dev/") || file.starts_with("/proc/");
}

}  // namespace

tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest) {
  if (file == "-") return read_all(stdin, longest);
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (is_fifo(status) && !is_of_shell(file))
    return tl::unexpected(fmt::format("a named pipe; read it from stdin: - < {}", file));
  if (!is_fifo(status) && !is_character_file(status)) return io::read_text_file(file, longest);
  std::FILE* const stream = std::fopen(file.c_str(), "r");
  if (!stream) return tl::unexpected(std::string(std::strerror(errno)));
  auto text = read_all(stream, longest);
  std::fclose(stream);
  return text;
}

io::Result<io::Run> read_run(const std::string& folder, ProgressKind progress) {
  return with_progress(progress, "reading the run", [&] { return io::read_run(folder); });
}

}  // namespace polynya::app
