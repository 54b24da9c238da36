#include "app/command_line/console.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <initializer_list>

#include <fcntl.h>
#include <unistd.h>

namespace polynya::app {
namespace {

// The first reason for which text was lost, or 0.
int out_error = 0;
int err_error = 0;

void note(int& error) {
  if (error == 0) error = errno != 0 ? errno : EIO;
}

void write(std::FILE* stream, std::string_view text, int& error) {
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stream) != text.size()) note(error);
}

void flush(std::FILE* stream, int& error) {
  errno = 0;
  if (std::fflush(stream) != 0) note(error);
}

/// The wrong way round, so that using the stream fails. Without /dev/null (a bare chroot), a folder serves.
void open_if_closed(int descriptor, int flags) {
  if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return;
  // The lowest free descriptor is this one, since those below it are open by now.
  if (::open("/dev/null", flags) < 0) static_cast<void>(::open("/", O_RDONLY | O_DIRECTORY));
}

volatile std::sig_atomic_t asked = 0;

extern "C" void on_signal(int signal) {
  asked = signal;
  std::signal(signal, SIG_DFL);  // the second one is not ours any more
}

}  // namespace

void open_streams() {
  open_if_closed(STDIN_FILENO, O_WRONLY);
  open_if_closed(STDOUT_FILENO, O_RDONLY);
  open_if_closed(STDERR_FILENO, O_RDONLY);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void write_out(std::string_view text) {
  write(stdout, text, out_error);
}

void flush_out() {
  flush(stdout, out_error);
}

void write_err(std::string_view text) {
  flush(stdout, out_error);
  write(stderr, text, err_error);
}

ExitCode fail(ExitCode code, std::string_view message) {
  print_err("polynya: {}\n", message);
  return code;
}

ExitCode code_of(const Outcome<ExitCode>& outcome) {
  return outcome ? *outcome : fail(outcome.error().code, outcome.error().words);
}

void print_lines(const std::vector<io::Problem>& problems) {
  for (const io::Problem& problem : problems) print_err("{}\n", to_string(problem));
}

void show_progress(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
  std::fflush(stderr);
}

int close_streams(int code) {
  flush(stdout, out_error);
  if (std::fclose(stdout) != 0) note(out_error);  // a network's disk may refuse only now
  if (out_error != 0 && out_error != EPIPE)
    print_err("polynya: stdout: {}; not all of the text was written\n",
              out_error == EBADF ? "it is closed" : std::strerror(out_error));
  if (code != kDone || (out_error == 0 && err_error == 0)) return code;
  const auto is_pipe_or_fine = [](int error) { return error == 0 || error == EPIPE; };
  return is_pipe_or_fine(out_error) && is_pipe_or_fine(err_error) ? kClosedPipe : kInputOutput;
}

void watch_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction previous {};
    // What our parent chose to ignore (nohup) stays ignored.
    if (sigaction(signal, nullptr, &previous) == 0 && previous.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

int stop_signal() {
  return asked;
}

}  // namespace polynya::app
