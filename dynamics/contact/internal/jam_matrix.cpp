#include "dynamics/contact/internal/jam_matrix.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {
namespace {

/// Limits on the work of the branches of the elimination tree: a branch has at most 1/kBranches of all work, and
/// usually at least half of that [-]. Fewer: threads wait for the longest branch. More: the trunk, on which one
/// thread works, grows.
constexpr double kBranches = 8;
/// Smallest number of bodies of a matrix that is divided into branches. Fewer: handing branches to threads takes as
/// long as the work on them.
constexpr int kLeastBranched = 96;

/// Marks functions that the clones for AVX2 call. They must be inlined, or they are compiled for other processors.
#define POLYNYA_IN_CLONE [[gnu::always_inline]] inline

using Rows = double[3][4];
using Three = std::array<double, 4>;  // and a lane that is 0

/// Computes to += block.
POLYNYA_IN_CLONE void add(Rows& to, const Rows& block) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) to[i][j] += block[i][j];
  }
}

/// Computes to = pᵀ w.
POLYNYA_IN_CLONE void product(Rows& to, const Rows& p, const Rows& w) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) to[i][j] = p[0][i] * w[0][j] + p[1][i] * w[1][j] + p[2][i] * w[2][j];
  }
}

/// Computes w = S q for one contact.
POLYNYA_IN_CLONE void slopes_times(const JamLoad& load, const Rows& q, Rows& w) {
  for (int j = 0; j < 4; ++j) {
    w[0][j] = load.slope[0] * q[0][j];
    w[1][j] = load.slope[1] * q[1][j];
    w[2][j] = load.slip_by_apart[0] * q[0][j] + load.slip_by_apart[1] * q[1][j] + load.slope[2] * q[2][j];
  }
}

/// Computes to −= pᵀ u.
POLYNYA_IN_CLONE void subtract_product(Rows& to, const Rows& p, const Rows& u) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) to[i][j] -= p[0][i] * u[0][j] + p[1][i] * u[1][j] + p[2][i] * u[2][j];
  }
}

/// Replaces a block by its factors L U, with the inverses of U's diagonal. Rows are taken in the order `row`, which is
/// chosen with the largest pivot first. Returns true if the block is regular.
POLYNYA_IN_CLONE bool factorize_own(Rows& d, int (&row)[3]) {
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

/// Computes u = L⁻¹ u, with the rows in their order, and l = l U⁻¹, where l is transposed.
POLYNYA_IN_CLONE void divide(Rows& u, Rows& l, const Rows& d, const int (&row)[3]) {
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

/// Computes L⁻¹ x, with the rows in their order.
POLYNYA_IN_CLONE void solve_lower(const Rows& d, const int (&row)[3], Three& x) {
  const Three was = x;
  x[0] = was[row[0]];
  x[1] = was[row[1]] - d[1][0] * x[0];
  x[2] = was[row[2]] - d[2][0] * x[0] - d[2][1] * x[1];
}

/// Computes U⁻¹ x.
POLYNYA_IN_CLONE void solve_upper(const Rows& d, Three& x) {
  x[2] *= d[2][2];
  x[1] = (x[1] - d[1][2] * x[2]) * d[1][1];
  x[0] = (x[0] - d[0][1] * x[1] - d[0][2] * x[2]) * d[0][0];
}

/// Computes x −= m y.
POLYNYA_IN_CLONE void subtract(Three& x, const Rows& m, const Three& y) {
  for (int i = 0; i < 3; ++i) x[i] -= m[i][0] * y[0] + m[i][1] * y[1] + m[i][2] * y[2];
}

/// Computes x −= mᵀ y.
POLYNYA_IN_CLONE void subtract_transposed(Three& x, const Rows& m, const Three& y) {
  for (int i = 0; i < 4; ++i) x[i] -= m[0][i] * y[0] + m[1][i] * y[1] + m[2][i] * y[2];
}

}  // namespace

void add_speeds(std::span<const JamRows> rows, std::span<const std::array<double, 4>> velocities,
                std::span<std::array<double, 3>> speeds) {
  const std::size_t prescribed = velocities.size() - 1;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JamRows& r = rows[k];
    const double* a = velocities[r.a < 0 ? prescribed : static_cast<std::size_t>(r.a)].data();
    const double* b = velocities[r.b < 0 ? prescribed : static_cast<std::size_t>(r.b)].data();
    for (int row = 0; row < 3; ++row) {
      double lane[4];
      for (int i = 0; i < 4; ++i) lane[i] = r.of_a[row][i] * a[i] + r.of_b[row][i] * b[i];
      speeds[k][static_cast<std::size_t>(row)] += lane[0] + lane[1] + lane[2];
    }
  }
}

