// What `polynya cut` writes it reads: long chains of cuts of awkward outlines, every piece written in one of
// the formats and read back before the next cut. POLYNYA_CHAINED_CUTS sets how many; the ctest label
// `endurance` runs 20 000.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/ice/cut_floes.hpp"
#include "geometry/cut/repair.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::tests {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

class Rolls {
 public:
  explicit Rolls(unsigned seed) : random_(seed) {}
  std::size_t below(std::size_t count) { return random_() % count; }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  /// The value or a double up to four steps from it.
  double near(double value) {
    const double far = std::numeric_limits<double>::infinity();
    const double towards = below(2) == 0 ? far : -far;
    for (std::size_t steps = below(5); steps > 0; --steps) value = std::nextafter(value, towards);
    return value;
  }
  Point near(Point p) { return {near(p.x), near(p.y)}; }

 private:
  std::mt19937 random_;
};

/// A ring around a point whose edges carry vertices on them but for rounding, and vertices a few steps from
/// others.
Ring crowded_ring(Rolls& rolls, Point centre, double radius) {
  Ring corners;
  const std::size_t count = 3 + rolls.below(9);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double r = radius * rolls.between(0.3, 1);
    corners.push_back(centre + Vector{r * std::cos(angle), r * std::sin(angle)});
  }
  Ring ring;
  for (std::size_t i = 0; i < count; ++i) {
    const Point a = corners[i];
    const Vector along = corners[(i + 1) % count] - a;
    ring.push_back(a);
    if (rolls.below(3) == 0) ring.push_back(rolls.near(a));
    double t = 0;
    for (std::size_t k = rolls.below(4); k > 0; --k) {
      t += (1 - t) * rolls.between(0, 0.6);
      ring.push_back(rolls.near(a + t * along));
      if (rolls.below(3) == 0) ring.push_back(rolls.near(ring.back()));
    }
  }
  return ring;
}

Polygon roll_outline(Rolls& rolls) {
  for (;;) {
    constexpr Point kPlaces[] = {{0, 0}, {100, 40}, {-3, 2500}, {412345.6, 7654321.1}};
    const Point centre = kPlaces[rolls.below(4)];
    const double radius = std::pow(10.0, rolls.between(0, 3));
    Polygon polygon{crowded_ring(rolls, centre, radius), {}};
    if (rolls.below(3) == 0) polygon.holes.push_back(crowded_ring(rolls, centre, 0.2 * radius));
    polygon = geometry::normalised(polygon);
    if (!find_defect(polygon)) return polygon;
  }
}

Point a_vertex(Rolls& rolls, const Polygon& polygon) {
  const std::size_t r = rolls.below(polygon.holes.size() + 1);
  const Ring& ring = r == 0 ? polygon.outer : polygon.holes[r - 1];
  return ring[rolls.below(ring.size())];
}

/// By the path, or through its first point where it has no length.
io::CutOp line(const Ring& path) {
  const auto tool = io::line_tool(path);
  return tool ? io::CutOp{*tool} : io::CutOp{io::CrackTool{path.front(), 60}};
}

