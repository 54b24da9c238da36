#include "dynamics/contact/jam_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/contact/internal/jam_matrix.hpp"

namespace polynya::dynamics {
namespace {

/// Newton steps; half a dozen is common. Fewer: more jams are left to the sweeps, which converge slowly.
constexpr int kMostSteps = 60;
/// After them half of what would change, an end's branch or a contact's slip, waits in each step, which ends cycles.
/// Fewer: every jam takes more steps; many more: those that cycle are not solved within kMostSteps.
constexpr int kWholeSteps = 8;
/// What friction's bound may still change the slip by, in slip speeds. Greater: the slip impulses found miss
/// Coulomb's law by that share.
constexpr double kBoundFound = 0.05;
/// Impulse per speed of rigid ends, in masses. Smaller: steel sinks into steel at a visible speed; far
/// greater: the masses are lost to rounding beside it, and the matrix is singular.
constexpr double kRigid = 1e6;

using Unknowns = Eigen::VectorXd;

JamRows rows_of(const ContactConstraint& c, int a, int b) {
  const geometry::Vector n = c.normal;
  const geometry::Vector t = perpendicular(n);
  return {.of_a = {{-n.x, -n.y, -c.arm_cross_normal_a[0], 0},
                   {-n.x, -n.y, -c.arm_cross_normal_a[1], 0},
                   {-t.x, -t.y, -c.arm_cross_tangent_a, 0}},
          .of_b = {{n.x, n.y, c.arm_cross_normal_b[0], 0},
                   {n.x, n.y, c.arm_cross_normal_b[1], 0},
                   {t.x, t.y, c.arm_cross_tangent_b, 0}},
          .a = a,
          .b = b};
}

/// Which half of all branches waits in a step, without any pattern that a cycle could follow.
bool waits(std::size_t branch, int step) {
  std::uint64_t x = branch * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(step) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 31U)) * 0x94D049BB133111EBU;
  return (x >> 40U & 1U) != 0;
}

}  // namespace

struct JamMemory::Parts {
  using Speeds = std::array<double, 3>;  ///< of one contact: apart at both ends, along the line [m/s]
  /// The branches that a contact is on: of its ends, and whether it slips to a side (−1, 1) or sticks (0).
  struct ActiveSet {
    ActiveBranches ends;
    int slip = 0;
    friend bool operator==(const ActiveSet&, const ActiveSet&) = default;
  };
  JamMatrix matrix;
  std::vector<std::array<double, 3>> impulses_before;     ///< of the constraints
  std::vector<SolverBody> bodies_before, bodies_without;  ///< those free to move; without any impulses
  std::vector<std::int32_t> body_of;                      ///< those free to move, three unknowns each
  std::vector<JamRows> rows;
  std::vector<Speeds> speeds;
  std::vector<JamLoad> loads;  ///< by the speeds, on the branches; the impulses need not obey their laws
  std::vector<ActiveSet> active_sets;
  std::vector<std::array<CrushKinks, 2>> kinks;  ///< of the laws
  std::vector<double> slip_bound;                ///< [N s]
  Unknowns mass, velocity, without;              ///< now, and without any impulses
};

namespace {

using ActiveSet = JamMemory::Parts::ActiveSet;
using Speeds = JamMemory::Parts::Speeds;

class Jam {
 public:
  Jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
      double slip_speed, double residual, JamMemory::Parts& memory)
      : constraints_(constraints),
        laws_(laws),
        bodies_(bodies),
        slip_speed_(slip_speed),
        residual_(residual),
        memory_(memory) {
    number_unknowns();
    take(velocity_);
    rows_.clear(), speeds_.clear(), loads_.clear(), slip_bound_.clear(), impulses_before_.clear();
    for (const ContactConstraint& c : constraints) {
      rows_.push_back(rows_of(c, number_of(c.a), number_of(c.b)));
      const ConstraintSpeeds now = speeds_at(c, bodies);
      speeds_.push_back({now.apart[0], now.apart[1], now.slip});
      loads_.push_back({{c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse}, {}, {}});
      slip_bound_.push_back(c.friction * (c.normal_impulse[0] + c.normal_impulse[1]));
    }
    for (const ContactConstraint& c : constraints)
      impulses_before_.push_back({c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse});
    take(bodies_before_);
    kinks_.clear();
    for (const EndLaws& law : laws) kinks_.push_back({kinks_of(law[0]), kinks_of(law[1])});
    for (ContactConstraint& c : constraints)
      apply_impulses(c, -c.normal_impulse[0], -c.normal_impulse[1], -c.slip_impulse, bodies);
    take(bodies_without_);
    take(without_);
    active_sets_.assign(rows_.size(), {});
  }

