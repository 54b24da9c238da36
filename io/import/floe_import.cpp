#include "io/import/floe_import.hpp"

#include <algorithm>
#include <map>
#include <span>

#include <fmt/format.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"
#include "io/text/problem.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::io {
namespace {

using geometry::Polygon;

/// Polygons whose areas are summed exactly.
using Sum = std::vector<const Polygon*>;

double area_of(const Sum& polygons) {
  return geometry::exact_balance(polygons, {}, {});
}
double change_of(const Polygon& after, const Polygon& before) {
  return geometry::exact_balance(Sum{&after}, Sum{&before}, {});
}
Sum sum_of(const std::vector<Polygon>& polygons) {
  Sum sum;
  for (const Polygon& polygon : polygons) sum.push_back(&polygon);
  return sum;
}

/// The floes of one file on their way.
class FloeImport {
 public:
  FloeImport(std::vector<SourceFloe>& floes, const std::vector<std::string>& refused, const ImportSettings& settings)
      : sources_(floes), refused_(refused), settings_(settings) {}

  ImportOutcome run(PlaneReport plane) {
    outcome_.plane = std::move(plane);
    outcome_.totals.read = sources_.size();
    drawn_.reserve(sources_.size());
    for (std::size_t i = 0; i < sources_.size(); ++i) take(i);
    if (settings_.simplify > 0) simplify();
    trim();
    sum_up();
    return std::move(outcome_);
  }

 private:
  ImportItem& item(std::size_t source) {
    ImportItem& one = items_[source];
    one.source = source;
    return one;
  }

  void take(std::size_t i) {
    drawn_.push_back(geometry::normalised(sources_[i].polygon));
    const Polygon& polygon = drawn_.back();
    if (!refused_[i].empty()) return refuse(i, refused_[i]);
    const auto defect = geometry::find_defect(polygon);
    if (!defect) {
      read_.push_back(i);
      outcome_.floes.push_back({polygon, i});
      return;
    }
    std::string words = fmt::format("{}{}", name_of(defect->defect), places_in_words(defect->places, 3));
    if (!settings_.repair) {
      item(i).is_outline_refused = true;
      return refuse(i, words);
    }
    auto repaired = geometry::repair(rings_of(polygon), *settings_.repair);
    if (!repaired) return refuse(i, words + ": " + repaired.error().detail);
    read_.push_back(i);
    Sum after;
    for (geometry::Shape& shape : repaired->shapes) outcome_.floes.push_back({std::move(shape.polygon), i});
    for (std::size_t k = outcome_.floes.size() - repaired->shapes.size(); k < outcome_.floes.size(); ++k)
      after.push_back(&outcome_.floes[k].polygon);
    ImportItem& note = item(i);
    note.defect = std::move(words);
    note.repaired = geometry::exact_balance(after, Sum{&polygon}, {});
    ++outcome_.totals.repaired;
  }

  void refuse(std::size_t i, std::string why) {
    item(i).refused = std::move(why);
    ++outcome_.totals.refused;
  }

  void simplify() {
    std::vector<Polygon> befores;
    Sum after;
    befores.reserve(outcome_.floes.size());
    for (ImportedFloe& floe : outcome_.floes) {
      Polygon fewer = geometry::simplified(floe.polygon, settings_.simplify);
      if (vertex_count(fewer) == vertex_count(floe.polygon) || geometry::find_defect(fewer)) continue;
      ImportItem& note = item(floe.source);
      if (note.vertices_before == 0) ++outcome_.totals.simplified;
      note.vertices_before += vertex_count(floe.polygon);
      note.vertices_after += vertex_count(fewer);
      note.simplified += change_of(fewer, floe.polygon);
      befores.push_back(std::exchange(floe.polygon, std::move(fewer)));
      after.push_back(&floe.polygon);
    }
    outcome_.totals.area_simplified = geometry::exact_balance(after, sum_of(befores), {});
  }

