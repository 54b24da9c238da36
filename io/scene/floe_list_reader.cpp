#include "io/scene/floe_list_reader.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/pose.hpp"
#include "io/scene/channel_region.hpp"
#include "io/scene/scene_check.hpp"
#include "io/text/floe_ids.hpp"
#include "io/text/floe_text.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

void open_ring(Ring& ring) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

std::vector<Polygon> floes_of(const LatticeInput& lattice) {
  std::vector<Polygon> floes;
  floes.reserve(static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows));
  const Vector margin = 0.5 * (lattice.pitch - lattice.size);
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      const Vector cell{column * lattice.pitch.x, row * lattice.pitch.y};
      floes.push_back(rectangle(lattice.origin + cell + margin, lattice.size));
    }
  }
  return floes;
}

Polygon floe_of(const RectangleInput& input) {
  Polygon floe = rectangle(input.corner, input.size);
  if (input.angle == 0) return floe;
  const geometry::Pose turned{input.corner, geometry::Rotation::by(input.angle)};
  for (Point& p : floe.outer) p = transform(turned, Point{} + (p - input.corner));
  return floe;
}

using simulation::FloeField;
using simulation::PowerLawSizes;

/// Default concentration between the openings of a field with a law of sizes [-]. A larger value makes fewer and larger
/// openings, and takes longer to fill.
constexpr double kDefaultPacking = 0.75;
constexpr int kCornersWithLaw = 16;  ///< default of the largest number of corners of a floe in such a field

class FieldReader {
 public:
  FieldReader(FieldInput& input, const simulation::Scene& scene, const ReportAt& report)
      : input_(input), scene_(scene), report_(report) {}

  std::optional<FloeField> read() {
    field_ = input_.field;
    const std::size_t problems_before = report_.problems.count();
    const auto is_sound = [&] { return report_.problems.count() == problems_before; };
    choose_sizes();
    set_region();
    field_.seed += scene_.seed;
    for (const geometry::Ring& clear : input_.keep_clear) field_.kept_clear.push_back(in_house_notation({clear, {}}));
    for (std::size_t i = 0; i < hull_count(scene_); ++i) {
      const simulation::PlacedHull& hull = hull_of(scene_, i);
      if (hull.hull.waterline.size() >= 3) field_.kept_clear.push_back(waterline_in_world(hull));
    }
    if (is_sound()) check_rings();
    if (is_sound() && field_.law) check_law();
    return is_sound() ? std::optional(std::move(field_)) : std::nullopt;
  }

 private:
  /// Sets the sizes of the floes, which come from a law or from floe_size_m. Each of the two has its own further keys.
  void choose_sizes() {
    const bool has_size = input_.floe_size.has_value();
    if (has_size == field_.law.has_value())
      report_(has_size ? "sizes" : "", has_size ? "sizes beside floe_size_m" : "neither sizes nor floe_size_m",
              "one of sizes and floe_size_m");
    if (field_.law && input_.size_spread)
      report_("size_spread", "size_spread beside sizes", "sizes with mean_m and spread");
    const auto check_without_law = [&](std::string_view key, bool is_given) {
      if (has_size && is_given) report_(key, fmt::format("{} with floe_size_m", key), "sizes instead");
    };
    check_without_law("aspect", input_.aspect.has_value());
    check_without_law("orientation_deg", input_.orientation.has_value());
    check_without_law("least_corners", input_.least_corners.has_value());
    check_without_law("packing", input_.packing.has_value());
    if (input_.orientation && !input_.aspect)
      report_("orientation_deg", "orientation_deg without aspect", "both, or neither");
    field_.orientation = input_.orientation;
    if (field_.law)
      complete_law();
    else
      complete_sizes();
  }

  /// Returns the value, after setting it to the default if it was not given.
  template <class Value>
  static Value filled_in(std::optional<Value>& given, Value otherwise) {
    if (!given) given = otherwise;
    return *given;
  }

