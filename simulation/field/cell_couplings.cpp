#include "simulation/field/cell_couplings.hpp"

#include <algorithm>

namespace polynya::simulation {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void CellCouplings::begin(std::size_t cells) {
  neighbours_.first.clear();
  neighbours_.sites.clear();
  gains_.clear();
  growth_.clear();
  neighbours_.first.reserve(cells + 1);
  growth_.reserve(cells);
}

void CellCouplings::begin_cell() {
  neighbours_.first.push_back(gains_.size());
  growth_.push_back(0);
}

void CellCouplings::add(std::uint32_t neighbour, double gain) {
  neighbours_.sites.push_back(neighbour);
  gains_.push_back(gain);
  growth_.back() += gain;
}

/// A cell without neighbours keeps its weight. The hundredth keeps the matrix from being singular.
double CellCouplings::diagonal(std::size_t cell) const {
  return 1.01 * std::max(growth_[cell], 0.1);
}

void CellCouplings::multiply(const std::vector<double>& weights, std::vector<double>& areas) const {
  const auto& [first, sites] = neighbours_;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    double sum = diagonal(i) * weights[i];
    for (std::size_t k = first[i]; k < first[i + 1]; ++k) sum -= gains_[k] * weights[sites[k]];
    areas[i] = sum;
  }
}

std::vector<double> CellCouplings::solve(const std::vector<double>& changes, int iterations) const {
  const std::size_t count = changes.size();
  std::vector<double> solution(count, 0);
  std::vector<double> residual = changes;
  std::vector<double> scaled(count);
  std::vector<double> product(count);
  for (std::size_t i = 0; i < count; ++i) scaled[i] = residual[i] / diagonal(i);
  std::vector<double> direction = scaled;
  double descent = dot(residual, scaled);
  for (int iteration = 0; iteration < iterations && descent > 0; ++iteration) {
    multiply(direction, product);
    const double curvature = dot(direction, product);
    if (!(curvature > 0)) break;
    const double step = descent / curvature;
    for (std::size_t i = 0; i < count; ++i) {
      solution[i] += step * direction[i];
      residual[i] -= step * product[i];
      scaled[i] = residual[i] / diagonal(i);
    }
    const double next = dot(residual, scaled);
    const double turn = next / descent;
    descent = next;
    for (std::size_t i = 0; i < count; ++i) direction[i] = scaled[i] + turn * direction[i];
  }
  return solution;
}

}  // namespace polynya::simulation
