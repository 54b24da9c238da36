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

// A description states once which members a JSON object may have, and where each is stored in the struct (the record)
// that the object becomes. Reader, writer, JSON Schema, the tables of docs/scene.md and `polynya init` follow from it,
// so a new key of scenes needs only a new field. describe.hpp makes descriptions. Records are in SI units whatever the
// unit of the key: `_deg` becomes radians, `_kN` newtons.

/// Kind of the JSON value of a field. describe_allowed() has a text for each, in this order.
enum class FieldKind {
  kText,  ///< a string
  /// A string of 1 to 100 letters, digits, spaces, '.', '_', '-', which begins with a letter or digit and so can be the
  /// name of a file.
  kName,
  kInteger,
  kNumber,
  kBoolean,
  kChoice,          ///< one of a few words (Field::choices)
  kNumberOrLaw,     ///< one number, or an object with a law from which a value is drawn for each floe
  kVector,          ///< [x, y]
  kNumberOrVector,  ///< [x, y], or one number for both; it is written as [x, y]
  kNumbers,         ///< a list of numbers
  kLine,            ///< a list of two or more [x, y]
  kRing,            ///< a list of three or more [x, y]
  kRings,           ///< a list of rings
  kObject,          ///< an object with the fields of Field::object
  kList,            ///< a list of objects with the fields of Field::object
};

/// Allowed number of items of a list. most = 0: there is no upper limit.
struct Length {
  int least = 0, most = 0;
};
/// Returns the allowed lengths of the nested lists of a kind, from the outermost inwards: for kRings those of the list
/// of rings, of a ring and of a point. None for a kind that is not a list of numbers.
std::span<const Length> lengths_of(FieldKind kind);

/// Range of allowed numbers, in the unit of the key. The limits themselves are allowed unless they are excluded. Within
/// any range the reader rejects numbers nearer to 0 than 1e-100 that are not 0.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_low_excluded = false;
  bool is_high_excluded = false;
};

/// Whether a field must be given, and what applies if it is not.
enum class Presence {
  kDefault,   ///< the record's initial value applies if the field is not given, or if it is wrong
  kRequired,  ///< must be given, unless it belongs to another alternative (Field::alternative)
  kLeftOut,   ///< may be left out, and is then not written either; a wrong value makes the object unusable
  kChosen,    ///< may be left out, and is then computed by the reader of scenes; a wrong value is as for kLeftOut
};

struct Object;

/// A member of a JSON object. The functions get records as void*; Description (below) ensures that the types match.
struct Field {
  std::string_view key = {};  ///< key in the JSON object, with its unit: "thickness_m"
  FieldKind kind = FieldKind::kNumber;
  std::string_view unit = {};     ///< unit of the JSON value, which messages show and to_si() converts; empty: none
  Range range = {};               ///< range of the number, of each component, or of the number of items of a kList
  std::string_view meaning = {};  ///< explanation in the schema, in docs/scene.md and in the file of `polynya init`
  /// For a required object: end of the message if it is missing, which says what may be given instead.
  std::string_view instead = {};
  Presence presence = Presence::kDefault;
  std::vector<std::string_view> choices = {};  ///< allowed words of kChoice
  std::string_view alternative = {};           ///< alternative of the object to which the field belongs; empty: to all
  const Object* object = nullptr;              ///< fields of kObject, kList and kNumberOrLaw
  /// Value in a new record, in the unit of the key, for the schema, docs/scene.md and `polynya init`; null for objects.
  /// The reader uses it only for a kName whose default ends with #, and replaces # by a number.
  JsonValue default_value = {};
  /// Stores a value, which has been checked, in the record, and converts it from the unit of the key to SI.
  std::function<void(void*, const JsonValue&)> set = {};
  /// Returns the value in the record, in the unit of the key; nothing if the record does not hold it.
  std::function<std::optional<JsonValue>(const void*)> get = {};
  /// For reading: returns the record of the object, or adds an item to the list and returns its record. Empty for a
  /// list that the record does not store.
  std::function<void*(void*)> open = {};
  /// For writing: returns the record of the object, or of the item with this index; null if there is none.
  std::function<const void*(const void*, std::size_t item)> find = {};
  std::function<void(void*)> drop = {};  ///< removes the last item of a list, because it was wrong
};