  void complete_sizes() {
    field_.floe_size = input_.floe_size.value_or(field_.floe_size);
    field_.size_spread = filled_in(input_.size_spread, field_.size_spread);
    field_.most_corners = filled_in(input_.most_corners, field_.most_corners);
  }

  void complete_law() {
    const double packing = std::max(field_.concentration, std::min(kDefaultPacking, 2 * field_.concentration));
    field_.aspect = input_.aspect.value_or(field_.aspect);
    field_.most_corners = filled_in(input_.most_corners, kCornersWithLaw);
    field_.least_corners = filled_in(input_.least_corners, field_.least_corners);
    field_.packing = filled_in(input_.packing, packing);
    if (field_.least_corners > field_.most_corners)
      report_("least_corners", fmt::format("{}, more than most_corners", field_.least_corners),
              fmt::format("at most {}", field_.most_corners));
    if (field_.packing < field_.concentration)
      report_("packing", fmt::format("{:g}, less than the concentration", field_.packing),
              fmt::format("at least {:g}: floes, and the holes among them that further floes would fill",
                          field_.concentration));
  }

  void set_region() {
    const auto* rectangle_of = std::get_if<FieldRectangle>(&input_.region);
    field_.is_rectangle = rectangle_of != nullptr;
    if (rectangle_of) {
      field_.region = rectangle(rectangle_of->corner, rectangle_of->extent).outer;
    } else if (const auto* outline = std::get_if<FieldOutline>(&input_.region)) {
      field_.region = in_house_notation({outline->ring, {}}).outer;
    } else {
      set_channel(std::get<FieldChannel>(input_.region));
    }
  }

  void set_channel(const FieldChannel& channel) {
    const auto& line = channel.centreline;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i] == line[i - 1])
        return report_("centreline_m", fmt::format("point {} a second time", i), "points that differ");
    }
    ChannelRegion region = channel_region(line, channel.width);
    if (region.too_sharp >= 0)
      return report_(
          "centreline_m",
          fmt::format("a bend at point {} that is too sharp for {:g} m of width", region.too_sharp + 1, channel.width),
          "longer legs, wider angles or less width");
    field_.region = std::move(region.outline);
    field_.parts = std::move(region.parts);
  }

  void check_ring(const geometry::Ring& ring, const std::string& key) {
    if (const auto defect = geometry::find_defect({ring, {}}))
      report_(key, "an invalid ring: " + describe(*defect), "a simple ring");
  }
  void check_rings() {
    if (!field_.is_rectangle)
      check_ring(field_.region, std::holds_alternative<FieldOutline>(input_.region) ? "outline_m" : "centreline_m");
    for (std::size_t i = 0; i < input_.keep_clear.size(); ++i)
      check_ring(field_.kept_clear[i].outer, fmt::format("keep_clear_m[{}]", i));
  }

  /// Returns the width of the region, which roughly limits the width of a floe [m].
  double width_of_region() const {
    if (const auto* channel = std::get_if<FieldChannel>(&input_.region)) return channel->width;
    const geometry::Box box = bounding_box(field_.region);
    return std::min(box.high.x - box.low.x, box.high.y - box.low.y);
  }

  void check_law() {
    const auto* power = std::get_if<PowerLawSizes>(&*field_.law);
    if (power && power->least >= power->largest)
      return report_("sizes.least_m", fmt::format("{:g}, not below largest_m", power->least),
                     fmt::format("less than {:g}", power->largest));
    const double count = simulation::floe_count(field_);
    const double width = width_of_region();
    // The largest floe of a power law is stated. A log-normal law has no upper limit, so the largest floe expected
    // among `count` is taken.
    const double largest = power ? power->largest : simulation::size_at(*field_.law, 1 - 0.5 / std::max(count, 1.0));
    if (largest > width) {
      const std::string_view key = power ? "sizes.largest_m" : "sizes";
      return report_(
          key, fmt::format("floes of up to {:.4g} m in a region {:.4g} m across", largest, width),
          power ? fmt::format("at most {:.4g}, or a wider region", width) : "smaller floes, or a wider region");
    }
  }

  FieldInput& input_;
  const simulation::Scene& scene_;
  const ReportAt& report_;  ///< reports at the entry's "field"
  FloeField field_;
};

