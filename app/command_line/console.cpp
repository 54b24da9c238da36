#include "app/command_line/console.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/text/output_file.hpp"

namespace polynya::app {
namespace {

// Error number of the first failure to write text, or 0.
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

/// Opens a closed descriptor in the wrong direction, so that using the stream fails. Without /dev/null (in a bare
/// chroot), a folder has the same effect.
void open_if_closed(int descriptor, int flags) {
  if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) return;
  // open() returns the lowest free descriptor, which is this one, because lower ones are open already.
  if (::open("/dev/null", flags) < 0) static_cast<void>(::open("/", O_RDONLY | O_DIRECTORY));
}

volatile std::sig_atomic_t asked = 0;

extern "C" void on_signal(int signal) {
  asked = signal;
  std::signal(signal, SIG_DFL);  // the second signal ends the program
}

/// A bar needs a terminal that can rewrite its line; otherwise lines are shown.
ProgressKind kind_for_stderr(ProgressKind kind) {
  if (kind != ProgressKind::kAuto && kind != ProgressKind::kBar) return kind;
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal != nullptr && std::strcmp(terminal, "dumb") == 0;
  return isatty(STDERR_FILENO) != 0 && !is_dumb ? ProgressKind::kBar : ProgressKind::kLines;
}

/// Returns as many of the fields, separated by two blanks, as fit into the columns. A longer line would wrap, and a
/// carriage return would then not return to its start.
std::string fitted(const std::string& fields, int columns) {
  const auto room = static_cast<std::size_t>(std::max(columns, 0));
  if (fields.size() <= room) return fields;
  const std::size_t end = fields.rfind("  ", room);
  return fields.substr(0, end == std::string::npos ? room : end);
}

/// Returns a bar with this many columns, drawn in eighths of a column.
std::string bar(double part, int width) {
  static constexpr const char* kEighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const int eighths = static_cast<int>(std::clamp(part, 0.0, 1.0) * width * 8);
  std::string text;
  for (int i = 0; i < eighths / 8; ++i) text += "█";
  text += kEighths[eighths % 8];
  for (int i = (eighths + 7) / 8; i < width; ++i) text += "░";
  return text;
}

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

/// Returns true for a pipe that the shell made and to which it writes, as for `<(command)`. Opening any other pipe
/// would wait for its writer, possibly forever.
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

void print_lines(const std::vector<io::Problem>& problems) {
  for (const io::Problem& problem : problems) print_err("{}\n", to_string(problem));
}

void show_progress(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
  std::fflush(stderr);
}

int close_streams(int code) {
  flush(stdout, out_error);
  if (std::fclose(stdout) != 0) note(out_error);  // a network disk may report a failure only now
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
    // A signal that the parent process chose to ignore (nohup) stays ignored.
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

ProgressOutput::ProgressOutput(ProgressKind kind)
    : kind_(kind_for_stderr(kind)), start_(std::chrono::steady_clock::now()) {}

double ProgressOutput::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

double ProgressOutput::pause() const {
  return kind_ == ProgressKind::kBar ? 0.1 : kind_ == ProgressKind::kLines ? 10 : 1;
}

void ProgressOutput::clear() const {
  if (kind_ == ProgressKind::kBar) show_progress("\r\x1b[K");
}

bool ProgressOutput::is_due() {
  if (kind_ == ProgressKind::kNone) return false;
  const double now = wall_time();
  if (now - last_shown_ < pause()) return false;
  last_shown_ = now;
  return true;
}

void ProgressOutput::show(const ProgressReport& report) const {
  std::string line;
  if (kind_ == ProgressKind::kJson) {
    line = report.json + "\n";
  } else if (kind_ == ProgressKind::kLines) {
    line = report.words + "\n";
  } else {
    winsize size{};
    const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    const int columns = (is_known ? size.ws_col : 80) - 1;  // some terminals wrap after the last column
    const int room = columns - static_cast<int>(report.words.size()) - 1;
    line = fmt::format("\r{}{}\x1b[K", room >= 8 && report.part >= 0 ? bar(report.part, std::min(room, 40)) + " " : "",
                       fitted(report.words, columns));
  }
  show_progress(line);
}

void ProgressOutput::finish(const ProgressReport& report) const {
  if (kind_ == ProgressKind::kBar || kind_ == ProgressKind::kJson) show(report);
  if (kind_ == ProgressKind::kBar) show_progress("\n");
}

WorkProgress::WorkProgress(ProgressKind kind, std::string work) : output_(kind), work_(std::move(work)) {
  if (output_.kind() == ProgressKind::kNone) return;
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) { show_until(stop); });
  } catch (const std::system_error&) {  // there is no thread, so no progress is shown
  }
}

WorkProgress::~WorkProgress() {
  thread_.request_stop();
}

void WorkProgress::show_until(const std::stop_token& stop) {
  constexpr double kFirst = 2;  // [s]; nothing is shown for shorter work
  double pause = std::max(kFirst, output_.pause());
  bool is_shown = false;
  std::unique_lock lock(mutex_);
  while (
      !ended_.wait_for(lock, stop, std::chrono::duration<double>(pause), [&stop] { return stop.stop_requested(); })) {
    output_.show(report());
    is_shown = true;
    pause = output_.pause();
  }
  if (is_shown) output_.clear();
}

ProgressReport WorkProgress::report() const {
  const double part = part_, wall = output_.wall_time();
  const std::string percent = part >= 0 ? fmt::format("{:3.0f} %  ", 100 * part) : "";
  return {part, fmt::format("{}{}  {}", percent, work_, clock_time(wall)),
          fmt::format(R"({{"work":"{}","part":{},"wall_time_s":{:.3f}}})", work_,
                      part >= 0 ? fmt::format("{:.4g}", part) : "null", wall)};
}

std::string clock_time(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

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
  // Replacing the file to which a stream is written would lose the other output of that stream.
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
  static_cast<void>(make_folder(out));  // an error is reported by the write that follows
  return write_output((std::filesystem::path(out) / name).string(), text);
}

}  // namespace polynya::app
