#include "app/force_report.hpp"

#include <cmath>

#include <fmt/format.h>

#include "io/run/shown_loads.hpp"

namespace polynya::app {
namespace {

/// "-1.89 MN"
std::string with_unit(double newtons) {
  const double size = std::abs(newtons);
  return size >= 1e6   ? fmt::format("{:.4g} MN", newtons / 1e6)
         : size >= 1e3 ? fmt::format("{:.4g} kN", newtons / 1e3)
                       : fmt::format("{:.4g} N", newtons);
}

std::string with_time(const io::Peak& peak) {
  if (peak.value == 0) return "0 N";
  return fmt::format("{} at {:.6g} s", with_unit(peak.value), peak.time);
}

}  // namespace

std::string force_lines(const io::RunSummary& summary, const simulation::Scene& scene) {
  std::string text;
  const std::vector<io::ShownLoad> loads = io::shown_loads(scene);
  for (const io::ShipPeaks& peaks : summary.peaks) {
    bool is_free = true;
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const io::Peak& surge = peaks.of_column[3 * i];
      const io::Peak& sway = peaks.of_column[3 * i + 1];
      if (surge.value == 0 && sway.value == 0) continue;
      is_free = false;
      text += fmt::format("{:<12}{}: surge {}, sway {} (largest {})\n",
                          loads[i].is_by_ice ? "ice force" : "ship force", peaks.ship, with_time(surge),
                          with_time(sway), loads[i].measure);
    }
    if (is_free) text += fmt::format("ice force   {}: none\n", peaks.ship);
  }
  return text;
}

}  // namespace polynya::app
