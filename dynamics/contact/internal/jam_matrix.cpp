#include "dynamics/contact/internal/jam_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace polynya::dynamics {
namespace {

using Rows = double[3][4];
using Three = std::array<double, 4>;  // and a lane, 0

/// The first unknown of a body.
Eigen::Index first_of(std::size_t body) {
  return static_cast<Eigen::Index>(3 * body);
}

/// to += pᵀ w
inline void add_product(Rows& to, const Rows& p, const Rows& w) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) to[i][j] += p[0][i] * w[0][j] + p[1][i] * w[1][j] + p[2][i] * w[2][j];
  }
}

/// w = S q, of one contact.
inline void slopes_times(const JamLoad& load, const Rows& q, Rows& w) {
  for (int j = 0; j < 4; ++j) {
    w[0][j] = load.slope[0] * q[0][j];
    w[1][j] = load.slope[1] * q[1][j];
    w[2][j] = load.slip_by_apart[0] * q[0][j] + load.slip_by_apart[1] * q[1][j] + load.slope[2] * q[2][j];
  }
}

/// to −= pᵀ u
inline void subtract_product(Rows& to, const Rows& p, const Rows& u) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) to[i][j] -= p[0][i] * u[0][j] + p[1][i] * u[1][j] + p[2][i] * u[2][j];
  }
}

/// L U in the block's place, of its rows in the order found, the largest first, with the inverses of U's
/// diagonal. Returns whether it is regular.
bool factorize_own(Rows& d, int (&row)[3]) {
  for (int k = 0; k < 3; ++k) row[k] = k;
  for (int k = 0; k < 3; ++k) {
    int largest = k;
    for (int i = k + 1; i < 3; ++i) {
      if (std::abs(d[i][k]) > std::abs(d[largest][k])) largest = i;
    }
    if (largest != k) {
      std::swap(d[k], d[largest]);
      std::swap(row[k], row[largest]);
    }
    if (d[k][k] == 0 || !std::isfinite(d[k][k])) return false;
    d[k][k] = 1 / d[k][k];
    for (int i = k + 1; i < 3; ++i) {
      d[i][k] *= d[k][k];
      for (int j = k + 1; j < 3; ++j) d[i][j] -= d[i][k] * d[k][j];
    }
  }
  return true;
}

/// u = L⁻¹ u, of the rows in their order; l = l U⁻¹, l transposed
inline void divide(Rows& u, Rows& l, const Rows& d, const int (&row)[3]) {
  Rows was;
  std::copy_n(&u[0][0], 12, &was[0][0]);
  for (int j = 0; j < 4; ++j) {
    u[0][j] = was[row[0]][j];
    u[1][j] = was[row[1]][j] - d[1][0] * u[0][j];
    u[2][j] = was[row[2]][j] - d[2][0] * u[0][j] - d[2][1] * u[1][j];
    l[0][j] *= d[0][0];
    l[1][j] = (l[1][j] - l[0][j] * d[0][1]) * d[1][1];
    l[2][j] = (l[2][j] - l[0][j] * d[0][2] - l[1][j] * d[1][2]) * d[2][2];
  }
}

/// L⁻¹ x, of the rows in their order.
void solve_lower(const Rows& d, const int (&row)[3], Three& x) {
  const Three was = x;
  x[0] = was[row[0]];
  x[1] = was[row[1]] - d[1][0] * x[0];
  x[2] = was[row[2]] - d[2][0] * x[0] - d[2][1] * x[1];
}

/// U⁻¹ x
void solve_upper(const Rows& d, Three& x) {
  x[2] *= d[2][2];
  x[1] = (x[1] - d[1][2] * x[2]) * d[1][1];
  x[0] = (x[0] - d[0][1] * x[1] - d[0][2] * x[2]) * d[0][0];
}

/// x −= m y
void subtract(Three& x, const Rows& m, const Three& y) {
  for (int i = 0; i < 3; ++i) x[i] -= m[i][0] * y[0] + m[i][1] * y[1] + m[i][2] * y[2];
}

