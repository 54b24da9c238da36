#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/axis_scale.hpp"
#include "io/figures.hpp"
#include "io/rows_of.hpp"
#include "io/svg_text.hpp"

namespace polynya::io {
namespace {

/// Energy that one sink (or source) took, a bar for each run that tells of it.
struct Sink {
  std::string name;
  std::vector<std::optional<double>> by_run;  ///< [J]
};

std::vector<Sink> sinks_of(const std::vector<Run>& runs) {
  std::vector<Sink> sinks;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const JsonValue* energy = runs[i].summary.find("energy");
    if (!energy || !energy->is(JsonValue::Kind::kObject)) continue;
    for (const JsonMember& member : energy->members()) {
      // The turnover is a scale for the imbalance, and no sink.
      if (!member.key.ends_with("_J") || member.key == "turnover_J" ||
          !member.value.is(JsonValue::Kind::kNumber))
        continue;
      std::string name = member.key.substr(0, member.key.size() - 2);
      std::ranges::replace(name, '_', ' ');
      auto found = std::ranges::find(sinks, name, &Sink::name);
      if (found == sinks.end()) {
        sinks.push_back({name, std::vector<std::optional<double>>(runs.size())});
        found = sinks.end() - 1;
      }
      found->by_run[i] = member.value.number();
    }
  }
  return sinks;
}

constexpr double kWidth = 1600;    ///< [px]
constexpr double kHeader = 84;     ///< [px]
constexpr double kNames = 300;     ///< room for the names [px]
constexpr double kNumbers = 150;   ///< room for the numbers [px]
constexpr double kBarHeight = 20;  ///< [px]
constexpr double kGap = 18;        ///< between sinks [px]
constexpr std::size_t kLegendColumns = 3;

}  // namespace

std::string energy_figure(const std::vector<Run>& runs) {
  const std::vector<Sink> sinks = sinks_of(runs);
  if (sinks.empty()) return "";
  double low = 0, high = 0;
  for (const Sink& sink : sinks) {
    for (const auto& energy : sink.by_run) {
      low = std::min(low, energy.value_or(0));
      high = std::max(high, energy.value_or(0));
    }
  }
  const double pitch = kBarHeight * static_cast<double>(runs.size()) + kGap;
  const double bottom = kHeader + pitch * static_cast<double>(sinks.size());
  SvgText svg(kWidth, bottom + 90 + 30 * static_cast<double>(rows_of(runs.size(), kLegendColumns)));
  svg.title(24, "Energy by sink", "work over the whole run; signs as in summary.json");
  const AxisScale axis = axis_scale(low / 1e6, high / 1e6, false, AxisFit::kRoomy);
  const auto x = [&](double megajoules) {
    return kNames + (kWidth - kNames - kNumbers) * axis.share(megajoules);
  };
  for (const double tick : axis.ticks) {
    svg.add("<path d='M{0:.2f} {1:.2f}V{2:.2f}' stroke='#dddddd'/>\n", x(tick), kHeader, bottom);
    svg.words(x(tick), bottom + 24, 16, fmt::format("{:.6g}", tick), "middle");
  }
  svg.words(0.5 * (x(axis.low) + x(axis.high)), bottom + 54, 16, "energy, MJ", "middle");
  for (std::size_t s = 0; s < sinks.size(); ++s) {
    const double top = kHeader + 0.5 * kGap + pitch * static_cast<double>(s);
    svg.words(kNames - 14, top + 0.5 * (pitch - kGap) + 6, 18, sinks[s].name, "end");
    for (std::size_t i = 0; i < runs.size(); ++i) {
      if (!sinks[s].by_run[i]) continue;
      const double value = *sinks[s].by_run[i] / 1e6;
      const double y = top + kBarHeight * static_cast<double>(i);
      svg.add("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='{}'/>\n",
              std::min(x(0), x(value)), y, std::abs(x(value) - x(0)), kBarHeight - 3,
              kCurveColours[colour_of_run(i)]);
      svg.words(std::max(x(0), x(value)) + 8, y + 14, 15, fmt::format("{:.4g}", value));
    }
  }
  svg.add("<path d='M{0:.2f} {1:.2f}V{2:.2f}' stroke='#000000'/>\n", x(0), kHeader, bottom);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double left = kNames + 430 * static_cast<double>(i % kLegendColumns);
    const double y = bottom + 84 + 30 * static_cast<double>(row_of(i, kLegendColumns));
    svg.add("<rect x='{:.2f}' y='{:.2f}' width='26' height='16' fill='{}'/>\n", left, y - 13,
            kCurveColours[colour_of_run(i)]);
    svg.words(left + 34, y, 16, runs[i].scene.scene.name);
  }
  return svg.finish();
}

}  // namespace polynya::io
