#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "views/map/figures.hpp"

namespace polynya::views {
namespace {

using simulation::ShipSample;
constexpr double kDegrees = 180 / std::numbers::pi;

constexpr std::array kComponents{"surge", "sway", "yaw"};
constexpr std::array kUnits{"N", "N", "N m"};
constexpr std::array kLoadColours{4, 6, 1};  ///< black before sky blue: apart in greyscale

/// 10³ⁿ with its prefix such that values up to `most` read well.
struct Prefix {
  double factor = 1;
  const char* name = "";
};
Prefix prefix_for(double most) {
  return most >= 1e9   ? Prefix{1e9, "G"}
         : most >= 1e6 ? Prefix{1e6, "M"}
         : most >= 1e3 ? Prefix{1e3, "k"}
                       : Prefix{};
}

/// A ship or structure of one of the runs.
struct Subject {
  const io::Run* run = nullptr;
  int ship = 0;
};
std::vector<Subject> subjects_of(const std::vector<io::Run>& runs) {
  std::vector<Subject> subjects;
  for (const io::Run& run : runs) {
    for (int ship = 0; ship < static_cast<int>(run.scene.scene.ships.size()); ++ship)
      subjects.push_back({&run, ship});
  }
  return subjects;
}

/// The run's name, and the ship's where the run has several.
std::string name_of(const Subject& subject) {
  const auto& ships = subject.run->scene.scene.ships;
  if (ships.size() == 1) return subject.run->label;
  return subject.run->label + ", " + ships[static_cast<std::size_t>(subject.ship)].name;
}

/// Of each short stretch of time the largest and the least value: no peak is lost, and paper shows no more.
std::vector<Chart::Point> peaks(const Subject& subject, const io::ForceColumn& column, double unit) {
  const io::Run& run = *subject.run;
  constexpr double kStretches = 900;
  const double stretch = std::max(1e-9, run.end_time() - run.start_time()) / kStretches;
  std::vector<Chart::Point> points;
  double until = -std::numeric_limits<double>::infinity();
  Chart::Point high, low;
  const auto put = [&] {
    if (high.y > 0) points.push_back(high);
    if (low.y < 0) points.push_back(low);
    high = low = {};
  };
  for (const ShipSample& sample : run.samples) {
    const double v = column.read(sample) / unit;
    if (sample.ship != subject.ship || !std::isfinite(v)) continue;
    if (sample.time >= until) {
      put();
      until = sample.time + stretch;
    }
    if (v > high.y) high = {sample.time, v};
    if (v < low.y) low = {sample.time, v};
  }
  put();
  return points;
}

std::vector<Chart::Mark> marks_of(const Subject& subject) {
  std::vector<Chart::Mark> marks;
  for (const simulation::Event& event : subject.run->events) {
    const bool is_split = event.kind == simulation::EventKind::kSplit;
    if (event.ship == subject.ship && (is_split || event.kind == simulation::EventKind::kBend))
      marks.push_back({event.time, is_split});
  }
  std::ranges::stable_sort(marks, {}, &Chart::Mark::is_major);
  return marks;
}

std::pair<double, double> common_range(const std::vector<io::Run>& runs,
                                       const std::vector<io::ShownLoad>& loads, std::size_t component) {
  double low = 0, high = 0;
  for (const io::Run& run : runs) {
    for (const ShipSample& sample : run.samples) {
      for (const io::ShownLoad& load : loads) {
        const double v = load.columns[component]->read(sample);
        if (!std::isfinite(v)) continue;
        low = std::min(low, v);
        high = std::max(high, v);
      }
    }
  }
  return {low, high};
}

/// The first load in front: its stems are drawn last.
std::vector<Chart::Curve> load_curves(const Subject& subject, std::string_view option, std::size_t component,
                                      double unit) {
  std::vector<Chart::Curve> curves;
  for (const io::ShownLoad& load : chosen_loads(subject.run->scene.scene, option))
    curves.push_back({load.measure, kLoadColours[curves.size()], Chart::Dash::kSolid,
                      peaks(subject, *load.columns[component], unit), Chart::Form::kStems});
  std::ranges::reverse(curves);
  return curves;
}

/// The range with room above it, so that the marks stand clear of the curves.
std::pair<double, double> with_room_for_marks(std::pair<double, double> range) {
  return {range.first, range.second + 0.15 * (range.second - range.first)};
}

std::string names(const std::vector<io::Run>& runs) {
  std::string text;
  for (const io::Run& run : runs) text += (text.empty() ? "" : ", ") + run.label;
  return text;
}

/// The direction of motion, near the heading (both count whole turns); none where noise decides it.
double course(const ShipSample& s) {
  if (length(s.velocity_in_world) < 0.02) return std::numeric_limits<double>::quiet_NaN();
  const double angle = std::atan2(s.velocity_in_world.y, s.velocity_in_world.x);
  return angle + 2 * std::numbers::pi * std::round((s.heading - angle) / (2 * std::numbers::pi));
}

template <class Value>
std::vector<Chart::Point> thinned(const Subject& subject, Value value) {
  const io::Run& run = *subject.run;
  const std::size_t rows = run.samples.size() / run.scene.scene.ships.size();
  const std::size_t step = std::max<std::size_t>(1, rows / 1500);
  std::vector<Chart::Point> points;
  std::size_t i = 0;
  for (const ShipSample& sample : run.samples) {
    if (sample.ship == subject.ship && i++ % step == 0) points.push_back({sample.time, value(sample)});
  }
  return points;
}

/// Number of floes, and share of the ice, in floes of at least a size.
struct SizeCurves {
  std::vector<Chart::Point> counts, shares;
};
SizeCurves sizes_at(const io::Run& run, double time) {
  std::vector<double> areas;
  double all = 0;
  for (const io::RunFloe& floe : run.floes) {
    if (!run.is_alive(floe.birth.floe, time)) continue;
    areas.push_back(floe.birth.area);
    all += floe.birth.area;
  }
  std::ranges::sort(areas, std::ranges::greater{});
  SizeCurves curves;
  double sum = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    sum += areas[i];
    curves.counts.push_back({std::sqrt(areas[i]), static_cast<double>(i + 1)});
    curves.shares.push_back({std::sqrt(areas[i]), 100 * sum / all});
  }
  for (auto* points : {&curves.counts, &curves.shares}) std::ranges::reverse(*points);
  return curves;
}

/// The x of a panel's curves with some room to either side.
std::pair<double, double> widened(const Chart::Panel& panel) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const Chart::Curve& curve : panel.curves) {
    for (const Chart::Point& point : curve.points) {
      low = std::min(low, point.x);
      high = std::max(high, point.x);
    }
  }
  return low <= high ? std::pair{0.8 * low, 1.25 * high} : std::pair{1.0, 10.0};
}

}  // namespace