/// x −= mᵀ y
void subtract_transposed(Three& x, const Rows& m, const Three& y) {
  for (int i = 0; i < 4; ++i) x[i] -= m[0][i] * y[0] + m[1][i] * y[1] + m[2][i] * y[2];
}

}  // namespace

bool JamMatrix::is_of(int bodies, std::span<const JamRows> rows) const {
  if (static_cast<std::size_t>(bodies) != own_.size() || rows.size() != between_.size()) return false;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (between_[k] != std::array{rows[k].a, rows[k].b}) return false;
  return true;
}

void JamMatrix::take(int bodies, std::span<const JamRows> rows) {
  if (is_of(bodies, rows)) return;
  between_.clear();
  for (const JamRows& r : rows) between_.push_back({r.a, r.b});
  place_of_.resize(static_cast<std::size_t>(bodies));
  own_.resize(static_cast<std::size_t>(bodies));
  order_bodies(rows);
  find_pairs(rows);
  places_.clear();
  for (const JamRows& r : rows) {
    const int a = r.a < 0 ? -1 : place_of_[r.a];
    const int b = r.b < 0 ? -1 : place_of_[r.b];
    places_.push_back({a, b, a < 0 || b < 0 ? -1 : pair_of(std::min(a, b), std::max(a, b))});
  }
}

/// An order in which few blocks fill in.
void JamMatrix::order_bodies(std::span<const JamRows> rows) {
  const int bodies = static_cast<int>(place_of_.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(place_of_.size() + 2 * rows.size());
  for (int i = 0; i < bodies; ++i) entries.emplace_back(i, i, 1);
  for (const JamRows& r : rows) {
    if (r.a < 0 || r.b < 0) continue;
    entries.emplace_back(r.a, r.b, 1);
    entries.emplace_back(r.b, r.a, 1);
  }
  Eigen::SparseMatrix<double> graph(bodies, bodies);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  for (int i = 0; i < bodies; ++i) place_of_[order.indices()[i]] = i;
}

/// A body's pairs are those of its contacts, and those of the bodies that it is the first later one of
/// [Davis2006].
void JamMatrix::find_pairs(std::span<const JamRows> rows) {
  const std::size_t bodies = place_of_.size();
  std::vector<std::vector<int>> later(bodies);
  for (const JamRows& r : rows) {
    if (r.a < 0 || r.b < 0) continue;
    const auto [first, second] = std::minmax(place_of_[r.a], place_of_[r.b]);
    later[first].push_back(second);
  }
  first_.assign(1, 0);
  later_.clear();
  for (std::size_t i = 0; i < bodies; ++i) {
    std::vector<int>& mine = later[i];
    std::sort(mine.begin(), mine.end());
    mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
    later_.insert(later_.end(), mine.begin(), mine.end());
    first_.push_back(static_cast<int>(later_.size()));
    if (!mine.empty()) later[mine[0]].insert(later[mine[0]].end(), mine.begin() + 1, mine.end());
  }
  is_filled_.assign(later_.size(), 0);
  pairs_.assign(later_.size(), {});
  find_targets();
}

void JamMatrix::find_targets() {
  targets_.clear();
  for (std::size_t i = 0; i < place_of_.size(); ++i) {
    for (int p = first_[i]; p < first_[i + 1]; ++p) {
      int at = first_[later_[p]];
      for (int q = p + 1; q < first_[i + 1]; ++q) {
        while (later_[at] != later_[q]) ++at;
        targets_.push_back(at);
      }
    }
  }
}

int JamMatrix::pair_of(int earlier, int later) const {
  int at = first_[earlier];
  while (later_[at] != later) ++at;
  return at;
}

void JamMatrix::add_up(const Eigen::VectorXd& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads) {
  for (std::size_t i = 0; i < place_of_.size(); ++i) {
    Own& own = own_[place_of_[i]];
    own = {};
    for (int k = 0; k < 3; ++k) own.block.at[k][k] = mass[first_of(i) + k];
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (is_filled_[p] != 0) pairs_[p] = {};
    is_filled_[p] = 0;
  }
  add(rows, loads);
}

void JamMatrix::add(std::span<const JamRows> rows, std::span<const JamLoad> loads) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JamLoad& load = loads[k];
    if (load.slope[0] == 0 && load.slope[1] == 0 && load.slope[2] == 0) continue;
    const Places& place = places_[k];
    Rows by_a, by_b;
    slopes_times(load, rows[k].of_a, by_a);
    slopes_times(load, rows[k].of_b, by_b);
    if (place.a >= 0) add_product(own_[place.a].block.at, rows[k].of_a, by_a);
    if (place.b >= 0) add_product(own_[place.b].block.at, rows[k].of_b, by_b);
    if (place.pair < 0) continue;
    Pair& pair = pairs_[place.pair];
    is_filled_[place.pair] = 1;
    const bool is_a_first = place.a < place.b;
    if (is_a_first) {
      add_product(pair.upper.at, rows[k].of_a, by_b);
      add_product(pair.lower.at, by_a, rows[k].of_b);
    } else {
      add_product(pair.upper.at, rows[k].of_b, by_a);
      add_product(pair.lower.at, by_b, rows[k].of_a);
    }
  }
}

