#include "io/scene/floe_ice.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/scene/scene_resolve.hpp"
#include "simulation/ice_scatter.hpp"

namespace polynya::io {
namespace {

using fracture::Ice;
using fracture::ScatterKind;
using fracture::ScatterLaw;
using JsonKind = JsonValue::Kind;

constexpr double kDeviations = 3;     ///< off the mean where a normal law without bounds is cut off
constexpr double kLeastShare = 0.01;  ///< of a law between its bounds: less is taken for a slip

ScatterKind kind_of(const std::string& word) {
  return word == "constant"  ? ScatterKind::kConstant
         : word == "uniform" ? ScatterKind::kUniform
         : word == "normal"  ? ScatterKind::kNormal
                             : ScatterKind::kLogNormal;
}

/// Reads one property of one entry, a number or a law.
class LawReader {
 public:
  LawReader(const FloeIceProperty& property, const JsonValue& value, std::string path,
            ProblemCollector& problems)
      : property_(property), value_(value), path_(std::move(path)), problems_(problems) {}

  std::optional<ScatterLaw> read(double scene_value) {
    ScatterLaw law;
    law.kind = ScatterKind::kConstant;
    law.mean = value_.is(JsonKind::kNumber) ? value_.number() : scene_value;
    if (value_.is(JsonKind::kNumber)) return law;
    const std::string& word = value_.find("law")->text();
    law.kind = kind_of(word);
    const bool is_uniform = law.kind == ScatterKind::kUniform;
    const bool is_constant = law.kind == ScatterKind::kConstant;
    check("mean", word, false, is_uniform);
    check("spread", word, !is_uniform && !is_constant, is_uniform || is_constant);
    check("least", word, is_uniform, is_constant);
    check("most", word, is_uniform, is_constant);
    if (!is_good_) return std::nullopt;
    law.mean = number("mean", scene_value);
    law.spread = number("spread", 0);
    set_bounds(law);
    check_bounds(law);
    return is_good_ ? std::optional(law) : std::nullopt;
  }

 private:
  double number(std::string_view key, double otherwise) const {
    const JsonValue* found = value_.find(key);
    return found ? found->number() : otherwise;
  }

  void report(const JsonValue& at, std::string_view key, std::string found, std::string allowed) {
    problems_.report(0, at.offset, key.empty() ? path_ : fmt::format("{}.{}", path_, key), std::move(found),
                     std::move(allowed));
    is_good_ = false;
  }

  void check(std::string_view key, const std::string& word, bool is_needed, bool is_refused) {
    const JsonValue* found = value_.find(key);
    if (!found && is_needed) report(value_, key, "nothing", fmt::format("a number: law {} needs it", word));
    if (found && is_refused) report(*found, key, show(*found), fmt::format("nothing: law {} has none", word));
  }

  void set_bounds(ScatterLaw& law) const {
    law.least = property_.range.low;
    law.most = property_.range.high;
    if (law.kind == ScatterKind::kNormal) {
      law.least = std::max(law.least, law.mean * (1 - kDeviations * law.spread));
      law.most = std::min(law.most, law.mean * (1 + kDeviations * law.spread));
    }
    law.least = number("least", law.least);
    law.most = number("most", law.most);
  }

  void check_bounds(const ScatterLaw& law) {
    if (law.least > law.most) {
      const JsonValue* at = value_.find("least");
      report(at ? *at : value_, "least", fmt::format("{:g}", law.least),
             fmt::format("at most `most`, {:g} [{}]", law.most, property_.unit));
    } else if (const double share = share_within_bounds(law); share < kLeastShare) {
      report(value_, "",
             fmt::format("a law of which {:.2g} lies between {:g} and {:g}", share, law.least, law.most),
             fmt::format("bounds around the mean, {:g} [{}], that hold {:g} of it or more", law.mean,
                         property_.unit, kLeastShare));
    }
  }