/// Through vertices, beside them by some steps, along edges, from vertex to vertex and beyond.
io::CutOp roll_op(Rolls& rolls, const Polygon& polygon) {
  const Point a = a_vertex(rolls, polygon);
  Point b = a_vertex(rolls, polygon);
  const geometry::Box box = bounding_box(polygon.outer);
  const double size = std::max(length(box.high - box.low), 1e-300);
  if (b == a) b = a + size * Vector{rolls.between(-1, 1), rolls.between(-1, 1)};
  while (b == a) b = rolls.near(a);
  switch (rolls.below(6)) {
    case 0:
      return line({a, b});
    case 1:
      return line({rolls.near(a - 2 * (b - a)), rolls.near(b + 2 * (b - a))});
    case 2:
      return {io::CrackTool{a, rolls.between(-180, 180)}};
    case 3: {
      const Vector aside = size * Vector{rolls.between(-1, 1), rolls.between(-1, 1)};
      return line({rolls.near(a) - aside, a, rolls.near(b), b + aside});
    }
    case 4: {
      const double radius = rolls.below(2) == 0 ? distance(a, b) : 0.3 * size * rolls.between(0.01, 1);
      const auto disc = io::disc_tool({a.x, a.y, radius}, 0);  // none where doubles leave it no room
      return disc ? io::CutOp{*disc, io::Keep::kBoth} : line({a, b});
    }
    default: {
      const std::size_t i = rolls.below(polygon.outer.size());
      const Point from = polygon.outer[i];
      const Point to = polygon.outer[(i + 1) % polygon.outer.size()];
      return line({rolls.near(from - (to - from)), rolls.near(to + (to - from))});
    }
  }
}

double half_step(double value) {
  return (std::nextafter(std::abs(value), std::numeric_limits<double>::infinity()) - std::abs(value)) / 2;
}

/// Nothing refused; every piece valid, not a point, and its area the nearest double; and areas that sum to
/// the parent's, exactly: the two terms of the ledger are nearest doubles themselves.
void expect_sound(const io::CutFloe& floe, const Polygon& parent) {
  ASSERT_FALSE(floe.rejected) << floe.rejected->reason << " " << floe.rejected->detail;
  EXPECT_EQ(floe.exact_defect, "0");
  std::vector<const Polygon*> pieces;
  for (const io::CutPiece& piece : floe.pieces) {
    pieces.push_back(&piece.polygon);
    const auto defect = find_defect(piece.polygon);
    ASSERT_FALSE(defect) << name_of(defect->defect);
    ASSERT_EQ(piece.area, exact_area(piece.polygon));
    ASSERT_GT(piece.area, 0);
  }
  const Polygon* const before[]{&parent};
  const double terms[]{floe.area_slivers, -floe.rounding_defect};
  const double off = exact_balance(pieces, before, terms);
  EXPECT_LE(std::abs(off), half_step(floe.area_slivers) + half_step(floe.rounding_defect));
}

/// A text of floes, cut again and again; what comes out of a cut goes back in as it was written.
class Chain {
 public:
  explicit Chain(unsigned seed) : rolls_(seed) { start(); }

  void step() {
    constexpr io::FloeFormat kFormats[] = {io::FloeFormat::kWkt, io::FloeFormat::kGeojson,
                                           io::FloeFormat::kNdjson};
    std::vector<io::FloeEntry> entries = read();
    const Polygon parent = geometry::normalised(entries[rolls_.below(entries.size())].polygon);
    const io::CutOp op = roll_op(rolls_, parent);
    const io::CutReport report = app::cut_floes(entries, {op}, {});
    for (std::size_t i = 0; i < entries.size(); ++i) {
      expect_sound(report.floes[i], geometry::normalised(entries[i].polygon));
      if (testing::Test::HasFatalFailure()) return;
      cuts_ += report.floes[i].pieces.size() + static_cast<std::size_t>(report.floes[i].slivers) > 1 ? 1 : 0;
      pieces_ += report.floes[i].pieces.size();
      slivers_ += report.floes[i].slivers;
    }
    text_ = to_floe_text(report, kFormats[rolls_.below(3)]);
    if (++generation_ == 40) start();
  }

  std::size_t cuts() const { return cuts_; }
  std::string counts() const {
    return fmt::format("{} cuts in {} outlines, {} pieces written and read back, {} slivers removed", cuts_,
                       outlines_, pieces_, slivers_);
  }
  const std::string& text() const { return text_; }

 private:
  void start() {
    io::CutReport report;
    report.floes.emplace_back().pieces.push_back({.polygon = roll_outline(rolls_)});
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
    while (entries.size() > 5)
      entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(rolls_.below(entries.size())));
    return std::move(entries);
  }

  Rolls rolls_;
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