/// Takes what a body's blocks contribute from those of the later ones. Its own block is factorized. Most
/// contacts of a jam carry nothing: their blocks are left out.
void JamMatrix::eliminate(int body, const int* targets) {
  const Own& own = own_[body];
  const int end = first_[body + 1];
  for (int p = first_[body]; p != end; ++p) {
    if (is_filled_[p] != 0) divide(pairs_[p].upper.at, pairs_[p].lower.at, own.block.at, own.row);
  }
  for (int p = first_[body]; p != end; targets += end - ++p) {
    if (is_filled_[p] == 0) continue;
    const Pair& of_p = pairs_[p];
    subtract_product(own_[later_[p]].block.at, of_p.lower.at, of_p.upper.at);
    for (int q = p + 1; q != end; ++q) {
      if (is_filled_[q] == 0) continue;
      const int to = targets[q - p - 1];
      is_filled_[to] = 1;
      subtract_product(pairs_[to].upper.at, of_p.lower.at, pairs_[q].upper.at);
      subtract_product(pairs_[to].lower.at, of_p.upper.at, pairs_[q].lower.at);
    }
  }
}

bool JamMatrix::factorize(const Eigen::VectorXd& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads) {
  add_up(mass, rows, loads);
  const int* target = targets_.data();
  for (int i = 0; i < static_cast<int>(own_.size()); ++i) {
    if (!factorize_own(own_[i].block.at, own_[i].row)) return false;
    eliminate(i, target);
    const int pairs = first_[i + 1] - first_[i];
    target += pairs * (pairs - 1) / 2;
  }
  return true;
}

Eigen::VectorXd JamMatrix::solve(const Eigen::VectorXd& right) const {
  const std::size_t bodies = own_.size();
  std::vector<Three> x(bodies);
  for (std::size_t i = 0; i < bodies; ++i) std::copy_n(&right[first_of(i)], 3, x[place_of_[i]].data());
  for (std::size_t i = 0; i < bodies; ++i) {
    solve_lower(own_[i].block.at, own_[i].row, x[i]);
    for (int p = first_[i]; p < first_[i + 1]; ++p) {
      if (is_filled_[p] != 0) subtract_transposed(x[later_[p]], pairs_[p].lower.at, x[i]);
    }
  }
  for (std::size_t i = bodies; i-- > 0;) {
    for (int p = first_[i]; p < first_[i + 1]; ++p) {
      if (is_filled_[p] != 0) subtract(x[i], pairs_[p].upper.at, x[later_[p]]);
    }
    solve_upper(own_[i].block.at, x[i]);
  }
  Eigen::VectorXd solution(right.size());
  for (std::size_t i = 0; i < bodies; ++i) std::copy_n(x[place_of_[i]].data(), 3, &solution[first_of(i)]);
  return solution;
}

}  // namespace polynya::dynamics
