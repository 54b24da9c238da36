#include "app/ice/cut_floes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::app {
namespace {

using geometry::Part;
using geometry::Piece;
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Shape;
using geometry::Vector;

template <class Use>
void for_edges(const Polygon& polygon, Use use) {
  const auto of_ring = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) use(ring[i], ring[(i + 1) % ring.size()]);
  };
  of_ring(polygon.outer);
  for (const Ring& hole : polygon.holes) of_ring(hole);
}

/// Where along a→b (0 to 1) edges of the polygon cross it, with both ends, in order.
std::vector<double> crossings(Point a, Point b, const Polygon& polygon) {
  std::vector<double> at{0, 1};
  const Vector along = b - a;
  for_edges(polygon, [&](Point p, Point q) {
    const double side_p = cross(along, p - a);
    const double side_q = cross(along, q - a);
    if ((side_p < 0) == (side_q < 0)) return;
    const Point meeting = p + (side_p / (side_p - side_q)) * (q - p);
    const double part = dot(meeting - a, along) / squared_length(along);
    if (part > 0 && part < 1) at.push_back(part);
  });
  std::ranges::sort(at);
  return at;
}

bool is_on_an_edge(Point point, const std::vector<Polygon>& polygons, double tolerance) {
  bool found = false;
  for (const Polygon& polygon : polygons) {
    for_edges(polygon, [&](Point p, Point q) { found = found || distance_to_segment(point, p, q) <= tolerance; });
    if (found) return true;
  }
  return false;
}

/// The parts of a path that lie in the ice of `before` and on no edge of the polygons it became: there the
/// path ends inside the ice, or only leads from hole to hole. Found in doubles, for the report.
std::vector<io::Dangling> find_dangling(const std::vector<Point>& path, const Polygon& before,
                                        const std::vector<Polygon>& after) {
  const geometry::Box box = bounding_box(before.outer);
  const double tolerance = 1e-9 * std::max({length(box.high - box.low), length(box.low - Point{}) * 1e-3});
  std::vector<io::Dangling> found;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point a = path[i - 1];
    const Vector along = path[i] - a;
    const std::vector<double> at = crossings(a, path[i], before);
    for (std::size_t k = 1; k < at.size(); ++k) {
      if ((at[k] - at[k - 1]) * length(along) <= tolerance) continue;
      const Point middle = a + 0.5 * (at[k - 1] + at[k]) * along;
      if (!contains(before, middle) || is_on_an_edge(middle, after, tolerance)) continue;
      found.push_back({a + at[k - 1] * along, a + at[k] * along});
    }
  }
  return found;
}

/// Floes go by their own ids where every one has one of its own, else by their number in the text.
std::vector<std::int64_t> ids_of(const std::vector<io::FloeEntry>& entries) {
  std::set<std::int64_t> own;
  for (const io::FloeEntry& entry : entries) {
    if (entry.floe_id) own.insert(*entry.floe_id);
  }
  std::vector<std::int64_t> ids;
  ids.reserve(entries.size());
  for (const io::FloeEntry& entry : entries)
    ids.push_back(own.size() == entries.size() ? *entry.floe_id : std::ssize(ids));
  return ids;
}

/// cos and sin, exact at whole quarter turns and equal between them.
geometry::Vector direction_of(double angle_deg) {
  constexpr double kDiagonal = 1 / std::numbers::sqrt2;
  constexpr geometry::Vector kEighths[] = {{1, 0}, {kDiagonal, kDiagonal}, {0, 1}, {-kDiagonal, kDiagonal}, {-1, 0}};
  const double angle = std::remainder(angle_deg, 360);  // exact, from −180 to 180
  const double eighths = std::abs(angle) / 45;
  if (eighths == std::floor(eighths)) {
    const geometry::Vector up = kEighths[static_cast<int>(eighths)];
    return {up.x, angle < 0 ? -up.y : up.y};
  }
  return {std::cos(angle * std::numbers::pi / 180), std::sin(angle * std::numbers::pi / 180)};
}

/// The crack's line from beyond the box to beyond it. The reach is a power of two, so that floes about as far
/// from the point share the very same line.
std::vector<Point> across(const io::CrackTool& crack, const geometry::Box& box) {
  double farthest = 0;
  for (const double x : {box.low.x, box.high.x}) {
    for (const double y : {box.low.y, box.high.y}) farthest = std::max(farthest, distance(crack.point, {x, y}));
  }
  const double reach = std::ldexp(1.0, std::ilogb(std::max(farthest, 1e-300)) + 2);
  const geometry::Vector arm = reach * direction_of(crack.angle_deg);
  return {crack.point - arm, crack.point + arm};
}

/// One floe on its way through all cuts.
class FloeCutter {
 public:
  explicit FloeCutter(io::CutFloe& floe) : floe_(floe) {}

