// `polynya cut` can read the files that it writes. The test makes long chains of cuts of awkward outlines. Every piece
// is written in one of the formats and read back before the next cut. POLYNYA_CHAINED_CUTS sets the number of cuts; the
// ctest label `endurance` runs 20 000.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/text/cut.hpp"
#include "tests/geometry/dice.hpp"

namespace polynya::tests {
namespace {

using geometry::Polygon;
using geometry::trials::Dice;

Dice roll(std::mt19937& random) {
  std::vector<std::uint8_t> bytes(600);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return Dice(std::move(bytes));
}

/// Returns a floe of a difficult kind: needle, comb, spiral, star, tiny or far away.
Polygon roll_outline(std::mt19937& random) {
  for (;;) {
    Dice dice = roll(random);
    Polygon polygon = geometry::normalised(geometry::trials::roll_floe(dice));
    if (!find_defect(polygon)) return polygon;
  }
}

/// Returns a crack, or polygons that cut off both sides. They pass through vertices, beside vertices by an ulp, and
/// along edges.
io::CutOp roll_op(std::mt19937& random, const Polygon& polygon) {
  Dice dice = roll(random);
  const geometry::trials::ManyKnives knives = roll_knives(dice, polygon);
  if (!knives.is_crack) return {io::PolygonTool{knives.polygons}, io::Keep::kBoth};
  const auto line = io::line_tool(knives.crack);
  return line ? io::CutOp{*line} : io::CutOp{io::CrackTool{polygon.outer.front(), 60}};
}

/// Returns the distance to the next larger double. Half of it is the largest error of rounding to nearest; for the
/// smallest doubles that half is not a double itself.
double step_at(double value) {
  return std::nextafter(std::abs(value), std::numeric_limits<double>::infinity()) - std::abs(value);
}

/// Checks that nothing is refused, that every piece is valid and has the nearest double of its area, and that the areas
/// add up to the parent's area exactly. The two terms of the ledger are nearest doubles themselves.
void expect_sound(const io::CutFloe& floe, const Polygon& parent) {
  ASSERT_FALSE(floe.rejected) << floe.rejected->reason << " " << floe.rejected->detail;
  EXPECT_EQ(floe.exact_defect, "0");
  std::vector<const Polygon*> pieces;
  for (const io::CutPiece& piece : floe.pieces) {
    pieces.push_back(&piece.polygon);
    const auto defect = find_defect(piece.polygon);
    ASSERT_FALSE(defect) << name_of(defect->defect);
    ASSERT_EQ(piece.area, exact_area(piece.polygon));
  }
  const Polygon* const before[]{&parent};
  const double terms[]{floe.area_slivers, -floe.rounding_defect};
  const double off = exact_balance(pieces, before, terms);
  EXPECT_LE(2 * std::abs(off), step_at(floe.area_slivers) + step_at(floe.rounding_defect));
}

/// A text of floes that is cut again and again. The output of each cut is the input of the next one.
class Chain {
 public:
  explicit Chain(unsigned seed) : random_(seed) { start(); }

  void step() {
    constexpr io::FloeFormat kFormats[] = {io::FloeFormat::kWkt, io::FloeFormat::kGeojson, io::FloeFormat::kNdjson};
    std::vector<io::FloeEntry> entries = read();
    const Polygon parent = geometry::normalised(entries[random_() % entries.size()].polygon);
    const io::CutOp op = roll_op(random_, parent);
    const io::CutReport report = io::cut_floes(entries, {op}, {});
    for (std::size_t i = 0; i < entries.size(); ++i) {
      expect_sound(report.floes[i], geometry::normalised(entries[i].polygon));
      if (testing::Test::HasFatalFailure()) return;
      cuts_ += report.floes[i].pieces.size() + static_cast<std::size_t>(report.floes[i].slivers) > 1 ? 1 : 0;
      pieces_ += report.floes[i].pieces.size();
      slivers_ += report.floes[i].slivers;
    }
    text_ = to_floe_text(report, kFormats[random_() % 3]);
    if (++generation_ == 40) start();
  }

  std::size_t cuts() const { return cuts_; }
  std::string counts() const {
    return fmt::format("{} cuts in {} outlines, {} pieces written and read back, {} slivers removed", cuts_, outlines_,
                       pieces_, slivers_);
  }
  const std::string& text() const { return text_; }

 private:
  void start() {
    io::CutReport report;
    report.floes.emplace_back().pieces.push_back({.polygon = roll_outline(random_)});
    text_ = to_floe_text(report, io::FloeFormat::kWkt);
    generation_ = 0;
    ++outlines_;
  }

  /// At most five of the floes in the text go on.
  std::vector<io::FloeEntry> read() {
    auto floes = io::read_floe_text(text_);
    if (!floes || floes->entries.empty()) {
      ADD_FAILURE() << (floes ? "no floes" : floes.error()) << " in\n" << text_;
      start();
      return read();
    }
    std::vector<io::FloeEntry>& entries = floes->entries;
    while (entries.size() > 5) entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(random_() % entries.size()));
    return std::move(entries);
  }

  std::mt19937 random_;
  std::string text_;
  std::size_t generation_ = 0;
  std::size_t outlines_ = 0;
  std::size_t cuts_ = 0;
  std::size_t pieces_ = 0;
  int slivers_ = 0;
};

TEST(CutChain, EveryOutputIsAnInput) {
  const char* wanted = std::getenv("POLYNYA_CHAINED_CUTS");
  const auto cuts = static_cast<std::size_t>(wanted != nullptr ? std::atoi(wanted) : 2000);
  Chain chain(2026);
  while (chain.cuts() < cuts) {
    const std::string before = chain.text();
    chain.step();
    if (HasFailure()) {
      ADD_FAILURE() << "at cut " << chain.cuts() << ", of\n" << before;
      break;
    }
  }
  std::printf("%s\n", chain.counts().c_str());
}

}  // namespace
}  // namespace polynya::tests
