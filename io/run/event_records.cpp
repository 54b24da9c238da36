#include "io/run/event_records.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/output_file.hpp"
#include "io/text/problem.hpp"
#include "io/text/shape_parts.hpp"

namespace polynya::io {

namespace {

using simulation::DecidingLoad;
using simulation::Event;
using simulation::FloeId;
using simulation::Scene;

/// Writes the fields of an event; for the player only fields with a label.
struct Writer {
  JsonWriter& json;
  const Scene& scene;
  FloeId parent_of_floe;
  bool is_for_player = false;

  template <class T>
  void operator()(std::string_view key, const T& value, const FieldMeaning& about) {
    if (!about.is_there.value_or(true) || (is_for_player && !is_shown(value, about))) return;
    json.key(key);
    if constexpr (std::is_same_v<T, std::vector<FloeId>>)
      json.list(value);
    else if constexpr (std::is_same_v<T, ShipName<const int>>)
      json.value(hull_name(scene, value.index));
    else if constexpr (std::is_same_v<T, Parent>)
      json.value(id_or_none(parent_of_floe));
    else if constexpr (std::is_same_v<T, DecidingLoad>)
      json.value(fmt::format("{} {} {}", value.name, value.comparison, value.capacity_name));
    else
      json.value(value);
  }
  void object(const FieldMeaning&, auto list) {
    json.key("criterion").open('{');
    list();
    json.close('}');
  }

 private:
  template <class T>
  static bool is_shown(const T& value, const FieldMeaning& about) {
    if constexpr (std::is_same_v<T, double>)
      if (value == 0 && about.unit == "m²") return false;
    return !about.label.empty();
  }
};

/// Collects the rule and, of other fields with a label, "label value unit".
struct Words {
  const Scene& scene;
  std::string text = {};

  void operator()(std::string_view, const auto&, const FieldMeaning&) {}
  void operator()(std::string_view, std::string_view rule, const FieldMeaning&) { text += rule; }
  void operator()(std::string_view, const DecidingLoad& by, const FieldMeaning&) {
    text += fmt::format("{} {:.4g} N {} {} {:.4g} N", by.name, by.load, by.comparison, by.capacity_name, by.capacity);
  }
  void operator()(std::string_view, const double& value, const FieldMeaning& about) {
    if (value != 0 && !about.is_derived) add(about, fmt::format("{:.4g}", value));
  }
  void operator()(std::string_view, const geometry::Vector& value, const FieldMeaning& about) {
    add(about, fmt::format("({:.3g}, {:.3g})", value.x, value.y));
  }
  void operator()(std::string_view, const std::string& value, const FieldMeaning& about) { add(about, value); }
  void operator()(std::string_view key, const ShipName<const int>& ship, const FieldMeaning& about) {
    if (key != "ship") add(about, hull_name(scene, ship.index));
  }
  void object(const FieldMeaning&, auto list) { list(); }

 private:
  void add(const FieldMeaning& about, std::string_view value) {
    if (about.label.empty()) return;
    text += fmt::format("{}{} {}{}{}", text.empty() ? "" : "; ", about.label, value, about.unit.empty() ? "" : " ",
                        about.unit);
  }
};

/// Reads the fields of a line into an event of its kind.
class Reader {
 public:
  Reader(const JsonValue& line, const Scene& scene) : at_(&line), scene_(scene) {}

  template <class T>
  void operator()(std::string_view key, T&& value, const FieldMeaning& about) {
    if (about.is_derived || (about.is_there && !has(key))) return;
    if (!has(key)) throw ReadError(fmt::format("\"{}\" is missing", key));
    if constexpr (requires { read(key, value); }) read(key, value);
    if constexpr (std::is_same_v<T, double&>)
      if (!(value >= about.least)) throw ReadError(fmt::format("\"{}\" is not ≥ {}", key, about.least));
  }
  void object(const FieldMeaning&, auto list) {
    const JsonValue* outer = std::exchange(at_, &json_member(*at_, "criterion", Kind::kObject));
    list();
    at_ = outer;
  }
  bool has(std::string_view key) const { return at_->find(key) != nullptr; }

 private:
  using Kind = JsonValue::Kind;
  const JsonValue& member(std::string_view key, Kind kind) const { return json_member(*at_, key, kind); }
  void read(std::string_view key, double& value) { value = member(key, Kind::kNumber).number(); }
  void read(std::string_view key, bool& value) { value = member(key, Kind::kBoolean).boolean(); }
  void read(std::string_view key, std::string& value) { value = member(key, Kind::kText).text(); }
  void read(std::string_view key, FloeId& value) { value = floe_id(*at_->find(key)); }
  void read(std::string_view key, std::vector<FloeId>& value) {
    for (const JsonValue& item : member(key, Kind::kArray).items()) value.push_back(floe_id(item));
  }
  void read(std::string_view key, geometry::Point& value) { value = point_of(*at_->find(key)); }
  void read(std::string_view key, geometry::Vector& value) { value = point_of(*at_->find(key)) - geometry::Point{}; }
  void read(std::string_view key, ShipName<int>& ship) {
    const std::string& name = member(key, Kind::kText).text();
    ship.index = hull_named(scene_, name);
    if (ship.index < 0 && !(name.empty() && ship.may_be_none))
      throw ReadError(fmt::format(R"("{}" is "{}", which is not in the scene)", key, shortened(name, 60)));
  }

  const JsonValue* at_;
  const Scene& scene_;
};

/// Adds the fields of a kind of event to a list.
struct Lister {
  std::vector<EventField>& fields;
  std::string_view kind;
  bool is_of_criterion = false;

