#include "io/scene/scene_assign.hpp"

#include <charconv>

#include <fmt/format.h>

#include "io/scene/record.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

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

/// Where the value of "ships[0].position_m[1]" belongs. Objects on the way are made where the scene has none, items of
/// lists must be there; null where the path leads nowhere, which has been reported.
template <class Report>
JsonValue* place_of(JsonValue& scene, std::string_view path, std::uint32_t offset, Report report) {
  JsonValue* at = &scene;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find_first_of(".[", begin + 1), path.size());
    const std::string_view so_far = path.substr(0, end);
    std::size_t index = 0;
    if (path[begin] == '[' && begin > 0) {
      const auto read = std::from_chars(path.data() + begin + 1, path.data() + end, index);
      if (read.ec != std::errc() || read.ptr + 1 != path.data() + end || *read.ptr != ']') return report.no_path();
      if (!at->is(JsonKind::kArray) || index >= at->items().size())
        return report(so_far, show(*at), "an item of a list that the scene has");
      at = &at->items()[index];
    } else {
      if (path[begin] == '.' && begin > 0) ++begin;
      const std::string_view key = path.substr(begin, end - begin);
      if (key.empty() || key[0] == '.' || key[0] == '[') return report.no_path();
      if (!at->is(JsonKind::kObject))
        return report(path.substr(0, begin - 1), show(*at), fmt::format("an object, to have \"{}\"", key));
      JsonValue* there = at->find(key);
      if (!there && end < path.size() && path[end] == '[')
        return report(so_far, "nothing", "a list that the scene has");
      if (!there)
        there = &at->members().emplace_back(JsonMember{std::string(key), offset, {JsonValue::Object{}, offset}}).value;
      at = there;
    }
    begin = end;
  }
  return at;
}

/// Reports a path that leads nowhere; the place is the path's.
struct ReportPath {
  std::string_view path;
  std::uint32_t offset;
  ProblemCollector& problems;

  JsonValue* operator()(std::string_view at, std::string found, std::string allowed) const {
    problems.report(0, offset, std::string(at), std::move(found), std::move(allowed));
    return nullptr;
  }
  JsonValue* no_path() const {
    return (*this)(path, fmt::format("\"{}\"", path),
                   "a path of a scene's key, as ice.thickness_m or ships[0].position_m[1]");
  }
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
    const std::uint32_t offset = begin + assignment.key_offset;
    const ReportPath report{assignment.path, offset, problems};
    JsonValue* const target =
        assignment.path.empty() ? report.no_path() : place_of(scene, assignment.path, offset, report);
    if (!target) continue;
    *target = assignment.value;
    shift(*target, begin);
  }
}

}  // namespace polynya::io
