#include "dynamics/contact/impulse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {
namespace {

/// Friction while sliding can raise the impulse that ends an approach above the frictionless one; seldom to
/// twice it.
constexpr double kFrictionSlack = 2;

/// How much of an unconverged step's impulses the next one starts from: a wrong start must decay, not grow.
constexpr double kTrustUnconverged = 0.5;

}  // namespace

void ImpulseSolver::fill_constraints(const Bodies& bodies, std::vector<Contact>& contacts,
                                     const SolverSettings& settings) {
  take_bodies(bodies, islands_.bodies_touched(), solver_bodies_);
  constraints_.resize(contacts.size());
  directions_.resize(contacts.size());
  before_.resize(contacts.size());
  for_chunks(constraints_.size(), kContactsPerChunk, settings.threads,
             [&](std::size_t, std::size_t begin, std::size_t end) {
               for (std::size_t k = begin; k < end; ++k) {
                 const std::uint32_t i = islands_.order()[k];
                 // Made in its place: copying it costs as much as making it.
                 new (&constraints_[k]) ContactConstraint(make_constraint(
                     bodies, contacts[i], islands_.place_of_a(i), islands_.place_of_b(i), solver_bodies_));
                 before_[k] = speeds_at(constraints_[k], solver_bodies_);
                 PersistentContact* record = contacts[i].record;
                 if (record == nullptr) continue;
                 record->restitution_limit =
                     std::max(record->restitution_limit, kFrictionSlack * settings.restitution *
                                                             isolated_impulse(constraints_[k], before_[k]));
               }
             });
}

/// Starts an island from the impulses that its last two steps predict.
void ImpulseSolver::warm_start(const Island& island, const std::vector<Contact>& contacts) {
  for (std::uint32_t k = island.first; k < island.first + island.count; ++k) {
    const PersistentContact* record = contacts[islands_.order()[k]].record;
    if (record == nullptr || (record->warm_start_impulse[0] == 0 && record->warm_start_impulse[1] == 0))
      continue;
    ContactConstraint& constraint = constraints_[k];
    for (int end = 0; end < 2; ++end)
      constraint.normal_impulse[end] = std::min(record->warm_start_impulse[end], constraint.limit);
    apply_impulses(constraint, constraint.normal_impulse[0], constraint.normal_impulse[1], 0, solver_bodies_);
  }
}

/// Extrapolates all impulses of an island along their search direction: the nonsmooth nonlinear conjugate
/// gradient of [Silcowitz2010]. Jammed floes need it, whose impulses grow by little in each iteration.
void ImpulseSolver::accelerate(const Island& island, SearchState& search) {
  double squared_change = 0;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    const ContactConstraint& constraint = constraints_[i];
    const Direction& direction = directions_[i];
    const double change[3] = {constraint.normal_impulse[0] - direction.before[0],
                              constraint.normal_impulse[1] - direction.before[1],
                              constraint.slip_impulse - direction.before[2]};
    squared_change += change[0] * change[0] * constraint.inverse_mass_at[0] +
                      change[1] * change[1] * constraint.inverse_mass_at[1] +
                      change[2] * change[2] * constraint.inverse_slip_mass;
  }
  const bool is_start = search.iterations++ == 0;
  const bool has_grown = squared_change > search.last_change * (1 + 1e-6);
  const double share = is_start || has_grown ? 0 : std::min(1.0, squared_change / search.last_change);
  search.last_change = squared_change;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    ContactConstraint& constraint = constraints_[i];
    Direction& direction = directions_[i];
    const double p[3] = {constraint.normal_impulse[0], constraint.normal_impulse[1], constraint.slip_impulse};
    double extrapolated[3];
    for (int k = 0; k < 3; ++k) {
      const double along = is_start ? 0 : share * direction.along[k];
      extrapolated[k] = p[k] + along;
      direction.along[k] = along + (p[k] - direction.before[k]);
    }
    if (share == 0) continue;
    constraint.normal_impulse[0] = std::clamp(extrapolated[0], constraint.least[0], constraint.limit);
    constraint.normal_impulse[1] = std::clamp(extrapolated[1], constraint.least[1], constraint.limit);
    const double most = constraint.friction * (constraint.normal_impulse[0] + constraint.normal_impulse[1]);
    constraint.slip_impulse = std::clamp(extrapolated[2], -most, most);
    apply_impulses(constraint, constraint.normal_impulse[0] - p[0], constraint.normal_impulse[1] - p[1],
                   constraint.slip_impulse - p[2], solver_bodies_);
  }
}