  void operator()(std::string_view key, const auto&, const FieldMeaning& about) {
    auto found = std::ranges::find_if(
        fields, [&](const EventField& field) { return field.key == key && field.meaning.meaning == about.meaning; });
    if (found == fields.end()) found = fields.insert(found, {key, about, is_of_criterion, {}});
    if (found->meaning.label.empty()) found->meaning.label = about.label;
    found->kinds.push_back(kind);
  }
  void object(const FieldMeaning& about, auto list) {
    (*this)("criterion", 0, about);
    is_of_criterion = true;
    list();
    is_of_criterion = false;
  }
};

/// Calls use(event) with an event of each kind.
template <std::size_t Index = 0>
void for_kinds(auto use) {
  if constexpr (Index < std::variant_size_v<decltype(Event::what)>) {
    Event event;
    event.what.emplace<Index>();
    use(event);
    for_kinds<Index + 1>(use);
  }
}

void write(JsonWriter& json, const Event& event, Writer line) {
  json.open('{');
  io::fields(line, event);
  json.close('}');
}

}  // namespace

void append_event(std::string& text, const Event& event, const Scene& scene, FloeId parent) {
  JsonWriter json(text);
  write(json, event, {json, scene, parent});
  text += '\n';
}

void write_shown_event(JsonWriter& json, const Event& event, const Scene& scene) {
  write(json, event, {json, scene, simulation::kNoFloe, true});
}

std::string words_of(const Event& event, const Scene& scene) {
  Words words{scene};
  std::visit([&](const auto& kind) { kind_fields(words, event, kind); }, event.what);
  return std::move(words.text);
}

Event event_of(const JsonValue& line, const Scene& scene) {
  const std::string& kind = json_member(line, "kind", JsonValue::Kind::kText).text();
  std::optional<Event> read;
  for_kinds([&](Event& event) {
    if (name_of(event) != kind) return;
    Reader reader(line, scene);
    io::fields(reader, event);
    read = std::move(event);
  });
  if (!read) throw ReadError(fmt::format("an unknown kind of event, \"{}\"", shortened(kind, 60)));
  return *std::move(read);
}

std::vector<EventField> event_fields() {
  std::vector<EventField> all;
  for_kinds([&](Event& event) {
    Lister line{all, name_of(event)};
    io::fields(line, std::as_const(event));
  });
  return all;
}

namespace {

std::string floe_text(double time, const simulation::RejectedCut& cut) {
  return json_object([&](JsonWriter& json) {
    json.key("type").value("Feature").key("properties").open('{').key("floe_id").value(cut.floe);
    json.key("t_s").value(time).key("reason").value(cut.reason);
    json.close('}').key("geometry").polygon(cut.input.polygon_in_body);
  });
}

std::string ops_text(const simulation::CutInput& cut) {
  std::string text;
  JsonWriter json(text);
  json.open('[').open('{');
  if (cut.cusp_in_body.empty()) {
    json.key("line").value(cut.crack_in_body);
  } else {
    json.key("polygon").polygon({cut.cusp_in_body, {}}).key("keep").value("both");
  }
  json.key("must_cut").value(true).close('}').close(']');
  return text + "\n";
}

constexpr std::string_view kFloeEnding = ".geojson";
constexpr std::string_view kOpsEnding = "-ops.json";

/// Returns true if the name is one that write_rejected_cut() gives to a file, or left when it was killed.
bool is_name_of_ours(std::string_view name) {
  constexpr std::string_view kPart = ".part";
  constexpr std::size_t kDigits = 6;
  if (name.ends_with(kPart)) name.remove_suffix(kPart.size());
  const bool is_numbered = name.size() > kDigits && name.find_first_not_of("0123456789") == kDigits;
  return is_numbered && (name.substr(kDigits) == kFloeEnding || name.substr(kDigits) == kOpsEnding);
}

/// Returns the folder for refused cuts, which may not exist.
Result<std::filesystem::path> folder_in(const std::filesystem::path& run_folder) {
  std::filesystem::path folder = run_folder / run_file::kRejectedCuts;
  std::error_code ignored;
  if (!std::filesystem::is_symlink(std::filesystem::symlink_status(folder, ignored))) return folder;
  return fail(fmt::format("{}: a link; polynya writes through no link in a run folder; remove it", folder.string()));
}

}  // namespace

Result<> write_rejected_cut(const std::filesystem::path& run_folder, double time, const simulation::RejectedCut& cut) {
  if (cut.input.number > kMostRejectedCuts) return {};
  const auto folder = folder_in(run_folder);
  if (!folder) return fail(folder.error());
  std::error_code error;
  std::filesystem::create_directory(*folder, error);
  if (error) return fail(fmt::format("{}: {}", folder->string(), error.message()));
  const auto write = [&](std::string_view ending, const std::string& text) {
    return write_whole_file(*folder / fmt::format("{:06}{}", cut.input.number, ending), text, Durability::kSynced);
  };
  if (auto written = write(kFloeEnding, floe_text(time, cut)); !written) return written;
  return write(kOpsEnding, ops_text(cut.input));
}

Result<> remove_rejected_cuts(const std::filesystem::path& run_folder) {
  const auto folder = folder_in(run_folder);
  if (!folder) return fail(folder.error());
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(*folder, error))
    if (is_name_of_ours(entry.path().filename().string())) files.push_back(entry.path());
  for (const auto& file : files) {
    std::filesystem::remove(file, error);
    if (error) return fail(fmt::format("{}: {}", file.string(), error.message()));
  }
  std::filesystem::remove(*folder, error);  // fails, as intended, if the folder contains other files
  return {};
}

}  // namespace polynya::io
