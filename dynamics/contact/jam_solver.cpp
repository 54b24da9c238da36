#include "dynamics/contact/jam_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dynamics/chunks.hpp"
#include "dynamics/contact/internal/jam_matrix.hpp"

namespace polynya::dynamics {
namespace {

/// Largest number of Newton steps for a jam; half a dozen is common. Fewer: more jams are left to the sweeps, which
/// converge slowly.
constexpr int kMostSteps = 60;
/// Number of Newton steps that change all branches. After them a random half of the changes (branches of ends, slip of
/// contacts) is postponed in each step, except for the change that is farthest beyond its branch. This ends cycles.
/// Fewer: every jam takes more steps. Many more: jams that cycle are not solved within kMostSteps.
constexpr int kWholeSteps = 4;
/// Number of Newton steps in which the friction bound of a slipping contact follows the normal impulses completely.
/// After them it follows only by half, because the matrix may be nearly singular with the complete derivative, and
/// speeds then jump. Fewer: every jam takes more steps. More: a few jams are never solved.
constexpr int kWholeBoundSteps = 16;
/// Largest change of slip by the friction bound at which the bound counts as found, as a fraction of the slip speed
/// [-]. Larger: the slip impulses deviate from Coulomb's law by that fraction.
constexpr double kBoundFound = 0.05;
/// Slope of a sticking contact, in units of the friction bound per slip speed [-]: the value at which it starts, and
/// the largest value that is kept while the bound changes. A smaller range: more rows of the matrix are factorized
/// again. A steeper start: Newton's method solves fewer jams.
constexpr double kStickStart = 1.4, kStickRange = 2;
/// Impulse per speed of a rigid end, in units of the effective mass there [-]. Smaller: steel visibly sinks into steel.
/// Far larger: the masses are lost in rounding, and the matrix becomes singular.
constexpr double kRigid = 1e6;

/// Number of contacts that one thread takes at a time: about 10 µs of work in each Newton step. Does not change
/// results.
constexpr std::size_t kPerChunk = 48;

/// Returns the derivatives of a contact's separating speeds at both ends and of its slip with respect to the velocities
/// of its two bodies, which have the given numbers in the system.
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

/// Returns true if a change of a branch is postponed to a later Newton step: a pseudo-random half of all branches in
/// each step, without a pattern that a cycle could follow.
bool is_postponed(std::size_t branch, int step) {
  std::uint64_t x = branch * 0x9E3779B97F4A7C15U + static_cast<std::uint64_t>(step) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 31U)) * 0x94D049BB133111EBU;
  return (x >> 40U & 1U) != 0;
}

}  // namespace

struct JamMemory::Parts {
  using Speeds = std::array<double, 3>;  ///< speeds of one contact: separation at both ends, slip along the line [m/s]
  /// Branches of the two ends of a contact, and whether it slips to one side (−1 or 1) or sticks (0).
  struct ActiveSet {
    ActiveBranches ends;
    int slip = 0;
    friend bool operator==(const ActiveSet&, const ActiveSet&) = default;
  };
  /// Straight line of the branch of an end's law, impulse = at_rest − slope × speed, and the range in which it is the
  /// nearest branch (see branch_near).
  struct Line {
    double at_rest, slope;  ///< impulse at a speed of 0 [N s], and its decrease per speed [N s per m/s]
    double after, to;       ///< places at which the branch begins and ends [m/s]
  };
  /// A contact that would leave its branches, the branches to which it would change, and how far it is beyond the
  /// present ones [m/s].
  struct Change {
    std::size_t contact;
    ActiveSet to;
    std::array<double, 3> by;  ///< for its two ends and its slip [m/s]
  };
  JamMatrix matrix;
  std::vector<Change> changes;
  std::vector<std::vector<Change>> changes_of_chunk;
  std::vector<double> normal;  ///< sum of the normal impulses of each contact, by its law alone [N s]
  std::vector<std::array<double, 3>> impulses_before;     ///< impulses of the constraints at the start
  std::vector<SolverBody> bodies_before, bodies_without;  ///< free bodies at the start, and without any impulses
  std::vector<std::int32_t> number_of;  ///< unknown of each of the solver's bodies; −1: prescribed motion
  std::vector<std::int32_t> body_of;    ///< solver body of each unknown; each has three components
  std::vector<JamRows> rows;
  std::vector<Speeds> speeds;
  std::vector<JamLoad> loads;  ///< linearised at the present speeds and branches; the impulses may violate their laws
  std::vector<ActiveSet> active_sets;
  std::vector<std::array<CrushKinks, 2>> kinks;  ///< kinks of the laws
  std::vector<std::array<Line, 2>> lines;        ///< lines of the branches
  std::vector<double> slip_bound;                ///< largest slip impulse by Coulomb's law [N s]
  std::vector<double> stick_slope;               ///< slip impulse per slip speed of a sticking contact [N s per m/s]
  JamVector mass, velocity, without;             ///< now, and without impulses; a last element for prescribed motion
  JamVector direction;
};

