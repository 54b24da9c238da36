#include "io/text/cut_ops.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/validity.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

constexpr std::size_t kMostPlaces = 4;  ///< in a message

tl::unexpected<ToolError> malformed(std::string words) {
  return tl::unexpected(ToolError{ToolError::Kind::kMalformed, std::move(words)});
}
tl::unexpected<ToolError> invalid(std::string words) {
  return tl::unexpected(ToolError{ToolError::Kind::kInvalidPolygon, std::move(words)});
}

ToolOutcome<PolygonTool> tool_of(const FloeText& text) {
  PolygonTool tool;
  for (const FloeEntry& entry : text.entries) {
    const std::string place = fmt::format("feature {}, polygon {}", entry.feature, entry.member);
    if (!entry.refusal.empty()) return invalid(fmt::format("{}: {}: {}", place, entry.refusal, entry.detail));
    geometry::Polygon polygon = geometry::normalised(entry.polygon);
    if (const auto found = geometry::find_defect(polygon))
      return invalid(
          fmt::format("{}: {}{}", place, name_of(found->defect), places_in_words(found->places, kMostPlaces)));
    tool.polygons.push_back(std::move(polygon));
  }
  if (tool.polygons.empty()) return malformed("there is no polygon in it");
  return tool;
}

Result<std::vector<double>> numbers_of(const JsonValue& value, std::size_t count, const char* form) {
  const auto is_number = [](const JsonValue& item) { return item.is(JsonKind::kNumber); };
  if (!value.is(JsonKind::kArray) || value.items().size() != count || !std::ranges::all_of(value.items(), is_number))
    return fail(fmt::format("expected {}", form));
  std::vector<double> numbers;
  for (const JsonValue& item : value.items()) numbers.push_back(item.number());
  return numbers;
}

template <class Tool>
ToolOutcome<CutOp> as_op(ToolOutcome<Tool> tool) {
  return std::move(tool).map([](Tool&& made) { return CutOp{std::move(made), {}}; });
}

ToolOutcome<DiscTool> disc_tool(const std::vector<double>& centre_and_radius, double sagitta) {
  DiscTool disc{{centre_and_radius[0], centre_and_radius[1]}, centre_and_radius[2], sagitta, {}};
  if (!(disc.radius > 0)) return malformed("the radius is not > 0");
  if (!(disc.sagitta > 0)) disc.sagitta = default_sagitta(disc.radius);
  disc.polygon.outer = geometry::disc_polygon(disc.centre, disc.radius, disc.sagitta);
  if (const auto found = geometry::find_defect(disc.polygon)) {
    return invalid(fmt::format("the disc's polygon has no room among the doubles there: {}{}", name_of(found->defect),
                               places_in_words(found->places, kMostPlaces)));
  }
  return disc;
}

ToolOutcome<CutOp> read_line(const JsonValue& value) {
  constexpr auto kForm = "[x0, y0, x1, y1] or a list of two or more [x, y]";
  const bool has_points =
      value.is(JsonKind::kArray) && !value.items().empty() && value.items().front().is(JsonKind::kArray);
  if (!has_points) {
    const auto n = numbers_of(value, 4, kForm);
    return n ? op_of_numbers("line", *n, 0) : malformed(n.error());
  }
  std::vector<geometry::Point> path;
  for (const JsonValue& item : value.items()) {
    const auto n = numbers_of(item, 2, kForm);
    if (!n) return malformed(n.error());
    path.push_back({(*n)[0], (*n)[1]});
  }
  return as_op(line_tool(std::move(path)));
}

ToolOutcome<CutOp> read_tool(std::string_view kind, const JsonValue& value, double sagitta) {
  if (kind == "line") return read_line(value);
  if (kind == "polygon")
    return as_op(value.is(JsonKind::kText) ? polygon_tool(value.text()) : tool_of(read_floe_json(value)));
  const auto n = numbers_of(value, 3, kind == "disc" ? "[x, y, radius]" : "[x, y, angle_deg]");
  return n ? op_of_numbers(kind, *n, sagitta) : malformed(n.error());
}

ToolOutcome<Keep> read_keep(const JsonValue& value) {
  for (const Keep keep : {Keep::kOutside, Keep::kInside, Keep::kBoth})
    if (value.is(JsonKind::kText) && value.text() == name_of(keep)) return keep;
  return malformed(R"(keep: expected "outside", "inside" or "both")");
}

