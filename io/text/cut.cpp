#include "io/text/cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/text/floe_ids.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

namespace {

using JsonKind = JsonValue::Kind;

constexpr std::size_t kMostPlaces = 4;  ///< number of places that a message names

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
  std::optional<double> snap = defaults.snap;
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
    } else if (member.key == "snap_m") {
      if (!member.value.is(JsonKind::kNumber) || !(member.value.number() >= 0))
        return malformed("snap_m: expected a number ≥ 0");
      snap = member.value.number();
    } else if (member.key == "disc" || member.key == "crack" || member.key == "line" || member.key == "polygon") {
      if (tool) return malformed(fmt::format(R"("{}" and "{}" in one: {})", tool->key, member.key, kForm));
      tool = &member;
    } else {
      const std::string meant =
          nearest(member.key, {"disc", "crack", "line", "polygon", "keep", "must_cut", "sagitta_m", "snap_m"});
      return malformed(fmt::format("unknown key \"{}\"{}", member.key.substr(0, 40),
                                   meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)));
    }
  }
  if (!tool) return malformed(kForm);
  auto op = read_tool(tool->key, tool->value, sagitta);
  if (op) {
    op->keep = keep;
    op->must_cut = must_cut;
    if (auto* line = std::get_if<LineTool>(&op->tool)) line->snap = snap;
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

Result<std::vector<double>> read_numbers(std::string_view text, std::size_t least, std::size_t most) {
  const JsonDocument list = parse_json(fmt::format("[{}]", text));
  const auto is_number = [](const JsonValue& item) { return item.is(JsonKind::kNumber); };
  if (!list.faults.empty() || !std::ranges::all_of(list.root.items(), is_number))
    return fail(fmt::format("\"{}\" is no list of numbers with commas between them", text));
  std::vector<double> numbers;
  for (const JsonValue& item : list.root.items()) numbers.push_back(item.number());
  if (numbers.size() < least || numbers.size() > most)
    return fail(fmt::format("{}, expected {}", counted(numbers.size(), "number"),
                            least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most)));
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

namespace {

void write_crs(JsonWriter& json, const std::string& crs) {
  if (!crs.empty()) json.key("crs").json(crs);
}

/// Writes the coordinate system and the place on the Earth of the coordinates.
void write_frame(JsonWriter& json, const CutReport& report) {
  write_crs(json, report.crs);
  write_place(json, report.place);
}

void write_feature(JsonWriter& json, const CutReport& report, bool has_frame, const CutFloe& floe,
                   const CutPiece& piece) {
  json.open('{').key("type").value("Feature");
  if (has_frame) write_frame(json, report);
  json.key("properties").open('{');
  json.key("floe_id").value(piece.floe_id).key("parent_id").value(floe.floe_id);
  json.key("area_m2").value(piece.area).key("part").value(name_of(piece.part));
  if (floe.source_id) json.key(report.source_id_key).json(*floe.source_id);
  if (floe.properties) json.json(*floe.properties);
  json.close('}').key("geometry").polygon(piece.polygon).close('}');
}

void write_tool(JsonWriter& json, const DiscTool& disc) {
  json.key("disc").list(std::array{disc.centre.x, disc.centre.y, disc.radius});
  json.key("sagitta_m").value(disc.sagitta).key("vertices").value(std::ssize(disc.polygon.outer));
}
void write_tool(JsonWriter& json, const PolygonTool& tool) {
  std::size_t vertices = 0;
  for (const geometry::Polygon& polygon : tool.polygons) vertices += vertex_count(polygon);
  json.key("polygons").value(tool.polygons.size()).key("vertices").value(vertices);
}
void write_tool(JsonWriter& json, const CrackTool& crack) {
  json.key("crack").list(std::array{crack.point.x, crack.point.y, crack.angle_deg});
}
void write_tool(JsonWriter& json, const LineTool& line) {
  json.key("line").value(line.path);
  if (line.snap) json.key("snap_m").value(*line.snap);
}

void write_op(JsonWriter& json, const CutOp& op) {
  std::visit([&](const auto& tool) { write_tool(json, tool); }, op.tool);
  if (std::holds_alternative<DiscTool>(op.tool) || std::holds_alternative<PolygonTool>(op.tool))
    json.key("keep").value(name_of(op.keep));
  if (op.must_cut) json.key("must_cut").value(true);
}

void write_rejection(JsonWriter& json, const std::optional<Rejection>& rejected) {
  json.key("rejected");
  if (!rejected) {
    json.null();
    return;
  }
  json.open('{').key("reason").value(rejected->reason);
  if (!rejected->detail.empty()) json.key("detail").value(rejected->detail);
  json.key("vertices").value(rejected->vertices).close('}');
}

void write_floe(JsonWriter& json, const CutFloe& floe) {
  json.key("floe_id").value(floe.floe_id);
  json.key("feature").value(floe.feature).key("polygon").value(floe.member).key("line").value(floe.line);
  json.key("area_m2").value(floe.area).key("pieces").value(std::ssize(floe.pieces));
  json.key("area_of_pieces_m2").value(floe.area_of_pieces).key("removed_m2").value(floe.removed);
  json.key("exact_defect_m2").value(floe.exact_defect);
  json.key("rounding_defect_m2").value(floe.rounding_defect);
  json.key("snap_rounded").value(floe.snap_rounded);
  json.key("slivers").value(floe.slivers).key("area_slivers_m2").value(floe.area_slivers);
  json.key("dangling_length_m").value(floe.dangling_length);
  if (floe.repair) {
    json.key("repair").open('{').key("rule").value(floe.repair->rule);
    json.key("defect").value(floe.repair->defect).key("area_drawn_m2").value(floe.repair->area_drawn);
    json.key("area_changed_m2").value(floe.repair->area_changed);
    json.key("shapes").value(floe.repair->shapes).close('}');
  }
  write_rejection(json, floe.rejected);
  json.key("parts").objects(floe.pieces, [&](const CutPiece& piece) {
    json.key("floe_id").value(piece.floe_id).key("part").value(name_of(piece.part)).key("area_m2").value(piece.area);
  });
}

void write_totals(JsonWriter& json, const CutTotals& totals) {
  json.key("floes").value(totals.floes).key("area_m2").value(totals.area);
  json.key("pieces").value(totals.pieces).key("area_of_pieces_m2").value(totals.area_of_pieces);
  json.key("removed_m2").value(totals.removed).key("exact_defect_m2").value(totals.exact_defect);
  json.key("rounding_defect_m2").value(totals.rounding_defect).key("slivers").value(totals.slivers);
  json.key("area_slivers_m2").value(totals.area_slivers).key("snap_rounded").value(totals.snap_rounded);
  json.key("dangling_length_m").value(totals.dangling_length).key("repaired").value(totals.repaired);
  json.key("area_changed_by_repair_m2").value(totals.area_repaired);
  json.key("rejected").value(totals.rejected);
}

}  // namespace

std::string_view name_of(geometry::Part part) {
  return part == geometry::Part::kInside ? "inside" : "outside";
}

CutTotals totals_of(const CutReport& report) {
  CutTotals totals;
  totals.floes = report.floes.size();
  for (const CutFloe& floe : report.floes) {
    totals.area += floe.area;
    totals.area_of_pieces += floe.area_of_pieces;
    totals.removed += floe.removed;
    totals.area_slivers += floe.area_slivers;
    totals.rounding_defect += floe.rounding_defect;
    totals.slivers += static_cast<std::size_t>(floe.slivers);
    totals.pieces += floe.pieces.size();
    totals.snap_rounded += static_cast<std::size_t>(floe.snap_rounded);
    totals.dangling_length += floe.dangling_length;
    totals.rejected += floe.rejected ? 1 : 0;
    if (floe.repair) {
      ++totals.repaired;
      totals.area_repaired += floe.repair->area_changed;
    }
    if (floe.exact_defect != "0") totals.exact_defect = floe.exact_defect;
  }
  return totals;
}

std::string to_ledger_json(const CutReport& report) {
  return json_object([&](JsonWriter& json) {
    json.key("tools").objects(report.ops, [&](const CutOp& op) { write_op(json, op); });
    json.key("floes").object_lines(report.floes, [&](const CutFloe& floe) { write_floe(json, floe); });
    json.start_line();
    json.key("totals").object([&] { write_totals(json, totals_of(report)); });
  });
}

std::string to_floe_text(const CutReport& report, FloeFormat format) {
  std::string text;
  const auto for_pieces = [&](auto use) {
    for (const CutFloe& floe : report.floes)
      for (const CutPiece& piece : floe.pieces) use(floe, piece);
  };
  if (format == FloeFormat::kGeojson) {
    return json_object([&](JsonWriter& json) {
      json.key("type").value("FeatureCollection");
      write_frame(json, report);
      json.key("features").open('[');
      for_pieces([&](const CutFloe& floe, const CutPiece& piece) {
        json.start_line();
        write_feature(json, report, false, floe, piece);
      });
      json.close(']');
    });
  }
  for_pieces([&](const CutFloe& floe, const CutPiece& piece) {
    if (format == FloeFormat::kNdjson) {
      JsonWriter json(text);
      write_feature(json, report, true, floe, piece);
    } else {
      append_wkt(text, piece.polygon);
    }
    text += '\n';
  });
  return text;
}

namespace {

using geometry::Part;
using geometry::Piece;
using geometry::Point;
using geometry::Polygon;
using geometry::Shape;

/// Applies all cuts to one floe.
class FloeCutter {
 public:
  explicit FloeCutter(CutFloe& floe) : floe_(floe) {}

  /// Takes the outline of the floe, repaired if a rule is given. Returns false if the polygon is refused.
  bool take(const Polygon& as_drawn, std::optional<geometry::FillRule> repair_rule) {
    Polygon polygon = geometry::normalised(as_drawn);
    const auto defect = find_defect(polygon);
    if (defect && repair_rule && repair(polygon, *defect, *repair_rule)) return true;
    if (defect) {
      if (!floe_.rejected) floe_.rejected = {{std::string(name_of(defect->defect)), "", defect->places}};
      return false;
    }
    floe_.area = measure(polygon).area;
    add({{.polygon = std::move(polygon), .known_valid = true}, Part::kOutside});
    return true;
  }

  /// Applies all cuts in order. Consecutive lines and cracks are one tool.
  void apply_all(const std::vector<CutOp>& ops) {
    for (std::size_t i = 0; i < ops.size();) {
      std::size_t end = i + 1;
      if (may_be_together(ops[i]))
        while (end < ops.size() && may_be_together(ops[end])) ++end;
      const std::span<const CutOp> together = std::span(ops).subspan(i, end - i);
      if (end - i > 1 && ends_within(paths_of(together), box_))
        apply_together(together, i);
      else
        for (std::size_t k = i; k < end; ++k) apply(ops[k], k);
      i = end;
    }
  }

  void finish(std::int64_t& next_id) {
    for (Piece& piece : pieces_) {
      const double area = measure(piece.shape.polygon).area;
      floe_.area_of_pieces += area;
      floe_.pieces.push_back({next_id++, piece.part, area, std::move(piece.shape.polygon)});
    }
  }

 private:
  void add(Piece piece) {
    const geometry::Box box = bounding_box(piece.shape.polygon.outer);
    if (pieces_.empty()) box_ = box;
    extend(box_, box);
    pieces_.push_back(std::move(piece));
  }

  bool repair(const Polygon& polygon, const geometry::DefectAt& defect, geometry::FillRule rule) {
    auto repaired = geometry::repair(rings_of(polygon), rule);
    if (!repaired) {
      // Rings that are not finite keep that reason. Others fail because they enclose no area.
      if (repaired.error().reason != geometry::CutFailure::kInvalidShape) {
        floe_.rejected = {
            {std::string(name_of(defect.defect)), "not repaired: " + repaired.error().detail, defect.places}};
      }
      return false;
    }
    floe_.area = repaired->ledger.area_before;
    floe_.repair = {repair_rule_name(rule), std::string(name_of(defect.defect)), repaired->area_drawn,
                    repaired->area_changed, repaired->shapes.size()};
    count(repaired->ledger);
    for (Shape& shape : repaired->shapes) add({std::move(shape), Part::kOutside});
    return true;
  }
  static std::string_view repair_rule_name(geometry::FillRule rule) {
    return rule == geometry::FillRule::kEvenOdd ? "even-odd" : "non-zero";
  }

  static bool is_area(const CutOp& op) {
    return std::holds_alternative<DiscTool>(op.tool) || std::holds_alternative<PolygonTool>(op.tool);
  }

  void put(const CutOp& op, Piece piece) {
    const bool is_kept =
        !is_area(op) || op.keep == Keep::kBoth || (op.keep == Keep::kInside) == (piece.part == Part::kInside);
    if (is_kept)
      pieces_.push_back(std::move(piece));
    else
      floe_.removed += measure(piece.shape.polygon).area;
  }

  void apply(const CutOp& op, std::size_t number) {
    std::vector<Piece> before = std::exchange(pieces_, {});
    for (Piece& piece : before) {
      auto outcome = std::visit([&](const auto& tool) { return cut(piece.shape, tool); }, op.tool);
      put_outcome(op, number, std::move(piece), std::move(outcome));
    }
  }

  static bool may_be_together(const CutOp& op) { return !is_area(op) && !op.must_cut; }

  std::vector<CutPath> paths_of(std::span<const CutOp> ops) const {
    std::vector<CutPath> paths;
    for (const CutOp& op : ops) {
      const auto* crack = std::get_if<CrackTool>(&op.tool);
      paths.push_back(crack ? path_across(crack->point, crack->angle_deg, box_) : std::get<LineTool>(op.tool).path);
    }
    return paths;
  }

  void apply_together(std::span<const CutOp> ops, std::size_t number) {
    const std::vector<CutPath> paths = paths_of(ops);
    std::optional<double> snap;
    for (const CutOp& op : ops)
      if (const auto* line = std::get_if<LineTool>(&op.tool); line && line->snap)
        snap = std::max(snap.value_or(0), *line->snap);
    std::vector<Piece> before = std::exchange(pieces_, {});
    for (Piece& piece : before) {
      auto outcome = cut_along_paths(piece.shape, paths, snap);
      put_outcome(ops.front(), number, std::move(piece), std::move(outcome));
    }
  }

  /// Cuts along paths whose ends were extended. The extensions do not count as cracks that end inside the ice.
  static geometry::CutOutcome cut_along_paths(const Shape& shape, const std::vector<CutPath>& paths,
                                              std::optional<double> snap) {
    const double rounding = default_snap(shape.polygon, paths);
    geometry::CutOutcome outcome = cut_along_all(shape, continued(paths, shape.polygon, snap.value_or(rounding)));
    const double least = 4 * rounding * static_cast<double>(paths.size());
    double& dangling = outcome ? outcome->ledger.dangling_length : outcome.error().dangling_length;
    if (dangling <= least) dangling = 0;
    return outcome;
  }

  void put_outcome(const CutOp& op, std::size_t number, Piece piece, geometry::CutOutcome outcome) {
    if (!outcome) return put_uncut(op, number, std::move(piece), outcome.error());
    count(outcome->ledger);
    floe_.dangling_length += outcome->ledger.dangling_length;
    for (Piece& child : outcome->pieces) {
      if (!is_area(op)) child.part = piece.part;
      put(op, std::move(child));
    }
  }

  void put_uncut(const CutOp& op, std::size_t number, Piece piece, const geometry::CutError& error) {
    const bool is_left_whole =
        error.reason == geometry::CutFailure::kMisses || error.reason == geometry::CutFailure::kDoesNotSeparate;
    if (is_left_whole) floe_.dangling_length += error.dangling_length;
    if (!is_left_whole || op.must_cut) {
      const std::string detail = fmt::format("cut {}: {}", number, error.detail);
      floe_.rejected = Rejection{std::string(name_of(error.reason)), detail, {}};
      pieces_.push_back(std::move(piece));
      return;
    }
    if (is_area(op)) piece.part = Part::kOutside;
    put(op, std::move(piece));
  }

  static geometry::CutOutcome cut(const Shape& shape, const DiscTool& disc) {
    return cut_by_polygon(shape, disc.polygon);
  }
  static geometry::CutOutcome cut(const Shape& shape, const PolygonTool& tool) {
    return cut_by_polygons(shape, tool.polygons);
  }
  static geometry::CutOutcome cut(const Shape& shape, const LineTool& line) {
    return cut_along_paths(shape, {line.path}, line.snap);
  }
  geometry::CutOutcome cut(const Shape& shape, const CrackTool& crack) const {
    return cut_along(shape, path_across(crack.point, crack.angle_deg, box_));
  }

  void count(const geometry::CutLedger& ledger) {
    floe_.rounding_defect += ledger.rounding_defect;
    floe_.slivers += ledger.slivers;
    floe_.snap_rounded += ledger.snap_rounded;
    floe_.area_slivers += ledger.area_slivers;
    floe_.removed += ledger.area_slivers;
    // Geometry refuses a cut whose pieces do not sum exactly to their parent. This reports a defect if it ever fails to
    // do so.
    if (ledger.exact_defect != "0") floe_.exact_defect = ledger.exact_defect;
  }

  CutFloe& floe_;
  std::vector<Piece> pieces_;
  geometry::Box box_{};  ///< box of the whole floe, so that a crack is the same line for all pieces
};

}  // namespace

CutReport cut_floes(const std::vector<FloeEntry>& entries, std::vector<CutOp> ops,
                    std::optional<geometry::FillRule> repair_rule) {
  CutReport report;
  report.ops = std::move(ops);
  std::vector<GivenId> given;
  for (const FloeEntry& entry : entries) given.push_back(given_id(entry));
  const bool are_own = are_usable(given);
  report.ids_replaced = why_ids_are_replaced(given);
  report.source_id_key = source_id_key(entries);
  std::int64_t next_id = std::ssize(entries);
  for (const GivenId& id : given)
    if (are_own) next_id = std::max(next_id, *id.number + 1);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const FloeEntry& entry = entries[i];
    CutFloe& floe = report.floes.emplace_back();
    floe.floe_id = are_own ? *given[i].number : static_cast<std::int64_t>(i);
    if (!are_own && given[i].is_given()) floe.source_id = given[i].as_json();
    floe.feature = entry.feature;
    floe.member = entry.member;
    floe.line = entry.line;
    floe.properties = entry.properties;
    if (!entry.refusal.empty()) {
      floe.rejected = {{entry.refusal, entry.detail, {}}};
      continue;
    }
    FloeCutter cutter(floe);
    if (!cutter.take(entry.polygon, repair_rule)) continue;
    cutter.apply_all(report.ops);
    cutter.finish(next_id);
  }
  return report;
}

}  // namespace polynya::io
