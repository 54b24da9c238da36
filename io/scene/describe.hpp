#pragma once

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <variant>

#include "geometry/shape/polygon.hpp"
#include "io/scene/record.hpp"

namespace polynya::io {

// Functions that make descriptions (record.hpp), for example
//
//   const Description<RectangleInput> kRectangle{
//       {required(member("corner_m", "m", coordinate(), "corner", &RectangleInput::corner)),
//        member("angle_deg", "°", from(-360, 360), "rotation about the corner", &RectangleInput::angle)}};
//
// A field has a key, a kind, a unit, a range, a meaning, and a path of pointers to members that leads from the record
// to the value. The path may pass through an optional or a variant. When the field is read, these are made to hold the
// class of the next member. When the field is written and they do not hold it, the field is left out. The kind follows
// from the type of the value. The presence follows too: a field whose value is optional may be left out, and any other
// has the record's initial value as its default. The functions at the end of this file change presence and kind.

/// Largest coordinate in a scene [m]. Larger ones are refused, because they usually have another unit or coordinate
/// system. A larger limit also costs precision: at 1e6 m a double is exact to 1e-10 m.
inline constexpr double kLargestCoordinate = 1e6;
/// Largest number of rows or columns of a lattice, and of entries of "floes". It equals the largest number of floes of
/// a scene (kMostFloes), so that a scene may list each of its floes.
inline constexpr double kLargestCount = 1e6;
/// Largest seed, and largest id of a floe: 2^53 − 1. JSON numbers are read as doubles, which represent all whole
/// numbers only up to this one.
inline constexpr double kLargestSeed = 9007199254740991;

/// Numbers > low and ≤ high, in the unit of the key.
inline Range above(double low, double high) {
  return {low, high, true, false};
}
/// Numbers ≥ low and ≤ high.
inline Range from(double low, double high) {
  return {low, high, false, false};
}
/// Numbers ≥ low and < high.
inline Range below(double low, double high) {
  return {low, high, false, true};
}
/// Coordinates up to kLargestCoordinate in size, for a field in metres.
inline Range coordinate() {
  return from(-kLargestCoordinate, kLargestCoordinate);
}

// Functions that find the value of a field in its record.
namespace place {

/// Tells whether a type is an optional, and which type of value it holds.
template <class T>
struct Optional : std::false_type {
  using Value = T;
};
template <class T>
struct Optional<std::optional<T>> : std::true_type {
  using Value = T;
};

/// T, const if Holder is const.
template <class T, class Holder>
using Held = std::conditional_t<std::is_const_v<Holder>, const T, T>;

/// Returns a pointer to the T in its holder. The holder is the T itself, a class derived from T, an optional or a
/// variant. If an optional or a variant does not hold a T, the result is null for a const holder; otherwise the holder
/// is given a T with its initial value.
template <class T, class Holder>
Held<T, Holder>* held(Holder& holder) {
  if constexpr (std::is_convertible_v<Holder*, const T*>) {
    return &holder;
  } else if constexpr (Optional<std::remove_const_t<Holder>>::value) {
    if constexpr (!std::is_const_v<Holder>)
      if (!holder) holder.emplace();
    return holder ? held<T>(*holder) : nullptr;
  } else {
    if constexpr (!std::is_const_v<Holder>)
      if (!std::holds_alternative<T>(holder)) holder.template emplace<T>();
    return std::get_if<T>(&holder);
  }
}

/// Returns a pointer to the T at the end of a path of pointers to members, starting at `whole`. Each member on the path
/// is looked for in its holder as by held(); the result is null if one is missing in a const record.
template <class T, class Whole>
Held<T, Whole>* at(Whole& whole) {
  return held<T>(whole);
}
template <class T, class Whole, class Class, class Member, class... Rest>
Held<T, Whole>* at(Whole& whole, Member Class::*first, Rest... rest) {
  auto* found = held<Class>(whole);
  return found ? at<T>(found->*first, rest...) : nullptr;
}

/// Class and member type of a pointer to a member.
template <class Pointer>
struct Parts;
template <class C, class M>
struct Parts<M C::*> {
  using Class = C;
  using Member = M;
};
/// Parts of the last pointer of a path.
template <class... Path>
using Last = Parts<std::remove_reference_t<decltype((std::declval<Path>(), ...))>>;
/// The record in which a path begins: the given one, or else the class of the path's first pointer.
template <class Given, class... Path>
struct Begin {
  using Record = Given;
};
template <class First, class... Rest>
struct Begin<void, First, Rest...> {
  using Record = typename Parts<First>::Class;
};

}  // namespace place

// Conversions between values of JSON and of records, by type. They need values of the right kind; RecordReader checks
// them before.

/// Returns the kind of a field whose value has the type T. A type that is none of those listed is taken for a vector or
/// point; one that is neither does not compile in value_of() or json_of().
template <class T>
constexpr FieldKind kind_of() {
  if (std::is_same_v<T, bool>) return FieldKind::kBoolean;
  if (std::is_integral_v<T>) return FieldKind::kInteger;
  if (std::is_same_v<T, double>) return FieldKind::kNumber;
  if (std::is_same_v<T, std::string>) return FieldKind::kText;
  if (std::is_same_v<T, std::vector<double>>) return FieldKind::kNumbers;
  if (std::is_same_v<T, geometry::Ring>) return FieldKind::kRing;
  if (std::is_same_v<T, std::vector<geometry::Ring>>) return FieldKind::kRings;
  return FieldKind::kVector;
}

/// Returns the value of a JSON value in SI units. `unit` is that of the key, and is converted for doubles and
/// lists of doubles only; vectors and rings must be in SI units. The range of an integer field must exclude numbers
/// that its type cannot hold.
template <class T>
T value_of(std::string_view unit, const JsonValue& json) {
  if constexpr (std::is_same_v<T, bool>) {
    return json.boolean();
  } else if constexpr (std::is_same_v<T, double>) {
    return to_si(unit, json.number());
  } else if constexpr (std::is_arithmetic_v<T>) {
    return static_cast<T>(json.number());
  } else if constexpr (std::is_same_v<T, std::string>) {
    return json.text();
  } else if constexpr (kind_of<T>() == FieldKind::kVector) {
    return {json.items()[0].number(), json.items()[1].number()};
  } else {
    T list;
    for (const JsonValue& item : json.items()) list.push_back(value_of<typename T::value_type>(unit, item));
    return list;
  }
}

/// Returns the JSON value of a value in SI units, in the unit of the key.
template <class T>
JsonValue json_of(std::string_view unit, const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    return {from_si(unit, value)};
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
    return {value};
  } else if constexpr (std::is_arithmetic_v<T>) {
    return {static_cast<double>(value)};
  } else if constexpr (kind_of<T>() == FieldKind::kVector) {
    return {JsonValue::Array{{value.x}, {value.y}}};
  } else {
    JsonValue list{JsonValue::Array{}};
    list.items().reserve(value.size());
    for (const auto& item : value) list.items().push_back(json_of(unit, item));
    return list;
  }
}

