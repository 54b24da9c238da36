#include "app/command_line/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "app/command_line/console.hpp"
#include "io/text/output_file.hpp"
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

bool is_open_as(const std::string& file, int descriptor) {
  struct stat named {
  }, opened{};
  return ::stat(file.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
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

std::string input_name(const std::string& file) {
  return file == "-" ? "stdin" : file;
}

io::Result<io::Run> read_run(const std::string& folder, ProgressKind progress) {
  return with_progress(progress, "reading the run", [&] { return io::read_run(folder); });
}

bool is_stdout(const std::string& file) {
  return file == "-" || is_open_as(file, STDOUT_FILENO);
}

io::Result<> write_output(const std::string& file, const std::string& text) {
  // Replacing the file that a stream goes to would lose what else is written there.
  if (is_stdout(file))
    write_out(text);
  else if (is_open_as(file, STDERR_FILENO))
    write_err(text);
  else
    return io::write_named_file(file, text);
  return {};
}

io::Result<> make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return io::fail(folder.string() + ": " + error.message());
  return {};
}

io::Result<> write_product(const std::string& out, const std::string& run, std::string_view name,
                           const std::string& text) {
  if (out.empty()) return io::write_whole_file(std::filesystem::path(run) / name, text);
  static_cast<void>(make_folder(out));  // writing reports what is wrong with it
  return write_output((std::filesystem::path(out) / name).string(), text);
}

}  // namespace polynya::app