/// Fields of a JSON object. They are written, and listed in tables, in their order. If there are alternatives, exactly
/// one must be chosen by giving any of its fields.
struct Object {
  std::vector<Field> fields;
  std::vector<std::string_view> alternatives = {};  ///< names of the alternatives (Field::alternative)
};

/// A field whose functions need a Record.
template <class Record>
struct FieldOf : Field {};

/// Fields of an object that is read into a Record.
template <class Record>
struct Description : Object {
  /// The alternatives are those that fields name. Fields of one alternative must be adjacent.
  Description(const std::vector<FieldOf<Record>>& of) : Object{{of.begin(), of.end()}} {
    for (const Field& field : fields)
      if (!field.alternative.empty() && (alternatives.empty() || alternatives.back() != field.alternative))
        alternatives.push_back(field.alternative);
  }
};

/// Path of a key below a path: "ships[2].hull.beam_m". The path of the scene itself is empty.
std::string key_path(std::string_view path, std::string_view key);

/// Describes the allowed values of a field for messages: "a number > 0, ≤ 20 [m]", "one of nevel, kashtelyan".
std::string describe_allowed(const Field& field);

/// Reads JSON objects into records. It reports every problem with its place, and goes on after it, so that a user sees
/// all problems at once. Unknown keys are problems too; the message suggests the key that may be meant.
class RecordReader {
 public:
  explicit RecordReader(ProblemCollector& problems) : problems_(problems) {}

  /// Reads an object, `value`, into `record`, which must have its initial values. `path` is that of the object, for
  /// messages. Returns false if `value` is no object, if no alternative or several are chosen, if a required field is
  /// missing, or if a field without a default is wrong; the record is then not to be used. Other wrong fields are
  /// reported and keep their defaults, and wrong items of lists are left out. `number` replaces the # in a default name
  /// such as "ship-#". For lists that the record does not store, only the list itself is checked, not its items.
  template <class Record>
  bool read(const Description<Record>& description, const JsonValue& value, const std::string& path, Record& record,
            std::size_t number = 1) {
    if (!root_) root_ = &description;
    return object(description, value, path, &record, number);
  }

 private:
  // Each of these reports problems, and returns true if the value can be used. `one_field` handles missing fields and
  // calls `checked` for given ones, which calls the function for the kind of the field. `leaf` reads a value that is
  // not an object.
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
  /// Reports a problem at an offset [bytes] in the scene, which is the first source (0) of the collector.
  void report(std::uint32_t offset, const std::string& path, std::string found, std::string allowed,
              std::string suggestion = {}) {
    problems_.report(0, offset, path, std::move(found), std::move(allowed), std::move(suggestion));
  }

  ProblemCollector& problems_;
  /// The description read first; unknown keys are looked up in it to suggest their right place.
  const Object* root_ = nullptr;
};

/// Returns the JSON object from which the same record is read, with the values of all fields, also those that have
/// their default. Left out are only values that the record does not hold. Lists that the record does not store are
/// empty. `record` must have the type that `object` describes; write() ensures it.
JsonValue write_object(const Object& object, const void* record);
template <class Record>
JsonValue write(const Description<Record>& description, const Record& record) {
  return write_object(description, &record);
}

/// Converts a number from the unit of its key to SI: every unit that begins with ° to radians (also "°/s"), "kN" to
/// newtons, "MW" to watts. Numbers of all other units stay as they are, so a key with another prefixed unit, or one in
/// °C, needs its conversion here.
double to_si(std::string_view unit, double value);
/// Converts back: returns the number with the fewest digits that to_si() converts to exactly this value, so that a
/// scene is written with the numbers of its author (15 [°], not 14.999999999999998). If there is none, returns one
/// beside it.
double from_si(std::string_view unit, double value);

}  // namespace polynya::io
