// Validity against an independent implementation: GEOS's IsValidOp, over random and degenerate polygons. GEOS
// decides with robust orientation predicates, so that the two may differ only by a bug in one of them.
#include <random>

#include <geos_c.h>
#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/validity.hpp"
#include "tests/geometry/dice.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

GEOSGeometry* to_geos_ring(GEOSContextHandle_t geos, const Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(geos, size + 1, 2);
  for (unsigned i = 0; i <= size; ++i) {
    const Point p = ring[i == size ? 0 : i];
    GEOSCoordSeq_setXY_r(geos, sequence, i, p.x, p.y);
  }
  return GEOSGeom_createLinearRing_r(geos, sequence);
}

bool is_valid_to_geos(GEOSContextHandle_t geos, const Polygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (const Ring& hole : polygon.holes) holes.push_back(to_geos_ring(geos, hole));
  GEOSGeometry* whole = GEOSGeom_createPolygon_r(geos, to_geos_ring(geos, polygon.outer), holes.data(),
                                                 static_cast<unsigned>(holes.size()));
  const bool is_valid = GEOSisValid_r(geos, whole) == 1;
  GEOSGeom_destroy_r(geos, whole);
  return is_valid;
}

// Returns a polygon of any kind, some of whose vertices are moved onto other places of its boundary.
Polygon roll_polygon(std::mt19937& random) {
  std::vector<std::uint8_t> bytes(160);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  trials::Dice dice(bytes);
  Polygon polygon = trials::roll_floe(dice);
  if (random() % 2 == 0) {
    const trials::Knife other = trials::roll_knife(dice, polygon);
    polygon.holes.push_back(other.points);
  }
  if (random() % 4 == 0)
    polygon.outer[random() % polygon.outer.size()] = polygon.outer[random() % polygon.outer.size()];
  return normalised(polygon);
}

TEST(Validity, AgreesWithGeos) {
  constexpr unsigned kPeerSeed = 31;
  std::mt19937 random(kPeerSeed);
  GEOSContextHandle_t geos = GEOS_init_r();
  int valid = 0;
  int invalid = 0;
  for (int i = 0; i < 20000; ++i) {
    const Polygon polygon = roll_polygon(random);
    if (polygon.outer.size() < 3) continue;
    if (std::any_of(polygon.holes.begin(), polygon.holes.end(), [](const Ring& hole) { return hole.size() < 3; }))
      continue;
    const bool ours = !find_defect(polygon);
    ++(ours ? valid : invalid);
    ASSERT_EQ(ours, is_valid_to_geos(geos, polygon)) << "seed " << kPeerSeed << " " << trials::to_code(polygon);
  }
  GEOS_finish_r(geos);
  EXPECT_GT(valid, 3000);
  EXPECT_GT(invalid, 3000);
}

}  // namespace
}  // namespace polynya::geometry
