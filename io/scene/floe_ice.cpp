#include <algorithm>

#include <fmt/format.h>

#include "io/scene/floe_list_reader.hpp"
#include "io/scene/record.hpp"
#include "simulation/ice/ice_scatter.hpp"

namespace polynya::io {
namespace {

using fracture::Ice;
using fracture::ScatterKind;
using fracture::ScatterLaw;

/// A normal law without bounds is cut off at this number of standard deviations from the mean.
constexpr double kDeviations = 3;
/// Least fraction of a law that must lie between its bounds. Less is taken for a mistake.
constexpr double kLeastShare = 0.01;

/// Reports keys that the kind of law needs but does not have, and keys that it does not use.
void check_keys(const LawInput& law, const ReportAt& report) {
  const std::string word = write(kLawDescription, law).find("law")->text();
  const auto check = [&](std::string_view key, std::optional<double> given, bool is_needed, bool is_refused) {
    if (!given && is_needed) report(key, "nothing", fmt::format("a number: law {} needs it", word));
    if (given && is_refused) report(key, show({*given}), fmt::format("nothing: law {} has none", word));
  };
  const bool is_uniform = law.kind == ScatterKind::kUniform;
  const bool is_constant = law.kind == ScatterKind::kConstant;
  check("mean", law.mean, false, is_uniform);
  check("spread", law.spread, !is_uniform && !is_constant, is_uniform || is_constant);
  check("least", law.least, is_uniform, is_constant);
  check("most", law.most, is_uniform, is_constant);
}

void check_bounds(const ScatterLaw& law, std::string_view unit, const ReportAt& report) {
  if (law.least > law.most) {
    report("least", fmt::format("{:g}", law.least), fmt::format("at most `most`, {:g} [{}]", law.most, unit));
  } else if (const double share = share_within_bounds(law); share < kLeastShare) {
    report("", fmt::format("a law of which {:.2g} lies between {:g} and {:g}", share, law.least, law.most),
           fmt::format("bounds around the mean, {:g} [{}], that hold {:g} of it or more", law.mean, unit, kLeastShare));
  }
}

/// Returns the complete law of one property of one entry. If it is wrong, reports it and returns nothing.
std::optional<ScatterLaw> complete_law(const NumberOrLaw& given, const FloeProperty& property, double scene_value,
                                       const ReportAt& report) {
  if (const double* number = std::get_if<double>(&given))
    return ScatterLaw{.kind = ScatterKind::kConstant, .mean = *number};
  const auto& input = std::get<LawInput>(given);
  const std::size_t problems_before = report.problems.count();
  check_keys(input, report);
  if (report.problems.count() > problems_before) return std::nullopt;
  ScatterLaw law{.kind = input.kind,
                 .mean = input.mean.value_or(scene_value),
                 .spread = input.spread.value_or(0),
                 .least = property.low,
                 .most = property.high};
  if (law.kind == ScatterKind::kNormal) {
    law.least = std::max(law.least, law.mean * (1 - kDeviations * law.spread));
    law.most = std::min(law.most, law.mean * (1 + kDeviations * law.spread));
  }
  law.least = input.least.value_or(law.least);
  law.most = input.most.value_or(law.most);
  check_bounds(law, property.unit, report);
  return report.problems.count() > problems_before ? std::nullopt : std::optional(law);
}

bool is_same(const Ice& a, const Ice& b) {
  return std::ranges::all_of(floe_ice_properties(), [&](const FloeProperty& p) { return a.*p.ice == b.*p.ice; });
}

}  // namespace

std::optional<GroupIce> GroupIce::of(const simulation::Scene& scene, const FloeGroup& group, const JsonValue& item,
                                     const std::string& path, ProblemCollector& problems) {
  GroupIce ice;
  if (!group.ice) return ice;
  ice.seed_ = scene.seed + group.ice->seed;
  bool is_good = true;
  for (std::size_t i = 0; i < kFloeIceProperties; ++i) {
    const FloeProperty& property = floe_ice_properties()[i];
    const std::optional<NumberOrLaw>& given = group.ice->properties[i];
    if (!given) continue;
    const ReportAt report{problems, *item.find("ice")->find(property.key),
                          fmt::format("{}.ice.{}", path, property.key)};
    if (auto law = complete_law(*given, property, scene.ice.*property.ice, report))
      ice.laws_.push_back({i, *law, {}});
    else
      is_good = false;
  }
  if (!is_good) return std::nullopt;
  return ice;
}

std::int32_t GroupIce::add_to(simulation::Scene& scene, const FloeProperties& given) {
  Ice ice = scene.ice;
  for (Law& law : laws_) {
    const FloeProperty& property = floe_ice_properties()[law.property];
    if (given.*property.member) continue;
    law.drawn.push_back(simulation::drawn_property(law.law, seed_, scene.floes.size(), law.property));
    ice.*property.ice = law.drawn.back();
  }
  for (const FloeProperty& property : floe_ice_properties())
    if (const auto& value = given.*property.member) ice.*property.ice = *value;
  if (is_same(ice, scene.ice)) return simulation::kSceneIce;
  if (scene.own_ice.empty() || !is_same(ice, scene.own_ice.back())) scene.own_ice.push_back(ice);
  return static_cast<std::int32_t>(scene.own_ice.size()) - 1;
}

std::vector<IceReport> GroupIce::reports(std::size_t group) const {
  std::vector<IceReport> reports;
  for (const Law& law : laws_) {
    if (law.law.kind == ScatterKind::kConstant || law.drawn.empty()) continue;
    reports.push_back({group, law.property, fracture::measure(law.law, law.drawn)});
  }
  return reports;
}

std::optional<IceInput> GroupIce::spelled_out(const simulation::Scene& scene, const FloeProperties& given) const {
  const Ice& ice = ice_of(scene, scene.floes.back().own_ice);
  IceInput own;
  for (std::size_t i = 0; i < kFloeIceProperties; ++i) {
    const FloeProperty& property = floe_ice_properties()[i];
    if (given.*property.member || std::ranges::count(laws_, i, &Law::property) > 0)
      own.properties[i] = ice.*property.ice;
  }
  const bool has_any = std::ranges::any_of(own.properties, [](const auto& property) { return property.has_value(); });
  return has_any ? std::optional(own) : std::nullopt;
}

}  // namespace polynya::io