  const FloeIceProperty& property_;
  const JsonValue& value_;
  std::string path_;
  ProblemCollector& problems_;
  bool is_good_ = true;
};

bool is_same(const Ice& a, const Ice& b) {
  return std::ranges::all_of(floe_ice_properties(),
                             [&](const FloeIceProperty& p) { return a.*p.value == b.*p.value; });
}

}  // namespace

const std::array<FloeIceProperty, kFloeIceProperties>& floe_ice_properties() {
  static const auto kProperties = [] {
    constexpr std::array<double Ice::*, kFloeIceProperties> kValues{
        &Ice::thickness,        &Ice::density,           &Ice::flexural_strength, &Ice::compressive_strength,
        &Ice::tensile_strength, &Ice::fracture_toughness};
    std::array<FloeIceProperty, kFloeIceProperties> properties;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const FloeProperty& in_file = floe_properties()[i];
      properties[i] = {in_file.key, in_file.unit, {.low = in_file.low, .high = in_file.high}, kValues[i]};
    }
    return properties;
  }();
  return kProperties;
}

GivenIce ice_of(const FloeProperties& properties) {
  GivenIce given;
  for (std::size_t i = 0; i < kFloeIceProperties; ++i) {
    if (const auto& value = properties.*floe_properties()[i].member)
      given.emplace_back(static_cast<std::uint8_t>(i), *value);
  }
  return given;
}

void append_ice(JsonWriter& json, const Ice& ice) {
  for (const FloeIceProperty& property : floe_ice_properties())
    json.key(property.key).value(ice.*property.value);
}

std::optional<GroupIce> GroupIce::of(const SceneDraft& draft, const std::string& path,
                                     ProblemCollector& problems) {
  GroupIce ice;
  ice.seed_ = draft.scene.seed + draft.group.ice.seed;
  bool is_good = true;
  for (std::size_t i = 0; i < kFloeIceProperties; ++i) {
    const auto& value = draft.group.ice.properties[i];
    if (!value) continue;
    const FloeIceProperty& property = floe_ice_properties()[i];
    LawReader reader(property, *value, fmt::format("{}.ice.{}", path, property.key), problems);
    if (auto law = reader.read(draft.scene.ice.*property.value))
      ice.laws_.push_back({i, *law, {}});
    else
      is_good = false;
  }
  if (!is_good) return std::nullopt;
  return ice;
}

std::int32_t GroupIce::add_to(simulation::Scene& scene, const GivenIce& given) {
  if (laws_.empty() && given.empty()) return simulation::kSceneIce;
  Ice ice = scene.ice;
  for (Law& law : laws_) {
    const bool is_given =
        std::ranges::any_of(given, [&](const auto& of_feature) { return of_feature.first == law.property; });
    if (is_given) continue;
    law.drawn.push_back(simulation::drawn_property(law.law, seed_, scene.floes.size(), law.property));
    ice.*floe_ice_properties()[law.property].value = law.drawn.back();
  }
  for (const auto& [property, value] : given) ice.*floe_ice_properties()[property].value = value;
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

JsonValue GroupIce::spelled_out(const simulation::Scene& scene, const GivenIce& given) const {
  const Ice& ice = ice_of(scene, scene.floes.back().own_ice);
  JsonValue value{JsonValue::Object{}};
  for (std::size_t i = 0; i < kFloeIceProperties; ++i) {
    const bool is_own = std::ranges::any_of(laws_, [&](const Law& law) { return law.property == i; }) ||
                        std::ranges::any_of(given, [&](const auto& of) { return of.first == i; });
    const FloeIceProperty& property = floe_ice_properties()[i];
    if (is_own) value.members().push_back({std::string(property.key), 0, {ice.*property.value}});
  }
  if (value.members().empty()) return {nullptr};
  value.members().push_back({"seed", 0, {0.0}});
  return value;
}

}  // namespace polynya::io
