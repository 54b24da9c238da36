#include "dynamics/internal/jam_matrix.hpp"

#include <algorithm>
#include <numeric>

namespace polynya::dynamics {
namespace {

/// Calls use(contact, row, column, p, q) for what each contact adds to the lower triangle: p[3 r] and q[3 r]
/// are what multiplies the slope of its speed r.
template <class Use>
void for_entries(std::span<const JamRows> rows, Use use) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JamRows& r = rows[k];
    const auto add_block = [&](int p, const double(&of_p)[3][3], int q, const double(&of_q)[3][3]) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          if (p + i >= q + j) use(k, p + i, q + j, &of_p[0][i], &of_q[0][j]);
        }
      }
    };
    if (r.a >= 0) add_block(r.a, r.of_a, r.a, r.of_a);
    if (r.b >= 0) add_block(r.b, r.of_b, r.b, r.of_b);
    if (r.a >= 0 && r.b > r.a) add_block(r.b, r.of_b, r.a, r.of_a);
    if (r.b >= 0 && r.a > r.b) add_block(r.a, r.of_a, r.b, r.of_b);
  }
}

}  // namespace

JamMatrix::JamMatrix(const Eigen::VectorXd& mass, std::span<const JamRows> rows)
    : upper_(mass.size(), mass.size()) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < mass.size(); ++i) entries.emplace_back(i, i, 1);
  for_entries(rows, [&](std::size_t, int row, int column, const double*, const double*) {
    entries.emplace_back(row, column, 1);
  });
  Matrix lower(mass.size(), mass.size());
  lower.setFromTriplets(entries.begin(), entries.end());
  const Matrix whole = lower.selfadjointView<Eigen::Lower>();
  Eigen::AMDOrdering<int>()(whole, order_);
  order_ = order_.inverse().eval();  // it gives the way back

  // Eigen puts the elements in order; their numbers as values give where each goes.
  std::iota(lower.valuePtr(), lower.valuePtr() + lower.nonZeros(), 0.0);
  upper_.selfadjointView<Eigen::Upper>() = lower.selfadjointView<Eigen::Lower>().twistedBy(order_);
  std::vector<int> place_of(static_cast<std::size_t>(lower.nonZeros()));
  for (int i = 0; i < upper_.nonZeros(); ++i) place_of[static_cast<std::size_t>(upper_.valuePtr()[i])] = i;
  const int* numbers = lower.innerIndexPtr();
  for (const auto& entry : entries) {
    const int* begin = numbers + lower.outerIndexPtr()[entry.col()];
    const int* end = numbers + lower.outerIndexPtr()[entry.col() + 1];
    places_.push_back(
        place_of[static_cast<std::size_t>(std::lower_bound(begin, end, entry.row()) - numbers)]);
  }
  cholesky_.analyzePattern(upper_);
}

bool JamMatrix::factorize(const Eigen::VectorXd& mass, std::span<const JamRows> rows,
                          std::span<const JamLoad> loads) {
  double* values = upper_.valuePtr();
  std::fill_n(values, upper_.nonZeros(), 0.0);
  const int* place = places_.data();
  for (Eigen::Index i = 0; i < mass.size(); ++i) values[*place++] += mass[i];
  for_entries(rows, [&](std::size_t contact, int, int, const double* p, const double* q) {
    const double* slope = loads[contact].slope;
    values[*place++] += slope[0] * p[0] * q[0] + slope[1] * p[3] * q[3] + slope[2] * p[6] * q[6];
  });
  cholesky_.factorize(upper_);
  return cholesky_.info() == Eigen::Success;
}

Eigen::VectorXd JamMatrix::solve(const Eigen::VectorXd& right) const {
  return order_.inverse() * cholesky_.solve(order_ * right);
}

}  // namespace polynya::dynamics
