#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "views/map/axis_scale.hpp"
#include "views/map/figures.hpp"
#include "views/map/svg_layout.hpp"

namespace polynya::views {
namespace {

/// Energy that one source gave or one sink took, a bar for each run that has it.
struct Sink {
  std::string name;
  bool is_source = false;
  std::vector<std::optional<double>> by_run;  ///< [J]
};

/// How the members of summary.json's `energy` are named here; one that is not among them is a sink of its own
/// name.
struct Name {
  std::string_view key, words;
  bool is_source = false;
};
constexpr Name kNames[] = {{"initial", "motion at the start", true},
                           {"thrust", "thrust and holding", true},
                           {"current", "current", true},
                           {"wind", "wind", true},
                           {"walls", "loads of walls", true},
                           {"imbalance", "imbalance", true},
                           {"kinetic", "motion at the end"},
                           {"drag", "water drag"},
                           {"friction", "friction"},
                           {"crushing", "crushing"},
                           {"restitution", "collisions"},
                           {"bending", "motion of broken cusps"},
                           {"splitting", "motion of splinters"},
                           {"rest", "floes put to rest"}};

std::vector<Sink> sinks_of(const std::vector<io::Run>& runs) {
  std::vector<Sink> sinks;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const io::JsonValue* energy = runs[i].summary.find("energy", io::JsonValue::Kind::kObject);
    if (!energy) continue;
    for (const io::JsonMember& member : energy->members()) {
      // The turnover is a scale for the imbalance, and no sink.
      if (!member.key.ends_with("_J") || member.key == "turnover_J" ||
          !member.value.is(io::JsonValue::Kind::kNumber))
        continue;
      std::string name = member.key.substr(0, member.key.size() - 2);
      const auto* named = std::ranges::find(kNames, name, &Name::key);
      const bool is_source = named != std::end(kNames) && named->is_source;
      if (named != std::end(kNames)) name = named->words;
      auto found = std::ranges::find(sinks, name, &Sink::name);
      if (found == sinks.end()) {
        sinks.push_back({name, is_source, std::vector<std::optional<double>>(runs.size())});
        found = sinks.end() - 1;
      }
      found->by_run[i] = member.value.number();
    }
  }
  std::stable_partition(sinks.begin(), sinks.end(), [](const Sink& sink) { return sink.is_source; });
  return sinks;
}

constexpr double kMargin = 24;     ///< [px]
constexpr double kWords = 250;     ///< room for the names [px]
constexpr double kNumbers = 90;    ///< room for the numbers [px]
constexpr double kBarHeight = 19;  ///< [px]
constexpr double kGap = 14;        ///< between sinks [px]
constexpr double kTitle = 36;      ///< room for a panel's title [px]

class EnergyFigure {
 public:
  EnergyFigure(const std::vector<io::Run>& runs, std::vector<Sink> sinks, const PageStyle& page)
      : runs_(runs),
        sinks_(std::move(sinks)),
        width_(page.pixels()),
        pitch_(kBarHeight * static_cast<double>(runs.size()) + kGap),
        heading_(page, kMargin, "Energy", "over the whole run; the sources' sum is that of the sinks"),
        legend_(legend_entries(), kMargin, width_ - kMargin),
        bottom_(heading_.height() + 2 * kTitle + pitch_ * static_cast<double>(sinks_.size())),
        svg_(width_, bottom_ + 70 + legend_.height()) {
    double low = 0, high = 0;
    for (const Sink& sink : sinks_) {
      for (const auto& energy : sink.by_run) {
        low = std::min(low, energy.value_or(0));
        high = std::max(high, energy.value_or(0));
      }
    }
    if (-low < 1e-6 * high) low = 0;  // rounding, in the imbalance
    axis_ = axis_scale(low / 1e6, high / 1e6, false, AxisFit::kRoomy);
  }

  std::string draw() {
    heading_.draw(svg_);
    draw_axis();
    double top = heading_.height();
    for (const bool is_source : {true, false}) {
      svg_.add("<text x='{:.2f}' y='{:.2f}' font-size='16' font-weight='bold'>{}{}</text>\n", kMargin,
               top + 24, letter_of(is_source ? 0 : 1, 2), is_source ? "Sources" : "Sinks");
      top += kTitle;
      const double first = top;
      for (const Sink& sink : sinks_) {
        if (sink.is_source != is_source) continue;
        draw_bars(sink, top);
        top += pitch_;
      }
      svg_.add("<path d='M{0:.2f} {1:.2f}V{2:.2f}' stroke='#000000'/>\n", x(0), first, top);
    }
    draw_legend();
    return svg_.finish();
  }

 private:
  std::vector<Legend::Entry> legend_entries() const {
    std::vector<Legend::Entry> entries;
    for (const io::Run& run : runs_) entries.push_back({run.label, 26});
    return entries;
  }
  double x(double megajoules) const {
    return kWords + (width_ - kWords - kNumbers) * axis_.share(megajoules);
  }

  void draw_axis() {
    double free_from = 0;
    for (const double tick : axis_.ticks) {
      const std::string number = fmt::format("{:.6g}", tick);
      svg_.add("<path d='M{0:.2f} {1:.2f}V{2:.2f}' stroke='#dddddd'/>\n", x(tick), heading_.height() + kTitle,
               bottom_);
      if (x(tick) - 0.5 * width_of(number, 16) < free_from) continue;
      svg_.words(x(tick), bottom_ + 22, 16, number, "middle");
      free_from = x(tick) + 0.5 * width_of(number, 16) + 8;
    }
    svg_.words(0.5 * (x(axis_.low) + x(axis_.high)), bottom_ + 46, 16, "energy, MJ", "middle");
  }

  void draw_bars(const Sink& sink, double top) {
    svg_.words(kWords - 14, top + 0.5 * (pitch_ - kGap) + 6, 16, sink.name, "end");
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (!sink.by_run[i]) continue;
      const double value = *sink.by_run[i] / 1e6;
      const double y = top + kBarHeight * static_cast<double>(i);
      svg_.add("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' fill='{}'/>\n",
               std::min(x(0), x(value)), y, std::abs(x(value) - x(0)), kBarHeight - 3,
               kCurveColours[colour_of_run(i)]);
      svg_.words(std::max(x(0), x(value)) + 8, y + 13, 14, fmt::format("{:.4g}", value));
    }
  }

  void draw_legend() {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const geometry::Point at = legend_.draw(svg_, i, bottom_ + 56);
      svg_.add("<rect x='{:.2f}' y='{:.2f}' width='26' height='16' fill='{}'/>\n", at.x, at.y - 13,
               kCurveColours[colour_of_run(i)]);
    }
  }

  const std::vector<io::Run>& runs_;
  std::vector<Sink> sinks_;
  double width_;  ///< [px]
  double pitch_;  ///< from sink to sink [px]
  Heading heading_;
  Legend legend_;
  double bottom_;  ///< of the bars [px]
  SvgText svg_;
  AxisScale axis_;
};

}  // namespace

std::string energy_figure(const std::vector<io::Run>& runs, const PageStyle& page) {
  std::vector<Sink> sinks = sinks_of(runs);
  return sinks.empty() ? "" : EnergyFigure(runs, std::move(sinks), page).draw();
}

}  // namespace polynya::views
