#include <cmath>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/read_input.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::app {
namespace {

/// Lines and columns in a text, in one pass: each offset is at or behind the one before.
class PlaceReader {
 public:
  explicit PlaceReader(std::string_view text) : text_(text) {}
  io::LineAndColumn at(std::size_t offset) {
    const auto step = io::line_and_column(text_.substr(offset_), offset - offset_);
    offset_ = offset;
    place_.column = step.line > 1 ? step.column : place_.column + step.column - 1;
    place_.line += step.line - 1;
    return place_;
  }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  io::LineAndColumn place_;
};

/// Writes a document's value, and the place of every value in it by its JSON pointer (RFC 6901): line and
/// column, and behind them those of its key.
class LocatedWriter {
 public:
  explicit LocatedWriter(std::string_view text) : reader_(text) { json_places_.open('{'); }

  std::string text_of(const io::JsonValue& root) {
    write(root, {});
    json_places_.close('}');
    return fmt::format("{{\"value\": {}, \"places\": {}}}\n", value_, places_);
  }

 private:
  void write(const io::JsonValue& value, std::optional<std::uint32_t> key_offset) {
    std::optional<io::LineAndColumn> key;
    if (key_offset) key = reader_.at(*key_offset);
    const io::LineAndColumn place = reader_.at(value.offset);
    json_places_.key(pointer_).open('[').value(place.line).value(place.column);
    if (key) json_places_.value(key->line).value(key->column);
    json_places_.close(']');
    switch (value.kind()) {
      case io::JsonValue::Kind::kNull:
        json_value_.null();
        break;
      case io::JsonValue::Kind::kBoolean:
        json_value_.value(value.boolean());
        break;
      case io::JsonValue::Kind::kNumber:
        write_number(value.number());
        break;
      case io::JsonValue::Kind::kText:
        json_value_.value(value.text());
        break;
      case io::JsonValue::Kind::kArray:
        write_items(value.items());
        break;
      case io::JsonValue::Kind::kObject:
        write_members(value.members());
        break;
    }
  }
  /// A whole number without point and exponent, by which Python knows one.
  void write_number(double number) {
    constexpr double kLargestWhole = 9007199254740992.0;  // 2^53, from where doubles are more than 1 apart
    if (std::trunc(number) == number && std::abs(number) <= kLargestWhole)
      json_value_.json(fmt::format("{}", static_cast<std::int64_t>(number)));
    else
      json_value_.value(number);
  }
  void write_items(const io::JsonValue::Array& items) {
    json_value_.open('[');
    for (std::size_t i = 0; i < items.size(); ++i) write_below(std::to_string(i), items[i], {});
    json_value_.close(']');
  }
  void write_members(const io::JsonValue::Object& members) {
    json_value_.open('{');
    for (const io::JsonMember& member : members) {
      json_value_.key(member.key);
      write_below(member.key, member.value, member.key_offset);
    }
    json_value_.close('}');
  }
  void write_below(std::string_view step, const io::JsonValue& value,
                   std::optional<std::uint32_t> key_offset) {
    const std::size_t length = pointer_.size();
    pointer_ += '/';
    for (const char c : step) {
      if (c == '~')
        pointer_ += "~0";
      else if (c == '/')
        pointer_ += "~1";
      else
        pointer_ += c;
    }
    write(value, key_offset);
    pointer_.resize(length);
  }

  PlaceReader reader_;
  std::string value_, places_, pointer_;
  io::JsonWriter json_value_{value_}, json_places_{places_};
};

int read_json(const std::string& file) {
  const auto text = read_input(file, io::kLongestScene);
  if (!text) {
    print_err("{}: {}\n", file, text.error());
    return kInputOutput;
  }
  const io::JsonDocument document = io::parse_json(*text);
  if (document.faults.empty()) {
    write_out(LocatedWriter(*text).text_of(document.root));
    return kDone;
  }
  io::ProblemCollector problems({.name = file, .text = *text});
  problems.add_faults(0, document.faults);
  for (const io::Problem& problem : problems.take()) print_err("{}\n", to_string(problem));
  return kSceneInvalid;
}

}  // namespace

/// For the commands that are written in Python, not in the help.
Command add_read_json(CommandLine& app) {
  CommandLine command =
      app.add_hidden_command("read-json", "Print a JSON file's value and the place of all in it");
  auto file = std::make_shared<std::string>();
  command.option("file", *file, "FILE", "JSON with comments").required();
  return {command, [file] { return read_json(*file); }};
}

}  // namespace polynya::app
