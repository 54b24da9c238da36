#include "views/map/svg_convert.hpp"

#include <array>
#include <optional>
#include <string>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/text/output_file.hpp"

namespace polynya::views {
namespace {

std::string read_all(int file) {
  std::string bytes;
  std::array<char, 1 << 16> part;
  for (ssize_t count = 0; (count = read(file, part.data(), part.size())) > 0;)
    bytes.append(part.data(), static_cast<std::size_t>(count));
  return bytes;
}

/// What rsvg-convert makes of an SVG file. It writes into a pipe: no folder is written to by a program that
/// may outlive this one.
std::optional<std::string> converted(const std::filesystem::path& svg, const char* format) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {};
  std::array<std::string, 5> words{"rsvg-convert", format, "--dpi-x=240", "--dpi-y=240", svg.string()};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string bytes = error == 0 ? read_all(ends[0]) : "";
  close(ends[0]);
  int status = 1;
  if (error != 0 || waitpid(child, &status, 0) != child || status != 0 || bytes.empty()) return {};
  return bytes;
}

}  // namespace

bool convert_svg(const std::filesystem::path& svg, const std::filesystem::path& target) {
  std::error_code error_of_file;
  const auto there = std::filesystem::symlink_status(target, error_of_file);
  if (exists(there) && !is_regular_file(there) && !is_symlink(there)) return false;
  const auto bytes = converted(svg, target.extension() == ".pdf" ? "--format=pdf" : "--format=png");
  if (bytes && io::write_whole_file(target, *bytes, io::Durability::kSynced)) return true;
  std::filesystem::remove(target, error_of_file);  // of an earlier picture
  return false;
}

}  // namespace polynya::views
