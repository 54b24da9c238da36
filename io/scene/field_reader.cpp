#include "io/scene/field_reader.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/exact/validity.hpp"
#include "io/scene/floe_list_reader.hpp"
#include "io/scene/record.hpp"
#include "io/scene/scene_check.hpp"

namespace polynya::io {
namespace {

using simulation::FloeField;
using simulation::PowerLawSizes;

constexpr double kDefaultPacking = 0.75;
constexpr int kCornersWithLaw = 16;

/// A strip along a line.
struct ChannelRegion {
  geometry::Ring outline;             ///< counter-clockwise [m]
  std::vector<geometry::Ring> parts;  ///< one for each leg, mitred at the bends, counter-clockwise [m]
  int too_sharp = -1;                 ///< point of the line at which a bend leaves a leg no room; −1: none
};

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

/// From the line to its port side at a point: half the width away from both legs.
Vector mitre(Vector before, Vector after, double half) {
  const Vector a = perpendicular(before) / length(before);
  const Vector b = perpendicular(after) / length(after);
  const double share = 1 + dot(a, b);
  return share > 0.02 ? half / share * (a + b) : Vector{};  // else the line turns back on itself
}

bool is_convex(const Ring& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(cross(ring[(i + 1) % n] - ring[i], ring[(i + 2) % n] - ring[(i + 1) % n]) > 0)) return false;
  }
  return true;
}

/// `width` across [m]. The line has two points or more, none of them twice in a row.
ChannelRegion channel_region(const std::vector<Point>& line, double width) {
  ChannelRegion region;
  const std::size_t last = line.size() - 1;
  std::vector<Vector> to_port;
  for (std::size_t i = 0; i <= last; ++i) {
    const Vector before = line[i == 0 ? 1 : i] - line[i == 0 ? 0 : i - 1];
    const Vector after = line[i == last ? last : i + 1] - line[i == last ? last - 1 : i];
    to_port.push_back(mitre(before, after, 0.5 * width));
  }
  for (std::size_t i = 0; i < last; ++i) {
    Ring part{line[i] - to_port[i], line[i + 1] - to_port[i + 1], line[i + 1] + to_port[i + 1], line[i] + to_port[i]};
    if (!is_convex(part) && region.too_sharp < 0)
      region.too_sharp = static_cast<int>(
          i == 0 || (i < last - 1 && squared_length(to_port[i + 1]) > squared_length(to_port[i])) ? i + 1 : i);
    region.parts.push_back(std::move(part));
  }
  for (std::size_t i = 0; i <= last; ++i) region.outline.push_back(line[i] - to_port[i]);
  for (std::size_t i = last + 1; i-- > 0;) region.outline.push_back(line[i] + to_port[i]);
  return region;
}

class FieldReader {
 public:
  FieldReader(FieldInput& input, const JsonValue& item, const std::string& path, const simulation::Scene& scene,
              ProblemCollector& problems)
      : input_(input), json_(*item.find("field")), path_(path), scene_(scene), problems_(problems) {}

  std::optional<FloeField> read() {
    field_ = input_.field;
    const std::size_t problems_before = problems_.count();
    choose_sizes();
    set_region();
    field_.seed += scene_.seed;
    for (const geometry::Ring& clear : input_.keep_clear) field_.kept_clear.push_back(in_house_notation({clear, {}}));
    for (std::size_t i = 0; i < hull_count(scene_); ++i) {
      const simulation::PlacedHull& hull = hull_of(scene_, i);
      if (hull.hull.waterline.size() >= 3) field_.kept_clear.push_back(waterline_in_world(hull));
    }
    if (problems_.count() > problems_before) return std::nullopt;
    check_rings();
    if (problems_.count() > problems_before) return std::nullopt;
    if (field_.law) check_law();
    if (problems_.count() > problems_before) return std::nullopt;
    return field_;
  }

 private:
  /// An index in a list of the field, as keep_clear_m[2], stands in the path alone: the place is the list's.
  void report(std::string_view key, std::string found, std::string allowed) {
    problems_.report(0, nearest_offset(json_, key.substr(0, key.find('['))), key.empty() ? path_ : key_path(path_, key),
                     std::move(found), std::move(allowed));
  }

  /// Sizes are a law's or floe_size_m's, and go with their own keys.
  void choose_sizes() {
    const bool has_size = input_.floe_size.has_value();
    if (has_size == field_.law.has_value())
      report(has_size ? "sizes" : "", has_size ? "sizes beside floe_size_m" : "neither sizes nor floe_size_m",
             "one of sizes and floe_size_m");
    if (field_.law && input_.size_spread)
      report("size_spread", "size_spread beside sizes", "sizes with mean_m and spread");
    const auto check_without_law = [&](std::string_view key, bool is_given) {
      if (has_size && is_given) report(key, fmt::format("{} with floe_size_m", key), "sizes instead");
    };
    check_without_law("aspect", input_.aspect.has_value());
    check_without_law("orientation_deg", input_.orientation.has_value());
    check_without_law("least_corners", input_.least_corners.has_value());
    check_without_law("packing", input_.packing.has_value());
    if (input_.orientation && !input_.aspect)
      report("orientation_deg", "orientation_deg without aspect", "both, or neither");
    field_.orientation = input_.orientation;
    if (field_.law)
      complete_law();
    else
      complete_sizes();
  }

  /// The value, put where it was not given.
  template <class Value>
  static Value filled_in(std::optional<Value>& given, Value otherwise) {
    if (!given) given = otherwise;
    return *given;
  }

  void complete_sizes() {
    field_.floe_size = input_.floe_size.value_or(field_.floe_size);
    field_.size_spread = filled_in(input_.size_spread, field_.size_spread);
    field_.most_corners = filled_in(input_.most_corners, field_.most_corners);
  }

