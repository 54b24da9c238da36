#include "dynamics/jam_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/SparseCholesky>

namespace polynya::dynamics {
namespace {

constexpr int kMostSteps = 60;      ///< of Newton's; a dozen is common
constexpr int kUndampedSteps = 10;  ///< after them the bounds of friction follow by halves, which ends cycles
constexpr int kMostBisections = 12;  ///< of one step's length
constexpr double kFlat = 0.1;        ///< a slope along the step below this share of its first is no slope
constexpr double kConverged =
    0.02;                       ///< largest change of a speed at a contact by the last step, in slip speeds
constexpr double kRigid = 1e6;  ///< impulse per speed of rigid ends, in masses

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// The rows of one contact: speeds apart at both ends and along the line, by the velocities of its bodies
/// (x, y, rotation), a's and b's.
struct Rows {
  double of_a[3][3], of_b[3][3];
  int a, b;  ///< first unknown; −1 of bodies of prescribed motion
};

Rows rows_of(const ContactConstraint& c, int a, int b) {
  const geometry::Vector n = c.normal;
  const geometry::Vector t = perpendicular(n);
  return {.of_a = {{-n.x, -n.y, -c.arm_cross_normal_a[0]},
                   {-n.x, -n.y, -c.arm_cross_normal_a[1]},
                   {-t.x, -t.y, -c.arm_cross_tangent_a}},
          .of_b = {{n.x, n.y, c.arm_cross_normal_b[0]},
                   {n.x, n.y, c.arm_cross_normal_b[1]},
                   {t.x, t.y, c.arm_cross_tangent_b}},
          .a = a,
          .b = b};
}

/// The impulses of one contact on b at given speeds, and how they grow with them.
struct ContactLoad {
  double impulse[3];  ///< at both ends, apart; along the line [N s]
  double slope[3];    ///< ≥ 0 [N s per m/s]
};

class Jam {
 public:
  Jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
      double slip_speed)
      : constraints_(constraints), laws_(laws), bodies_(bodies), slip_speed_(slip_speed) {
    number_unknowns();
    velocity_ = velocities();
    for (const ContactConstraint& c : constraints) {
      rows_.push_back(rows_of(c, unknown_of(c.a), unknown_of(c.b)));
      const ConstraintSpeeds now = speeds_at(c, bodies);
      speeds_.push_back({now.apart[0], now.apart[1], now.slip});
    }
    before_constraints_.assign(constraints.begin(), constraints.end());
    for (const std::int32_t body : body_of_) before_bodies_.push_back(bodies[index(body)]);
    for (ContactConstraint& c : constraints)
      apply_impulses(c, -c.normal_impulse[0], -c.normal_impulse[1], -c.slip_impulse, bodies);
    without_ = velocities();
    loads_.resize(rows_.size());
    changes_.resize(rows_.size());
    slip_bound_.resize(rows_.size());
  }

  bool solve() {
    bool is_solved = false;
    for (int step = 0; step < kMostSteps && !is_solved; ++step) {
      find_loads(step < kUndampedSteps ? 1 : 0.5);
      const Vector gradient = gradient_now();
      assemble();
      if (step == 0) cholesky_.analyzePattern(hessian_);
      cholesky_.factorize(hessian_);
      if (cholesky_.info() != Eigen::Success) break;
      const Vector direction = cholesky_.solve(-gradient);
      const double largest = find_changes(direction);
      const double way = way_down(direction, gradient.dot(direction));
      velocity_ += way * direction;
      for (std::size_t k = 0; k < rows_.size(); ++k) speeds_[k] = speeds_after(k, way);
      is_solved = way == 1 && largest < kConverged * slip_speed_;
    }
    enter_impulses();
    is_solved = is_solved && missed_speed() < slip_speed_;
    if (!is_solved) restore();
    return is_solved;
  }

