#include "dynamics/internal/jam_matrix.hpp"

#include <algorithm>

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
    : lower_(mass.size(), mass.size()) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < mass.size(); ++i) entries.emplace_back(i, i, 1);
  for_entries(rows, [&](std::size_t, int row, int column, const double*, const double*) {
    entries.emplace_back(row, column, 1);
  });
  lower_.setFromTriplets(entries.begin(), entries.end());
  const int* numbers = lower_.innerIndexPtr();
  for (const auto& entry : entries) {
    const int* begin = numbers + lower_.outerIndexPtr()[entry.col()];
    const int* end = numbers + lower_.outerIndexPtr()[entry.col() + 1];
    places_.push_back(static_cast<int>(std::lower_bound(begin, end, entry.row()) - numbers));
  }
  cholesky_.analyzePattern(lower_);
}

bool JamMatrix::factorize(const Eigen::VectorXd& mass, std::span<const JamRows> rows,
                          std::span<const JamLoad> loads) {
  double* values = lower_.valuePtr();
  std::fill_n(values, lower_.nonZeros(), 0.0);
  const int* place = places_.data();
  for (Eigen::Index i = 0; i < mass.size(); ++i) values[*place++] += mass[i];
  for_entries(rows, [&](std::size_t contact, int, int, const double* p, const double* q) {
    const double* slope = loads[contact].slope;
    values[*place++] += slope[0] * p[0] * q[0] + slope[1] * p[3] * q[3] + slope[2] * p[6] * q[6];
  });
  cholesky_.factorize(lower_);
  return cholesky_.info() == Eigen::Success;
}

}  // namespace polynya::dynamics
