#include "io/text/child_process.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace polynya::io {
namespace {

/// A temporary file without a name, into which the child process writes.
using NamelessFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

int spawn(std::vector<std::string> words, int in, int out, int err, pid_t& child) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, 0);
  posix_spawn_file_actions_adddup2(&actions, out, 1);
  posix_spawn_file_actions_adddup2(&actions, err, 2);
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

Result<std::string> text_in(std::FILE* file, std::size_t longest) {
  const long size = std::fseek(file, 0, SEEK_END) == 0 ? std::ftell(file) : -1;
  if (size < 0) return fail(std::strerror(errno));
  if (static_cast<std::size_t>(size) > longest) return fail(fmt::format("more than the {} bytes allowed", longest));
  std::rewind(file);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (std::fread(text.data(), 1, text.size(), file) != text.size()) return fail(std::strerror(errno));
  return text;
}

}  // namespace

tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t longest,
                                                  std::string_view input) {
  const auto failed = [&](std::string why, bool is_missing = false) {
    return tl::unexpected(ChildFailure{is_missing, std::move(why)});
  };
  const NamelessFile in(std::tmpfile(), std::fclose), out(std::tmpfile(), std::fclose),
      err(std::tmpfile(), std::fclose);
  if (!in || !out || !err) return failed(fmt::format("no temporary file: {}", std::strerror(errno)));
  if (std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() || std::fflush(in.get()) != 0)
    return failed(fmt::format("a temporary file: {}", std::strerror(errno)));
  if (lseek(fileno(in.get()), 0, SEEK_SET) != 0) return failed(std::strerror(errno));
  pid_t child = 0;
  if (const int error = spawn(words, fileno(in.get()), fileno(out.get()), fileno(err.get()), child); error != 0)
    return failed(fmt::format("{}: {}", words[0], std::strerror(error)), true);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (code == 127) return failed(fmt::format("{}: not found", words[0]), true);
  auto text = text_in(out.get(), longest), messages = text_in(err.get(), longest);
  if (!text || !messages)
    return failed(fmt::format("what {} wrote: {}", words[0], text ? messages.error() : text.error()));
  return ChildOutput{*std::move(text), *std::move(messages), code};
}

}  // namespace polynya::io
