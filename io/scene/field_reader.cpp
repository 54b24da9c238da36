#include "io/scene/field_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/exact/validity.hpp"
#include "io/scene/channel_region.hpp"
#include "io/scene/floe_group.hpp"
#include "io/scene/scene_check.hpp"
#include "io/scene/scene_resolve.hpp"

namespace polynya::io {
namespace {

using simulation::FloeField;
using simulation::PowerLawSizes;

constexpr double kDefaultPacking = 0.75;
constexpr int kCornersWithLaw = 16;

class FieldReader {
 public:
  FieldReader(JsonValue& item, const std::string& path, const SceneDraft& draft, ProblemCollector& problems)
      : json_(*item.find("field")), path_(path), group_(draft.group), draft_(draft), problems_(problems) {}

  std::optional<FloeField> read() {
    field_ = group_.field;
    const std::size_t problems_before = problems_.count();
    choose_sizes();
    set_region();
    field_.seed += draft_.scene.seed;
    for (geometry::Polygon& clear : field_.kept_clear) clear = in_house_notation(std::move(clear));
    for (const auto& ship : draft_.scene.ships) {
      if (ship.hull.waterline.size() >= 3) field_.kept_clear.push_back(waterline_in_world(ship));
    }
    if (problems_.count() > problems_before) return std::nullopt;
    check_rings();
    if (problems_.count() > problems_before) return std::nullopt;
    if (field_.law) check_law();
    if (problems_.count() > problems_before) return std::nullopt;
    return field_;
  }

 private:
  void report(std::string_view key, std::string found, std::string allowed) {
    const JsonValue* at = &json_;
    std::string_view rest = key;
    while (!rest.empty()) {
      const std::size_t dot = rest.find('.');
      const JsonValue* next = at->find(rest.substr(0, std::min({dot, rest.find('['), rest.size()})));
      if (!next) break;
      at = next;
      rest = dot == std::string_view::npos ? "" : rest.substr(dot + 1);
    }
    problems_.report(0, at->offset, key.empty() ? path_ : fmt::format("{}.{}", path_, key), std::move(found),
                     std::move(allowed));
  }

  /// Puts a default where the table has it, behind another key.
  void fill_in(std::string_view key, double value, std::string_view behind) {
    if (json_.find(key)) return;
    auto& members = json_.members();
    auto place = std::ranges::find(members, behind, &JsonMember::key);
    if (place != members.end()) ++place;
    members.insert(place, {std::string(key), json_.offset, {value, json_.offset}});
  }

  /// Sizes are a law's or floe_size_m's, and go with their own keys.
  void choose_sizes() {
    const bool has_size = json_.find("floe_size_m") != nullptr;
    if (has_size == field_.law.has_value())
      report(has_size ? "sizes" : "", has_size ? "sizes beside floe_size_m" : "neither sizes nor floe_size_m",
             "one of sizes and floe_size_m");
    if (field_.law && json_.find("size_spread"))
      report("size_spread", "size_spread beside sizes", "sizes with mean_m and spread");
    for (const std::string_view key : {"aspect", "orientation_deg", "least_corners", "packing"}) {
      if (has_size && json_.find(key)) report(key, fmt::format("{} with floe_size_m", key), "sizes instead");
    }
    if (field_.orientation && !json_.find("aspect"))
      report("orientation_deg", "orientation_deg without aspect", "both, or neither");
    if (!field_.law) {
      fill_in("size_spread", field_.size_spread, "floe_size_m");
      fill_in("most_corners", field_.most_corners, "gap_m");
      return;
    }
    if (!json_.find("most_corners")) field_.most_corners = kCornersWithLaw;
    if (!json_.find("packing"))
      field_.packing = std::max(field_.concentration, std::min(kDefaultPacking, 2 * field_.concentration));
    fill_in("most_corners", field_.most_corners, "gap_m");
    fill_in("least_corners", field_.least_corners, "most_corners");
    fill_in("packing", field_.packing, "least_corners");
    if (field_.least_corners > field_.most_corners)
      report("least_corners", fmt::format("{}, more than most_corners", field_.least_corners),
             fmt::format("at most {}", field_.most_corners));
    if (field_.packing < field_.concentration)
      report("packing", fmt::format("{:g}, less than the concentration", field_.packing),
             fmt::format("at least {:g}: floes, and the holes among them that further floes would fill",
                         field_.concentration));
  }