std::vector<io::ShownLoad> chosen_loads(const simulation::Scene& scene, std::string_view option) {
  std::vector<io::ShownLoad> loads = io::shown_loads(scene);
  std::erase_if(loads, [&](const io::ShownLoad& load) {
    return option == "true" ? load.option != "mean" && load.option != "max" : load.option != option;
  });
  return loads;
}

Chart load_figure(const std::vector<io::Run>& runs, std::string_view option, const PageStyle& page) {
  const std::vector<Subject> subjects = subjects_of(runs);
  const std::vector<io::ShownLoad> loads = chosen_loads(runs.front().scene.scene, option);
  if (subjects.empty() || loads.empty()) return {};
  Chart chart{fmt::format("Load of {} on {}", loads.front().source(),
                          subjects.size() > runs.size() ? "ships and structures" : "the ship"),
              "in the ship's frame: surge forward, sway to port, yaw counter-clockwise",
              {}};
  chart.page = page;
  chart.columns = columns_for(subjects.size(), page);
  chart.panel_height = 180;
  chart.minor_mark = "cusp broken by bending";
  chart.major_mark = "floe split";
  for (std::size_t first = 0; first < subjects.size(); first += chart.columns) {
    for (std::size_t component = 0; component < kComponents.size(); ++component) {
      const auto [low, high] = with_room_for_marks(common_range(runs, loads, component));
      const Prefix prefix = prefix_for(std::max(-low, high));
      for (std::size_t i = first; i < first + chart.columns; ++i) {
        if (i >= subjects.size()) {
          chart.panels.emplace_back();
          continue;
        }
        const io::Run& run = *subjects[i].run;
        chart.panels.push_back(
            {fmt::format("{}: {}", name_of(subjects[i]), kComponents[component]),
             {"time, s", false, std::pair{run.start_time(), run.end_time()}},
             {fmt::format("{}, {}{}", kComponents[component], prefix.name, kUnits[component]), false,
              std::pair{low / prefix.factor, high / prefix.factor}},
             load_curves(subjects[i], option, component, prefix.factor),
             marks_of(subjects[i])});
      }
    }
  }
  return chart;
}

