#include "dynamics/jam_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/internal/jam_matrix.hpp"

namespace polynya::dynamics {
namespace {

constexpr int kMostSteps = 60;      ///< half a dozen is common
constexpr int kUndampedSteps = 10;  ///< after them the bounds of friction follow by halves, which ends cycles
// Of the last step, in slip speeds:
constexpr double kConverged = 0.1;   ///< largest change of a speed at a contact
constexpr double kBoundFound = 0.5;  ///< what friction's bound may still change the slip by
constexpr double kRigid = 1e6;       ///< impulse per speed of rigid ends, in masses

using Vector = Eigen::VectorXd;

JamRows rows_of(const ContactConstraint& c, int a, int b) {
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

/// The pieces that a contact is on: of its ends, and whether it slips to a side (−1, 1) or sticks (0).
struct ContactPieces {
  CrushPieces ends;
  int slip;
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
      loads_.push_back({{c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse}, {}});
      slip_bound_.push_back(c.friction * (c.normal_impulse[0] + c.normal_impulse[1]));
    }
    before_constraints_.assign(constraints.begin(), constraints.end());
    for (const std::int32_t body : body_of_) before_bodies_.push_back(bodies[index(body)]);
    for (ContactConstraint& c : constraints)
      apply_impulses(c, -c.normal_impulse[0], -c.normal_impulse[1], -c.slip_impulse, bodies);
    without_ = velocities();
    pieces_.resize(rows_.size());
  }

  bool solve() {
    JamMatrix matrix(mass_, rows_);
    bool is_solved = false;
    for (int step = 0; step < kMostSteps && !is_solved; ++step) {
      bool is_same = true;
      for (std::size_t k = 0; k < rows_.size(); ++k)
        is_same &= choose_pieces(k, step < kUndampedSteps ? 1 : 0.5);
      const Vector gradient = gradient_now();
      if (!matrix.factorize(mass_, rows_, loads_)) break;
      const Vector direction = matrix.solve(-gradient);
      is_solved = advance(direction) < kConverged * slip_speed_ && is_same;
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

  /// Chooses the pieces that are nearest a contact's speeds and impulses, and brings the impulses onto them.
  /// Then the bound of friction goes a share of the way to μ times the normal impulses: the other way round,
  /// stick and slip may follow each other for ever. Returns whether pieces of ends and bound are found.
  bool choose_pieces(std::size_t k, double share) {
    const ContactConstraint& c = constraints_[k];
    ContactPieces& pieces = pieces_[k];
    const CrushPieces before = pieces.ends;
    double normal = 0;
    for (std::size_t end = 0; end < 2; ++end) {
      const CrushResponse& law = laws_[k][end];
      const double impulse = loads_[k].impulse[end];
      pieces.ends.of[end] = piece_near(law, -speeds_[k][end], impulse, c.inverse_mass_at[end]);
      normal += std::clamp(impulse, 0.0, law.cap);
    }
    const double place = c.inverse_slip_mass * loads_[k].impulse[2] - speeds_[k][2];
    const double most = c.inverse_slip_mass * slip_bound_[k] + slip_speed_;
    pieces.slip = std::abs(place) <= most ? 0 : place > 0 ? 1 : -1;
    const double off = c.friction * normal - slip_bound_[k];
    slip_bound_[k] += share * off;
    loads_[k] = load_of(k);
    return pieces.ends == before && std::abs(off) * c.inverse_slip_mass < kBoundFound * slip_speed_;
  }
  /// By the speeds now, on the pieces as if they had no ends.
  JamLoad load_of(std::size_t k) const {
    JamLoad load;
    for (std::size_t end = 0; end < 2; ++end) {
      const CrushBranch branch = branch_of(laws_[k][end], pieces_[k].ends.of[end]);
      load.impulse[end] = branch.at_rest - branch.slope * (speeds_[k][end] + laws_[k][end].gap_speed);
      load.slope[end] = branch.slope;
    }
    const int slip = pieces_[k].slip;
    load.slope[2] = slip == 0 ? slip_bound_[k] / slip_speed_ : 0;
    load.impulse[2] = slip == 0 ? -load.slope[2] * speeds_[k][2] : slip * slip_bound_[k];
    return load;
  }
  Vector gradient_now() const {
    Vector gradient = mass_.cwiseProduct(velocity_ - without_);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const JamRows& r = rows_[k];
      for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i) {
          if (r.a >= 0) gradient[r.a + i] -= loads_[k].impulse[row] * r.of_a[row][i];
          if (r.b >= 0) gradient[r.b + i] -= loads_[k].impulse[row] * r.of_b[row][i];
        }
      }
    }
    return gradient;
  }
  /// Changes the velocities, and with them speeds and impulses. Returns the largest change of a speed at a
  /// contact.
  double advance(const Vector& direction) {
    velocity_ += direction;
    double largest = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const JamRows& r = rows_[k];
      for (std::size_t row = 0; row < 3; ++row) {
        double change = 0;
        for (int i = 0; i < 3; ++i) {
          if (r.a >= 0) change += r.of_a[row][i] * direction[r.a + i];
          if (r.b >= 0) change += r.of_b[row][i] * direction[r.b + i];
        }
        speeds_[k][row] += change;
        largest = std::max(largest, std::abs(change));
      }
      loads_[k] = load_of(k);
    }
    return largest;
  }
  void enter_impulses() {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      ContactConstraint& c = constraints_[k];
      for (std::size_t end = 0; end < 2; ++end)
        c.normal_impulse[end] = std::clamp(loads_[k].impulse[end], 0.0, laws_[k][end].cap);
      const double most = c.friction * (c.normal_impulse[0] + c.normal_impulse[1]);
      c.slip_impulse = std::clamp(loads_[k].impulse[2], -most, most);
      apply_impulses(c, c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse, bodies_);
    }
  }

  /// By how much the impulses entered, which obey their bounds, give other speeds than those they were found
  /// at: short of the minimum, or where masses differ by more than doubles bear [m/s].
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
  std::vector<JamRows> rows_;
  std::vector<Speeds> speeds_;
  std::vector<JamLoad> loads_;  ///< by the speeds, on the pieces; the impulses need not obey their laws
  std::vector<ContactPieces> pieces_;
  std::vector<double> slip_bound_;    ///< [N s]
  Vector mass_, velocity_, without_;  ///< now, and without any impulses
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
