// Snap rounding of exact polygons: always valid on even lattices, and no area moved but along the edges.
#include "geometry/cut/internal/snap_rounding.hpp"

#include <cmath>
#include <random>
#include <sstream>

#include <gtest/gtest.h>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/validity.hpp"

namespace polynya::geometry {
namespace {

using exact::Lattice;
using exact::Rational;

// Valid polygons of rationals whose vertices lie near one line, at scales many decades apart: what closed
// paths through such points enclose.
class NearCollinear {
 public:
  explicit NearCollinear(unsigned seed) : random_(seed) {}

  std::vector<exact::Polygon> roll() {
    const double large = std::ldexp(1.0, below(30));
    const double small = std::ldexp(1.0, -below(60));
    const Rational slope(unit_(random_));
    exact::Ring path;
    for (int i = 4 + below(8); i > 0; --i) {
      const double scale = below(2) == 0 ? large : small;
      const Rational x = Rational(scale * unit_(random_)) / 3;
      const Rational aside = Rational(scale * std::ldexp(unit_(random_), -below(70))) / 7;
      path.push_back({x, slope * x + aside});
    }
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, path, 0);
    const auto odd = [](exact::Winding w) { return w.shape % 2 != 0 ? 0 : -1; };
    std::vector<exact::Polygon> polygons;
    for (exact::Region& region : exact::overlay(segments, odd, exact::Seams::kDissolve).regions)
      polygons.push_back(std::move(region.polygon));
    return polygons;
  }

 private:
  int below(int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); }
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{-1, 1};
};

Rational area_of(const std::vector<Polygon>& parts) {
  Rational sum = 0;
  for (const Polygon& part : parts) sum += exact::area(part);
  return sum;
}

// An edge moves by a cell's width at most, at its ends and where it bends.
double most_moved(const exact::Polygon& polygon, const Lattice& lattice) {
  const Polygon near = exact::rounded(polygon);
  double sum = 0;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
      const double width = 2 * lattice.width(size);
      sum += (std::abs(b.x - a.x) + std::abs(b.y - a.y) + 2 * width) * width;
    }
  };
  add(near.outer);
  for (const Ring& hole : near.holes) add(hole);
  return sum;
}

TEST(SnapRounding, EveryPolygonRoundsValidlyOnAnEvenLattice) {
  NearCollinear polygons(11);
  int rounded = 0;
  int parted = 0;
  int vanished = 0;
  for (int trial = 0; trial < 400; ++trial) {
    for (const exact::Polygon& polygon : polygons.roll()) {
      for (const Lattice& lattice : {Lattice::spanning(polygon), Lattice::of_doubles()}) {
        const auto parts = exact::snapped(polygon, lattice);
        if (!parts) {
          ASSERT_EQ(lattice.width(0), Lattice::of_doubles().width(0)) << "on an even lattice it is a theorem";
          continue;
        }
        for (const Polygon& part : *parts) ASSERT_FALSE(find_defect(part));
        const Rational moved = area_of(*parts) - exact::area(polygon);
        ASSERT_LE(std::abs(moved.get_d()), most_moved(polygon, lattice));
        ++rounded;
        parted += parts->size() > 1 ? 1 : 0;
        vanished += parts->empty() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(parted, 5);
  EXPECT_GT(vanished, 50);
  EXPECT_LT(vanished, rounded / 2);
}

TEST(SnapRounding, PartsAreDisjoint) {
  NearCollinear polygons(12);
  int parted = 0;
  while (parted < 20) {
    for (const exact::Polygon& polygon : polygons.roll()) {
      const auto parts = exact::snapped(polygon, Lattice::spanning(polygon));
      ASSERT_TRUE(parts);
      parted += parts->size() > 1 ? 1 : 0;
      for (std::size_t i = 0; i < parts->size(); ++i) {
        for (std::size_t j = 0; j < i; ++j)
          ASSERT_EQ(overlap(Shape{(*parts)[i]}, {}, Shape{(*parts)[j]}, {})->exact_area, "0");
      }
    }
  }
}

// Found by search, once in 65 000 of the polygons above: near the origin cells are so much smaller than at
// the ends of an edge that rounding carries it across a vertex there.
TEST(SnapRounding, EvenCellsHoldWhereThoseOfDoublesDoNot) {
  std::istringstream numbers(
      "-2023397952794725/402653184 -4601680450678489520033245569221/1813388729421943762059264 "
      "-2439564501909967/29710560942849126597578981376 "
      "-38836997709372744294061389673865/936631298338286171944500167451231183251177472 "
      "-3048466398282443/59421121885698253195157962752 "
      "-48530480947188225260623771375597/1873262596676572343889000334902462366502354944 "
      "294993888026485/67108864 4696195919456797228150226771923/2115620184325601055735808 "
      "22254177328761553894287497612803819950888396938638659179/"
      "2140098513935697152958274980860959803901611081728 "
      "354278449440817506320582970921499123521273159535112262093575955996048717/"
      "67467028089278705573468784419258958313156456831129330303543279616 "
      "3754523018573657/402653184 61205143265018249230963182664179751/12998370412496492886440804352 "
      "2282545306967773/402653184 1190700490737113827636548896090036233/415947853199887772366105739264 "
      "-1387846153224797/402653184 -11312132355789648459406930965106733/6499185206248246443220402176 "
      "-262382496549363/2475880078570760549798248448 "
      "-4137975277005998272495078528773/78052608194857180995375013954269265270931456 ");
  exact::Polygon polygon;
  for (exact::Point p; numbers >> p.x >> p.y;) polygon.outer.push_back(p);
  ASSERT_EQ(polygon.outer.size(), 9u);
  EXPECT_FALSE(exact::snapped(polygon, Lattice::of_doubles()));
  const auto parts = exact::snapped(polygon, Lattice::spanning(polygon));
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 1u);
  EXPECT_FALSE(find_defect(parts->front()));
}

TEST(SnapRounding, ANeckNarrowerThanACellParts) {
  // Two squares of 4 m, 8 m apart, joined by a strip of 1e-17 m.
  const Rational thin(1, mpz_class("100000000000000000"));
  const exact::Polygon dumbbell{{{-12, -2},
                                 {-8, -2},
                                 {-8, 0},
                                 {8, 0},
                                 {8, -2},
                                 {12, -2},
                                 {12, 2},
                                 {8, 2},
                                 {8, thin},
                                 {-8, thin},
                                 {-8, 2},
                                 {-12, 2}},
                                {}};
  const auto parts = exact::snapped(dumbbell, Lattice::spanning(dumbbell));
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ(area_of(*parts), 32);
}

TEST(SnapRounding, RingsThatTouchStayTogether) {
  // The hole's corner lies on the edge from (0, 0) to (9, 1/3), at 1/3 of it, and is no double.
  const exact::Polygon polygon{{{0, 0}, {9, Rational(1, 3)}, {9, 9}, {0, 9}},
                               {{{3, Rational(1, 9)}, {2, 4}, {4, 4}}}};
  for (const Lattice& lattice : {Lattice::of_doubles(), Lattice::spanning(polygon)}) {
    const auto parts = exact::snapped(polygon, lattice);
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), 1u);
    ASSERT_EQ(parts->front().holes.size(), 1u);
    EXPECT_EQ(parts->front().outer.size(), 5u) << "the point of touch is a vertex of both";
  }
}

}  // namespace
}  // namespace polynya::geometry