namespace place {

/// Completes a field by the functions that store its value in a record and return it. T is the type of the value at the
/// end of `path`; `read` converts it from JSON and `write` to JSON. A field with a default takes it from a new Record,
/// in which a variant on the path is first made to hold the class of the path.
template <class Record, class T, class Read, class Write, class... Path>
FieldOf<Record> leaf(Field field, Read read, Write write, Path... path) {
  field.set = [read, path...](void* record, const JsonValue& json) {
    *at<T>(*static_cast<Record*>(record), path...) = read(json);
  };
  field.get = [write, path...](const void* record) -> std::optional<JsonValue> {
    const T* found = at<T>(*static_cast<const Record*>(record), path...);
    return found ? std::optional(write(*found)) : std::nullopt;
  };
  Record constructed{};
  if (field.presence == Presence::kDefault) field.default_value = write(*at<T>(constructed, path...));
  return {std::move(field)};
}

}  // namespace place

/// Makes a field with a number, a vector, a text, a list of numbers or rings. `unit` is the unit of its JSON value
/// ("°", "kN"), from which to_si() converts; empty: none. `range` is in that unit. `meaning` is the text of
/// docs/scene.md and of the schema. Give the template argument `Given` if the record is a variant: it is then the
/// variant, and the path begins at one of its alternatives.
template <class Given = void, class... Path>
auto member(std::string_view key, std::string_view unit, Range range, std::string_view meaning, Path... path) {
  using Place = place::Optional<typename place::Last<Path...>::Member>;
  using T = typename Place::Value;
  Field field{.key = key, .kind = kind_of<T>(), .unit = unit, .range = range, .meaning = meaning};
  if (Place::value) field.presence = Presence::kLeftOut;
  return place::leaf<typename place::Begin<Given, Path...>::Record, T>(
      std::move(field), [unit](const JsonValue& json) { return value_of<T>(unit, json); },
      [unit](const T& value) { return json_of(unit, value); }, path...);
}

/// Makes a field with one of a few words. `words` pairs each word of the JSON with the value that it stores. Every
/// value that the record may have must be among them.
template <class T, class... Path>
auto choice(std::string_view key, std::string_view meaning, std::initializer_list<std::pair<std::string_view, T>> words,
            Path... path) {
  Field field{.key = key, .kind = FieldKind::kChoice, .meaning = meaning};
  for (const auto& [word, value] : words) field.choices.push_back(word);
  const std::vector<std::pair<std::string_view, T>> all(words);
  return place::leaf<typename place::Begin<void, Path...>::Record, T>(
      std::move(field),
      [all](const JsonValue& json) {
        return std::ranges::find_if(all, [&](const auto& one) { return one.first == json.text(); })->second;
      },
      [all](const T& value) -> JsonValue {
        return {std::string(std::ranges::find_if(all, [&](const auto& one) { return one.second == value; })->first)};
      },
      path...);
}