void subtract_impulses(std::span<const JamRows> rows, std::span<const JamLoad> loads,
                       std::span<std::array<double, 4>> momenta) {
  const std::size_t prescribed = momenta.size() - 1;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const JamRows& r = rows[k];
    double* a = momenta[r.a < 0 ? prescribed : static_cast<std::size_t>(r.a)].data();
    double* b = momenta[r.b < 0 ? prescribed : static_cast<std::size_t>(r.b)].data();
    const double(&p)[3] = loads[k].impulse;
    for (int i = 0; i < 4; ++i) a[i] -= p[0] * r.of_a[0][i] + p[1] * r.of_a[1][i] + p[2] * r.of_a[2][i];
    for (int i = 0; i < 4; ++i) b[i] -= p[0] * r.of_b[0][i] + p[1] * r.of_b[1][i] + p[2] * r.of_b[2][i];
  }
}

bool JamMatrix::is_of(int bodies, std::span<const JamRows> rows) const {
  if (static_cast<std::size_t>(bodies) != own_.size() || rows.size() != between_.size()) return false;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (between_[k] != std::array{rows[k].a, rows[k].b}) return false;
  return true;
}

void JamMatrix::take(int bodies, std::span<const JamRows> rows) {
  is_changed_.assign(static_cast<std::size_t>(bodies), 1);
  slopes_.assign(rows.size(), {});
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
  of_contact_.resize(rows.size());
  find_contacts();
}

/// Orders the bodies so that few blocks fill in.
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
  body_at_.resize(place_of_.size());
  for (int i = 0; i < bodies; ++i) body_at_[place_of_[i]] = i;
}

/// Finds the pairs of each body. They are the pairs of its contacts, and the pairs of the bodies of which it is the
/// first later neighbour [Davis2006].
void JamMatrix::find_pairs(std::span<const JamRows> rows) {
  const std::size_t bodies = place_of_.size();
  std::vector<std::vector<int>>& later = later_of_;
  if (later.size() < bodies) later.resize(bodies);
  for (std::size_t i = 0; i < bodies; ++i) later[i].clear();
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
  find_branches();
}

/// Divides the elimination tree into branches, which are subtrees. The parent of a body in the tree is the first later
/// body among its pairs.
void JamMatrix::find_branches() {
  constexpr double kOwnWork = 4;  // work of a row itself, in products of blocks
  const int bodies = static_cast<int>(place_of_.size());
  std::vector<double> work(place_of_.size(), kOwnWork);  // work of each subtree
  const auto parent = [&](int i) { return first_[i] < first_[i + 1] ? later_[first_[i]] : -1; };
  for (int i = 0; i < bodies; ++i) {
    for (int e = first_earlier_[i]; e < first_earlier_[i + 1]; ++e)
      work[i] += first_[earlier_[e].body + 1] - earlier_[e].pair;
    if (parent(i) >= 0) work[parent(i)] += work[i];
  }
  double all = 0;
  for (int i = 0; i < bodies; ++i) all += parent(i) < 0 ? work[i] : 0;
  const double most = bodies < kLeastBranched ? 0 : all / kBranches;  // a subtree with more work belongs to the trunk
  std::vector<int> branch_of(place_of_.size(), -1);                   // −1: the trunk
  int branches = 0;
  double of_branch = 0;
  for (int i = bodies; i-- > 0;) {
    if (work[i] > most) continue;
    if (parent(i) >= 0 && work[parent(i)] <= most) {
      branch_of[i] = branch_of[parent(i)];
      continue;
    }
    if (branches == 0 || of_branch + work[i] > most) ++branches, of_branch = 0;
    of_branch += work[i];
    branch_of[i] = branches - 1;
  }
  first_of_branch_.assign(static_cast<std::size_t>(branches) + 1, 0);
  for (const int branch : branch_of)
    if (branch >= 0) ++first_of_branch_[branch + 1];
  for (int k = 0; k < branches; ++k) first_of_branch_[k + 1] += first_of_branch_[k];
  std::vector<std::size_t> next = first_of_branch_;
  by_branch_.resize(place_of_.size());
  for (int i = 0; i < bodies; ++i) by_branch_[next[branch_of[i] < 0 ? branches : branch_of[i]]++] = i;
}

