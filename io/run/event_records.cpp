#include "io/run/event_records.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/run/record_reader.hpp"
#include "io/run/records.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

using simulation::Event;
using simulation::FloeId;
using simulation::Scene;

/// Writes a line; of the player's only what has a label.
class Writer {
 public:
  Writer(JsonWriter& json, const Scene& scene, FloeId parent, bool is_shown)
      : json_(json), scene_(scene), parent_(parent), is_for_player_(is_shown) {}

  template <class T>
  void operator()(std::string_view key, const T& value, const FieldMeaning& about) {
    if (is_for_player_ && (about.label.empty() || is_no_area(value, about))) return;
    json_.key(key);
    if constexpr (std::is_same_v<T, std::vector<FloeId>>)
      json_.list(value);
    else
      json_.value(value);
  }
  void optional(bool is_there, std::string_view key, const auto& value, const FieldMeaning& about) {
    if (is_there) (*this)(key, value, about);
  }
  void derived(std::string_view key, const auto& value, const FieldMeaning& about) {
    (*this)(key, value, about);
  }
  void object(std::string_view key, const FieldMeaning&, auto list) {
    json_.key(key).open('{');
    list();
    json_.close('}');
  }
  void ship(std::string_view key, int index, const FieldMeaning& about) {
    (*this)(key, ship_name(scene_, index), about);
  }
  void ship_or_none(std::string_view key, int index, const FieldMeaning& about) { ship(key, index, about); }
  void parent(const FieldMeaning& about) { (*this)("parent", id_or_none(parent_), about); }
  void rule(std::string_view words) { json_.key("kind").value(words); }
  void rule(const simulation::DecidingLoad& by) {
    rule(fmt::format("{} {} {}", by.name, by.comparison, by.capacity_name));
  }

 private:
  static bool is_no_area(const auto& value, const FieldMeaning& about) {
    if constexpr (std::is_same_v<decltype(value), const double&>) return value == 0 && about.unit == "m²";
    return false;
  }

  JsonWriter& json_;
  const Scene& scene_;
  FloeId parent_;
  bool is_for_player_;
};

/// The rule, and "label number unit" of each number that has a label.
class Words {
 public:
  explicit Words(const Scene& scene) : scene_(scene) {}
  std::string text;

  void operator()(std::string_view, const auto&, const FieldMeaning&) {}
  void operator()(std::string_view, const double& value, const FieldMeaning& about) {
    if (value != 0) add(about, fmt::format("{:.4g}", value));
  }
  void operator()(std::string_view, geometry::Vector value, const FieldMeaning& about) {
    add(about, fmt::format("({:.3g}, {:.3g})", value.x, value.y));
  }
  void operator()(std::string_view, const std::string& value, const FieldMeaning& about) {
    add(about, value);
  }
  void optional(bool is_there, std::string_view key, const auto& value, const FieldMeaning& about) {
    if (is_there) (*this)(key, value, about);
  }
  void derived(std::string_view, const auto&, const FieldMeaning&) {}
  void object(std::string_view, const FieldMeaning&, auto list) { list(); }
  void ship(std::string_view key, int index, const FieldMeaning& about) {
    if (key != "ship") add(about, ship_name(scene_, index));
  }
  void ship_or_none(std::string_view, int, const FieldMeaning&) {}
  void parent(const FieldMeaning&) {}
  void rule(std::string_view words) { text += words; }
  void rule(const simulation::DecidingLoad& by) {
    rule(fmt::format("{} {:.4g} N {} {} {:.4g} N", by.name, by.load, by.comparison, by.capacity_name,
                     by.capacity));
  }

 private:
  void add(const FieldMeaning& about, std::string_view value) {
    if (about.label.empty()) return;
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", about.label, value);
    if (!about.unit.empty()) text.append(1, ' ').append(about.unit);
  }

  const Scene& scene_;
};

/// Reads a line into an event of its kind.
class Reader {
 public:
  Reader(const JsonValue& line, const Scene& scene) : at_(&line), scene_(scene) {}

  template <class T>
  void operator()(std::string_view key, T& value, const FieldMeaning& about) {
    const JsonValue* found = at_->find(key);
    if (!found) throw ReadError(fmt::format("\"{}\" is missing", key));
    read(key, *found, value);
    if constexpr (std::is_same_v<T, double>)
      if (!(value >= about.least)) throw ReadError(fmt::format("\"{}\" is not ≥ {}", key, about.least));
  }
  void optional(bool, std::string_view key, auto& value, const FieldMeaning& about) {
    if (has(key)) (*this)(key, value, about);
  }
  void derived(std::string_view, const auto&, const FieldMeaning&) {}
  void object(std::string_view key, const FieldMeaning&, auto list) {
    const JsonValue* outer = std::exchange(at_, &json_member(*at_, key, JsonValue::Kind::kObject));
    list();
    at_ = outer;
  }
  void ship_or_none(std::string_view key, int& index, const FieldMeaning&) {
    const std::string& name = json_member(*at_, key, JsonValue::Kind::kText).text();
    index = ship_index(scene_, name);
    if (index < 0 && !name.empty())
      throw ReadError(fmt::format("\"{}\" is \"{}\", which is not in the scene", key, shortened(name, 60)));
  }
  void ship(std::string_view key, int& index, const FieldMeaning& about) {
    ship_or_none(key, index, about);
    if (index < 0) throw ReadError(fmt::format("\"{}\" is empty", key));
  }
  void parent(const FieldMeaning&) {}
  void rule(auto...) {}
  bool has(std::string_view key) const { return at_->find(key) != nullptr; }

