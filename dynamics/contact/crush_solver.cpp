#include "dynamics/contact/crush_solver.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "dynamics/chunks.hpp"
#include "dynamics/contact/jam_solver.hpp"

namespace polynya::dynamics {
namespace {

constexpr int kPlainSweeps = 4;  ///< before the acceleration; most islands need no more
/// An island that needs more sweeps is jammed: Newton's method, now and again. Most small ones come to their
/// solution by some more.
constexpr int sweeps_to_jam(const Island& island) {
  return island.count > 64 ? 24 : 48;
}
constexpr double kSlipShare = 0.5;  ///< of the tolerance: speed within which friction grows to its bound

}  // namespace

void CrushSolver::fill(const Bodies& bodies, const std::vector<Contact>& contacts,
                       const CrushSettings& settings) {
  take_bodies(bodies, islands_.bodies_touched(), solver_bodies_);
  constraints_.resize(contacts.size());
  crushing_.resize(contacts.size());
  before_.resize(contacts.size());
  directions_.resize(contacts.size());
  for_chunks(contacts.size(), kContactsPerChunk, settings.threads,
             [&](std::size_t, std::size_t begin, std::size_t end) {
               for (std::size_t k = begin; k < end; ++k) {
                 const std::uint32_t i = islands_.order()[k];
                 const Contact& c = contacts[i];
                 // Made in their places: copying them costs as much as making them.
                 new (&constraints_[k]) ContactConstraint(make_constraint(
                     bodies, c, islands_.place_of_a(i), islands_.place_of_b(i), solver_bodies_));
                 new (&crushing_[k]) Crushing{.force = c.crushing_force,
                                              .stiffness = c.crushing_stiffness,
                                              .depth = c.depth,
                                              .loaded = c.record->loaded_depth,
                                              .missed = c.missed_impulse,
                                              .breaking_force = c.breaking_force,
                                              .ends = {},
                                              .pieces = {},
                                              .total = {0, 0},
                                              .total_slip = 0,
                                              .normal_work = 0,
                                              .slip_work = 0,
                                              .is_rigid = c.is_rigid,
                                              .is_broken = false};
               }
             });
}

/// The most impulse that the ice gives in a time τ before it breaks: where the force grows to the breaking
/// force sooner, at the speed of closing now, all until then [N s].
double CrushSolver::impulse_to_breaking(const Crushing& c, const ConstraintSpeeds& speeds, double tau) {
  if (!std::isfinite(c.breaking_force)) return c.breaking_force;
  const double growth = -0.5 * (speeds.apart[0] + speeds.apart[1]) * c.stiffness;  // [N/s]
  const double left = c.breaking_force - c.force;
  if (left <= 0) return 0;
  const double time = growth > 0 ? left / growth : tau;
  return time < tau ? 0.5 * (c.force + c.breaking_force) * time : tau * c.breaking_force;
}

void CrushSolver::begin_substep(const Island& island, double tau, bool is_first) {
  for (std::uint32_t k = island.first; k < island.first + island.count; ++k) {
    Crushing& c = crushing_[k];
    ContactConstraint& constraint = constraints_[k];
    before_[k] = speeds_at(constraint, solver_bodies_);
    // The force at the overlap now, by the law's slope where it was found.
    CrushResponse& end = c.ends[0];
    end.impulse_of_force = 0.5 * (tau * c.force + (is_first ? c.missed : 0));
    end.slope = 0.25 * c.stiffness * tau * tau;
    end.gap_speed = std::max(0.0, c.loaded - c.depth) / tau;
    end.cap = c.is_broken ? 0 : 0.5 * (impulse_to_breaking(c, before_[k], tau) + (is_first ? c.missed : 0));
    c.ends[1] = end;
  }
}

void CrushSolver::warm_start(const Island& island, const std::vector<Contact>& contacts, bool is_first,
                             bool is_warm) {
  for (std::uint32_t k = island.first; k < island.first + island.count; ++k) {
    ContactConstraint& constraint = constraints_[k];
    const PersistentContact& record = *contacts[islands_.order()[k]].record;
    for (int end = 0; end < 2; ++end) {
      const double last = is_first ? record.last_impulse[end] : constraint.normal_impulse[end];
      const double from = is_warm ? last : 0;
      constraint.normal_impulse[end] =
          crushing_[k].is_rigid ? from : std::min(from, crushing_[k].ends[end].cap);
    }
    const double most = constraint.friction * (constraint.normal_impulse[0] + constraint.normal_impulse[1]);
    constraint.slip_impulse = is_first ? 0 : std::clamp(constraint.slip_impulse, -most, most);
    apply_impulses(constraint, constraint.normal_impulse[0], constraint.normal_impulse[1],
                   constraint.slip_impulse, solver_bodies_);
  }
}

double CrushSolver::sweep(const Island& island, const CrushSettings& settings) {
  const int to_jam = sweeps_to_jam(island);
  double last = 0;
  double violation = 0;
  int accelerated = 0;  // sweeps since the last start
  for (int round = 0; round < settings.max_iterations; ++round) {
    const bool is_plain = round < kPlainSweeps;
    violation = 0;
    for (std::uint32_t k = island.first; k < island.first + island.count; ++k) {
      ContactConstraint& constraint = constraints_[k];
      if (!is_plain)
        directions_[k].before[0] = constraint.normal_impulse[0],
        directions_[k].before[1] = constraint.normal_impulse[1],
        directions_[k].before[2] = constraint.slip_impulse;
      if (crushing_[k].is_rigid) {
        violation = std::max(violation, solve_constraint(constraint, std::span(solver_bodies_)));
        continue;
      }
      const SolverBody& a = solver_bodies_[constraint.a];
      const SolverBody& b = solver_bodies_[constraint.b];
      const std::array<double, 2> apart = apart_at(constraint, a, b);
      const EndsMobility mobility{{constraint.inverse_mass_at[0], constraint.inverse_mass_at[1]},
                                  constraint.inverse_mass_between};
      const double p0 = constraint.normal_impulse[0], p1 = constraint.normal_impulse[1];
      const std::array<double, 2> free{-apart[0] + mobility.at[0] * p0 + mobility.between * p1,
                                       -apart[1] + mobility.between * p0 + mobility.at[1] * p1};
      if (p0 == 0 && p1 == 0 && constraint.slip_impulse == 0 && free[0] <= 0 && free[1] <= 0) continue;
      const auto impulse = crush_impulses(crushing_[k].ends, mobility, free, crushing_[k].pieces);
      const double change_0 = impulse[0] - p0;
      const double change_1 = impulse[1] - p1;
      constraint.normal_impulse[0] = impulse[0];
      constraint.normal_impulse[1] = impulse[1];
      const double slip = slip_to_rest(constraint, a, b, change_0, change_1) - constraint.slip_impulse;
      constraint.slip_impulse += slip;
      apply_impulses(constraint, change_0, change_1, slip, solver_bodies_);
      violation =
          std::max({violation, std::abs(change_0) * mobility.at[0], std::abs(change_1) * mobility.at[1],
                    std::abs(slip) * constraint.inverse_slip_mass});
    }
    if (violation <= settings.tolerance) return violation;
    if (round + 1 >= settings.max_iterations) break;
    if (round % to_jam == to_jam - 1) {
      solve_jam(island, settings.tolerance);
      accelerated = 0;
    } else if (!is_plain) {
      accelerate(island, last, accelerated++ == 0);
    }
  }
  return violation;
}

void CrushSolver::solve_jam(const Island& island, double tolerance) {
  std::vector<EndLaws> laws(island.count);
  for (std::uint32_t k = 0; k < island.count; ++k) {
    const Crushing& crushing = crushing_[island.first + k];
    const ContactConstraint& constraint = constraints_[island.first + k];
    if (crushing.is_rigid)
      laws[k] = {rigid_law(constraint.inverse_mass_at[0]), rigid_law(constraint.inverse_mass_at[1])};
    else
      laws[k] = crushing.ends;
  }
  dynamics::solve_jam(std::span(constraints_).subspan(island.first, island.count), laws, solver_bodies_,
                      kSlipShare * tolerance);
}

void CrushSolver::accelerate(const Island& island, double& last, bool is_first) {
  double now = 0;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    const ContactConstraint& c = constraints_[i];
    const Direction& d = directions_[i];
    const double change[3] = {c.normal_impulse[0] - d.before[0], c.normal_impulse[1] - d.before[1],
                              c.slip_impulse - d.before[2]};
    now += change[0] * change[0] * c.inverse_mass_at[0] + change[1] * change[1] * c.inverse_mass_at[1] +
           change[2] * change[2] * c.inverse_slip_mass;
  }
  const double share = is_first || now > last * (1 + 1e-6) ? 0 : std::min(1.0, now / last);
  last = now;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    ContactConstraint& c = constraints_[i];
    Direction& d = directions_[i];
    const double p[3] = {c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse};
    double on[3];
    for (int k = 0; k < 3; ++k) {
      const double along = is_first ? 0 : share * d.along[k];
      on[k] = p[k] + along;
      d.along[k] = along + (p[k] - d.before[k]);
    }
    if (share == 0) continue;
    for (int end = 0; end < 2; ++end)
      c.normal_impulse[end] =
          std::max(0.0, crushing_[i].is_rigid ? on[end] : std::min(on[end], crushing_[i].ends[end].cap));
    const double most = c.friction * (c.normal_impulse[0] + c.normal_impulse[1]);
    c.slip_impulse = std::clamp(on[2], -most, most);
    apply_impulses(c, c.normal_impulse[0] - p[0], c.normal_impulse[1] - p[1], c.slip_impulse - p[2],
                   solver_bodies_);
  }
}

