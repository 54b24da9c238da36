#include "app/command_line/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "app/command_line/console.hpp"

namespace polynya::app {
namespace {

/// A bar needs a terminal that can rewrite its line.
ProgressKind kind_for_stderr(ProgressKind kind) {
  if (kind != ProgressKind::kAuto && kind != ProgressKind::kBar) return kind;
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal != nullptr && std::strcmp(terminal, "dumb") == 0;
  return isatty(STDERR_FILENO) != 0 && !is_dumb ? ProgressKind::kBar : ProgressKind::kLines;
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// As many of the fields, two blanks apart, as fit into that many columns. A longer line would wrap, and a
/// carriage return would not lead back to its start.
std::string fitted(const std::string& fields, int columns) {
  const auto room = static_cast<std::size_t>(std::max(columns, 0));
  if (fields.size() <= room) return fields;
  const std::size_t end = fields.rfind("  ", room);
  return fields.substr(0, end == std::string::npos ? room : end);
}

/// A bar of that many columns, in eighths.
std::string bar(double part, int width) {
  static constexpr const char* kEighths[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const int eighths = static_cast<int>(std::clamp(part, 0.0, 1.0) * width * 8);
  std::string text;
  for (int i = 0; i < eighths / 8; ++i) text += "█";
  text += kEighths[eighths % 8];
  for (int i = (eighths + 7) / 8; i < width; ++i) text += "░";
  return text;
}

}  // namespace

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
    const int columns = terminal_width() - 1;  // the last one would wrap some terminals
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
  } catch (const std::system_error&) {  // no thread: nothing is shown
  }
}

WorkProgress::~WorkProgress() {
  thread_.request_stop();
}

void WorkProgress::show_until(const std::stop_token& stop) {
  constexpr double kFirst = 2;  // [s]
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

}  // namespace polynya::app
