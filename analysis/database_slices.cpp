#include "analysis/database_slices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fracture/bending/published_forms.hpp"
#include "geometry/shape/angle.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::analysis {
namespace {

using fracture::BendingCapacity;
using fracture::BendingLoad;
using fracture::FsiDatabaseModel;
using geometry::kDegreesPerRadian;

/// A figure: the quantity on its horizontal axis, its range, and how it is drawn.
struct Figure {
  const char* name;
  const char* x_label;
  void (*set)(BendingLoad& load, double abscissa);
  double scale;  ///< factor from abscissae in SI to the shown unit
  double low, high;
  bool is_x_log, is_radius_log;
  bool has_speeds;  ///< true: its curves have different speeds; false: different wedge angles
};

std::vector<SlicePoint> slice(const FsiDatabaseModel& model, BendingLoad load, const Figure& figure,
                              std::span<const double> abscissae) {
  std::vector<SlicePoint> points;
  for (const double value : abscissae) {
    figure.set(load, value);
    points.push_back(compare_models(model, load));
  }
  return points;
}

constexpr int kPoints = 161;  ///< number of points of a curve; more: smoother curves and a longer file
/// Widest opening angle of a wedge; towards 180 the crushed area grows without limit [deg].
constexpr double kWidestWedge = 170;

std::vector<double> evenly(double low, double high, bool is_log) {
  std::vector<double> values;
  for (int i = 0; i < kPoints; ++i) {
    const double share = static_cast<double>(i) / (kPoints - 1);
    values.push_back(is_log ? low * std::pow(high / low, share) : low + (high - low) * share);
  }
  return values;
}

/// Returns the loads of the curves of a figure with their names: first the load itself, then its neighbours.
std::vector<std::pair<std::string, BendingLoad>> family(const BendingLoad& load, bool are_speeds) {
  const double own =
      are_speeds ? load.mean_approach_speed : (load.front_half_angle + load.back_half_angle) * kDegreesPerRadian;
  const auto name = [&](double value) { return fmt::format("{:g}{}", value, are_speeds ? " m/s" : "° wedge"); };
  std::vector<std::pair<std::string, BendingLoad>> members{{name(own), load}};
  for (const double value : are_speeds ? std::array{0.1, 1.0, 4.0} : std::array{45.0, 90.0, 135.0}) {
    if (std::abs(value - own) <= 1e-9) continue;
    BendingLoad& other = members.emplace_back(name(value), load).second;
    if (are_speeds)
      other.mean_approach_speed = value;
    else
      other.front_half_angle = other.back_half_angle = 0.5 * value / kDegreesPerRadian;
  }
  return members;
}

struct Curve {
  std::string name;
  const char* source;
  std::vector<SlicePoint> slice;
  std::function<const BendingCapacity&(const SlicePoint&)> capacity_of;
};

void write_curve(io::JsonWriter& json, const Curve& curve) {
  std::vector<double> forces, radii;
  std::vector<int> is_in_range;
  for (const SlicePoint& point : curve.slice) {
    const BendingCapacity& capacity = curve.capacity_of(point);
    forces.push_back(capacity.vertical_force);
    radii.push_back(capacity.cusp_radius);
    is_in_range.push_back(capacity.is_in_range ? 1 : 0);
  }
  json.key("name").value(curve.name).key("source").value(curve.source);
  json.key("vertical_force_N").list(forces).key("cusp_radius_m").list(radii).key("is_in_range").list(is_in_range);
}

void write_figure(io::JsonWriter& json, const FsiDatabaseModel& model, const BendingLoad& load, const Figure& figure) {
  const std::vector<double> abscissae = evenly(figure.low, figure.high, figure.is_x_log);
  std::vector<double> shown = abscissae;
  for (double& value : shown) value *= figure.scale;
  json.key("name").value(figure.name).key("x_label").value(figure.x_label);
  json.key("is_x_log").value(figure.is_x_log).key("is_radius_log").value(figure.is_radius_log);
  const auto of_database = [](const SlicePoint& p) -> const auto& {
    return p.database.capacity;
  };
  const auto members = family(load, figure.has_speeds);
  std::vector<Curve> curves;
  curves.reserve(members.size() + 2);
  for (const auto& [name, of_member] : members)
    curves.push_back({"database, " + name, "database", slice(model, of_member, figure, abscissae), of_database});
  const std::vector<SlicePoint> own = curves.front().slice;
  curves.push_back({"Nevel, " + members.front().first, "Nevel", own, &SlicePoint::nevel});
  curves.push_back({"Kashtelyan, " + members.front().first, "Kashtelyan", own, &SlicePoint::kashtelyan});
  json.key("x").list(shown).key("curves").object_lines(curves, [&](const Curve& curve) { write_curve(json, curve); });
}

}  // namespace

SlicePoint compare_models(const FsiDatabaseModel& model, const BendingLoad& load) {
  SlicePoint point;
  point.database = model.forecast(load);
  BendingLoad at_break = load;
  at_break.penetration = point.database.penetration;
  point.nevel = fracture::NevelModel().capacity(at_break);
  point.kashtelyan = fracture::KashtelyanModel().capacity(at_break);
  return point;
}

std::string database_slices(const FsiDatabaseModel& model, const std::string& title, const BendingLoad& load,
                            const std::string& description) {
  const std::vector<double>& grid = model.database().grid().opening_angles_deg;
  const double widest = std::min(grid.back(), kWidestWedge);
  const double narrowest = std::min(grid.front(), 0.5 * widest);
  const auto set_speed = [](BendingLoad& at, double speed) { at.mean_approach_speed = speed; };
  const auto set_opening = [](BendingLoad& at, double angle) {
    at.front_half_angle = at.back_half_angle = 0.5 * angle;
  };
  const auto set_thickness = [](BendingLoad& at, double thickness) { at.ice.thickness = thickness; };
  const Figure figures[] = {{"speed", "normal approach speed, m/s", set_speed, 1, 0.02, 8, true, false, false},
                            {"wedge-angle", "opening angle 2α of the wedge, °", set_opening, kDegreesPerRadian,
                             narrowest / kDegreesPerRadian, widest / kDegreesPerRadian, false, false, true},
                            {"thickness", "ice thickness, m", set_thickness, 1, 0.1, 3, true, true, false}};
  return io::json_object([&](io::JsonWriter& json) {
    json.key("title").value("Icebreaking database: " + title);
    json.key("caption").value("Around " + description +
                              ". Faint: outside of the table or of the published form's range.");
    json.key("figures").object_lines(figures, [&](const Figure& figure) { write_figure(json, model, load, figure); });
  });
}

}  // namespace polynya::analysis
