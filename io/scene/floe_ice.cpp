#include "io/scene/floe_ice.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/scene/record.hpp"
#include "simulation/ice/ice_scatter.hpp"

namespace polynya::io {
namespace {

using fracture::Ice;
using fracture::ScatterKind;
using fracture::ScatterLaw;

constexpr double kDeviations = 3;     ///< off the mean where a normal law without bounds is cut off
constexpr double kLeastShare = 0.01;  ///< of a law between its bounds: less is taken for a slip

/// As the scene has it.
std::string word_of(const LawInput& law) {
  return write(law_description(), law).find("law")->text();
}

/// Completes the law of one property of one entry; `value` is its JSON.
class LawReader {
 public:
  LawReader(const FloeIceProperty& property, const JsonValue& value, std::string path, ProblemCollector& problems)
      : property_(property), value_(value), path_(std::move(path)), problems_(problems) {}

  std::optional<ScatterLaw> read(const NumberOrLaw& given, double scene_value) {
    if (const double* number = std::get_if<double>(&given))
      return ScatterLaw{.kind = ScatterKind::kConstant, .mean = *number};
    input_ = std::get<LawInput>(given);
    const std::string word = word_of(input_);
    const bool is_uniform = input_.kind == ScatterKind::kUniform;
    const bool is_constant = input_.kind == ScatterKind::kConstant;
    check("mean", input_.mean, word, false, is_uniform);
    check("spread", input_.spread, word, !is_uniform && !is_constant, is_uniform || is_constant);
    check("least", input_.least, word, is_uniform, is_constant);
    check("most", input_.most, word, is_uniform, is_constant);
    if (!is_good_) return std::nullopt;
    ScatterLaw law{.kind = input_.kind, .mean = input_.mean.value_or(scene_value), .spread = input_.spread.value_or(0)};
    set_bounds(law);
    check_bounds(law);
    return is_good_ ? std::optional(law) : std::nullopt;
  }

 private:
  void report(std::string_view key, std::string found, std::string allowed) {
    problems_.report(0, nearest_offset(value_, key), key.empty() ? path_ : fmt::format("{}.{}", path_, key),
                     std::move(found), std::move(allowed));
    is_good_ = false;
  }

  void check(std::string_view key, std::optional<double> given, const std::string& word, bool is_needed,
             bool is_refused) {
    if (!given && is_needed) report(key, "nothing", fmt::format("a number: law {} needs it", word));
    if (given && is_refused) report(key, show({*given}), fmt::format("nothing: law {} has none", word));
  }

  void set_bounds(ScatterLaw& law) const {
    law.least = property_.range.low;
    law.most = property_.range.high;
    if (law.kind == ScatterKind::kNormal) {
      law.least = std::max(law.least, law.mean * (1 - kDeviations * law.spread));
      law.most = std::min(law.most, law.mean * (1 + kDeviations * law.spread));
    }
    law.least = input_.least.value_or(law.least);
    law.most = input_.most.value_or(law.most);
  }

  void check_bounds(const ScatterLaw& law) {
    if (law.least > law.most) {
      report("least", fmt::format("{:g}", law.least),
             fmt::format("at most `most`, {:g} [{}]", law.most, property_.unit));
    } else if (const double share = share_within_bounds(law); share < kLeastShare) {
      report("", fmt::format("a law of which {:.2g} lies between {:g} and {:g}", share, law.least, law.most),
             fmt::format("bounds around the mean, {:g} [{}], that hold {:g} of it or more", law.mean, property_.unit,
                         kLeastShare));
    }
  }

  const FloeIceProperty& property_;
  const JsonValue& value_;
  std::string path_;
  ProblemCollector& problems_;
  LawInput input_;
  bool is_good_ = true;
};

bool is_same(const Ice& a, const Ice& b) {
  return std::ranges::all_of(floe_ice_properties(), [&](const FloeIceProperty& p) { return a.*p.value == b.*p.value; });
}

}  // namespace

const std::array<FloeIceProperty, kFloeIceProperties>& floe_ice_properties() {
  static const auto kProperties = [] {
    constexpr std::array<double Ice::*, kFloeIceProperties> kValues{&Ice::thickness,         &Ice::density,
                                                                    &Ice::flexural_strength, &Ice::compressive_strength,
                                                                    &Ice::tensile_strength,  &Ice::fracture_toughness};
    constexpr std::array<std::optional<NumberOrLaw> IceInput::*, kFloeIceProperties> kInputs{
        &IceInput::thickness,         &IceInput::density,
        &IceInput::flexural_strength, &IceInput::compressive_strength,
        &IceInput::tensile_strength,  &IceInput::fracture_toughness};
    std::array<FloeIceProperty, kFloeIceProperties> properties;
    for (std::size_t i = 0; i < properties.size(); ++i) {
      const FloeProperty& in_file = floe_properties()[i];
      properties[i] = {in_file.key, in_file.unit, {.low = in_file.low, .high = in_file.high}, kValues[i], kInputs[i]};
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
  for (const FloeIceProperty& property : floe_ice_properties()) json.key(property.key).value(ice.*property.value);
}

std::optional<GroupIce> GroupIce::of(const simulation::Scene& scene, const FloeGroup& group, const JsonValue& item,
                                     const std::string& path, ProblemCollector& problems) {
  GroupIce ice;
  if (!group.ice) return ice;
  ice.seed_ = scene.seed + group.ice->seed;
  bool is_good = true;
  for (std::size_t i = 0; i < kFloeIceProperties; ++i) {
    const FloeIceProperty& property = floe_ice_properties()[i];
    const std::optional<NumberOrLaw>& given = (*group.ice).*property.input;
    if (!given) continue;
    LawReader reader(property, *item.find("ice")->find(property.key), fmt::format("{}.ice.{}", path, property.key),
                     problems);
    if (auto law = reader.read(*given, scene.ice.*property.value))
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

std::optional<IceInput> GroupIce::spelled_out(const simulation::Scene& scene, const GivenIce& given) const {
  if (laws_.empty() && given.empty()) return std::nullopt;
  const Ice& ice = ice_of(scene, scene.floes.back().own_ice);
  IceInput own;
  const auto set = [&](std::size_t property) {
    const FloeIceProperty& of = floe_ice_properties()[property];
    own.*of.input = ice.*of.value;
  };
  for (const Law& law : laws_) set(law.property);
  for (const auto& [property, value] : given) set(property);
  return own;
}

}  // namespace polynya::io