/// Says what would allow the field to reach its concentration.
std::string remedy(const FloeField& field, const simulation::FloeFieldOutcome& outcome) {
  const double reachable = outcome.reachable_concentration;
  if (!field.law) return fmt::format("at most {:.3g} with this gap_m", reachable);
  const std::string most = fmt::format("at most {:.3g} with these sizes", std::floor(1000 * reachable) / 1000);
  const double room = outcome.reachable_without_gap - field.concentration;
  const double taken = outcome.reachable_without_gap - reachable;
  if (room > 0 && taken > 0)
    return fmt::format("{}, or a gap_m of at most {:.2g}", most, 0.95 * field.gap * room / taken);
  return fmt::format("{}, or most_corners above {}", most, field.most_corners);
}

/// Reports at its key a cover that the field did not reach. Returns true if it reached it.
bool check_cover(const FloeField& field, const simulation::FloeFieldOutcome& outcome, const ReportAt& report,
                 std::string_view key) {
  if (field.law && outcome.region_area <= 0) {
    report("", "no room: all of the region is kept clear", "a region with free water");
    return false;
  }
  if (outcome.reachable_concentration >= field.concentration) return true;
  report(key, fmt::format("{:g}", field.concentration), remedy(field, outcome));
  return false;
}

/// A floe file that was read for a scene.
struct FloeFile {
  std::size_t source = 0;  ///< index in the ProblemCollector's sources
  std::vector<FileFloe> floes;
  FileReport report;  ///< report without its group
};

std::string origin_in_scene(double latitude, double longitude) {
  return fmt::format(R"("origin": {{"latitude_deg": {:.6g}, "longitude_deg": {:.6g}}} in the scene)", latitude,
                     longitude);
}

/// Returns the words between commas.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for_pieces(text, ',', [&words](std::string_view piece, std::size_t) {
    if (const auto word = trimmed(piece); !word.empty()) words.push_back(word);
  });
  return words;
}

/// Reads a floe file of a scene and projects it to the plane about the scene's origin. The file is GeoJSON, or GDAL
/// converts it (io/import/floe_import.hpp). Each object reads one file. `offset` is that of the entry's `file` in the
/// scene.
class FloeFileReader {
 public:
  FloeFileReader(const std::optional<FileImport>& import, std::string path, std::uint32_t offset,
                 ProblemCollector& problems)
      : is_imported_(import.has_value()),
        import_(import.value_or(FileImport{})),
        path_(std::move(path)),
        offset_(offset),
        problems_(problems) {}

  /// Returns the file; nothing if there are problems of the file or the entry, which are reported.
  std::optional<FloeFile> read(const FloeFiles& files, const std::string& name,
                               const std::optional<simulation::GeographicOrigin>& origin) {
    const std::size_t before = problems_.count();
    if (origin && !import_.settings.plane.target.empty())
      report_entry("import.crs in a scene that has an origin", "one of the two: the scene has one plane");
    if (origin && import_.settings.plane.is_shifted)
      report_entry("import.shift in a scene that has an origin",
                   "one of the two: floes lie about the scene's origin where they lie on the Earth");
    auto file = text_of(files, name);
    if (!file) {
      const FloeFileFailure& failure = file.error();
      report_entry(fmt::format("\"{}\": {}", failure.shown, failure.words),
                   failure.is_name ? std::string("a floe file in the scene's folder or below")
                                   : fmt::format("a floe file of at most {} bytes", kLongestFloesFile));
      return {};
    }
    result_.source = problems_.add_source({file->shown, std::move(file->text)});
    PropertyRules rules{
        .names = {}, .no_data = import_.no_data, .no_data_in_words = R"("nodata": [{}] in its "import")"};
    for (const std::string_view words : words_of(import_.properties))
      if (auto added = add_property_name(words, rules.names); !added)
        report_entry(added.error(), "KEY=NAME, as thickness_m=THICK or thickness_m=CM*0.01");
    auto read = read_floe_text(problems_.source(result_.source).text);
    if (!read) report_entry(fmt::format("\"{}\":{}", file->shown, read.error()), "a floe file (docs/import.md)");
    if (problems_.count() > before) return {};
    text_ = *std::move(read);
    place_ = {is_foreign_ ? system_ : system_of(text_), text_.place};
    select();
    FloesOfText floes = floes_of(text_, rules);
    result_.report = {.run_time = floes.run_time,
                      .near_misses = std::move(floes.near_misses),
                      .notes = std::move(notes_),
                      .offset = offset_};
    std::ranges::copy(floes.notes, std::back_inserter(result_.report.notes));
    note_ids(floes.floes);
    place(floes.floes, plane_of(origin));
    if (problems_.count() > before) return {};
    return std::move(result_);
  }