void CrushSolver::end_substep(const Island& island, double tau) {
  for (std::uint32_t k = island.first; k < island.first + island.count; ++k) {
    Crushing& c = crushing_[k];
    const ContactConstraint& constraint = constraints_[k];
    const ConstraintSpeeds after = speeds_at(constraint, solver_bodies_);
    const ConstraintSpeeds& before = before_[k];
    double closing = 0;
    for (int end = 0; end < 2; ++end) {
      const double p = constraint.normal_impulse[end];
      c.total[end] += p;
      c.normal_work += 0.5 * p * (before.apart[end] + after.apart[end]);
      closing -= 0.5 * after.apart[end];  // as the bodies are moved, by their new speeds
      if (!c.is_rigid && piece_at(c.ends[end], -after.apart[end]) == CrushPiece::kBroken) c.is_broken = true;
    }
    c.total_slip += constraint.slip_impulse;
    c.slip_work += 0.5 * constraint.slip_impulse * (before.slip + after.slip);
    const double moved = tau * closing;
    c.depth = std::max(0.0, c.depth + moved);
    c.force =
        std::max(0.0, c.force + c.stiffness * std::max(0.0, c.depth - std::max(c.loaded, c.depth - moved)));
    if (constraint.normal_impulse[0] + constraint.normal_impulse[1] > 0)
      c.loaded = std::max(c.loaded, c.depth);
  }
}

