#include "app/read_input.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fmt/format.h>

#include "io/output_file.hpp"
#include "io/source_text.hpp"

namespace polynya::app {

tl::expected<std::string, std::string> read_input(const std::string& file, std::size_t longest) {
  if (file != "-") return io::read_text_file(file, longest);
  std::string text;
  char block[1 << 16];
  while (const std::size_t count = std::fread(block, 1, sizeof block, stdin)) {
    text.append(block, count);
    if (text.size() > longest) return tl::unexpected(fmt::format("more than the {} bytes allowed", longest));
  }
  if (std::ferror(stdin)) return tl::unexpected(std::string(std::strerror(errno)));
  return text;
}

std::string write_output(const std::string& file, const std::string& text) {
  if (file != "-") return io::write_whole_file(file, text);
  const bool is_whole =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  return is_whole ? "" : fmt::format("stdout: {}", std::strerror(errno));
}

}  // namespace polynya::app
