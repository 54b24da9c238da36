#include "io/text/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace polynya::io {
namespace {

/// Both ends of a pipe, closed with it.
class Pipe {
 public:
  Pipe() { is_open_ = pipe2(ends_.data(), O_CLOEXEC) == 0; }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  bool is_open() const { return is_open_; }
  int end(int which) const { return ends_[which]; }
  void close_end(int which) {
    if (ends_[which] >= 0) close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  bool is_open_ = false;
};

int spawn(const std::vector<std::string>& words, const Pipe& out, const Pipe& err, pid_t& child) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  arguments.reserve(copies.size() + 1);
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.end(1), 1);
  posix_spawn_file_actions_adddup2(&actions, err.end(1), 2);
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Reads both pipes to their ends; false where there is too much to read.
bool drain(Pipe& out, Pipe& err, std::size_t longest, ChildOutput& output) {
  std::array<pollfd, 2> open{{{out.end(0), POLLIN, 0}, {err.end(0), POLLIN, 0}}};
  std::array<std::string*, 2> texts{&output.out, &output.err};
  while (open[0].fd >= 0 || open[1].fd >= 0) {
    if (poll(open.data(), open.size(), -1) < 0 && errno != EINTR) return true;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (open[i].fd < 0 || open[i].revents == 0) continue;
      char block[1 << 16];
      const ssize_t count = read(open[i].fd, block, sizeof block);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) {
        open[i].fd = -1;
        continue;
      }
      texts[i]->append(block, static_cast<std::size_t>(count));
      if (texts[i]->size() > longest) return false;
    }
  }
  return true;
}

}  // namespace

Result<ChildOutput> run_child(const std::vector<std::string>& words, std::size_t longest) {
  Pipe out, err;
  if (!out.is_open() || !err.is_open()) return fail(std::strerror(errno));
  pid_t child = 0;
  if (const int error = spawn(words, out, err, child); error != 0)
    return fail(fmt::format("{}: {}", words[0], std::strerror(error)));
  out.close_end(1);
  err.close_end(1);
  ChildOutput output;
  const bool is_whole = drain(out, err, longest, output);
  if (!is_whole) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!is_whole) return fail(fmt::format("{} wrote more than the {} bytes allowed", words[0], longest));
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (output.code == 127) return fail(fmt::format("{}: not found", words[0]));
  return output;
}

}  // namespace polynya::io
