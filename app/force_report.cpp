#include "app/force_report.hpp"

#include <algorithm>
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
  const std::vector<const io::ForceColumn*> columns = io::peak_columns(scene);
  for (const io::ShipPeaks& peaks : summary.peaks) {
    const auto peak_of = [&](const io::ForceColumn& column) -> const io::Peak& {
      return peaks.of_column.at(
          static_cast<std::size_t>(std::ranges::find(columns, &column) - columns.begin()));
    };
    bool is_free = true;
    for (const io::ShownLoad& load : loads) {
      const io::Peak& surge = peak_of(*load.columns[0]);
      const io::Peak& sway = peak_of(*load.columns[1]);
      if (surge.value == 0 && sway.value == 0) continue;
      is_free = false;
      text += fmt::format("{:<12}{}: surge {}, sway {} (largest {})\n",
                          load.is_by_ice ? "ice force" : "ship force", peaks.ship, with_time(surge),
                          with_time(sway), load.measure);
    }
    if (is_free) text += fmt::format("ice force   {}: none\n", peaks.ship);
  }
  return text;
}

}  // namespace polynya::app