namespace {

using ActiveSet = JamMemory::Parts::ActiveSet;
using Change = JamMemory::Parts::Change;
using Line = JamMemory::Parts::Line;
using Speeds = JamMemory::Parts::Speeds;

class Jam {
 public:
  Jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
      double slip_speed, double residual, JamMemory::Parts& memory, int threads)
      : constraints_(constraints),
        laws_(laws),
        bodies_(bodies),
        slip_speed_(slip_speed),
        residual_(residual),
        threads_(threads),
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
    stick_slope_.assign(rows_.size(), 0);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr Line kNone{.at_rest = 0, .slope = 0, .after = kInfinity, .to = kInfinity};  // no branch yet
    lines_.assign(rows_.size(), {kNone, kNone});
    normal_.resize(rows_.size());
  }

  bool solve() {
    JamMatrix& matrix = memory_.matrix;
    matrix.take(static_cast<int>(body_of_.size()), rows_);
    for (int step = 0; step < kMostSteps; ++step) {
      const Choice choice = update_active_sets(step);
      if (step > 0 && choice.are_sets_found && choice.are_bounds_found && enter() < slip_speed_) return true;
      if (!matrix.factorize(mass_, rows_, loads_, threads_)) break;
      find_imbalance();
      matrix.solve(memory_.direction, threads_);
      advance();
    }
    if (enter() >= residual_) restore();
    return false;
  }

 private:
  struct Choice {
    bool are_sets_found = true;    ///< no contact would leave its branches
    bool are_bounds_found = true;  ///< no friction bound would change
  };

  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  /// Numbers the free bodies in the order in which the contacts name them.
  void number_unknowns() {
    body_of_.clear();
    std::vector<std::int32_t>& number = memory_.number_of;
    if (number.size() < bodies_.size()) number.resize(bodies_.size());
    for (const ContactConstraint& c : constraints_) number[index(c.a)] = number[index(c.b)] = -1;
    for (const ContactConstraint& c : constraints_) {
      for (const std::int32_t body : {c.a, c.b}) {
        if (number[index(body)] >= 0 || bodies_[index(body)].inverse_mass == 0) continue;
        number[index(body)] = static_cast<std::int32_t>(body_of_.size());
        body_of_.push_back(body);
      }
    }
    mass_.assign(body_of_.size() + 1, {});
    for (std::size_t i = 0; i < body_of_.size(); ++i) {
      const SolverBody& body = bodies_[index(body_of_[i])];
      const double mass = 1 / body.inverse_mass;
      mass_[i] = {mass, mass, 1 / body.inverse_moment, 0};
    }
  }
  int number_of(std::int32_t body) const { return memory_.number_of[index(body)]; }
  void take(JamVector& v) const {
    v.assign(mass_.size(), {});
    for (std::size_t i = 0; i < body_of_.size(); ++i) {
      const SolverBody& body = bodies_[index(body_of_[i])];
      v[i] = {body.velocity.x, body.velocity.y, body.angular_velocity, 0};
    }
  }

  Choice update_active_sets(int step) {
    Choice choice;
    share_that_follows_ = step < kWholeBoundSteps ? 1 : 0.5;
    if (step == 0) find_changes([](std::size_t, std::size_t) {});
    double most = 0;
    for (const Change& change : changes_) most = std::max({most, change.by[0], change.by[1], change.by[2]});
    for (const Change& change : changes_) {
      const std::size_t k = change.contact;
      const auto take = [&](auto& from, auto to, std::size_t place) {
        if (step < kWholeSteps || !is_postponed(3 * k + place, step) || change.by[place] == most) from = to;
      };
      take(active_sets_[k].ends.of[0], change.to.ends.of[0], 0);
      take(active_sets_[k].ends.of[1], change.to.ends.of[1], 1);
      take(active_sets_[k].slip, change.to.slip, 2);
      find_lines(k);
    }
    choice.are_sets_found = changes_.empty();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (step == 0) find_lines(k);
      const double bound = constraints_[k].friction * normal_[k];
      const double off = std::abs(bound - slip_bound_[k]) * constraints_[k].inverse_slip_mass;
      choice.are_bounds_found &= off < kBoundFound * slip_speed_;
      slip_bound_[k] = bound;
      if (step == 0)
        find_load(k);
      else
        find_slip_load(k);
    }
    if (step > 0) {
      for (const Change& change : changes_) find_load(change.contact);
    }
    return choice;
  }
  /// Calls prepare(begin, end) for chunks of contacts in parallel, and then finds their changes of branches, which are
  /// listed in the order of the contacts.
  template <class Prepare>
  void find_changes(Prepare prepare) {
    auto& of_chunk = memory_.changes_of_chunk;
    const std::size_t chunks = chunk_count(rows_.size(), kPerChunk);
    if (of_chunk.size() < chunks) of_chunk.resize(chunks);
    for_chunks(rows_.size(), kPerChunk, threads_, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      of_chunk[chunk].clear();
      prepare(begin, end);
      for (std::size_t k = begin; k < end; ++k) find_change(k, of_chunk[chunk]);
    });
    changes_.clear();
    for (const auto& some : std::span(of_chunk).first(chunks))
      changes_.insert(changes_.end(), some.begin(), some.end());
  }
  /// Adds a change to the list if contact k would leave its branches at the present speeds and impulses.
  void find_change(std::size_t k, std::vector<Change>& changes) {
    const ContactConstraint& c = constraints_[k];
    const std::array<double, 2> beyond{beyond_branch(k, 0), beyond_branch(k, 1)};
    ActiveSet set = active_sets_[k];
    normal_[k] = beyond[0] <= 0 && beyond[1] <= 0 ? normal_within_law(k) : find_branches(k, set.ends);
    const double slipping = c.inverse_slip_mass * loads_[k].impulse[2] - speeds_[k][2];
    const double most = c.inverse_slip_mass * slip_bound_[k] + stick_speed(k);
    // The bound of the last step is used here: with the new one, stick and slip may alternate forever.
    set.slip = std::abs(slipping) <= most ? 0 : slipping > 0 ? 1 : -1;
    if (set == active_sets_[k]) return;
    const auto by = [&](auto from, auto to, double beyond_it) { return from != to ? beyond_it : 0; };
    const ActiveSet& now = active_sets_[k];
    changes.push_back({k,
                       set,
                       {by(now.ends.of[0], set.ends.of[0], beyond[0]), by(now.ends.of[1], set.ends.of[1], beyond[1]),
                        by(now.slip, set.slip, std::abs(std::abs(slipping) - most))}});
  }
  /// Returns how far an end is beyond the range in which its branch is the nearest one; negative inside [m/s].
  double beyond_branch(std::size_t k, std::size_t end) const {
    const Line& line = lines_[k][end];
    const double place =
        -speeds_[k][end] - laws_[k][end].gap_speed + constraints_[k].inverse_mass_at[end] * loads_[k].impulse[end];
    return std::max(line.after - place, place - line.to);
  }
  /// Finds the branches that solve the law of a contact alone, with the impulses of all other contacts fixed. Returns
  /// the sum of the normal impulses of both ends [N s].
  double find_branches(std::size_t k, ActiveBranches& branches) const {
    const EndsMobility mobility = mobility_of(constraints_[k]);
    const auto trial = trial_speeds(mobility, {speeds_[k][0], speeds_[k][1]}, loads_[k].impulse);
    const std::array<double, 2> ends = crush_impulses(laws_[k], kinks_[k], mobility, trial, branches);
    return ends[0] + ends[1];
  }
  /// Computes the lines of the branches of contact k.
  void find_lines(std::size_t k) {
    for (std::size_t end = 0; end < 2; ++end) {
      const CrushBranch branch = active_sets_[k].ends.of[end];
      const BranchLine line = line_of(laws_[k][end], kinks_[k][end].creep, branch);
      const auto [after, to] = places_of(laws_[k][end], kinks_[k][end], constraints_[k].inverse_mass_at[end], branch);
      lines_[k][end] = {line.at_rest, line.slope, after, to};
    }
  }
  /// Returns the slip speed at which a sticking contact reaches its friction bound [m/s].
  double stick_speed(std::size_t k) const {
    return stick_slope_[k] > 0 ? slip_bound_[k] / stick_slope_[k] : slip_speed_;
  }
  /// Linearises a contact at the present speeds, on its branches extended without ends. The friction bound of a
  /// slipping contact follows the normal impulses within the step: this is the exact derivative of Coulomb's law, which
  /// is not symmetric.
  void find_load(std::size_t k) {
    JamLoad& load = loads_[k];
    for (std::size_t end = 0; end < 2; ++end) {
      const Line& line = lines_[k][end];
      load.impulse[end] = line.at_rest - line.slope * (speeds_[k][end] + laws_[k][end].gap_speed);
      load.slope[end] = line.slope;
    }
    find_slip_load(k);
  }
  /// Linearises the slip impulse of contact k.
  void find_slip_load(std::size_t k) {
    JamLoad& load = loads_[k];
    const double friction = share_that_follows_ * active_sets_[k].slip * constraints_[k].friction;
    for (int end = 0; end < 2; ++end) load.slip_by_apart[end] = friction * load.slope[end];
    load.slope[2] = 0;
    load.impulse[2] = friction * (load.impulse[0] + load.impulse[1]) +
                      (1 - share_that_follows_) * active_sets_[k].slip * slip_bound_[k];
    if (active_sets_[k].slip != 0) return;
    find_stick_slope(k);
    load.slope[2] = stick_slope_[k];
    load.impulse[2] = -load.slope[2] * speeds_[k][2];
  }
  /// Updates the slope of a sticking contact. It is kept while the friction bound changes little, so that the rows of
  /// the matrix are kept too.
  void find_stick_slope(std::size_t k) {
    const double most = slip_bound_[k] / slip_speed_;
    if (stick_slope_[k] < most || stick_slope_[k] > kStickRange * most) stick_slope_[k] = kStickStart * most;
  }
  /// Finds the momenta that are missing for equilibrium.
  void find_imbalance() {
    JamVector& missed = memory_.direction;
    missed.resize(mass_.size());
    for (std::size_t i = 0; i < mass_.size(); ++i) {
      for (std::size_t j = 0; j < 4; ++j) missed[i][j] = mass_[i][j] * (velocity_[i][j] - without_[i][j]);
    }
    subtract_impulses(rows_, loads_, missed);
    for (auto& of_body : missed) {
      for (double& each : of_body) each = -each;
    }
    missed.back() = {};
  }
  /// Changes the velocities by the Newton direction, and with them speeds and impulses.
  void advance() {
    for (std::size_t i = 0; i < velocity_.size(); ++i) {
      for (std::size_t j = 0; j < 4; ++j) velocity_[i][j] += memory_.direction[i][j];
    }
    find_changes([&](std::size_t begin, std::size_t end) {
      const std::size_t count = end - begin;
      add_speeds(std::span(rows_).subspan(begin, count), memory_.direction, std::span(speeds_).subspan(begin, count));
      for (std::size_t k = begin; k < end; ++k) {
        find_load(k);
        if (active_sets_[k].slip == 0) continue;  // impulses within their laws: others would reverse the slip
        slip_bound_[k] = constraints_[k].friction * normal_within_law(k);
        loads_[k].impulse[2] = active_sets_[k].slip * slip_bound_[k];
      }
    });
  }
  /// Returns the sum of the normal impulses of both ends, each limited by its law [N s].
  double normal_within_law(std::size_t k) const {
    double normal = 0;
    for (std::size_t end = 0; end < 2; ++end) normal += std::clamp(loads_[k].impulse[end], 0.0, laws_[k][end].cap);
    return normal;
  }
  /// Enters the impulses, limited to their bounds, into the constraints and the bodies. Returns missed_speed() [m/s].
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

  /// Returns the largest difference between the speeds after the entered (limited) impulses and the speeds for which
  /// they were computed [m/s]. It is large before the minimum is reached, and where masses differ by more than double
  /// precision can resolve.
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
  /// Restores the impulses and bodies from before the solution.
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
  double residual_;  ///< residual of the sweeps before [m/s]
  int threads_;
  double share_that_follows_ = 1;  ///< fraction of a change of the friction bound that is followed within a step
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
  std::vector<Change>& changes_ = memory_.changes;
  std::vector<double>& normal_ = memory_.normal;
  std::vector<std::array<Line, 2>>& lines_ = memory_.lines;
  std::vector<double>& slip_bound_ = memory_.slip_bound;
  std::vector<double>& stick_slope_ = memory_.stick_slope;
  JamVector &mass_ = memory_.mass, &velocity_ = memory_.velocity, &without_ = memory_.without;
};

}  // namespace

JamMemory::JamMemory() : parts_(std::make_unique<Parts>()) {}
JamMemory::~JamMemory() = default;
JamMemory::JamMemory(JamMemory&&) noexcept = default;
JamMemory& JamMemory::operator=(JamMemory&&) noexcept = default;

// At kCreepSpeed, the default of CrushResponse::creep_speed, the impulse is kRigid times the effective mass times that
// speed; its ratio to the speed is the slope of the creep branch.
CrushResponse rigid_law(double inverse_mass) {
  return {.impulse_of_force = kCreepSpeed * kRigid / inverse_mass,
          .slope = 0,
          .gap_speed = 0,
          .cap = std::numeric_limits<double>::infinity()};
}

bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
               double slip_speed, double residual, JamMemory& memory, int threads) {
  return Jam(constraints, laws, bodies, slip_speed, residual, memory.parts(), threads).solve();
}

}  // namespace polynya::dynamics