  bool solve() {
    JamMatrix& matrix = memory_.matrix;
    matrix.take(static_cast<int>(body_of_.size()), rows_);
    for (int step = 0; step < kMostSteps; ++step) {
      const Choice choice = update_active_sets(step);
      if (step > 0 && choice.are_sets_found && choice.are_bounds_found && enter() < slip_speed_) return true;
      if (!matrix.factorize(mass_, rows_, loads_)) break;
      advance(matrix.solve(-gradient_now()));
    }
    if (enter() >= residual_) restore();
    return false;
  }

 private:
  struct Choice {
    bool are_sets_found = true;    ///< no contact would leave its own
    bool are_bounds_found = true;  ///< of friction
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  void number_unknowns() {
    body_of_.clear();
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
  int number_of(std::int32_t body) const {
    const auto found = std::ranges::lower_bound(body_of_, body);
    const bool is_free = found != body_of_.end() && *found == body;
    return is_free ? static_cast<int>(found - body_of_.begin()) : -1;
  }
  void take(Unknowns& v) const {
    v.resize(mass_.size());
    for (std::size_t i = 0; i < body_of_.size(); ++i) {
      const SolverBody& body = bodies_[index(body_of_[i])];
      v.segment<3>(static_cast<Eigen::Index>(3 * i)) << body.velocity.x, body.velocity.y, body.angular_velocity;
    }
  }

  Choice update_active_sets(int step) {
    Choice choice;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      double normal = 0;
      const ActiveSet next = active_set_of(k, normal);
      if (next != active_sets_[k]) {
        choice.are_sets_found = false;
        const auto change = [&](auto& from, auto to, std::size_t place) {
          if (step < kWholeSteps || !waits(3 * k + place, step)) from = to;
        };
        change(active_sets_[k].ends.of[0], next.ends.of[0], 0);
        change(active_sets_[k].ends.of[1], next.ends.of[1], 1);
        change(active_sets_[k].slip, next.slip, 2);
      }
      const double bound = constraints_[k].friction * normal;
      const double off = std::abs(bound - slip_bound_[k]) * constraints_[k].inverse_slip_mass;
      choice.are_bounds_found &= off < kBoundFound * slip_speed_;
      slip_bound_[k] = bound;
      loads_[k] = load_of(k);
    }
    return choice;
  }
  /// The branches that a contact would be on by itself, were its bodies free but for the impulses of the
  /// others: both ends together, then its slip within the bound so far. (Within the new bound, stick and slip
  /// may follow each other for ever.) `normal`: its impulses then, both ends' [N s].
  ActiveSet active_set_of(std::size_t k, double& normal) const {
    const ContactConstraint& c = constraints_[k];
    const Speeds& speed = speeds_[k];
    const double(&impulse)[3] = loads_[k].impulse;
    const EndsMobility mobility = mobility_of(c);
    const auto trial = trial_speeds(mobility, {speed[0], speed[1]}, impulse);
    ActiveSet set = active_sets_[k];
    const std::array<double, 2> ends = crush_impulses(laws_[k], kinks_[k], mobility, trial, set.ends);
    normal = ends[0] + ends[1];
    const double place = c.inverse_slip_mass * impulse[2] - speed[2];
    const double most = c.inverse_slip_mass * slip_bound_[k] + slip_speed_;
    set.slip = std::abs(place) <= most ? 0 : place > 0 ? 1 : -1;
    return set;
  }
  /// By the speeds now, on the branches as if they had no ends. The bound of what slips follows the normal
  /// impulses within the step: the exact derivative of Coulomb's law, which is not symmetric.
  JamLoad load_of(std::size_t k) const {
    JamLoad load{};
    for (std::size_t end = 0; end < 2; ++end) {
      const BranchLine line = line_of(laws_[k][end], kinks_[k][end].creep, active_sets_[k].ends.of[end]);
      load.impulse[end] = line.at_rest - line.slope * (speeds_[k][end] + laws_[k][end].gap_speed);
      load.slope[end] = line.slope;
    }
    if (active_sets_[k].slip == 0) {
      load.slope[2] = slip_bound_[k] / slip_speed_;
      load.impulse[2] = -load.slope[2] * speeds_[k][2];
      return load;
    }
    const double friction = active_sets_[k].slip * constraints_[k].friction;
    load.impulse[2] = friction * (load.impulse[0] + load.impulse[1]);
    for (int end = 0; end < 2; ++end) load.slip_by_apart[end] = friction * load.slope[end];
    return load;
  }
  Unknowns gradient_now() const {
    Unknowns gradient = mass_.cwiseProduct(velocity_ - without_);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const JamRows& r = rows_[k];
      for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i) {
          if (r.a >= 0) gradient[3 * r.a + i] -= loads_[k].impulse[row] * r.of_a[row][i];
          if (r.b >= 0) gradient[3 * r.b + i] -= loads_[k].impulse[row] * r.of_b[row][i];
        }
      }
    }
    return gradient;
  }
  /// Changes the velocities, and with them speeds and impulses.
  void advance(const Unknowns& direction) {
    velocity_ += direction;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const JamRows& r = rows_[k];
      for (std::size_t row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i) {
          if (r.a >= 0) speeds_[k][row] += r.of_a[row][i] * direction[3 * r.a + i];
          if (r.b >= 0) speeds_[k][row] += r.of_b[row][i] * direction[3 * r.b + i];
        }
      }
      loads_[k] = load_of(k);
      if (active_sets_[k].slip != 0) {  // by impulses within their laws: others would turn the slip round
        slip_bound_[k] = constraints_[k].friction * normal_within_law(k);
        loads_[k].impulse[2] = active_sets_[k].slip * slip_bound_[k];
      }
    }
  }
  double normal_within_law(std::size_t k) const {
    double normal = 0;
    for (std::size_t end = 0; end < 2; ++end) normal += std::clamp(loads_[k].impulse[end], 0.0, laws_[k][end].cap);
    return normal;
  }
  /// Returns by how much the impulses, which obey their bounds once entered, give other speeds than they were found at
  /// [m/s].
  double enter() {
    put(bodies_without_);
    enter_impulses();
    return missed_speed();
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
      for (const double missed :
           {now.apart[0] - speeds_[k][0], now.apart[1] - speeds_[k][1], now.slip - speeds_[k][2]}) {
        if (!std::isfinite(missed)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, std::abs(missed));
      }
    }
    return largest;
  }
  void restore() {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      ContactConstraint& c = constraints_[k];
      c.normal_impulse[0] = impulses_before_[k][0], c.normal_impulse[1] = impulses_before_[k][1];
      c.slip_impulse = impulses_before_[k][2];
    }
    put(bodies_before_);
  }
  void take(std::vector<SolverBody>& all) const {
    all.clear();
    for (const std::int32_t body : body_of_) all.push_back(bodies_[index(body)]);
  }
  void put(const std::vector<SolverBody>& all) {
    for (std::size_t i = 0; i < body_of_.size(); ++i) bodies_[index(body_of_[i])] = all[i];
  }

  std::span<ContactConstraint> constraints_;
  std::span<const EndLaws> laws_;
  std::span<SolverBody> bodies_;
  double slip_speed_;
  double residual_;  ///< of the sweeps before [m/s]
  JamMemory::Parts& memory_;
  std::vector<std::array<double, 3>>& impulses_before_ = memory_.impulses_before;
  std::vector<SolverBody>& bodies_before_ = memory_.bodies_before;
  std::vector<SolverBody>& bodies_without_ = memory_.bodies_without;
  std::vector<std::int32_t>& body_of_ = memory_.body_of;
  std::vector<JamRows>& rows_ = memory_.rows;
  std::vector<Speeds>& speeds_ = memory_.speeds;
  std::vector<JamLoad>& loads_ = memory_.loads;
  std::vector<ActiveSet>& active_sets_ = memory_.active_sets;
  std::vector<std::array<CrushKinks, 2>>& kinks_ = memory_.kinks;
  std::vector<double>& slip_bound_ = memory_.slip_bound;
  Unknowns &mass_ = memory_.mass, &velocity_ = memory_.velocity, &without_ = memory_.without;
};

}  // namespace

JamMemory::JamMemory() : parts_(std::make_unique<Parts>()) {}
JamMemory::~JamMemory() = default;
JamMemory::JamMemory(JamMemory&&) noexcept = default;
JamMemory& JamMemory::operator=(JamMemory&&) noexcept = default;

CrushResponse rigid_law(double inverse_mass) {
  return {.impulse_of_force = kCreepSpeed * kRigid / inverse_mass,
          .slope = 0,
          .gap_speed = 0,
          .cap = std::numeric_limits<double>::infinity()};
}

bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
               double slip_speed, double residual, JamMemory& memory) {
  return Jam(constraints, laws, bodies, slip_speed, residual, memory.parts()).solve();
}

}  // namespace polynya::dynamics