 private:
  using Speeds = std::array<double, 3>;  ///< of one contact: apart at both ends, along the line [m/s]

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  void number_unknowns() {
    for (const ContactConstraint& c : constraints_) {
      for (const std::int32_t body : {c.a, c.b}) {
        if (bodies_[index(body)].inverse_mass != 0) body_of_.push_back(body);
      }
    }
    std::ranges::sort(body_of_);
    body_of_.erase(std::unique(body_of_.begin(), body_of_.end()), body_of_.end());
    mass_.resize(static_cast<Eigen::Index>(3 * body_of_.size()));
    for (std::size_t i = 0; i < body_of_.size(); ++i) {
      const SolverBody& body = bodies_[index(body_of_[i])];
      const double mass = 1 / body.inverse_mass;
      mass_.segment<3>(static_cast<Eigen::Index>(3 * i)) << mass, mass, 1 / body.inverse_moment;
    }
  }
  int unknown_of(std::int32_t body) const {
    const auto found = std::ranges::lower_bound(body_of_, body);
    const bool is_free = found != body_of_.end() && *found == body;
    return is_free ? static_cast<int>(3 * (found - body_of_.begin())) : -1;
  }
  Vector velocities() const {
    Vector v(mass_.size());
    for (std::size_t i = 0; i < body_of_.size(); ++i) {
      const SolverBody& body = bodies_[index(body_of_[i])];
      v.segment<3>(static_cast<Eigen::Index>(3 * i)) << body.velocity.x, body.velocity.y,
          body.angular_velocity;
    }
    return v;
  }

