#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "io/scene/scene_draft.hpp"
#include "io/text/json_value.hpp"

namespace polynya::io {

/// The one table of everything a scene may hold. It drives the reader (scene_resolve.cpp), the JSON Schema,
/// the tables in docs/scene.md and the commented scene of `polynya init` (scene_schema.cpp).

enum class FieldKind {
  kText,  ///< a string
  kName,  ///< a string of letters, digits, space, '.', '_', '-' that can name a file
  kInteger,
  kNumber,
  kBoolean,
  kChoice,          ///< one of a few words
  kNumberOrLaw,     ///< one number, or the fields of law_object(), by which each floe's is drawn
  kVector,          ///< [x, y]
  kNumberOrVector,  ///< [x, y], or one number for both; resolved to [x, y]
  kNumbers,         ///< a list of numbers
  kLine,            ///< a list of two or more [x, y]
  kRing,            ///< a list of three or more [x, y]
  kRings,           ///< a list of rings
  kObject,          ///< the fields of `object`
  kList,            ///< a list of such objects
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_low_excluded = false;
  bool is_high_excluded = false;
};

struct Object;

inline constexpr std::string_view kLeftOut = "null";  ///< as a field's default

struct Field {
  std::string_view key;
  FieldKind kind = FieldKind::kNumber;
  std::string_view unit;          ///< as shown to people; empty for none
  Range range;                    ///< of the number, of each component, or of a list's length
  std::string_view default_json;  ///< empty: must be given (or does not apply, see alternative); "null": may
                                  ///< be left out, and is then not there
  std::string_view meaning;
  void (*set)(SceneDraft&, const JsonValue&) = nullptr;
  std::vector<std::string_view> choices = {};
  std::string_view alternative = {};  ///< belongs to this one of its object's alternatives; empty: to all
  const Object* object = nullptr;     ///< of kObject and kList
};

/// The fields of one object. Where there are alternatives, exactly one is chosen by giving any of its fields.
struct Object {
  std::vector<Field> fields;
  std::vector<std::string_view> alternatives = {};
  void (*begin)(SceneDraft&) = nullptr;  ///< called before the fields of each list item are set
};

/// The whole scene.
const Object& scene_object();

/// A law of scatter; the range of its numbers, but for the spread, is that of the field it is given for.
const Object& law_object();

/// "a number > 0, ≤ 20 [m]", "one of nevel, kashtelyan".
std::string describe_allowed(const Field& field);

}  // namespace polynya::io