void CrushSolver::write_back(Bodies& bodies, std::vector<Contact>& contacts, double step) {
  for (std::size_t k = 0; k < constraints_.size(); ++k) {
    ContactConstraint& constraint = constraints_[k];
    const Crushing& c = crushing_[k];
    Contact& contact = contacts[islands_.order()[k]];
    for (int end = 0; end < 2; ++end) {
      contact.record->last_impulse[end] = constraint.normal_impulse[end];  // of one substep
      contact.normal_impulse[end] = constraint.normal_impulse[end] = c.total[end];
    }
    contact.slip_impulse = constraint.slip_impulse = c.total_slip;
    contact.normal_work = c.normal_work;
    contact.slip_work = c.slip_work;
    contact.is_broken = c.is_broken;
    if (!c.is_rigid) contact.impulse_limit = contact.total_normal_impulse();  // all of it crushes
    contact.record->loaded_depth = c.loaded;
    const double steady = step * contact.crushing_force;
    contact.steady_share = c.missed > 0 ? steady / (steady + c.missed) : 1;
    const bool is_prescribed =
        solver_bodies_[constraint.a].inverse_mass == 0 || solver_bodies_[constraint.b].inverse_mass == 0;
    contact.prescribed_work =
        is_prescribed ? prescribed_work(constraint, solver_bodies_, bodies, contact) : 0;
  }
  give_back_bodies(solver_bodies_, islands_.bodies_touched(), bodies);
}

SolverResult CrushSolver::solve(Bodies& bodies, std::vector<Contact>& contacts,
                                const CrushSettings& settings) {
  islands_.find(bodies, contacts);
  fill(bodies, contacts, settings);
  residuals_.assign(islands_.islands().size(), 0);
  const double tau = settings.step / settings.substeps;
  const int threads = contacts.size() < 2 * kContactsPerChunk ? 1 : settings.threads;
  for_chunks(islands_.islands().size(), kIslandsPerChunk, threads,
             [&](std::size_t, std::size_t begin, std::size_t end) {
               for (std::size_t k = begin; k < end; ++k) {
                 const Island& island = islands_.islands()[k];
                 for (int substep = 0; substep < settings.substeps; ++substep) {
                   begin_substep(island, tau, substep == 0);
                   warm_start(island, contacts, substep == 0, settings.is_warm_started);
                   residuals_[k] = std::max(residuals_[k], sweep(island, settings));
                   end_substep(island, tau);
                 }
               }
             });
  write_back(bodies, contacts, settings.step);
  SolverResult result;
  for (const double residual : residuals_) {
    result.unconverged += residual > settings.tolerance;
    result.residual = std::max(result.residual, residual);
  }
  return result;
}

}  // namespace polynya::dynamics
