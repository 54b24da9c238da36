#include "app/database_plots.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/database_input.hpp"
#include "fracture/bending/studies.hpp"
#include "io/text/json_writer.hpp"

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

/// A curve of a figure: a capacity of each point of a slice.
template <class CapacityOf>
void write_curve(io::JsonWriter& json, const std::string& name, const char* source,
                 const std::vector<SlicePoint>& slice, CapacityOf capacity_of) {
  std::vector<double> forces, radii;
  std::vector<int> is_in_range;
  for (const SlicePoint& point : slice) {
    const fracture::BendingCapacity& capacity = capacity_of(point);
    forces.push_back(capacity.vertical_force);
    radii.push_back(capacity.cusp_radius);
    is_in_range.push_back(capacity.is_in_range ? 1 : 0);
  }
  json.start_line();
  json.open('{').key("name").value(name).key("source").value(source);
  json.key("vertical_force_N").list(forces).key("cusp_radius_m").list(radii);
  json.key("is_in_range").list(is_in_range).close('}');
}

struct FigureText {
  const char* name;
  const char* x_label;
  bool is_x_log;
  bool is_radius_log;
};

void write_figure(io::JsonWriter& json, const FsiDatabaseModel& model, const BendingLoad& load,
                  SliceAxis axis, const std::vector<double>& abscissae, const FigureText& text) {
  const double scale = axis == SliceAxis::kOpeningAngle ? kDegree : 1;
  std::vector<double> shown;
  shown.reserve(abscissae.size());
  for (const double value : abscissae) shown.push_back(value * scale);
  json.start_line();
  json.open('{').key("name").value(text.name).key("x_label").value(text.x_label);
  json.key("is_x_log").value(text.is_x_log).key("is_radius_log").value(text.is_radius_log);
  json.key("x").list(shown).key("curves").open('[');
  const std::vector<Member> members = family(load, axis);
  for (const Member& member : members)
    write_curve(
        json, "database, " + member.name, "database", slice(model, member.load, axis, abscissae),
        [](const SlicePoint& p) -> const auto& { return p.database.capacity; });
  const std::vector<SlicePoint> own = slice(model, load, axis, abscissae);
  write_curve(
      json, "Nevel, " + members.front().name, "Nevel", own,
      [](const SlicePoint& p) -> const auto& { return p.nevel; });
  write_curve(
      json, "Kashtelyan, " + members.front().name, "Kashtelyan", own,
      [](const SlicePoint& p) -> const auto& { return p.kashtelyan; });
  json.close(']').close('}');
}

}  // namespace

std::string database_slices(const FsiDatabaseModel& model, const std::string& title,
                            const BendingLoad& load) {
  const std::vector<double>& grid = model.database().grid().opening_angles_deg;
  const double widest = std::min(grid.back(), kWidestWedge);
  const double narrowest = std::min(grid.front(), 0.5 * widest);
  std::string text;
  io::JsonWriter json(text);
  json.open('{').key("title").value("Icebreaking database: " + title);
  json.key("caption").value("Around " + describe(load) +
                            ". Faint: outside of the table or of the published form's range.");
  json.key("figures").open('[');
  write_figure(json, model, load, SliceAxis::kSpeed, evenly(0.02, 8, true),
               {"speed", "normal approach speed, m/s", true, false});
  write_figure(json, model, load, SliceAxis::kOpeningAngle,
               evenly(narrowest / kDegree, widest / kDegree, false),
               {"wedge-angle", "opening angle 2α of the wedge, °", false, false});
  write_figure(json, model, load, SliceAxis::kThickness, evenly(0.1, 3, true),
               {"thickness", "ice thickness, m", true, true});
  json.close(']').close('}');
  return text + '\n';
}

}  // namespace polynya::app