  /// False where the polygon is refused.
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

  void apply(const io::CutOp& op, std::size_t number) {
    std::vector<Piece> before = std::exchange(pieces_, {});
    for (Piece& piece : before) {
      auto outcome = std::visit([&](const auto& tool) { return cut(piece.shape, tool); }, op.tool);
      if (!outcome) {
        put_uncut(op, number, std::move(piece), outcome.error());
        continue;
      }
      count(outcome->ledger);
      note_dangling(op, outcome->ledger.dangling_length, piece, outcome->pieces);
      for (Piece& child : outcome->pieces) {
        if (!is_area(op)) child.part = piece.part;
        put(op, std::move(child));
      }
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
      // Rings that are not finite keep that name; others enclose nothing.
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

  static bool is_area(const io::CutOp& op) {
    return std::holds_alternative<io::DiscTool>(op.tool) || std::holds_alternative<io::PolygonTool>(op.tool);
  }

  void put(const io::CutOp& op, Piece piece) {
    const bool is_kept =
        !is_area(op) || op.keep == io::Keep::kBoth || (op.keep == io::Keep::kInside) == (piece.part == Part::kInside);
    if (is_kept)
      pieces_.push_back(std::move(piece));
    else
      floe_.removed += measure(piece.shape.polygon).area;
  }

  void put_uncut(const io::CutOp& op, std::size_t number, Piece piece, const geometry::CutError& error) {
    const bool is_left_whole =
        error.reason == geometry::CutFailure::kMisses || error.reason == geometry::CutFailure::kDoesNotSeparate;
    if (is_left_whole) note_dangling(op, error.dangling_length, piece, {piece});
    if (!is_left_whole || op.must_cut) {
      const std::string detail = fmt::format("cut {}: {}", number, error.detail);
      floe_.rejected = io::Rejection{std::string(name_of(error.reason)), detail, {}};
      pieces_.push_back(std::move(piece));
      return;
    }
    if (is_area(op)) piece.part = Part::kOutside;
    put(op, std::move(piece));
  }

  static geometry::CutOutcome cut(const Shape& shape, const io::DiscTool& disc) {
    return cut_by_polygon(shape, disc.polygon);
  }
  static geometry::CutOutcome cut(const Shape& shape, const io::PolygonTool& tool) {
    return cut_by_polygons(shape, tool.polygons);
  }
  static geometry::CutOutcome cut(const Shape& shape, const io::LineTool& line) { return cut_along(shape, line.path); }
  geometry::CutOutcome cut(const Shape& shape, const io::CrackTool& crack) const {
    return cut_along(shape, across(crack, box_));
  }

  void count(const geometry::CutLedger& ledger) {
    floe_.rounding_defect += ledger.rounding_defect;
    floe_.slivers += ledger.slivers;
    floe_.snap_rounded += ledger.snap_rounded;
    floe_.area_slivers += ledger.area_slivers;
    floe_.removed += ledger.area_slivers;
    // Geometry refuses a cut whose pieces do not sum to their parent exactly; were it ever not so, it shows
    // here.
    if (ledger.exact_defect != "0") floe_.exact_defect = ledger.exact_defect;
  }

  void note_dangling(const io::CutOp& op, double length, const Piece& before, const std::vector<Piece>& after) {
    const auto* line = std::get_if<io::LineTool>(&op.tool);
    if (!line || !(length > 0)) return;
    floe_.dangling_length += length;
    std::vector<Polygon> polygons;
    polygons.reserve(after.size());
    for (const Piece& piece : after) polygons.push_back(piece.shape.polygon);
    const auto found = find_dangling(line->path, before.shape.polygon, polygons);
    floe_.dangling.insert(floe_.dangling.end(), found.begin(), found.end());
  }

  io::CutFloe& floe_;
  std::vector<Piece> pieces_;
  geometry::Box box_{};  ///< of the whole floe, so that a crack is one line for all its pieces
};

}  // namespace

io::CutReport cut_floes(const std::vector<io::FloeEntry>& entries, std::vector<io::CutOp> ops,
                        std::optional<geometry::FillRule> repair_rule) {
  io::CutReport report{std::move(ops), {}, {}};
  const std::vector<std::int64_t> ids = ids_of(entries);
  std::int64_t next_id = ids.empty() ? 0 : 1 + *std::ranges::max_element(ids);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const io::FloeEntry& entry = entries[i];
    io::CutFloe& floe = report.floes.emplace_back();
    floe.floe_id = ids[i];
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
    for (std::size_t number = 0; number < report.ops.size(); ++number) cutter.apply(report.ops[number], number);
    cutter.finish(next_id);
  }
  return report;
}

}  // namespace polynya::app