  void set_region() {
    field_.is_rectangle = group_.extent != geometry::Vector{};
    if (group_.centreline.empty()) {
      field_.region = field_.is_rectangle ? rectangle(group_.origin, group_.extent).outer
                                          : in_house_notation({field_.region, {}}).outer;
      return;
    }
    const auto& line = group_.centreline;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i] == line[i - 1])
        return report("centreline_m", fmt::format("point {} a second time", i), "points that differ");
    }
    ChannelRegion channel = channel_region(line, group_.width);
    if (channel.too_sharp >= 0)
      return report("centreline_m",
                    fmt::format("a bend at point {} that is too sharp for {:g} m of width",
                                channel.too_sharp + 1, group_.width),
                    "longer legs, wider angles or less width");
    field_.region = std::move(channel.outline);
    field_.parts = std::move(channel.parts);
  }

  void check_ring(const geometry::Ring& ring, const std::string& key) {
    if (const auto defect = geometry::find_defect({ring, {}}))
      report(key, "an invalid ring: " + describe(*defect), "a simple ring");
  }
  void check_rings() {
    if (!field_.is_rectangle)
      check_ring(field_.region, group_.centreline.empty() ? "outline_m" : "centreline_m");
    const std::size_t given = json_.find("keep_clear_m")->items().size();
    for (std::size_t i = 0; i < given; ++i)
      check_ring(field_.kept_clear[i].outer, fmt::format("keep_clear_m[{}]", i));
  }

  /// The widest floe that the region can hold, roughly: as wide as the region [m].
  double width_of_region() const {
    if (!group_.centreline.empty()) return group_.width;
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
    const double largest =
        power ? power->largest : simulation::size_at(*field_.law, 1 - 0.5 / std::max(count, 1.0));
    if (largest > width) {
      const std::string_view key = power ? "sizes.largest_m" : "sizes";
      return report(key, fmt::format("floes of up to {:.4g} m in a region {:.4g} m across", largest, width),
                    power ? fmt::format("at most {:.4g}, or a wider region", width)
                          : "smaller floes, or a wider region");
    }
  }

  JsonValue& json_;
  const std::string& path_;
  const FloeGroup& group_;
  const SceneDraft& draft_;
  ProblemCollector& problems_;
  FloeField field_;
};

/// What would make room for the cover.
std::string remedy(const FloeField& field, const simulation::FloeFieldOutcome& outcome) {
  const double reachable = outcome.reachable_concentration;
  if (!field.law) return fmt::format("at most {:.3g} with this gap_m", reachable);
  const std::string most =
      fmt::format("at most {:.3g} with these sizes", std::floor(1000 * reachable) / 1000);
  const double room = outcome.reachable_without_gap - field.concentration;
  const double taken = outcome.reachable_without_gap - reachable;
  if (room > 0 && taken > 0)
    return fmt::format("{}, or a gap_m of at most {:.2g}", most, 0.95 * field.gap * room / taken);
  return fmt::format("{}, or most_corners above {}", most, field.most_corners);
}

}  // namespace

std::optional<FloeField> complete_field(JsonValue& item, const std::string& path, const SceneDraft& draft,
                                        ProblemCollector& problems) {
  return FieldReader(item, path, draft, problems).read();
}

bool check_cover(const FloeField& field, const simulation::FloeFieldOutcome& outcome, const JsonValue& item,
                 const std::string& path, ProblemCollector& problems) {
  const JsonValue& concentration = *item.find("field")->find("concentration");
  if (field.law && outcome.region_area <= 0) {
    problems.report(0, item.offset, path, "no room: all of the region is kept clear",
                    "a region with free water");
    return false;
  }
  if (outcome.reachable_concentration >= field.concentration) return true;
  problems.report(0, concentration.offset, path + ".concentration", show(concentration),
                  remedy(field, outcome));
  return false;
}

}  // namespace polynya::io
