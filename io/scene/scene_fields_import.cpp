#include <algorithm>

#include "io/scene/scene_field_parts.hpp"

namespace polynya::io {
namespace {

using Draft = SceneDraft;
using Value = JsonValue;
using Kind = FieldKind;

/// Words between commas.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::size_t first = text.find_first_not_of(' ', start);
    if (first < end) words.push_back(text.substr(first, text.find_last_not_of(' ', end - 1) - first + 1));
    start = end + 1;
  }
  return words;
}

const Object kImport{
    {field("from", Kind::kText, "", {}, "\"\"",
           "the file's coordinate system, where the file names none: EPSG:4326",
           [](Draft& d, const Value& v) {
             d.group.file_settings.is_import = true;
             d.group.file_settings.import.plane.source = v.text();
           }),
     field("crs", Kind::kText, "", {}, "\"\"",
           "the projected system whose plane is the scene's: EPSG:3413; of scenes without an origin",
           [](Draft& d, const Value& v) { d.group.file_settings.import.plane.target = v.text(); }),
     field("shift", Kind::kBoolean, "", {}, "false",
           "moves the middle of the floes' box to (0, 0), by whole metres",
           [](Draft& d, const Value& v) { d.group.file_settings.import.plane.is_shifted = v.boolean(); }),
     field("repair", Kind::kChoice, "", {}, "\"refuse\"",
           "what becomes of outlines that are not valid: refused, or made of what a rule fills",
           [](Draft& d, const Value& v) {
             if (v.text() == "even-odd") d.group.file_settings.import.repair = geometry::FillRule::kEvenOdd;
             if (v.text() == "non-zero") d.group.file_settings.import.repair = geometry::FillRule::kNonZero;
           },
           {"refuse", "even-odd", "non-zero"}),
     field("simplify_m", Kind::kNumber, "m", from(0, 1e4), "0",
           "leaves out vertices, each at most so far from the outline that is left",
           [](Draft& d, const Value& v) { d.group.file_settings.import.simplify = v.number(); }),
     field("min_area_m2", Kind::kNumber, "m²", from(0, 1e12), "0", "drops smaller floes",
           [](Draft& d, const Value& v) { d.group.file_settings.import.least_area = v.number(); }),
     field("gap_m", Kind::kNumber, "m", from(0, 1000), "0",
           "least distance between floes: the smaller of two is trimmed to it",
           [](Draft& d, const Value& v) { d.group.file_settings.import.gap = v.number(); }),
     field("layer", Kind::kText, "", {}, "\"\"", "of a file with several",
           [](Draft& d, const Value& v) { d.group.file_settings.layer = v.text(); }),
     field("properties", Kind::kText, "", {}, "\"\"",
           "the file's names for properties, with factors for units: thickness_m=CM*0.01, floe_id=FID",
           [](Draft& d, const Value& v) { d.group.file_settings.property_names = words_of(v.text()); })}};

}  // namespace

const Object& import_object() {
  return kImport;
}

}  // namespace polynya::io