 private:
  using Kind = JsonValue::Kind;
  static const JsonValue& expect(std::string_view key, const JsonValue& json, Kind kind) {
    if (!json.is(kind)) throw ReadError(fmt::format("\"{}\" is not {}", key, name_of(kind)));
    return json;
  }
  static void read(std::string_view key, const JsonValue& json, double& value) {
    value = expect(key, json, Kind::kNumber).number();
  }
  static void read(std::string_view key, const JsonValue& json, bool& value) {
    value = expect(key, json, Kind::kBoolean).boolean();
  }
  static void read(std::string_view key, const JsonValue& json, std::string& value) {
    value = expect(key, json, Kind::kText).text();
  }
  static void read(std::string_view, const JsonValue& json, FloeId& value) { value = floe_id(json); }
  static void read(std::string_view key, const JsonValue& json, std::vector<FloeId>& value) {
    for (const JsonValue& item : expect(key, json, Kind::kArray).items()) value.push_back(floe_id(item));
  }
  static void read(std::string_view key, const JsonValue& json, geometry::Point& value) {
    value = point(expect(key, json, Kind::kArray));
  }
  static void read(std::string_view key, const JsonValue& json, geometry::Vector& value) {
    value = point(expect(key, json, Kind::kArray)) - geometry::Point{};
  }

  const JsonValue* at_;
  const Scene& scene_;
};

/// Enters the fields of a kind into a list.
class Lister {
 public:
  Lister(std::vector<EventField>& fields, std::string_view kind) : fields_(fields), kind_(kind) {}

  void operator()(std::string_view key, const auto&, const FieldMeaning& about) { enter(key, about); }
  void optional(bool, std::string_view key, const auto&, const FieldMeaning& about) { enter(key, about); }
  void derived(std::string_view key, const auto&, const FieldMeaning& about) { enter(key, about); }
  void object(std::string_view key, const FieldMeaning& about, auto list) {
    enter(key, about);
    is_of_criterion_ = true;
    list();
    is_of_criterion_ = false;
  }
  void ship(std::string_view key, int, const FieldMeaning& about) { enter(key, about); }
  void ship_or_none(std::string_view key, int, const FieldMeaning& about) { enter(key, about); }
  void parent(const FieldMeaning& about) { enter("parent", about); }
  void rule(auto...) { enter("kind", {"", "the rule, in words", "by"}); }

 private:
  void enter(std::string_view key, const FieldMeaning& about) {
    const auto is_same = [&](const EventField& field) {
      return field.key == key && field.meaning.meaning == about.meaning;
    };
    auto found = std::ranges::find_if(fields_, is_same);
    if (found == fields_.end()) found = fields_.insert(found, EventField{key, about, is_of_criterion_, {}});
    if (found->meaning.label.empty()) found->meaning.label = about.label;
    found->kinds.push_back(kind_);
  }

  std::vector<EventField>& fields_;
  std::string_view kind_;
  bool is_of_criterion_ = false;
};

/// Uses an event of each kind.
template <std::size_t Index = 0>
void for_kinds(auto use) {
  if constexpr (Index < std::variant_size_v<decltype(Event::what)>) {
    Event event;
    event.what.emplace<Index>();
    use(event);
    for_kinds<Index + 1>(use);
  }
}

}  // namespace

void append_event(std::string& text, const Event& event, const Scene& scene, FloeId parent) {
  JsonWriter json(text);
  json.open('{');
  Writer line(json, scene, parent, false);
  fields(line, event);
  json.close('}');
  text += '\n';
}

void write_shown_event(JsonWriter& json, const Event& event, const Scene& scene) {
  json.open('{');
  Writer line(json, scene, simulation::kNoFloe, true);
  fields(line, event);
  json.close('}');
}

std::string words_of(const Event& event, const Scene& scene) {
  Words words(scene);
  std::visit([&](const auto& kind) { kind_fields(words, event, kind); }, event.what);
  return std::move(words.text);
}

Event event_of(const JsonValue& line, const Scene& scene) {
  const std::string& kind = json_member(line, "kind", JsonValue::Kind::kText).text();
  std::optional<Event> read;
  for_kinds([&](Event& event) {
    if (name_of(event) != kind) return;
    Reader reader(line, scene);
    fields(reader, event);
    read = std::move(event);
  });
  if (!read) throw ReadError(fmt::format("an unknown kind of event, \"{}\"", shortened(kind, 60)));
  return *std::move(read);
}

std::vector<EventField> event_fields() {
  std::vector<EventField> all;
  for_kinds([&](Event& event) {
    Lister line(all, name_of(event));
    fields(line, std::as_const(event));
  });
  return all;
}

}  // namespace polynya::io
