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

// What a JSON object holds, described once for each struct that it becomes: reader, writer, JSON Schema,
// tables and `polynya init` follow from the description. Descriptions are made by describe.hpp; their records
// are SI, whatever the unit of the key: `_deg` is radians in the record, `_kN` newtons.

enum class FieldKind {
  kText,  ///< a string
  kName,  ///< a string of letters, digits, space, '.', '_', '-' that can name a file
  kInteger,
  kNumber,
  kBoolean,
  kChoice,          ///< one of a few words
  kNumberOrLaw,     ///< one number, or the fields of `object`, by which each floe's is drawn
  kVector,          ///< [x, y]
  kNumberOrVector,  ///< [x, y], or one number for both; written as [x, y]
  kNumbers,         ///< a list of numbers
  kLine,            ///< a list of two or more [x, y]
  kRing,            ///< a list of three or more [x, y]
  kRings,           ///< a list of rings
  kObject,          ///< the fields of `object`
  kList,            ///< a list of such objects
};

/// How many items a list has; a most of 0: as many as there are.
struct Length {
  int least = 0, most = 0;
};
/// Those of the lists of numbers that a kind is, from the outermost on; none of what is no list of numbers.
std::span<const Length> lengths_of(FieldKind kind);

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_low_excluded = false;
  bool is_high_excluded = false;
};

enum class Presence {
  kDefault,   ///< the record's own value where it is not given
  kRequired,  ///< or does not apply, see Field::alternative
  kLeftOut,   ///< may be left out, and is then not written either
  kChosen,    ///< by all of the scene where it is not given
};

struct Object;

/// One member of a record. Records are passed as void*; Description (below) keeps their types together.
struct Field {
  std::string_view key = {};
  FieldKind kind = FieldKind::kNumber;
  std::string_view unit = {};  ///< as shown to people; empty for none
  Range range = {};            ///< of the number, of each component, or of a list's length
  std::string_view meaning = {};
  std::string_view instead = {};  ///< what else may be given, where a required one is missing
  Presence presence = Presence::kDefault;
  std::vector<std::string_view> choices = {};
  std::string_view alternative = {};  ///< belongs to this one of its object's alternatives; empty: to all
  const Object* object = nullptr;     ///< of kObject, kList and kNumberOrLaw
  JsonValue default_value = {};       ///< of the record as it is constructed, of what is no object
  std::function<void(void*, const JsonValue&)> set = {};                ///< from a value that has been checked
  std::function<std::optional<JsonValue>(const void*)> get = {};        ///< nothing where it is not there
  std::function<void*(void*)> open = {};                                ///< the part; of a list, a new item
  std::function<const void*(const void*, std::size_t item)> find = {};  ///< the part or item, or null
  std::function<void(void*)> drop = {};                                 ///< the last item
};

/// The fields of one object. Where there are alternatives, whose fields follow each other, exactly one is chosen by
/// giving any of its fields.
struct Object {
  std::vector<Field> fields;
  std::vector<std::string_view> alternatives = {};
};

template <class Record>
struct FieldOf : Field {};

/// The fields of an object that becomes a Record.
template <class Record>
struct Description : Object {
  Description(const std::vector<FieldOf<Record>>& of) : Object{{of.begin(), of.end()}} {
    for (const Field& field : fields)
      if (!field.alternative.empty() && (alternatives.empty() || alternatives.back() != field.alternative))
        alternatives.push_back(field.alternative);
  }
};

/// "ships[2].hull.beam_m": a key below a path, which is empty of the scene itself.
std::string key_path(std::string_view path, std::string_view key);

/// "a number > 0, ≤ 20 [m]", "one of nevel, kashtelyan".
std::string describe_allowed(const Field& field);

/// Reads JSON objects into records. Every problem is reported with its place.
class RecordReader {
 public:
  explicit RecordReader(ProblemCollector& problems) : problems_(problems) {}

  /// False where a field without a default is missing or wrong; elsewhere the default stands for what is
  /// wrong. `number` takes the place of the # of a default name. Lists without a place in the record are
  /// checked but for their items.
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
  const Object* root_ = nullptr;  ///< of what is read first: where keys are looked for that are unknown in their place
};

/// The object that reads back to the same record, with every default. Lists without a place in the record are
/// empty.
JsonValue write_object(const Object& object, const void* record);
template <class Record>
JsonValue write(const Description<Record>& description, const Record& record) {
  return write_object(description, &record);
}

/// A number in the unit of its key and in SI: degrees and radians, kilo- and mega-units and units.
double to_si(std::string_view unit, double value);
/// The number of the fewest digits that to_si() makes this value of.
double from_si(std::string_view unit, double value);

}  // namespace polynya::io