 private:
  tl::expected<FloeFileText, FloeFileFailure> text_of(const FloeFiles& files, const std::string& name) {
    Selection selection = import_.selection;
    selection.layer_in_words = R"("layer": NAME in its "import")";
    auto file = files(name, selection);
    if (!file || !file->is_foreign) return file;
    is_foreign_ = true;
    system_ = std::move(file->system);
    notes_ = std::move(file->notes);
    return file;
  }

  /// Selects the features that the entry asks for, unless GDAL has already done so.
  void select() {
    if (is_foreign_) return;
    const Selection& selection = import_.selection;
    if (!selection.layer.empty())
      report_entry(fmt::format("import.layer \"{}\"", selection.layer), "no layer of GeoJSON, NDJSON and WKT");
    if (selection.where.empty()) return;
    auto taken = select_features(text_, selection.where);
    if (taken)
      notes_.push_back(*std::move(taken));
    else
      report_entry("import.where: " + taken.error(), "a condition on the features' properties: POLY_TYPE = 'I'");
  }

  /// Notes ids of the file that cannot be used, because floes of a scene have numbers only.
  void note_ids(const std::vector<SourceFloe>& floes) {
    std::vector<GivenId> ids;
    for (std::size_t i = 0; i < floes.size(); ++i) {
      GivenId id{floes[i].properties.floe_id, text_.entries[i].other_id};
      if (id.number) id.other = {};
      ids.push_back(std::move(id));
    }
    if (const std::string why = why_ids_are_replaced(ids); !why.empty())
      result_.report.notes.push_back(fmt::format(
          "floe_id: {}; the run knows floes by their own numbers, polynya import keeps such ids as source_id", why));
  }

  /// Returns true if the property area_m2 of the features equals the area of their coordinates, so that these are
  /// metres however small the floes are.
  bool are_metres() const {
    CoordinateEvidence evidence;
    for (const FloeEntry& entry : text_.entries) evidence.add(entry.polygon);
    return text_.stated_area > 0 && std::abs(text_.stated_area - evidence.area) <= 1e-3 * evidence.area;
  }

  PlaneSettings plane_of(const std::optional<simulation::GeographicOrigin>& origin) const {
    PlaneSettings plane = import_.settings.plane;
    if (plane.target.empty()) plane.origin = origin;
    plane.are_metres = are_metres();
    plane.origin_in_words = origin_in_scene;
    plane.shift_in_words = R"("import": {"shift": true} beside "file" moves them to the middle of the plane, )"
                           "an origin in the scene projects them about a place";
    plane.source_in_words = R"("import": {"from": "EPSG:n"} beside "file" names it)";
    return plane;
  }

