#include "views/map/svg_convert.hpp"

#include <array>
#include <string>
#include <system_error>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace polynya::views {

bool convert_svg(const std::filesystem::path& svg, const std::filesystem::path& target) {
  std::error_code error_of_file;
  const auto there = std::filesystem::symlink_status(target, error_of_file);
  if (exists(there) && !is_regular_file(there) && !is_symlink(there)) return false;
  std::filesystem::path part = target;  // what is at `target`, or is linked there, is never opened
  part += ".part";
  std::filesystem::remove(part, error_of_file);
  const char* format = target.extension() == ".pdf" ? "--format=pdf" : "--format=png";
  std::array<std::string, 6> words{
      "rsvg-convert", format, "--dpi-x=240", "--dpi-y=240", "--output=" + part.string(), svg.string()};
  std::array<char*, 7> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 1;
  bool is_made = error == 0 && waitpid(child, &status, 0) == child && status == 0;
  if (is_made) std::filesystem::rename(part, target, error_of_file);
  is_made = is_made && !error_of_file;
  if (!is_made) std::filesystem::remove(part, error_of_file);
  if (!is_made) std::filesystem::remove(target, error_of_file);  // of an earlier picture
  return is_made;
}

}  // namespace polynya::views