/// Calls work(branch, places) for each branch, in parallel.
template <class Work>
void JamMatrix::for_branches(int threads, Work work) const {
  for_chunks(first_of_branch_.size() - 1, 1, threads, [&](std::size_t k, std::size_t, std::size_t) {
    work(k, std::span(by_branch_).subspan(first_of_branch_[k], first_of_branch_[k + 1] - first_of_branch_[k]));
  });
}

std::span<const int> JamMatrix::trunk() const {
  return std::span(by_branch_).subspan(first_of_branch_.back());
}

void JamMatrix::find_targets() {
  targets_.clear(), first_target_.clear();
  first_earlier_.assign(place_of_.size() + 1, 0);
  for (const int later : later_) ++first_earlier_[later + 1];
  for (std::size_t i = 0; i < place_of_.size(); ++i) first_earlier_[i + 1] += first_earlier_[i];
  earlier_.resize(later_.size());
  std::vector<int> next(first_earlier_.begin(), first_earlier_.end() - 1);
  for (int i = 0; i < static_cast<int>(place_of_.size()); ++i) {
    for (int p = first_[i]; p < first_[i + 1]; ++p) {
      earlier_[next[later_[p]]++] = {i, p};
      first_target_.push_back(static_cast<int>(targets_.size()));
      int at = first_[later_[p]];
      for (int q = p + 1; q < first_[i + 1]; ++q) {
        while (later_[at] != later_[q]) ++at;
        targets_.push_back(at);
      }
    }
  }
}

void JamMatrix::find_contacts() {
  first_contact_.assign(place_of_.size() + 1, 0);
  const auto for_each_body = [&](auto&& visit) {
    for (int k = 0; k < static_cast<int>(places_.size()); ++k) {
      if (places_[k].a >= 0) visit(places_[k].a, k);
      if (places_[k].b >= 0) visit(places_[k].b, k);
    }
  };
  for_each_body([&](int body, int /*contact*/) { ++first_contact_[body + 1]; });
  for (std::size_t i = 0; i < place_of_.size(); ++i) first_contact_[i + 1] += first_contact_[i];
  contacts_.resize(first_contact_.back());
  std::vector<int> next(first_contact_.begin(), first_contact_.end() - 1);
  for_each_body([&](int body, int contact) { contacts_[next[body]++] = contact; });
}

int JamMatrix::pair_of(int earlier, int later) const {
  int at = first_[earlier];
  while (later_[at] != later) ++at;
  return at;
}

void JamMatrix::mark_changed(std::span<const JamRows> rows, std::span<const JamLoad> loads) {
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const JamLoad& load = loads[k];
    const Slopes now{{load.slope[0], load.slope[1], load.slope[2]}, {load.slip_by_apart[0], load.slip_by_apart[1]}};
    if (now == slopes_[k]) continue;
    slopes_[k] = now;
    find_blocks(places_[k], rows[k], load, of_contact_[k]);
    if (places_[k].a >= 0) is_changed_[places_[k].a] = 1;
    if (places_[k].b >= 0) is_changed_[places_[k].b] = 1;
  }
}

void JamMatrix::find_blocks(const Places& place, const JamRows& rows, const JamLoad& load, OfContact& found) {
  Rows by_a, by_b;
  slopes_times(load, rows.of_a, by_a);
  slopes_times(load, rows.of_b, by_b);
  product(found.of_a.at, rows.of_a, by_a);
  product(found.of_b.at, rows.of_b, by_b);
  const bool is_a_earlier = place.a < place.b;
  product(found.pair.upper.at, is_a_earlier ? rows.of_a : rows.of_b, is_a_earlier ? by_b : by_a);
  product(found.pair.lower.at, is_a_earlier ? by_a : by_b, is_a_earlier ? rows.of_b : rows.of_a);
}

/// Sums up a body's own block and its pairs from its mass and its contacts. Most contacts of a jam carry no force;
/// their blocks are left out.
void JamMatrix::add_up(int body, const double* mass) {
  Own& own = own_[body];
  own = {};
  for (int k = 0; k < 3; ++k) own.block.at[k][k] = mass[k];
  for (int p = first_[body]; p < first_[body + 1]; ++p) {
    if (is_filled_[p] != 0) pairs_[p] = {};
    is_filled_[p] = 0;
  }
  for (int i = first_contact_[body]; i < first_contact_[body + 1]; ++i) {
    const int k = contacts_[i];
    if (slopes_[k] == Slopes{}) continue;
    const Places& place = places_[k];
    const OfContact& c = of_contact_[k];
    add(own.block.at, (place.a == body ? c.of_a : c.of_b).at);
    if (place.pair < 0 || body != std::min(place.a, place.b)) continue;
    Pair& pair = pairs_[place.pair];
    is_filled_[place.pair] = 1;
    add(pair.upper.at, c.pair.upper.at);
    add(pair.lower.at, c.pair.lower.at);
  }
}