  void complete_law() {
    const double packing = std::max(field_.concentration, std::min(kDefaultPacking, 2 * field_.concentration));
    field_.aspect = input_.aspect.value_or(field_.aspect);
    field_.most_corners = filled_in(input_.most_corners, kCornersWithLaw);
    field_.least_corners = filled_in(input_.least_corners, field_.least_corners);
    field_.packing = filled_in(input_.packing, packing);
    if (field_.least_corners > field_.most_corners)
      report("least_corners", fmt::format("{}, more than most_corners", field_.least_corners),
             fmt::format("at most {}", field_.most_corners));
    if (field_.packing < field_.concentration)
      report("packing", fmt::format("{:g}, less than the concentration", field_.packing),
             fmt::format("at least {:g}: floes, and the holes among them that further floes would fill",
                         field_.concentration));
  }

  void set_region() {
    const auto* rectangle_of = std::get_if<FieldRectangle>(&input_.region);
    field_.is_rectangle = rectangle_of != nullptr;
    if (rectangle_of) {
      field_.region = rectangle(rectangle_of->corner, rectangle_of->extent).outer;
    } else if (const auto* outline = std::get_if<FieldOutline>(&input_.region)) {
      field_.region = in_house_notation({outline->ring, {}}).outer;
    } else {
      set_channel(std::get<FieldChannel>(input_.region));
    }
  }

  void set_channel(const FieldChannel& channel) {
    const auto& line = channel.centreline;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i] == line[i - 1])
        return report("centreline_m", fmt::format("point {} a second time", i), "points that differ");
    }
    ChannelRegion region = channel_region(line, channel.width);
    if (region.too_sharp >= 0)
      return report(
          "centreline_m",
          fmt::format("a bend at point {} that is too sharp for {:g} m of width", region.too_sharp + 1, channel.width),
          "longer legs, wider angles or less width");
    field_.region = std::move(region.outline);
    field_.parts = std::move(region.parts);
  }

  void check_ring(const geometry::Ring& ring, const std::string& key) {
    if (const auto defect = geometry::find_defect({ring, {}}))
      report(key, "an invalid ring: " + describe(*defect), "a simple ring");
  }
  void check_rings() {
    if (!field_.is_rectangle)
      check_ring(field_.region, std::holds_alternative<FieldOutline>(input_.region) ? "outline_m" : "centreline_m");
    for (std::size_t i = 0; i < input_.keep_clear.size(); ++i)
      check_ring(field_.kept_clear[i].outer, fmt::format("keep_clear_m[{}]", i));
  }

  /// The widest floe that the region can hold, roughly: as wide as the region [m].
  double width_of_region() const {
    if (const auto* channel = std::get_if<FieldChannel>(&input_.region)) return channel->width;
    const geometry::Box box = bounding_box(field_.region);
    return std::min(box.high.x - box.low.x, box.high.y - box.low.y);
  }

  void check_law() {
    const auto* power = std::get_if<PowerLawSizes>(&*field_.law);
    if (power && power->least >= power->largest)
      return report("sizes.least_m", fmt::format("{:g}, not below largest_m", power->least),
                    fmt::format("less than {:g}", power->largest));
    const double count = simulation::floe_count(field_);
    const double width = width_of_region();
    // The bounds of a power law are asked for; a log-normal law has none that a field would have to reach.
    const double largest = power ? power->largest : simulation::size_at(*field_.law, 1 - 0.5 / std::max(count, 1.0));
    if (largest > width) {
      const std::string_view key = power ? "sizes.largest_m" : "sizes";
      return report(
          key, fmt::format("floes of up to {:.4g} m in a region {:.4g} m across", largest, width),
          power ? fmt::format("at most {:.4g}, or a wider region", width) : "smaller floes, or a wider region");
    }
  }

  FieldInput& input_;
  const JsonValue& json_;
  const std::string& path_;
  const simulation::Scene& scene_;
  ProblemCollector& problems_;
  FloeField field_;
};

/// What would make room for the cover.
std::string remedy(const FloeField& field, const simulation::FloeFieldOutcome& outcome) {
  const double reachable = outcome.reachable_concentration;
  if (!field.law) return fmt::format("at most {:.3g} with this gap_m", reachable);
  const std::string most = fmt::format("at most {:.3g} with these sizes", std::floor(1000 * reachable) / 1000);
  const double room = outcome.reachable_without_gap - field.concentration;
  const double taken = outcome.reachable_without_gap - reachable;
  if (room > 0 && taken > 0)
    return fmt::format("{}, or a gap_m of at most {:.2g}", most, 0.95 * field.gap * room / taken);
  return fmt::format("{}, or most_corners above {}", most, field.most_corners);
}

}  // namespace

std::optional<FloeField> complete_field(FieldInput& input, const JsonValue& item, const std::string& path,
                                        const simulation::Scene& scene, ProblemCollector& problems) {
  return FieldReader(input, item, path, scene, problems).read();
}

bool check_cover(const FloeField& field, const simulation::FloeFieldOutcome& outcome, const JsonValue& item,
                 const std::string& path, ProblemCollector& problems) {
  const JsonValue& concentration = *item.find("field")->find("concentration");
  if (field.law && outcome.region_area <= 0) {
    problems.report(0, item.offset, path, "no room: all of the region is kept clear", "a region with free water");
    return false;
  }
  if (outcome.reachable_concentration >= field.concentration) return true;
  problems.report(0, concentration.offset, path + ".concentration", show(concentration), remedy(field, outcome));
  return false;
}

}  // namespace polynya::io