/// Solves the constraints of an island one after the other until it has converged or the iterations are used
/// up. Returns the residual, the largest change of a velocity in the last iteration; 0 where it has converged
/// [m/s].
double ImpulseSolver::iterate(const Island& island, const SolverSettings& settings) {
  constexpr int kPlainIterations = 4;  // most islands need no more
  const std::span<ContactConstraint> constraints(constraints_.data() + island.first, island.count);
  const std::span<SolverBody> solver_bodies(solver_bodies_);
  SearchState search;
  double largest_change = 0;
  for (int iteration = 0; iteration < settings.max_iterations; ++iteration) {
    largest_change = 0;
    const bool is_plain = iteration < kPlainIterations;
    if (!is_plain) {
      for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
        const ContactConstraint& constraint = constraints_[i];
        directions_[i].before[0] = constraint.normal_impulse[0];
        directions_[i].before[1] = constraint.normal_impulse[1];
        directions_[i].before[2] = constraint.slip_impulse;
      }
    }
    for (ContactConstraint& constraint : constraints)
      largest_change = std::max(largest_change, solve_constraint(constraint, solver_bodies));
    if (largest_change <= settings.tolerance) return 0;
    if (!is_plain && iteration + 1 < settings.max_iterations) accelerate(island, search);
  }
  return largest_change;
}

bool ImpulseSolver::apply_restitution(const Island& island, std::vector<Contact>& contacts,
                                      double restitution, bool is_converged) {
  bool gave = false;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    ContactConstraint& constraint = constraints_[i];
    PersistentContact* record = contacts[islands_.order()[i]].record;
    const double compression = constraint.normal_impulse[0] + constraint.normal_impulse[1];
    double owed = restitution * compression;
    if (record != nullptr) {
      owed = std::min(owed + record->owed_impulse, record->restitution_limit - record->given_impulse);
      for (int end = 0; end < 2; ++end) {
        // The prediction for the next step: steady or falling in proportion, never more than the last two.
        const double last = record->last_impulse[end];
        const double now = constraint.normal_impulse[end];
        const double warm_start = now < last ? now * (now / last) : last;
        record->warm_start_impulse[end] = is_converged ? warm_start : kTrustUnconverged * warm_start;
        record->last_impulse[end] = now;
      }
    }
    if (owed <= 0) continue;
    double given[2];
    double still_owed = 0;
    const double owed_per_compression = compression > 0 ? owed / compression : 0;
    for (int end = 0; end < 2; ++end) {
      const double share =
          compression > 0 ? owed_per_compression * constraint.normal_impulse[end] : 0.5 * owed;
      constraint.least[end] = std::min(constraint.normal_impulse[end] + share, constraint.limit);
      given[end] = constraint.least[end] - constraint.normal_impulse[end];
      still_owed += share - given[end];
      constraint.normal_impulse[end] = constraint.least[end];
      gave = gave || given[end] > 0;
    }
    apply_impulses(constraint, given[0], given[1], 0, solver_bodies_);
    if (record != nullptr) {
      record->owed_impulse = still_owed;
      record->given_impulse += owed - still_owed;
    }
  }
  return gave;
}

void ImpulseSolver::write_back(Bodies& bodies, std::vector<Contact>& contacts) {
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    const ContactConstraint& constraint = constraints_[i];
    Contact& c = contacts[islands_.order()[i]];
    c.normal_impulse[0] = constraint.normal_impulse[0];
    c.normal_impulse[1] = constraint.normal_impulse[1];
    c.slip_impulse = constraint.slip_impulse;
    // Impulses together change the kinetic energy by each one times the mean of the speeds before and after.
    const ConstraintSpeeds& before = before_[i];
    const ConstraintSpeeds after = speeds_at(constraint, solver_bodies_);
    c.normal_work = 0.5 * (constraint.normal_impulse[0] * (before.apart[0] + after.apart[0]) +
                           constraint.normal_impulse[1] * (before.apart[1] + after.apart[1]));
    c.slip_work = 0.5 * constraint.slip_impulse * (before.slip + after.slip);
    const bool is_prescribed =
        solver_bodies_[constraint.a].inverse_mass == 0 || solver_bodies_[constraint.b].inverse_mass == 0;
    c.prescribed_work = is_prescribed ? prescribed_work(constraint, solver_bodies_, bodies, c) : 0;
  }
  give_back_bodies(solver_bodies_, islands_.bodies_touched(), bodies);
}

SolverResult ImpulseSolver::solve(Bodies& bodies, std::vector<Contact>& contacts,
                                  const SolverSettings& settings) {
  islands_.find(bodies, contacts);
  fill_constraints(bodies, contacts, settings);
  residuals_.assign(islands_.islands().size(), 0);
  const int threads = contacts.size() < 2 * kContactsPerChunk ? 1 : settings.threads;
  for_chunks(islands_.islands().size(), kIslandsPerChunk, threads,
             [&](std::size_t, std::size_t begin, std::size_t end) {
               for (std::size_t k = begin; k < end; ++k) {
                 const Island& island = islands_.islands()[k];
                 warm_start(island, contacts);
                 residuals_[k] = iterate(island, settings);
                 if (apply_restitution(island, contacts, settings.restitution, residuals_[k] == 0))
                   residuals_[k] = std::max(residuals_[k], iterate(island, settings));
               }
             });
  write_back(bodies, contacts);
  SolverResult result;
  for (const double residual : residuals_) {
    result.unconverged += residual > 0;
    result.residual = std::max(result.residual, residual);
  }
  return result;
}

}  // namespace polynya::dynamics