/// Makes a field with an object, whose fields `description` describes. The path leads to its own record, of type Part.
/// Without a path, the fields of the object are members of the present record, which is then a Part. An object in an
/// optional may be left out. `Given` is that of member().
template <class Given = void, class Part, class... Path>
auto object(std::string_view key, const Description<Part>& description, std::string_view meaning, Path... path) {
  using Start = std::conditional_t<std::is_void_v<Given> && sizeof...(Path) == 0, Part, Given>;
  using Record = typename place::Begin<Start, Path...>::Record;
  FieldOf<Record> field{{.key = key, .kind = FieldKind::kObject, .meaning = meaning, .object = &description}};
  if constexpr (sizeof...(Path) > 0) {
    if (place::Optional<typename place::Last<Path...>::Member>::value) field.presence = Presence::kLeftOut;
  }
  field.open = [path...](void* record) -> void* { return place::at<Part>(*static_cast<Record*>(record), path...); };
  field.find = [path...](const void* record, std::size_t) -> const void* {
    return place::at<Part>(*static_cast<const Record*>(record), path...);
  };
  return field;
}

/// Makes a field with a list of objects, which are stored in a std::vector<Item> at the end of the path. `length` is
/// the allowed number of items. If the list is not given it is empty. An empty list is written as [], also if the path
/// passes through an optional that holds nothing; only an item, when it is read, makes the optional hold its list.
template <class Item, class... Path>
auto list(std::string_view key, Range length, std::string_view meaning, const Description<Item>& items, Path... path) {
  using Record = typename place::Begin<void, Path...>::Record;
  FieldOf<Record> field{{.key = key,
                         .kind = FieldKind::kList,
                         .range = length,
                         .meaning = meaning,
                         .object = &items,
                         .default_value = {JsonValue::Array{}}}};
  field.open = [path...](void* record) -> void* {
    return &place::at<std::vector<Item>>(*static_cast<Record*>(record), path...)->emplace_back();
  };
  field.find = [path...](const void* record, std::size_t item) -> const void* {
    const auto* found = place::at<std::vector<Item>>(*static_cast<const Record*>(record), path...);
    return found && item < found->size() ? &(*found)[item] : nullptr;
  };
  field.drop = [path...](void* record) {
    place::at<std::vector<Item>>(*static_cast<Record*>(record), path...)->pop_back();
  };
  return field;
}

/// Makes a field with a list of at most `longest` objects that the record does not store. RecordReader checks only that
/// it is a list of allowed length; the caller reads the items one by one, because a scene may have a million floes.
template <class Record, class Item>
FieldOf<Record> list_of(std::string_view key, double longest, std::string_view meaning,
                        const Description<Item>& items) {
  return {{.key = key,
           .kind = FieldKind::kList,
           .range = from(0, longest),
           .meaning = meaning,
           .object = &items,
           .default_value = {JsonValue::Array{}}}};
}

// Functions that change a property of a field.

/// The field must be given.
template <class Record>
FieldOf<Record> required(FieldOf<Record> field) {
  field.presence = Presence::kRequired;
  return field;
}
/// If the field is not given, the reader of scenes computes its value from the whole scene, as for the time step. The
/// value that the record has then is written.
template <class Record>
FieldOf<Record> chosen(FieldOf<Record> field) {
  field.presence = Presence::kChosen;
  return field;
}
/// The field belongs to one of the alternatives of its object (Object::alternatives), and may be given only with fields
/// of the same alternative. An alternative exists if a field names it.
template <class Record>
FieldOf<Record> of(std::string_view alternative, FieldOf<Record> field) {
  field.alternative = alternative;
  return field;
}
/// The field has another kind than the one that follows from its type, for example kName for a text.
template <class Record>
FieldOf<Record> as(FieldKind kind, FieldOf<Record> field) {
  field.kind = kind;
  return field;
}
/// The field may be left out. The record's initial value means "left out": the field is not written while the record
/// has it, and tables show "left out" as its default. For a number only; its range should exclude that value, such as 0
/// with above(0, 1000), because a user who gives it would not get it back.
template <class Record>
FieldOf<Record> left_out(FieldOf<Record> field) {
  field.presence = Presence::kLeftOut;
  field.get = [get = field.get, otherwise = field.default_value.number()](const void* record) {
    auto value = get(record);
    return value && value->number() == otherwise ? std::nullopt : value;
  };
  return field;
}

}  // namespace polynya::io
