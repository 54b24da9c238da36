#include "tests/fracture/bending/floating_beam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/SparseLU>

#include "fracture/bending/peak.hpp"

namespace polynya::fracture {

BeamResponse solve_floating_beam(BeamShape shape, const TipLoad& load, double length) {
  constexpr double d = kBeamStep;
  const int intervals = static_cast<int>(std::lround(length / d));
  const bool is_wedge = shape == BeamShape::kWedge;
  const auto width = [&](double x) { return is_wedge ? x : 1; };
  const double slope = load.patch > 0 ? 2 / (load.patch * load.patch) : 0;  // of the line load under the patch
  // The unknowns are w of each node, followed by M.
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * (intervals + 1));
  for (int i = 1; i < intervals; ++i) {
    const int w = 2 * i, m = w + 1;
    const double x = i * d;
    for (const auto& [node, factor] : {std::pair{-1, 1.0}, {0, -2.0}, {1, 1.0}}) {
      entries.emplace_back(w, w + 2 * node, factor * width(x) / (d * d));
      entries.emplace_back(m, m + 2 * node, factor / (d * d));
    }
    entries.emplace_back(w, m, -1);
    entries.emplace_back(m, w, width(x));
    right[m] = slope * x * std::clamp((load.patch - x) / d + 0.5, 0.0, 1.0);
  }
  // At the tip M and M' are given. The difference of M is M' plus the contribution of q − b w over half a step.
  entries.emplace_back(0, 1, 1);
  right[0] = load.moment;
  entries.emplace_back(1, 3, 1 / d);
  entries.emplace_back(1, 1, -1 / d);
  entries.emplace_back(1, 0, is_wedge ? d * d / 6 : d / 2);
  right[1] = load.force + slope * d * d / 6;
  for (const int last : {2 * intervals, 2 * intervals + 1}) entries.emplace_back(last, last, 1);
  Eigen::SparseMatrix<double> matrix(right.size(), right.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd solution = Eigen::SparseLU<Eigen::SparseMatrix<double>>(matrix).solve(right);

  BeamResponse response{.tip_deflection = solution[0]};
  std::vector<double> distances, curvatures;
  for (int i = 0; i <= intervals; ++i) {
    response.moments.push_back(solution[2 * i + 1]);
    if (i == 0) continue;
    distances.push_back(i * d);
    curvatures.push_back(response.moments.back() / width(i * d));
  }
  const Peak peak = find_peak(distances, curvatures);
  response.peak_curvature = peak.value;
  response.peak_distance = peak.place;
  return response;
}

}  // namespace polynya::fracture
