// Cells against the definition: every point belongs to the site of least power distance.
#include "geometry/shape/power_diagram.hpp"

#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using scenery::Random;

constexpr std::uint64_t kSeed = 91;

std::vector<Site> random_sites(Random& random, int count, double weight) {
  std::vector<Site> sites;
  for (int i = 0; i < count; ++i)
    sites.push_back({{random.between(-3, 7), random.between(100, 104)}, random.between(-weight, weight)});
  return sites;
}

double power(const Site& site, Point p) {
  return squared_length(p - site.point) - site.weight;
}

TEST(PowerDiagram, CellsTileTheBoxAndAreConvex) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  for (int trial = 0; trial < 200; ++trial) {
    const auto sites = random_sites(random, 1 + random.below(60), trial % 3 == 0 ? 0 : 0.3);
    double sum = 0;
    for (const Ring& cell : power_diagram(sites, {{-3, 100}, {7, 104}})) {
      if (cell.empty()) continue;
      sum += signed_area(cell);
      for (std::size_t i = 0; i < cell.size(); ++i) {
        const Point a = cell[i];
        const Point b = cell[(i + 1) % cell.size()];
        ASSERT_GE(cross(b - a, cell[(i + 2) % cell.size()] - b), -1e-12);
      }
    }
    ASSERT_NEAR(sum, 40, 1e-10);
  }
}

TEST(PowerDiagram, EveryPointIsInTheCellOfLeastPowerDistance) {
  Random random(kSeed + 1);
  for (int trial = 0; trial < 100; ++trial) {
    const auto sites = random_sites(random, 2 + random.below(80), trial % 3 == 0 ? 0 : 1.0);
    const auto cells = power_diagram(sites, {{-3, 100}, {7, 104}});
    for (int k = 0; k < 50; ++k) {
      const Point p{random.between(-3, 7), random.between(100, 104)};
      std::size_t nearest = 0;
      double runner_up = INFINITY;
      for (std::size_t i = 1; i < sites.size(); ++i) {
        const double d = power(sites[i], p);
        if (d < power(sites[nearest], p)) {
          runner_up = power(sites[nearest], p);
          nearest = i;
        } else {
          runner_up = std::min(runner_up, d);
        }
      }
      if (runner_up - power(sites[nearest], p) < 1e-9) continue;  // on a boundary, but for rounding
      ASSERT_TRUE(contains({cells[nearest], {}}, p)) << trial << " " << p.x << " " << p.y;
    }
  }
}

TEST(PowerCells, AreThoseOfThePowerDiagramWhateverTheWeights) {
  Random random(kSeed + 2);
  const Ring region{{-3, 100}, {7, 100}, {7, 104}, {-3, 104}};
  for (int trial = 0; trial < 200; ++trial) {
    auto sites = random_sites(random, 2 + random.below(80), 0.3);
    for (Site& site : sites) {  // few of great weight
      if (trial % 2 == 0 && random.below(8) == 0) site.weight += random.between(1, 40);
    }
    const auto cells = power_diagram(sites, {{-3, 100}, {7, 104}});
    std::vector<std::vector<std::uint32_t>> neighbours(sites.size());
    std::size_t next = 0;
    visit_power_cells(sites, region, [&](const PowerCell& cell) {
      ASSERT_EQ(cell.site, next++);
      const double area = cell.ring.empty() ? 0 : signed_area(cell.ring);
      ASSERT_NEAR(area, cells[cell.site].empty() ? 0 : signed_area(cells[cell.site]), 1e-10);
      ASSERT_EQ(cell.ring.size(), cell.beyond.size());
      for (std::size_t k = 0; k < cell.ring.size(); ++k) {
        const Point middle = midpoint(cell.ring[k], cell.ring[(k + 1) % cell.ring.size()]);
        if (cell.beyond[k] == kNoSite) {
          ASSERT_TRUE(middle.x < -3 + 1e-9 || middle.x > 7 - 1e-9 || middle.y < 100 + 1e-9 ||
                      middle.y > 104 - 1e-9);
        } else {  // an edge is as far from the site beyond it
          ASSERT_NEAR(power(sites[cell.beyond[k]], middle), power(sites[cell.site], middle), 1e-9);
        }
      }
    });
    ASSERT_EQ(next, sites.size());
  }
}

TEST(PowerCells, OfTwoSitesInOnePlaceOneHasTheCell) {
  double sum = 0;
  int cells = 0;
  visit_power_cells({{{1, 1}, 0}, {{1, 1}, 0}, {{3, 1}, 0}}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}},
                    [&](const PowerCell& cell) {
                      if (cell.ring.empty()) return;
                      sum += signed_area(cell.ring);
                      ++cells;
                    });
  EXPECT_DOUBLE_EQ(sum, 8);
  EXPECT_EQ(cells, 2);
}

TEST(PowerDiagram, WithoutWeightsTwoSitesMeetAtTheirBisector) {
  const auto cells = power_diagram({{{1, 1}, 0}, {{3, 1}, 0}}, {{0, 0}, {4, 2}});
  EXPECT_DOUBLE_EQ(signed_area(cells[0]), 4);
  const auto weighted = power_diagram({{{1, 1}, 2}, {{3, 1}, 0}}, {{0, 0}, {4, 2}});
  EXPECT_DOUBLE_EQ(signed_area(weighted[0]), 5) << "the bisector moves by (w₁ − w₂) / 2d = 0.5 m";
}

}  // namespace
}  // namespace polynya::geometry