  void place(std::vector<SourceFloe>& floes, PlaneSettings plane) {
    const auto offset_of = [&](std::size_t floe) { return text_.entries[floe].offset; };
    if (!is_imported_) {
      auto placed = bring_to_plane(floes, place_, plane);
      if (!placed) return report(placed.error());
      for (std::size_t i = 0; i < floes.size(); ++i) {
        if (!floes[i].refused.empty()) report({i, floes[i].refused});
        result_.floes.push_back({in_house_notation(std::move(floes[i].polygon)), floes[i].properties, offset_of(i)});
      }
      result_.report.plane = std::move(*placed);
      return;
    }
    ImportSettings settings = import_.settings;
    settings.plane = std::move(plane);
    auto imported = import_floes(floes, place_, settings);
    if (!imported) return report(imported.error());
    for (const ImportItem& item : imported->items) {
      if (item.refused.empty()) continue;
      report({item.source, item.refused + (item.is_outline_refused ? R"(; "repair": "non-zero" in its "import")"
                                                                     " makes a valid polygon of it"
                                                                   : "")});
    }
    result_.report.plane = std::move(imported->plane);
    result_.report.totals = imported->totals;
    for (ImportedFloe& floe : imported->floes)
      result_.floes.push_back({std::move(floe.polygon), floes[floe.source].properties, offset_of(floe.source)});
  }

  void report(const PlaneError& error) {
    const std::uint32_t offset = error.floe ? text_.entries[*error.floe].offset : 0;
    const std::string path = error.floe ? fmt::format("{} (its floe {})", path_, *error.floe) : path_;
    problems_.add(result_.source, offset, {.path = path, .sentence = error.words});
  }

  void report_entry(std::string found, std::string allowed) {
    problems_.report(0, offset_, path_, std::move(found), std::move(allowed));
  }

  const bool is_imported_;
  const FileImport import_;
  std::string path_;
  std::uint32_t offset_;
  ProblemCollector& problems_;
  FloeText text_;
  FilePlace place_;
  bool is_foreign_ = false;  ///< true if GDAL has read the file
  std::string system_;       ///< coordinate system of a file that GDAL has read
  std::vector<std::string> notes_;
  FloeFile result_;
};

}  // namespace

Polygon rectangle(Point corner, Vector size) {
  return {{corner, {corner.x + size.x, corner.y}, corner + size, {corner.x, corner.y + size.y}}, {}};
}

Polygon in_house_notation(Polygon polygon) {
  open_ring(polygon.outer);
  if (geometry::signed_area(polygon.outer) < 0) std::ranges::reverse(polygon.outer);
  for (Ring& hole : polygon.holes) {
    open_ring(hole);
    if (geometry::signed_area(hole) > 0) std::ranges::reverse(hole);
  }
  return polygon;
}

void FloeListReader::add(std::size_t index, FloeGroup group, const JsonValue& item) {
  index_ = index;
  item_ = &item;
  path_ = fmt::format("floes[{}]", index);
  group_ = std::move(group);
  member_ = 0;
  check_fast_ice(group_.is_fast);
  auto ice_of_group = GroupIce::of(draft_.scene, group_, item, path_, problems_);
  if (!ice_of_group) return;
  ice_ = std::move(*ice_of_group);
  std::visit([&](auto& form) { add_floes(form); }, group_.form);
  std::ranges::move(ice_.reports(index), std::back_inserter(loaded_.ice));
}

/// Reports fast ice that turns, and fast ice with the impulse law, which does not define an impulse between two bodies
/// of prescribed motion.
void FloeListReader::check_fast_ice(bool is_fast) {
  if (!is_fast) return;
  if (group_.is_fast && group_.angular_velocity != 0)
    report("angular_velocity_deg_per_s", fmt::format("{:g}, of fast ice", from_si("°", group_.angular_velocity)),
           "0: fast ice does not turn");
  if (draft_.scene.contact.law == simulation::ContactLaw::kImpulse)
    report("fast_ice", "true with contact.law impulse", "contact.law crush, or false");
}

void FloeListReader::add_all(std::vector<Polygon> floes, bool are_known_valid) {
  const bool are_numbered =
      std::holds_alternative<LatticeInput>(group_.form) || std::holds_alternative<FieldInput>(group_.form);
  int member = 0;
  for (Polygon& floe : floes)
    add_floe(group_, std::move(floe), {},
             {.offset = item_->offset,
              .group = index_,
              .member = are_numbered ? member++ : -1,
              .is_known_valid = are_known_valid});
  written.items().push_back(write(kFloesDescription, group_));
}