  ContactLoad load_at(std::size_t k, const Speeds& speeds) const {
    ContactLoad load;
    for (std::size_t end = 0; end < 2; ++end) {
      const CrushResponse& law = laws_[k][end];
      const CrushBranch branch = branch_of(law, piece_at(law, -speeds[end]));
      load.impulse[end] = branch.at_rest - branch.slope * (speeds[end] + law.gap_speed);
      load.slope[end] = branch.slope;
    }
    const double slope = slip_bound_[k] / slip_speed_;
    const double slip = -slope * speeds[2];
    const bool is_bound = std::abs(slip) >= slip_bound_[k];
    load.impulse[2] = is_bound ? std::copysign(slip_bound_[k], slip) : slip;
    load.slope[2] = is_bound ? 0 : slope;
    return load;
  }
  /// By the speeds now. The bounds of friction go a share of the way to μ times the normal impulses.
  void find_loads(double share) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const ContactLoad normal = load_at(k, speeds_[k]);
      const double bound = constraints_[k].friction * (normal.impulse[0] + normal.impulse[1]);
      slip_bound_[k] += share * (bound - slip_bound_[k]);
      loads_[k] = load_at(k, speeds_[k]);
    }
  }
  Vector gradient_now() const {
    Vector gradient = mass_.cwiseProduct(velocity_ - without_);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const Rows& r = rows_[k];
      for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i) {
          if (r.a >= 0) gradient[r.a + i] -= loads_[k].impulse[row] * r.of_a[row][i];
          if (r.b >= 0) gradient[r.b + i] -= loads_[k].impulse[row] * r.of_b[row][i];
        }
      }
    }
    return gradient;
  }
  /// The lower triangle of the second derivative.
  void assemble() {
    entries_.clear();
    for (Eigen::Index i = 0; i < mass_.size(); ++i)
      entries_.emplace_back(static_cast<int>(i), static_cast<int>(i), mass_[i]);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const Rows& r = rows_[k];
      if (r.a >= 0) add_block(loads_[k], r.a, r.of_a, r.a, r.of_a);
      if (r.b >= 0) add_block(loads_[k], r.b, r.of_b, r.b, r.of_b);
      if (r.a >= 0 && r.b > r.a) add_block(loads_[k], r.b, r.of_b, r.a, r.of_a);
      if (r.b >= 0 && r.a > r.b) add_block(loads_[k], r.a, r.of_a, r.b, r.of_b);
    }
    hessian_.resize(mass_.size(), mass_.size());
    hessian_.setFromTriplets(entries_.begin(), entries_.end());
  }
  void add_block(const ContactLoad& load, int p, const double (&of_p)[3][3], int q,
                 const double (&of_q)[3][3]) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (p + i < q + j) continue;
        double sum = 0;
        for (int row = 0; row < 3; ++row) sum += load.slope[row] * of_p[row][i] * of_q[row][j];
        entries_.emplace_back(p + i, q + j, sum);
      }
    }
  }

  /// How a change of the velocities changes the speeds at the contacts; returns the largest.
  double find_changes(const Vector& direction) {
    double largest = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const Rows& r = rows_[k];
      for (std::size_t row = 0; row < 3; ++row) {
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
          if (r.a >= 0) sum += r.of_a[row][i] * direction[r.a + i];
          if (r.b >= 0) sum += r.of_b[row][i] * direction[r.b + i];
        }
        changes_[k][row] = sum;
        largest = std::max(largest, std::abs(sum));
      }
    }
    return largest;
  }
  Speeds speeds_after(std::size_t k, double way) const {
    Speeds speeds = speeds_[k];
    for (std::size_t row = 0; row < 3; ++row) speeds[row] += way * changes_[k][row];
    return speeds;
  }
  /// How far to go along a direction: all of it, or to where the slope along it vanishes, which is a sum of
  /// functions that do not fall.
  double way_down(const Vector& direction, double slope_at_0) const {
    const Vector momentum = mass_.cwiseProduct(direction);
    const double of_mass = momentum.dot(velocity_ - without_);
    const double growth = momentum.dot(direction);
    const auto slope = [&](double way) {
      double sum = of_mass + way * growth;
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        const ContactLoad load = load_at(k, speeds_after(k, way));
        for (std::size_t row = 0; row < 3; ++row) sum -= load.impulse[row] * changes_[k][row];
      }
      return sum;
    };
    const double flat = kFlat * std::abs(slope_at_0);
    double low = 0, high = 1, at_low = slope_at_0, at_high = slope(1);
    if (at_high <= flat) return 1;
    double way = 1;
    for (int i = 0; i < kMostBisections; ++i) {
      way = low + (high - low) * std::clamp(at_low / (at_low - at_high), 0.05, 0.95);
      const double here = slope(way);
      if (std::abs(here) <= flat) break;
      (here < 0 ? low : high) = way;
      (here < 0 ? at_low : at_high) = here;
    }
    return way;
  }
  void enter_impulses() {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const ContactLoad load = load_at(k, speeds_[k]);
      ContactConstraint& c = constraints_[k];
      c.normal_impulse[0] = load.impulse[0];
      c.normal_impulse[1] = load.impulse[1];
      c.slip_impulse = load.impulse[2];
      apply_impulses(c, load.impulse[0], load.impulse[1], load.impulse[2], bodies_);
    }
  }

  /// By how much the impulses entered give other speeds than those they were found at, which they do short of
  /// the minimum or where masses differ by more than doubles bear [m/s].
  double missed_speed() const {
    double largest = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const ConstraintSpeeds now = speeds_at(constraints_[k], bodies_);
      largest = std::max({largest, std::abs(now.apart[0] - speeds_[k][0]),
                          std::abs(now.apart[1] - speeds_[k][1]), std::abs(now.slip - speeds_[k][2])});
    }
    return largest;
  }
  void restore() {
    std::ranges::copy(before_constraints_, constraints_.begin());
    for (std::size_t i = 0; i < body_of_.size(); ++i) bodies_[index(body_of_[i])] = before_bodies_[i];
  }

  std::span<ContactConstraint> constraints_;
  std::span<const EndLaws> laws_;
  std::span<SolverBody> bodies_;
  double slip_speed_;
  std::vector<ContactConstraint> before_constraints_;
  std::vector<SolverBody> before_bodies_;
  std::vector<std::int32_t> body_of_;  ///< those free to move, three unknowns each
  std::vector<Rows> rows_;
  std::vector<Speeds> speeds_, changes_;
  std::vector<ContactLoad> loads_;
  std::vector<double> slip_bound_;    ///< [N s]
  Vector mass_, velocity_, without_;  ///< now, and without any impulses
  std::vector<Eigen::Triplet<double>> entries_;
  Matrix hessian_;
  Eigen::SimplicialLLT<Matrix> cholesky_;
};

}  // namespace

CrushResponse rigid_law(double inverse_mass) {
  return {.impulse_of_force = kCreepSpeed * kRigid / inverse_mass,
          .slope = 0,
          .gap_speed = 0,
          .cap = std::numeric_limits<double>::infinity()};
}

bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws,
               std::span<SolverBody> bodies, double slip_speed) {
  return Jam(constraints, laws, bodies, slip_speed).solve();
}

}  // namespace polynya::dynamics