/// Subtracts from a body's blocks the contributions of the bodies eliminated before it.
void JamMatrix::take_earlier(int body) {
  for (int e = first_earlier_[body]; e < first_earlier_[body + 1]; ++e) {
    const int p = earlier_[e].pair;
    if (is_filled_[p] == 0) continue;
    const Pair& of_p = pairs_[p];
    subtract_product(own_[body].block.at, of_p.lower.at, of_p.upper.at);
    const int* target = targets_.data() + first_target_[p];
    const int end = first_[earlier_[e].body + 1];
    for (int q = p + 1; q != end; ++q, ++target) {
      if (is_filled_[q] == 0) continue;
      is_filled_[*target] = 1;
      subtract_product(pairs_[*target].upper.at, of_p.lower.at, pairs_[q].upper.at);
      subtract_product(pairs_[*target].lower.at, of_p.upper.at, pairs_[q].lower.at);
    }
  }
}

bool JamMatrix::factorize_row(int body) {
  Own& own = own_[body];
  if (!factorize_own(own.block.at, own.row)) return false;
  for (int p = first_[body]; p < first_[body + 1]; ++p) {
    if (is_filled_[p] != 0) divide(pairs_[p].upper.at, pairs_[p].lower.at, own.block.at, own.row);
  }
  return true;
}

bool JamMatrix::factorize_rows(std::span<const int> places, const JamVector& mass) {
  return std::ranges::all_of(places, [&](int i) {
    if (is_changed_[i] == 0) return true;
    add_up(i, mass[body_at_[i]].data());
    take_earlier(i);
    return factorize_row(i);
  });
}

bool JamMatrix::factorize(const JamVector& mass, std::span<const JamRows> rows, std::span<const JamLoad> loads,
                          int threads) {
  mark_changed(rows, loads);
  for (std::size_t i = 0; i < own_.size(); ++i) {
    // The next body that this one fills also receives the other bodies that this one fills.
    if (is_changed_[i] != 0 && first_[i] < first_[i + 1]) is_changed_[later_[first_[i]]] = 1;
  }
  std::vector<std::uint8_t> is_regular(first_of_branch_.size(), 1);
  for_branches(threads, [&](std::size_t k, std::span<const int> places) {
    is_regular[k] = factorize_rows(places, mass) ? 1 : 0;
  });
  if (std::ranges::count(is_regular, 0) > 0 || !factorize_rows(trunk(), mass)) return false;
  is_changed_.assign(is_changed_.size(), 0);
  return true;
}

void JamMatrix::solve_lower_rows(std::span<const int> places, JamVector& x) const {
  for (const int i : places) {
    for (int e = first_earlier_[i]; e < first_earlier_[i + 1]; ++e) {
      const auto [body, pair] = earlier_[e];
      if (is_filled_[pair] != 0) subtract_transposed(x[i], pairs_[pair].lower.at, x[body]);
    }
    solve_lower(own_[i].block.at, own_[i].row, x[i]);
  }
}

void JamMatrix::solve_upper_rows(std::span<const int> places, JamVector& x) const {
  for (std::size_t k = places.size(); k-- > 0;) {
    const int i = places[k];
    for (int p = first_[i]; p < first_[i + 1]; ++p) {
      if (is_filled_[p] != 0) subtract(x[i], pairs_[p].upper.at, x[later_[p]]);
    }
    solve_upper(own_[i].block.at, x[i]);
  }
}

void JamMatrix::solve(JamVector& x, int threads) const {
  ordered_.resize(own_.size());
  for (std::size_t i = 0; i < own_.size(); ++i) ordered_[place_of_[i]] = x[i];
  for_branches(threads, [&](std::size_t, std::span<const int> places) { solve_lower_rows(places, ordered_); });
  solve_lower_rows(trunk(), ordered_);
  solve_upper_rows(trunk(), ordered_);
  for_branches(threads, [&](std::size_t, std::span<const int> places) { solve_upper_rows(places, ordered_); });
  for (std::size_t i = 0; i < own_.size(); ++i) x[i] = ordered_[place_of_[i]];
}

}  // namespace polynya::dynamics