void FloeListReader::add_floes(const LatticeInput& lattice) {
  const bool is_too_wide = (lattice.size.x > lattice.pitch.x && lattice.columns > 1) ||
                           (lattice.size.y > lattice.pitch.y && lattice.rows > 1);
  if (is_too_wide)
    report("lattice.size_m", fmt::format("{} × {} m, more than the pitch", lattice.size.x, lattice.size.y),
           fmt::format("at most pitch_m, {} × {} m, or neighbours overlap", lattice.pitch.x, lattice.pitch.y));
  const auto count = static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows);
  if (!is_too_wide && has_room_for(count, path_)) add_all(floes_of(lattice), true);
}

void FloeListReader::add_floes(const RectangleInput& rectangle) {
  if (has_room_for(1, path_)) add_all({floe_of(rectangle)}, true);
}

void FloeListReader::add_floes(const Polygon& polygon) {
  if (has_room_for(1, path_)) add_all({in_house_notation(polygon)}, false);
}

std::optional<simulation::FloeFieldOutcome> FloeListReader::make_field(FieldInput& input,
                                                                       const ReportAt& report_field) {
  const auto field = FieldReader(input, draft_.scene, report_field).read();
  if (!field) return std::nullopt;
  const double count = simulation::floe_count(*field);
  if (count < 1) {
    report_field("", "room for less than one floe", "a region for some floes of that size at the concentration");
    return std::nullopt;
  }
  if (!has_room_for(static_cast<std::size_t>(std::min(count, 1e9)), report_field.path)) return std::nullopt;
  // Making a million floes takes half a minute, which is not worth it for a scene that is refused.
  if (problems_.count() > 0) return std::nullopt;
  simulation::FloeFieldOutcome outcome = simulation::make_floe_field(*field);
  const bool is_channel = std::holds_alternative<ChannelInput>(group_.form);
  if (!check_cover(*field, outcome, report_field, is_channel ? "cover" : "concentration")) return std::nullopt;
  return outcome;
}

void FloeListReader::add_floes(FieldInput& input) {
  auto outcome = make_field(input, {problems_, *item_->find("field"), path_ + ".field"});
  if (!outcome) return;
  add_all(std::exchange(outcome->floes, {}), true);
  loaded_.fields.push_back({index_, input.field.gap, *std::move(outcome), {}});
}

bool FloeListReader::has_room_for(std::size_t count, const std::string& path) {
  if (draft_.scene.floes.size() + count <= kMostFloes) return true;
  problems_.report(0, item_->offset, path, fmt::format("{} floes in all", draft_.scene.floes.size() + count),
                   fmt::format("at most {}", kMostFloes));
  return false;
}

void FloeListReader::add_floes(const FileInput& input) {
  const std::string path = path_ + ".file";
  const std::uint32_t name = nearest_offset(*item_, "file");
  auto file = FloeFileReader(input.import, path, name, problems_).read(files_, input.name, draft_.scene.origin);
  if (!file || !has_room_for(file->floes.size(), path)) return;
  FileReport& came = file->report;
  came.place = place_in_words(came.plane);
  check_places(came, name);
  came.group = index_;
  came.floes = file->floes.size();
  const auto is_fast = [](const FileFloe& floe) { return floe.properties.is_fast.value_or(false); };
  check_fast_ice(!group_.is_fast && std::ranges::any_of(file->floes, is_fast));
  for (std::size_t i = 0; i < file->floes.size(); ++i) {
    FileFloe& floe = file->floes[i];
    FloeGroup entry = spelled_out(floe, came.run_time.has_value());
    add_floe(entry, std::get<Polygon>(entry.form), floe.properties,
             {.source = file->source,
              .offset = floe.offset,
              .group = index_,
              .member = static_cast<int>(i),
              .is_known_valid = came.totals.has_value()});
    entry.ice = ice_.spelled_out(draft_.scene, floe.properties);
    written.items().push_back(write(kFloesDescription, entry));
    if (floe.properties.thickness) ++came.with_thickness;
  }
  loaded_.files.push_back(std::move(came));
}