  void trim() {
    std::vector<Polygon> whole;
    std::vector<std::size_t> source;
    whole.reserve(outcome_.floes.size());
    for (ImportedFloe& floe : outcome_.floes) {
      whole.push_back(std::move(floe.polygon));
      source.push_back(floe.source);
    }
    outcome_.floes.clear();
    std::vector<geometry::Trimmed> trimmed = geometry::make_disjoint(whole, settings_.gap);
    Sum before, after;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      if (trimmed[i].yields.empty() && !trimmed[i].error) continue;
      before.push_back(&whole[i]);
      for (const Polygon& piece : trimmed[i].pieces) after.push_back(&piece);
      note_trim(source[i], whole[i], trimmed[i], source);
    }
    outcome_.totals.area_trimmed = geometry::exact_balance(before, after, {});
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (Polygon& piece : trimmed[i].pieces) keep_or_drop(source[i], std::move(piece));
    outcome_.totals.area_dropped = area_of(sum_of(dropped_));
  }

  void note_trim(std::size_t source, const Polygon& whole, const geometry::Trimmed& trimmed,
                 const std::vector<std::size_t>& sources) {
    ImportItem& note = item(source);
    if (trimmed.error && note.refused.empty()) {
      note.refused = "its overlap was not cut off: " + trimmed.error->detail;
      ++outcome_.totals.refused;
    }
    if (note.yields.empty()) ++outcome_.totals.trimmed;
    for (const std::size_t other : trimmed.yields) note.yields.push_back(sources[other]);
    note.trimmed += geometry::exact_balance(Sum{&whole}, sum_of(trimmed.pieces), {});
  }

  void keep_or_drop(std::size_t source, Polygon piece) {
    const geometry::Measures measures = geometry::measure(piece);
    if (measures.area >= settings_.least_area && simulation::can_be_floe(measures)) {
      outcome_.floes.push_back({std::move(piece), source});
      return;
    }
    ImportItem& note = item(source);
    note.dropped += measures.area;
    ++note.dropped_pieces;
    dropped_.push_back(std::move(piece));
  }

  /// Areas of the items and of all, and how many floes left nothing.
  void sum_up() {
    ImportTotals& totals = outcome_.totals;
    Sum read, written;
    for (const std::size_t i : read_) read.push_back(&drawn_[i]);
    std::vector<std::size_t> pieces(sources_.size());
    for (const ImportedFloe& floe : outcome_.floes) {
      written.push_back(&floe.polygon);
      ++pieces[floe.source];
      if (sources_[floe.source].properties.thickness) ++totals.with_thickness;
      if (const auto found = items_.find(floe.source); found != items_.end())
        found->second.area_after += geometry::measure(floe.polygon).area;
    }
    for (const std::size_t i : read_) {
      if (const auto found = items_.find(i); found != items_.end())
        found->second.area_before = geometry::exact_area(drawn_[i]);
      if (pieces[i] == 0 && items_[i].refused.empty()) ++totals.dropped;
    }
    totals.written = outcome_.floes.size();
    totals.area_read = area_of(read);
    totals.area_written = area_of(written);
    totals.area_change = geometry::exact_balance(written, read, {});
    for (auto& [source, note] : items_) {
      note.pieces = pieces[source];
      totals.area_repaired += note.repaired;
      outcome_.items.push_back(std::move(note));
    }
  }

  std::vector<SourceFloe>& sources_;
  const std::vector<std::string>& refused_;
  const ImportSettings& settings_;
  std::vector<Polygon> drawn_;     ///< as read, in the plane and in house notation
  std::vector<std::size_t> read_;  ///< those not refused
  std::vector<Polygon> dropped_;
  std::map<std::size_t, ImportItem> items_;
  ImportOutcome outcome_;
};

}  // namespace

tl::expected<ImportOutcome, PlaneError> import_floes(std::vector<SourceFloe>& floes, std::vector<std::string> refused,
                                                     const std::string& crs, const ImportSettings& settings) {
  refused.resize(floes.size());
  auto plane = bring_to_plane(floes, refused, crs, settings.plane);
  if (!plane) return tl::unexpected(std::move(plane.error()));
  return FloeImport(floes, refused, settings).run(std::move(*plane));
}

}  // namespace polynya::io
