#include "io/text/cut_report.hpp"

#include <array>

#include "geometry/exact/validity.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/wkt.hpp"

namespace polynya::io {
namespace {

void write_crs(JsonWriter& json, const std::string& crs) {
  if (!crs.empty()) json.key("crs").json(crs);
}

void write_feature(JsonWriter& json, const std::string& crs, const CutFloe& floe, const CutPiece& piece) {
  json.open('{').key("type").value("Feature");
  write_crs(json, crs);
  json.key("properties").open('{');
  json.key("floe_id").value(piece.floe_id).key("parent_id").value(floe.floe_id);
  json.key("area_m2").value(piece.area).key("part").value(name_of(piece.part));
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
}

void write_op(JsonWriter& json, const CutOp& op) {
  std::visit([&](const auto& tool) { write_tool(json, tool); }, op.tool);
  if (std::holds_alternative<DiscTool>(op.tool) || std::holds_alternative<PolygonTool>(op.tool))
    json.key("keep").value(name_of(op.keep));
  if (op.must_cut) json.key("must_cut").value(true);
}

void write_dangling(JsonWriter& json, const CutFloe& floe) {
  json.key("dangling_length_m").value(floe.dangling_length);
  json.key("dangling").objects(floe.dangling, [&](const Dangling& one) {
    json.key("from_m").value(one.from).key("to_m").value(one.to).key("length_m").value(distance(one.from, one.to));
  });
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
  write_dangling(json, floe);
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
  json.key("dangling").value(totals.dangling).key("repaired").value(totals.repaired);
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
    totals.dangling += floe.dangling.size();
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
      write_crs(json, report.crs);
      json.key("features").open('[');
      for_pieces([&](const CutFloe& floe, const CutPiece& piece) {
        json.start_line();
        write_feature(json, "", floe, piece);
      });
      json.close(']');
    });
  }
  for_pieces([&](const CutFloe& floe, const CutPiece& piece) {
    if (format == FloeFormat::kNdjson) {
      JsonWriter json(text);
      write_feature(json, report.crs, floe, piece);
    } else {
      append_wkt(text, piece.polygon);
    }
    text += '\n';
  });
  return text;
}

}  // namespace polynya::io
