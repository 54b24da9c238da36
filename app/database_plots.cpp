#include "app/database_plots.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "app/database_input.hpp"
#include "fracture/bending/studies.hpp"

namespace polynya::app {
namespace {

using fracture::BendingLoad;
using fracture::FsiDatabaseModel;
using fracture::SliceAxis;
using fracture::SlicePoint;

constexpr int kPoints = 161;
constexpr double kWidestWedge = 170;  ///< towards 180 the crushed area grows without bound [deg]

std::vector<double> evenly(double low, double high, bool is_log) {
  std::vector<double> values;
  for (int i = 0; i < kPoints; ++i) {
    const double share = static_cast<double>(i) / (kPoints - 1);
    values.push_back(is_log ? low * std::pow(high / low, share) : low + (high - low) * share);
  }
  return values;
}

/// What a curve of a family is for: the load with one thing changed.
struct Member {
  std::string name;
  BendingLoad load;
};

Member with_angle(BendingLoad load, double angle_deg) {
  load.front_half_angle = load.back_half_angle = 0.5 * angle_deg / kDegree;
  return {fmt::format("{:g}° wedge", angle_deg), load};
}

Member with_speed(BendingLoad load, double speed) {
  load.mean_approach_speed = speed;
  return {fmt::format("{:g} m/s", speed), load};
}

/// The load itself first, then its neighbours.
std::vector<Member> family(const BendingLoad& load, SliceAxis axis) {
  std::vector<Member> members;
  if (axis == SliceAxis::kOpeningAngle) {
    members.push_back(with_speed(load, load.mean_approach_speed));
    for (const double speed : {0.1, 1.0, 4.0})
      if (speed != load.mean_approach_speed) members.push_back(with_speed(load, speed));
    return members;
  }
  const double angle = (load.front_half_angle + load.back_half_angle) * kDegree;
  members.push_back({fmt::format("{:g}° wedge", angle), load});
  for (const double other : {45.0, 90.0, 135.0})
    if (std::abs(other - angle) > 1e-9) members.push_back(with_angle(load, other));
  return members;
}

using Quantity = double (*)(const fracture::BendingCapacity&);

double force_of(const fracture::BendingCapacity& capacity) {
  return capacity.vertical_force / 1e3;
}
double radius_of(const fracture::BendingCapacity& capacity) {
  return capacity.cusp_radius;
}

/// The slices of one figure: the family's, in its order.
struct Figure {
  SliceAxis axis;
  std::vector<Member> members;
  std::vector<std::vector<SlicePoint>> slices;
};

views::Chart::Panel panel(const Figure& figure, std::string title, views::Chart::Axis x, views::Chart::Axis y,
                          Quantity quantity) {
  views::Chart::Panel panel{std::move(title), std::move(x), std::move(y), {}};
  const double x_scale = figure.axis == SliceAxis::kOpeningAngle ? kDegree : 1;
  const auto add = [&](std::string name, int colour, views::Chart::Dash dash,
                       const std::vector<SlicePoint>& slice, auto capacity_of) {
    views::Chart::Curve curve{std::move(name), colour, dash, {}};
    for (const SlicePoint& point : slice) {
      const fracture::BendingCapacity& capacity = capacity_of(point);
      curve.points.push_back({point.abscissa * x_scale, quantity(capacity), !capacity.is_in_range});
    }
    panel.curves.push_back(std::move(curve));
  };
  using Dash = views::Chart::Dash;
  for (std::size_t i = 0; i < figure.members.size(); ++i)
    add(
        "database, " + figure.members[i].name, static_cast<int>(i), Dash::kSolid, figure.slices[i],
        [](const SlicePoint& p) -> const auto& { return p.database.capacity; });
  const std::string& name = figure.members.front().name;
  add(
      "Nevel, " + name, 4, Dash::kDashed, figure.slices.front(),
      [](const SlicePoint& p) -> const auto& { return p.nevel; });
  add(
      "Kashtelyan, " + name, 5, Dash::kDotted, figure.slices.front(),
      [](const SlicePoint& p) -> const auto& { return p.kashtelyan; });
  return panel;
}

struct FigureText {
  std::string file;
  std::string x_label;
  bool is_x_log;
  bool is_radius_log;
};

NamedChart draw(const FsiDatabaseModel& model, const std::string& title, const BendingLoad& load,
                SliceAxis axis, std::span<const double> abscissae, const FigureText& text) {
  Figure figure{axis, family(load, axis), {}};
  for (const Member& member : figure.members)
    figure.slices.push_back(slice(model, member.load, axis, abscissae));
  views::Chart chart;
  chart.title = "Icebreaking database: " + title;
  chart.caption =
      "Around " + describe(load) + ". Faint: outside of the table or of the published form's range.";
  const views::Chart::Axis x{text.x_label, text.is_x_log};
  chart.panels.push_back(
      panel(figure, "Vertical force that breaks the wedge", x, {"vertical force V [kN]", true}, force_of));
  chart.panels.push_back(
      panel(figure, "Radius of the cusp", x, {"cusp radius R [m]", text.is_radius_log}, radius_of));
  return {text.file, std::move(chart)};
}

}  // namespace

std::vector<NamedChart> database_charts(const FsiDatabaseModel& model, const std::string& title,
                                        const BendingLoad& load) {
  const std::vector<double>& grid = model.database().grid().opening_angles_deg;
  const double widest = std::min(grid.back(), kWidestWedge);
  const double narrowest = std::min(grid.front(), 0.5 * widest);
  std::vector<NamedChart> charts;
  charts.push_back(draw(model, title, load, SliceAxis::kSpeed, evenly(0.02, 8, true),
                        {"speed.svg", "normal approach speed v_n [m/s]", true, false}));
  charts.push_back(draw(model, title, load, SliceAxis::kOpeningAngle,
                        evenly(narrowest / kDegree, widest / kDegree, false),
                        {"wedge-angle.svg", "opening angle 2α of the wedge [°]", false, false}));
  charts.push_back(draw(model, title, load, SliceAxis::kThickness, evenly(0.1, 3, true),
                        {"thickness.svg", "ice thickness h [m]", true, true}));
  return charts;
}

}  // namespace polynya::app
