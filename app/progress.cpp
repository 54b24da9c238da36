#include "app/progress.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace polynya::app {
namespace {

double pause_of(ProgressKind kind) {
  return kind == ProgressKind::kBar ? 0.1 : kind == ProgressKind::kLines ? 10 : 1;
}

ProgressKind settled(ProgressKind kind) {
  if (kind != ProgressKind::kAuto) return kind;
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal != nullptr && std::strcmp(terminal, "dumb") == 0;
  return isatty(STDERR_FILENO) != 0 && !is_dumb ? ProgressKind::kBar : ProgressKind::kLines;
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// "1:05", "2:03:04".
std::string clock_time(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

/// A bar of so many columns, in eighths.
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

Progress::Progress(ProgressKind kind, double until)
    : kind_(settled(kind)), until_(until), start_(std::chrono::steady_clock::now()) {}

double Progress::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::show(double sim_time, long long fractures) {
  if (kind_ == ProgressKind::kNone) return;
  const double now = wall_time();
  if (now - last_shown_ < pause_of(kind_)) return;
  last_shown_ = now;
  draw(sim_time, fractures);
}

void Progress::finish(double sim_time, long long fractures) {
  if (kind_ == ProgressKind::kBar) {
    draw(sim_time, fractures);
    std::fputs("\n", stderr);
  } else if (kind_ == ProgressKind::kJson) {
    draw(sim_time, fractures);
  }
}

void Progress::draw(double sim_time, long long fractures) {
  const double wall = std::max(wall_time(), 1e-9);
  const double rate = sim_time / wall;
  const double part = until_ > 0 ? sim_time / until_ : 1;
  const double left = rate > 0 ? std::max(0.0, until_ - sim_time) / rate : 0;
  std::string line;
  switch (kind_) {
    case ProgressKind::kJson:
      line = fmt::format(
          R"({{"sim_time_s":{:.6g},"until_s":{:.6g},"wall_time_s":{:.3f},"real_time_factor":{:.4g},"time_left_s":{:.1f},"fractures":{}}})"
          "\n",
          sim_time, until_, wall, rate, left, fractures);
      break;
    case ProgressKind::kLines:
      line = fmt::format("{:3.0f} %  {:.1f} of {:g} s simulated, {:.3g} x real time, {} left, {} fractures\n",
                         100 * part, sim_time, until_, rate, clock_time(left), fractures);
      break;
    default: {
      const std::string words =
          fmt::format(" {:3.0f} %  {:.1f}/{:g} s  {:.0f}x real time  {} left  {} fractures", 100 * part,
                      sim_time, until_, rate, clock_time(left), fractures);
      const int room = terminal_width() - static_cast<int>(words.size()) - 1;
      line = fmt::format("\r{}{}\x1b[K", room >= 8 ? bar(part, std::min(room, 40)) : "", words);
    }
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace polynya::app