/// Reports floe files in metres of different planes, because their coordinates then do not give their true relative
/// positions.
void FloeListReader::check_places(const FileReport& came, std::uint32_t offset) {
  if (draft_.scene.origin || came.place.empty()) return;
  const auto other = std::ranges::find_if(
      loaded_.files, [&](const FileReport& file) { return !file.place.empty() && file.place != came.place; });
  if (other == loaded_.files.end()) return;
  problems_.report(0, offset, path_ + ".file", "metres of " + came.place,
                   fmt::format("those of floes[{}].file, which are of {}; with an \"origin\" in the scene each file "
                               "is brought to its plane",
                               other->group, other->place));
}

/// Returns the entry by which the resolved scene represents one floe of a file. Values of the file replace those of the
/// file's entry. The polygon of the floe is moved there.
FloeGroup FloeListReader::spelled_out(FileFloe& floe, bool is_of_run) const {
  const FloeProperties& own = floe.properties;
  const simulation::WaterSettings& water = draft_.scene.water;
  const dynamics::ShearCurrent shear = simulation::current_of(water.shear);
  FloeGroup entry{.is_fast = group_.is_fast || own.is_fast.value_or(false),
                  .velocity = group_.velocity,
                  .angular_velocity = group_.angular_velocity,
                  .has_crushed_overlaps = group_.has_crushed_overlaps,
                  .source_floe = group_.source_floe,
                  .under_hull_of = own.under_hull_of ? own.under_hull_of : group_.under_hull_of,
                  .under_hull_path = own.under_hull_path ? own.under_hull_path : group_.under_hull_path};
  if (own.velocity_x || own.velocity_y) {
    geometry::Vector velocity{own.velocity_x.value_or(0), own.velocity_y.value_or(0)};
    if (!entry.is_fast)  // the scene's velocity is relative to the water at that place
      velocity -= water.drift_at(0) + shear.velocity_at(geometry::measure(floe.polygon).centroid);
    entry.velocity = {velocity.x + 0.0, velocity.y + 0.0};  // adding 0.0 turns −0 into 0
  }
  if (own.angular_velocity)
    entry.angular_velocity =
        entry.is_fast ? 0 : to_si("°/s", *own.angular_velocity - from_si("°/s", shear.angular_velocity()));
  if (is_of_run && !entry.has_crushed_overlaps) entry.has_crushed_overlaps = true;
  if (!entry.source_floe) entry.source_floe = own.floe_id;
  entry.form = std::move(floe.polygon);
  return entry;
}

/// Returns the index of the ship under whose hull a floe is. If there is no such ship with a draught, reports it and
/// returns −1.
int FloeListReader::ship_over(const std::string& name, const Origin& origin) {
  const auto& ships = draft_.scene.ships;
  const auto ship = std::ranges::find(ships, name, &simulation::Ship::name);
  if (ship != ships.end() && ship->hull.draught > 0) return static_cast<int>(ship - ships.begin());
  problems_.report(origin.source, origin.offset, path_ + ".under_hull_of", show({name}),
                   "the name of a ship with a hull.draught_m");
  return -1;
}

void FloeListReader::add_floe(const FloeGroup& group, geometry::Polygon polygon, const FloeProperties& given,
                              Origin origin) {
  const std::int32_t own_ice = ice_.add_to(draft_.scene, given);
  draft_.scene.floes.push_back({std::move(polygon), group.velocity, group.angular_velocity, group.is_fast, own_ice,
                                group.has_crushed_overlaps.value_or(false), group.source_floe.value_or(-1),
                                group.under_hull_of ? ship_over(*group.under_hull_of, origin) : -1,
                                group.under_hull_path.value_or(0)});
  draft_.floe_origins.push_back(origin);
}

}  // namespace polynya::io
