#include "io/scene/scene_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/scene/scene_field_parts.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

const Object kScene{
    {field("name", Kind::kName, "", {}, "\"scene\"",
           "names the run folder; if left out, the scene file's name",
           [](Draft& d, const Value& v) { d.scene.name = v.text(); }),
     field("description", Kind::kText, "", {}, "\"\"", "for people",
           [](Draft& d, const Value& v) { d.description = v.text(); }),
     field("seed", Kind::kInteger, "", from(0, 9007199254740991), "1",
           "of whatever is random: floe fields, ice that scatters, where ice comes up",
           [](Draft& d, const Value& v) { d.scene.seed = static_cast<std::uint64_t>(v.number()); }),
     field("origin", Kind::kObject, "", {}, kLeftOut,
           "where the scene lies on the Earth: floe files in degrees, or of a system that they name, are "
           "projected "
           "about it, and `polynya export --geojson` goes back",
           nullptr, {}, "", &origin_object()),
     section("time", time_object()), section("water", water_object()), section("wind", wind_object()),
     section("ice", ice_object()), section("contact", contact_object()),
     section("fracture", fracture_object()), section("record", record_object()),
     list("ships", 100, "the ships", ship_object()),
     list("structures", 100, "what stands in the ice and does not move", structure_object()),
     list("walls", 100, "straight boundaries that ice cannot pass, and that may press on it", wall_object()),
     list("floes", kLargestCount, "the ice, in groups", floes_object())}};

std::string describe_range(const Field& field) {
  std::string text;
  const auto number = [](double value) {
    std::string digits;
    append_number(digits, value);
    return digits;
  };
  if (field.range.low > -std::numeric_limits<double>::infinity())
    text += (field.range.is_low_excluded ? " > " : " ≥ ") + number(field.range.low);
  if (field.range.high < std::numeric_limits<double>::infinity())
    text += (text.empty() ? "" : ",") + std::string(field.range.is_high_excluded ? " < " : " ≤ ") +
            number(field.range.high);
  if (!field.unit.empty()) text += fmt::format(" [{}]", field.unit);
  return text;
}

}  // namespace

const Object& scene_object() {
  return kScene;
}

std::string describe_allowed(const Field& field) {
  switch (field.kind) {
    case Kind::kText:
      return "text";
    case Kind::kName:
      return "1 to 100 letters, digits, spaces and . _ -, starting with a letter or digit";
    case Kind::kInteger:
      return "an integer" + describe_range(field);
    case Kind::kNumber:
      return "a number" + describe_range(field);
    case Kind::kBoolean:
      return "true or false";
    case Kind::kChoice:
      return fmt::format("one of {}", fmt::join(field.choices, ", "));
    case Kind::kNumberOrLaw:
      return "a number" + describe_range(field) + ", or a law of such";
    case Kind::kVector:
      return "[x, y], each" + describe_range(field);
    case Kind::kNumberOrVector:
      return "a number or [x, y], each" + describe_range(field);
    case Kind::kNumbers:
      return "a list of numbers, each" + describe_range(field);
    case Kind::kLine:
      return "a list of two or more [x, y], each" + describe_range(field);
    case Kind::kRing:
      return "a list of three or more [x, y], each" + describe_range(field);
    case Kind::kRings:
      return "a list of rings, each three or more [x, y], each" + describe_range(field);
    case Kind::kObject:
      return "an object";
    case Kind::kList:
      return "a list of objects, its length" + describe_range(field);
  }
  return "";
}

}  // namespace polynya::io
