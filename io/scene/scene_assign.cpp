#include "io/scene/scene_assign.hpp"

#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "io/scene/record.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

/// One step of a path: a key of an object, or an index in a list where the key is empty.
struct Step {
  std::string key;
  std::size_t index = 0;
};

/// The index that a path continues with at '[', which is cut off it; nothing where it is none.
std::optional<std::size_t> take_index(std::string_view& path) {
  std::size_t index = 0;
  const char* const end = path.data() + path.size();
  const auto [stop, error] = std::from_chars(path.data() + 1, end, index);
  if (error != std::errc() || stop == end || *stop != ']') return {};
  path.remove_prefix(static_cast<std::size_t>(stop - path.data()) + 1);
  return index;
}

/// The steps of "ships[0].position_m[1]"; none where it is no path.
std::vector<Step> steps_of(std::string_view path) {
  std::vector<Step> steps;
  while (!path.empty()) {
    if (path.front() == '[' && !steps.empty()) {
      const auto index = take_index(path);
      if (!index) return {};
      steps.push_back({"", *index});
      continue;
    }
    if (!steps.empty() && path.front() != '.') return {};
    if (!steps.empty()) path.remove_prefix(1);
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    if (end == 0) return {};
    steps.push_back({std::string(path.substr(0, end)), 0});
    path.remove_prefix(end);
  }
  return steps;
}

void shift(JsonValue& value, std::uint32_t by) {
  value.offset += by;
  if (value.is(JsonKind::kArray)) {
    for (JsonValue& item : value.items()) shift(item, by);
  } else if (value.is(JsonKind::kObject)) {
    for (JsonMember& member : value.members()) {
      member.key_offset += by;
      shift(member.value, by);
    }
  }
}

/// Walks one path into the scene. One use.
class Assigner {
 public:
  Assigner(const Assignment& assignment, std::uint32_t begin, ProblemCollector& problems)
      : path_(assignment.path), place_(begin + assignment.key_offset), problems_(problems) {}

  /// Where the value belongs; null where the path leads nowhere, which has been reported.
  JsonValue* find(JsonValue& scene) {
    const std::vector<Step> steps = steps_of(path_);
    if (steps.empty()) {
      report(std::string(path_), fmt::format("\"{}\"", path_),
             "a path of a scene's key, as ice.thickness_m or ships[0].position_m[1]");
      return nullptr;
    }
    JsonValue* at = &scene;
    std::string so_far;
    for (std::size_t i = 0; i < steps.size() && at; ++i) {
      const bool is_list = i + 1 < steps.size() && steps[i + 1].key.empty();
      at = steps[i].key.empty() ? item(*at, steps[i], so_far) : member(*at, steps[i], is_list, so_far);
    }
    return at;
  }

 private:
  JsonValue* item(JsonValue& list, const Step& step, std::string& so_far) {
    const std::string name = fmt::format("{}[{}]", so_far, step.index);
    if (!list.is(JsonKind::kArray)) {
      report(name, show(list), "an item of a list that the scene has");
      return nullptr;
    }
    if (step.index >= list.items().size()) {
      report(name, show(list),
             list.items().empty() ? "an item that the list has"
                                  : fmt::format("an index from 0 to {}", list.items().size() - 1));
      return nullptr;
    }
    so_far = name;
    return &list.items()[step.index];
  }

  /// A key that the scene leaves out is made, but for a list.
  JsonValue* member(JsonValue& object, const Step& step, bool is_list, std::string& so_far) {
    if (!object.is(JsonKind::kObject)) {
      report(so_far, show(object), fmt::format("an object, to have \"{}\"", step.key));
      return nullptr;
    }
    so_far += (so_far.empty() ? "" : ".") + step.key;
    if (JsonValue* there = object.find(step.key)) return there;
    if (is_list) {
      report(so_far, "nothing", "a list that the scene has");
      return nullptr;
    }
    return &object.members().emplace_back(JsonMember{step.key, place_, {JsonValue::Object{}, place_}}).value;
  }

  void report(std::string path, std::string found, std::string allowed) {
    problems_.report(0, place_, std::move(path), std::move(found), std::move(allowed));
  }

  std::string_view path_;
  std::uint32_t place_;
  ProblemCollector& problems_;
};

}  // namespace

Result<Assignment> parse_assignment(std::string_view words, std::string_view option) {
  const std::size_t equals = words.find('=');
  if (equals == 0 || equals == std::string_view::npos)
    return fail(fmt::format("\"{}\" is not KEY=VALUE, as ice.thickness_m=0.7", words));
  const std::string_view value = words.substr(equals + 1);
  JsonDocument document = parse_json(value);
  if (!document.faults.empty()) document.root.data = std::string(value);
  return Assignment{std::string(words.substr(0, equals)),
                    std::move(document.root),
                    0,
                    {fmt::format("{} {}", option, words), 0, words.size()}};
}

tl::expected<std::vector<Assignment>, Problem> parse_case(std::string_view text, const std::string& file, int line) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) {
    const JsonFault& fault = document.faults.front();
    return tl::unexpected(Problem{
        .file = file, .line = line, .column = static_cast<int>(fault.offset) + 1, .sentence = message_of(fault)});
  }
  if (!document.root.is(JsonKind::kObject))
    return tl::unexpected(Problem{.file = file,
                                  .line = line,
                                  .column = 1,
                                  .found = show(document.root),
                                  .allowed = "an object of paths and values"});
  std::vector<Assignment> assignments;
  for (JsonMember& member : document.root.members())
    assignments.push_back({member.key, std::move(member.value), member.key_offset, {file, line, text.size()}});
  return assignments;
}

void assign(JsonValue& scene, const std::vector<Assignment>& assignments, ProblemCollector& problems) {
  for (const Assignment& assignment : assignments) {
    const std::uint32_t begin = problems.add_overlay(assignment.text);
    JsonValue* const target = Assigner(assignment, begin, problems).find(scene);
    if (!target) continue;
    *target = assignment.value;
    shift(*target, begin);
  }
}

}  // namespace polynya::io
