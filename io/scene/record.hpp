#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

// A description states the contents of a JSON object once, for the struct that it becomes. Reader, writer, JSON Schema,
// tables and `polynya init` follow from it. describe.hpp makes descriptions. Records are in SI units whatever the unit
// of the key: `_deg` becomes radians, `_kN` newtons.

enum class FieldKind {
  kText,  ///< a string
  kName,  ///< a string of letters, digits, space, '.', '_', '-', which can be a file name
  kInteger,
  kNumber,
  kBoolean,
  kChoice,          ///< one of a few words
  kNumberOrLaw,     ///< one number, or an object with a law from which a value is drawn for each floe
  kVector,          ///< [x, y]
  kNumberOrVector,  ///< [x, y], or one number for both; it is written as [x, y]
  kNumbers,         ///< a list of numbers
  kLine,            ///< a list of two or more [x, y]
  kRing,            ///< a list of three or more [x, y]
  kRings,           ///< a list of rings
  kObject,          ///< the fields of `object`
  kList,            ///< a list of objects with the fields of `object`
};

/// Allowed number of items of a list. most = 0: there is no upper limit.
struct Length {
  int least = 0, most = 0;
};
/// Returns the allowed lengths of the lists of a kind, from the outermost inwards; none for a kind that is not a list
/// of numbers.
std::span<const Length> lengths_of(FieldKind kind);

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_low_excluded = false;
  bool is_high_excluded = false;
};

enum class Presence {
  kDefault,   ///< the record's initial value applies if the field is not given
  kRequired,  ///< must be given, unless it belongs to another alternative (Field::alternative)
  kLeftOut,   ///< may be left out; it is then not written either
  kChosen,    ///< if it is not given, it is computed from the whole scene
};

struct Object;

/// A member of a record. The functions get records as void*; Description (below) ensures that the types match.
struct Field {
  std::string_view key = {};
  FieldKind kind = FieldKind::kNumber;
  std::string_view unit = {};  ///< unit for people; empty: none
  Range range = {};            ///< range of the number, of each component, or of the length of a list
  std::string_view meaning = {};
  std::string_view instead = {};  ///< end of the message if this required field is missing: what may be given instead
  Presence presence = Presence::kDefault;
  std::vector<std::string_view> choices = {};
  std::string_view alternative = {};  ///< alternative of the object to which the field belongs; empty: to all
  const Object* object = nullptr;     ///< fields of kObject, kList and kNumberOrLaw
  JsonValue default_value = {};       ///< value in a new record; null for objects
  std::function<void(void*, const JsonValue&)> set = {};  ///< stores a value, which has been checked, in the record
  /// Returns the value in the record; nothing if it is not there.
  std::function<std::optional<JsonValue>(const void*)> get = {};
  std::function<void*(void*)> open = {};  ///< returns the object's record, or for a list that of a new item
  /// Returns the record of the object or item, or null.
  std::function<const void*(const void*, std::size_t item)> find = {};
  std::function<void(void*)> drop = {};  ///< removes the last item of a list
};

/// Fields of a JSON object. If there are alternatives, whose fields must be adjacent, exactly one is chosen by giving
/// any of its fields.
struct Object {
  std::vector<Field> fields;
  std::vector<std::string_view> alternatives = {};
};

template <class Record>
struct FieldOf : Field {};

/// Fields of an object that is read into a Record.
template <class Record>
struct Description : Object {
  Description(const std::vector<FieldOf<Record>>& of) : Object{{of.begin(), of.end()}} {
    for (const Field& field : fields)
      if (!field.alternative.empty() && (alternatives.empty() || alternatives.back() != field.alternative))
        alternatives.push_back(field.alternative);
  }
};

/// Path of a key below a path: "ships[2].hull.beam_m". The path of the scene itself is empty.
std::string key_path(std::string_view path, std::string_view key);

/// Describes the allowed values: "a number > 0, ≤ 20 [m]", "one of nevel, kashtelyan".
std::string describe_allowed(const Field& field);

/// Reads JSON objects into records. It reports every problem with its place.
class RecordReader {
 public:
  explicit RecordReader(ProblemCollector& problems) : problems_(problems) {}

  /// Reads an object. Returns false if a field without a default is missing or wrong. Other wrong fields are reported
  /// and keep their defaults. `number` replaces the # in a default name such as "ship-#". For lists that the record
  /// does not store, only the list itself is checked, not its items.
  template <class Record>
  bool read(const Description<Record>& description, const JsonValue& value, const std::string& path, Record& record,
            std::size_t number = 1) {
    if (!root_) root_ = &description;
    return object(description, value, path, &record, number);
  }

 private:
  bool object(const Object& table, const JsonValue& value, const std::string& path, void* record, std::size_t number);
  bool one_field(const Field& field, const JsonValue& parent, const std::string& parent_path, void* record,
                 std::size_t number);
  bool checked(const Field& field, const JsonValue& value, const std::string& path, void* record);
  bool leaf(const Field& field, const JsonValue& value, const std::string& path, void* record);
  bool list(const Field& field, const JsonValue& value, const std::string& path, void* record);
  bool law(const Field& field, const JsonValue& value, const std::string& path, void* record);
  void report_unknown_keys(const Object& table, const JsonValue& value, const std::string& path);
  bool choose_alternative(const Object& table, const JsonValue& value, const std::string& path,
                          std::string_view& chosen);
  void report(std::uint32_t offset, const std::string& path, std::string found, std::string allowed,
              std::string suggestion = {}) {
    problems_.report(0, offset, path, std::move(found), std::move(allowed), std::move(suggestion));
  }

  ProblemCollector& problems_;
  /// The description read first; unknown keys are looked up in it to suggest their right place.
  const Object* root_ = nullptr;
};

/// Returns the object that is read back to the same record, with all defaults. Lists that the record does not store are
/// empty.
JsonValue write_object(const Object& object, const void* record);
template <class Record>
JsonValue write(const Description<Record>& description, const Record& record) {
  return write_object(description, &record);
}

/// Converts a number from the unit of its key to SI: degrees to radians, kilo- and mega-units to units.
double to_si(std::string_view unit, double value);
/// Returns the number with the fewest digits that to_si() converts to this value.
double from_si(std::string_view unit, double value);

}  // namespace polynya::io
