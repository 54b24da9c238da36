#pragma once

#include <vector>

#include "io/run/run_reader.hpp"

namespace polynya::analysis {

/// Floes of sizes (√area, as the fracture criteria have it) from `from` to below `below`.
struct SizeClass {
  double from = 0, below = 0;  ///< [m]
  std::size_t count = 0;
  double area = 0;          ///< of those floes [m²]
  std::size_t from_on = 0;  ///< how many are in it or in larger classes
};

struct SizedFloe {
  double size = 0;  ///< [m]
  double area = 0;  ///< what its class adds up [m²]
};
/// Classes of 1, 2, 5 × 10ⁿ m from the least floe's to the largest's; the floes ascend by size.
std::vector<SizeClass> size_classes(const std::vector<SizedFloe>& floes);

struct SizeDistribution {
  double time = 0;  ///< [s]
  std::size_t count = 0;
  std::size_t without_size = 0;               ///< left out: their recorded area is not a positive number
  double area = 0;                            ///< of all [m²]
  double least = 0, median = 0, largest = 0;  ///< [m]
  std::vector<SizeClass> classes;
};
/// Of the floes alive at a time [s].
SizeDistribution size_distribution(const io::Run& run, double time);

}  // namespace polynya::analysis
