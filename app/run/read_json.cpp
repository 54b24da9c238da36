#include <memory>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

/// The place of every value of a document by its JSON pointer (RFC 6901): line and column, and behind them
/// those of its key.
class PlaceWriter {
 public:
  explicit PlaceWriter(std::string_view text) : lines_(text) { json_.open('{'); }

  std::string places_of(const io::JsonValue& root) {
    add(root, {});
    json_.close('}');
    return places_;
  }

 private:
  void add(const io::JsonValue& value, std::optional<std::uint32_t> key_offset) {
    std::optional<io::LineAndColumn> key;
    if (key_offset) key = lines_.at(*key_offset);
    const io::LineAndColumn place = lines_.at(value.offset);
    json_.key(pointer_).open('[').value(place.line).value(place.column);
    if (key) json_.value(key->line).value(key->column);
    json_.close(']');
    if (value.is(io::JsonValue::Kind::kArray)) {
      std::size_t index = 0;
      for (const io::JsonValue& item : value.items()) add_below(std::to_string(index++), item, {});
    } else if (value.is(io::JsonValue::Kind::kObject)) {
      for (const io::JsonMember& member : value.members()) add_below(member.key, member.value, member.key_offset);
    }
  }
  void add_below(std::string_view step, const io::JsonValue& value, std::optional<std::uint32_t> key_offset) {
    const std::size_t length = pointer_.size();
    pointer_ += '/';
    for (const char c : step) pointer_ += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    add(value, key_offset);
    pointer_.resize(length);
  }

  io::LineIndex lines_;
  std::string places_, pointer_;
  io::JsonWriter json_{places_};
};

int read_json(const std::string& file) {
  const auto text = read_input(file, io::kLongestScene);
  if (!text) {
    print_err("{}: {}\n", file, text.error());
    return kInputOutput;
  }
  const io::JsonDocument document = io::parse_json(*text);
  if (document.faults.empty()) {
    print_out("{{\"value\": {}, \"places\": {}}}\n", io::to_json_text(document.root),
              PlaceWriter(*text).places_of(document.root));
    return kDone;
  }
  io::ProblemCollector problems({.name = file, .text = *text});
  problems.add_faults(0, document.faults);
  print_lines(problems.take());
  return kSceneInvalid;
}

}  // namespace

/// Prints a JSON file's value and the place of all in it, for the commands that are written in Python; not in the help.
Command add_read_json(CommandLine& app) {
  CommandLine command = app.add_command("read-json", "", "");
  auto file = std::make_shared<std::string>();
  command.option("file", file.get(), "FILE", "JSON with comments", {}, {.is_required = true});
  return {command, [file] { return read_json(*file); }};
}

}  // namespace polynya::app
