#pragma once

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <variant>

#include "geometry/shape/polygon.hpp"
#include "io/scene/record.hpp"

namespace polynya::io {

// Functions that make descriptions (record.hpp). A field has a key, a kind, a unit, a range, a meaning, and a path of
// pointers to members that leads from the record to the value. The path may pass through an optional or a variant. When
// the field is read, these are made to hold the class of the next member. When the field is written and they do not
// hold it, the field is left out. The kind follows from the type of the value. A field whose value is optional may be
// left out.

inline constexpr double kLargestCoordinate = 1e6;  ///< [m]
inline constexpr double kLargestCount = 1e6;
inline constexpr double kLargestSeed = 9007199254740991;  ///< 2^53 − 1

inline Range above(double low, double high) {
  return {low, high, true, false};
}
inline Range from(double low, double high) {
  return {low, high, false, false};
}
inline Range below(double low, double high) {
  return {low, high, false, true};
}
inline Range coordinate() {
  return from(-kLargestCoordinate, kLargestCoordinate);
}

namespace place {

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

/// Returns the T in its holder, which is the T itself, a class derived from it, an optional or a variant. If the holder
/// has no T, the result is null for a const holder, and otherwise a T is made.
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

/// Returns the T at the end of a path of pointers to members in the same way.
template <class T, class Whole>
Held<T, Whole>* at(Whole& whole) {
  return held<T>(whole);
}
template <class T, class Whole, class Class, class Member, class... Rest>
Held<T, Whole>* at(Whole& whole, Member Class::*first, Rest... rest) {
  auto* found = held<Class>(whole);
  return found ? at<T>(found->*first, rest...) : nullptr;
}

template <class Pointer>
struct Parts;
template <class C, class M>
struct Parts<M C::*> {
  using Class = C;
  using Member = M;
};
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

// Conversions between values of JSON and of records, by type.

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

/// Makes a field whose value is converted from JSON by `read` and to JSON by `write`.
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

/// Makes a field with a number, vector, text and so on. `Given` is the record, if that is a variant.
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

/// Makes a field with one of a few words, each of which has a value.
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

/// Makes a field with an object that has its own record. Without a path the object has some members of this record.
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

/// Makes a field with a list of objects.
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

/// Makes a field with a list whose items are not stored in the record; they are read one by one.
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

template <class Record>
FieldOf<Record> required(FieldOf<Record> field) {
  field.presence = Presence::kRequired;
  return field;
}
/// If the field is not given, the reader computes its value from the whole scene.
template <class Record>
FieldOf<Record> chosen(FieldOf<Record> field) {
  field.presence = Presence::kChosen;
  return field;
}
/// The field belongs to one of the alternatives of its object.
template <class Record>
FieldOf<Record> of(std::string_view alternative, FieldOf<Record> field) {
  field.alternative = alternative;
  return field;
}
/// The field has another kind than that of its type.
template <class Record>
FieldOf<Record> as(FieldKind kind, FieldOf<Record> field) {
  field.kind = kind;
  return field;
}
/// The field may be left out. Its default is a number that may not be given and that means "left out".
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