Chart motion_figure(const std::vector<io::Run>& runs) {
  Chart chart{"Speed and course", names(runs), {}};
  chart.panel_height = 300;
  Chart::Panel speed{"Speed over ground", {"time, s"}, {"speed, m/s"}, {}};
  Chart::Panel heading{"Heading, and course over ground", {"time, s"}, {"angle from the x axis, °"}, {}};
  const std::vector<Subject> subjects = subjects_of(runs);
  const bool is_alone = subjects.size() == 1;
  std::size_t number = 0;
  for (const Subject& subject : subjects) {
    const int colour = colour_of_run(number++);
    const std::string name = name_of(subject);
    const auto add = [&](Chart::Panel& panel, const std::string& words, Chart::Dash dash, auto value) {
      panel.curves.push_back({words, colour, dash, thinned(subject, value)});
    };
    add(speed, is_alone ? "speed, heading" : name, Chart::Dash::kSolid,
        [](const ShipSample& s) { return length(s.velocity_in_world); });
    add(heading, is_alone ? "speed, heading" : name, Chart::Dash::kSolid,
        [](const ShipSample& s) { return kDegrees * s.heading; });
    add(heading, is_alone ? "course over ground" : name + ", course", Chart::Dash::kDotted,
        [](const ShipSample& s) { return kDegrees * course(s); });
  }
  if (is_alone) {
    speed.marks = heading.marks = marks_of(subjects.front());
    chart.minor_mark = "cusp broken by bending";
    chart.major_mark = "floe split";
  }
  chart.panels = {std::move(speed), std::move(heading)};
  return chart;
}

Chart size_figure(const std::vector<io::Run>& runs) {
  Chart chart{"Floe sizes", names(runs) + "; size is the root of the area", {}};
  chart.panel_height = 300;
  Chart::Panel counts{"Number of floes at least as large", {"size, m", true}, {"floes", true}, {}};
  Chart::Panel shares{"Share of the ice in floes at least as large",
                      {"size, m", true},
                      {"share of the ice, %", false, std::pair{0.0, 100.0}, true},
                      {}};
  std::size_t number = 0;
  for (const io::Run& run : runs) {
    const int colour = colour_of_run(number++);
    for (const bool is_end : {false, true}) {
      const SizeCurves curves = sizes_at(run, is_end ? run.end_time() : run.start_time());
      const std::string name =
          fmt::format("{} at {:g} s", run.label, is_end ? run.end_time() : run.start_time());
      const auto dash = is_end ? Chart::Dash::kSolid : Chart::Dash::kDashed;
      counts.curves.push_back({name, colour, dash, curves.counts, Chart::Form::kSteps});
      shares.curves.push_back({name, colour, dash, curves.shares, Chart::Form::kSteps});
    }
  }
  counts.x.range = shares.x.range = widened(counts);
  chart.panels = {std::move(counts), std::move(shares)};
  return chart;
}

}  // namespace polynya::views
