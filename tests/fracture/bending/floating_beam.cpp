#include "tests/fracture/bending/floating_beam.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include <Eigen/SparseCholesky>

#include "fracture/bending/internal/plate.hpp"
#include "fracture/bending/peak.hpp"

namespace polynya::fracture {
namespace {

constexpr double kBeamLength = 12;  // in l: the tail has decayed by e^{-12/√2} ≈ 2e-4 of the tip's motion

/// A fine uniform mesh under the patch, then elements that grow geometrically from the same size.
std::vector<double> graded_nodes(double patch_length, int elements) {
  const int under_patch = patch_length > 0 ? elements / 4 : 0;
  const double first = patch_length > 0 ? patch_length / under_patch : kBeamLength / (20.0 * elements);
  const int beyond = elements - under_patch;
  double lower = 1e-9,
         upper = 5;  // growth per element by bisection: first · (e^{gn} − 1) / (e^g − 1) = length
  for (int i = 0; i < 100; ++i) {
    const double growth = 0.5 * (lower + upper);
    const double reach = first * std::expm1(growth * beyond) / std::expm1(growth);
    (reach < kBeamLength - patch_length ? lower : upper) = growth;
  }
  std::vector<double> nodes;
  for (int i = 0; i <= under_patch; ++i) nodes.push_back(first * i);
  for (int i = 1; i <= beyond; ++i) nodes.push_back(patch_length + first * std::expm1(lower * i) / std::expm1(lower));
  return nodes;
}

double width(BeamShape shape, double x) {
  return shape == BeamShape::kWedge ? x : 1;
}

/// Line load of a unit tip load spread as uniform pressure over the patch.
double line_load(BeamShape shape, double x, double patch_length) {
  if (x > patch_length) return 0;
  return shape == BeamShape::kWedge ? 2 * x / (patch_length * patch_length) : 1 / patch_length;
}

}  // namespace

BeamResponse solve_floating_beam(BeamShape shape, double patch_length, int elements) {
  assert(elements >= 8 && (patch_length > 0 || shape == BeamShape::kUniform));
  const std::vector<double> nodes = graded_nodes(patch_length, elements);
  const auto size = static_cast<Eigen::Index>(2 * nodes.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(size);
  if (patch_length == 0) load[0] = 1;
  for (std::size_t e = 0; e + 1 < nodes.size(); ++e) {
    for (const auto& [point, weight] : gauss_points(nodes[e], nodes[e + 1])) {
      const HermiteValues n = hermite(nodes[e], nodes[e + 1], point);
      const double b = width(shape, point);
      const double q = patch_length > 0 ? line_load(shape, point, patch_length) : 0;
      for (int i = 0; i < 4; ++i) {
        const auto row = static_cast<Eigen::Index>(2 * e) + i;
        load[row] += weight * q * n.value[i];
        for (int j = 0; j < 4; ++j)
          entries.emplace_back(row, static_cast<Eigen::Index>(2 * e) + j,
                               weight * b * (n.second[i] * n.second[j] + n.value[i] * n.value[j]));
      }
    }
  }
  Eigen::SparseMatrix<double> stiffness(size, size);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(stiffness);
  assert(factor.info() == Eigen::Success);
  const Eigen::VectorXd w = factor.solve(load);

  // A cubic's second derivative is most accurate at the element's two Gauss points.
  std::vector<double> distance, curvature;
  for (std::size_t e = 0; e + 1 < nodes.size(); ++e) {
    for (const double point : stress_points(nodes[e], nodes[e + 1])) {
      const HermiteValues n = hermite(nodes[e], nodes[e + 1], point);
      double second = 0;
      for (int i = 0; i < 4; ++i) second += n.second[i] * w[static_cast<Eigen::Index>(2 * e) + i];
      distance.push_back(point);
      curvature.push_back(second);
    }
  }
  const Peak peak = find_peak(distance, curvature);
  return {w[0], peak.value, peak.place};
}

}  // namespace polynya::fracture
