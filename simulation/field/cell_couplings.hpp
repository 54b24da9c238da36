#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape/power_cells.hpp"

namespace polynya::simulation {

/// How the areas of a power diagram's cells answer to the weights of its sites: a cell gains l / 2d from each
/// neighbour per unit by which its own weight is raised above the neighbour's, l the length of their common
/// edge and d the distance of their sites.
class CellCouplings {
 public:
  void begin(std::size_t cells);
  /// Cells come in their order, each with its neighbours, and then the end.
  void begin_cell();
  void add(std::uint32_t neighbour, double gain);
  void end() { neighbours_.first.push_back(gains_.size()); }
  const geometry::NeighbourGuess& neighbours() const { return neighbours_; }

  /// Σ l / 2d of a cell.
  double growth(std::size_t cell) const { return growth_[cell]; }

  /// Changes of all weights that bring about these changes of the areas [m²], to first order: by so many
  /// iterations of conjugate gradients, which do not go far from 0 where the changes do not add up to 0.
  std::vector<double> solve(const std::vector<double>& changes, int iterations) const;

 private:
  void multiply(const std::vector<double>& weights, std::vector<double>& areas) const;
  double diagonal(std::size_t cell) const;

  geometry::NeighbourGuess neighbours_;
  std::vector<double> gains_;  ///< one for each of the neighbours
  std::vector<double> growth_;
};

}  // namespace polynya::simulation