ToolOutcome<CutOp> read_op(const JsonValue& value, const CutDefaults& defaults) {
  constexpr auto kForm = "expected an object with one of disc, crack, line, polygon";
  if (!value.is(JsonKind::kObject)) return malformed(kForm);
  const JsonMember* tool = nullptr;
  Keep keep = defaults.keep;
  bool must_cut = false;
  double sagitta = defaults.sagitta;
  for (const JsonMember& member : value.members()) {
    if (member.key == "keep") {
      const auto read = read_keep(member.value);
      if (!read) return tl::unexpected(read.error());
      keep = *read;
    } else if (member.key == "must_cut") {
      if (!member.value.is(JsonKind::kBoolean)) return malformed("must_cut: expected true or false");
      must_cut = member.value.boolean();
    } else if (member.key == "sagitta_m") {
      if (!member.value.is(JsonKind::kNumber) || !(member.value.number() > 0))
        return malformed("sagitta_m: expected a number > 0");
      sagitta = member.value.number();
    } else if (member.key == "disc" || member.key == "crack" || member.key == "line" || member.key == "polygon") {
      if (tool) return malformed(fmt::format(R"("{}" and "{}" in one: {})", tool->key, member.key, kForm));
      tool = &member;
    } else {
      const std::string meant =
          nearest(member.key, {"disc", "crack", "line", "polygon", "keep", "must_cut", "sagitta_m"});
      return malformed(fmt::format("unknown key \"{}\"{}", member.key.substr(0, 40),
                                   meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)));
    }
  }
  if (!tool) return malformed(kForm);
  auto op = read_tool(tool->key, tool->value, sagitta);
  if (op) {
    op->keep = keep;
    op->must_cut = must_cut;
  } else {
    op.error().words = fmt::format("{}: {}", tool->key, op.error().words);
  }
  return op;
}

}  // namespace

std::string_view name_of(Keep keep) {
  return keep == Keep::kOutside ? "outside" : keep == Keep::kInside ? "inside" : "both";
}

double default_sagitta(double radius) {
  return std::min(0.02, radius / 250);
}

Result<std::vector<double>> read_numbers(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  const auto skip_blanks = [&] {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  };
  while (true) {
    skip_blanks();
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || !std::isfinite(value))
      return fail(fmt::format("\"{}\" is not a finite number", text.substr(0, text.find(','))));
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    skip_blanks();
    if (text.empty()) break;
    if (text.front() != ',') return fail(fmt::format("\"{}\" where a comma is expected", text));
    text.remove_prefix(1);
  }
  if (numbers.size() != count)
    return fail(fmt::format("{} number{}, expected {}", numbers.size(), numbers.size() == 1 ? "" : "s", count));
  return numbers;
}

ToolOutcome<LineTool> line_tool(std::vector<geometry::Point> path) {
  path.erase(std::unique(path.begin(), path.end()), path.end());
  if (path.size() < 2) return malformed("the line's ends are one point");
  return LineTool{std::move(path)};
}

ToolOutcome<CutOp> op_of_numbers(std::string_view kind, const std::vector<double>& n, double sagitta) {
  if (kind == "disc") return as_op(disc_tool(n, sagitta));
  if (kind == "line") return as_op(line_tool({{n[0], n[1]}, {n[2], n[3]}}));
  return CutOp{CrackTool{{n[0], n[1]}, n[2]}, {}};
}

ToolOutcome<PolygonTool> polygon_tool(std::string text) {
  const auto floes = read_floe_text(std::move(text));
  if (!floes) return malformed(floes.error());
  return tool_of(*floes);
}

ToolOutcome<std::vector<CutOp>> read_cut_ops(const std::string& text, const CutDefaults& defaults) {
  const auto value = parse_lenient_json(text);
  if (!value) return malformed(value.error());
  if (!value->is(JsonKind::kArray)) return malformed("expected a list of cuts");
  std::vector<CutOp> ops;
  for (const JsonValue& item : value->items()) {
    auto op = read_op(item, defaults);
    if (!op) return tl::unexpected(ToolError{op.error().kind, fmt::format("[{}]: {}", ops.size(), op.error().words)});
    ops.push_back(std::move(*op));
  }
  if (ops.empty()) return malformed("the list of cuts is empty");
  return ops;
}

}  // namespace polynya::io
