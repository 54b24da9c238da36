#include "dynamics/contact/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {
namespace {

/// Number of sweeps before the acceleration starts. Most islands need no more. Fewer: the search directions include
/// contacts that still open and close.
constexpr int kPlainSweeps = 4;

/// Slip speed within which friction grows to its bound in jams, as a fraction of the tolerance [-]. At 1 and more,
/// sticking contacts slip by more than the tolerance. Far smaller: Newton's method solves fewer jams.
constexpr double kSlipShare = 0.5;

/// Smallest number of contacts of an island whose memory of jams is kept for the next step. Smaller: finding the memory
/// takes as long as finding the structure of a matrix again. Results do not depend on it.
constexpr std::uint32_t kLeastKept = 24;

/// Returns true if the friction of an island starts from its impulses of the last step. A jam that changes little then
/// needs a quarter of the Newton steps. With a smaller limit, rows of few floes would carry the residual from step to
/// step and turn because of it.
constexpr bool is_large(const Island& island) {
  return island.count > 64;
}

/// Number of sweeps after which an island counts as jammed and is solved by Newton's method, again after each further
/// such number. Most small islands converge with somewhat more sweeps, so their number is larger.
constexpr int sweeps_to_jam(const Island& island) {
  return is_large(island) ? 24 : 48;
}

/// Grows a list to at least `count` elements and never shrinks it, since steps with few contacts alternate with others.
template <class T>
void grow(std::vector<T>& list, std::size_t count) {
  if (list.size() < count) list.resize(count);
}

/// Calls use(part, range) for each part of an island: for its two halves, 0 and 1, in parallel, then for the contacts
/// between them, 2.
template <class Use>
void for_parts(const Island& island, int threads, Use use) {
  if (!island.is_divided()) return use(std::size_t{0}, island.all());
  for_chunks(2, 1, threads, [&](std::size_t half, std::size_t, std::size_t) {
    use(half, half == 0 ? island.first_half() : island.second_half());
  });
  use(std::size_t{2}, island.between());
}

}  // namespace

template <class Law>
void ContactSolver::fill(const Bodies& bodies, const std::vector<Contact>& contacts, const Law& law, int threads) {
  auto& states = std::get<States<Law>>(states_);
  const std::span touched = islands_.bodies_touched();
  grow(solver_bodies_, touched.size());
  for_chunks(touched.size(), kContactsPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    take_bodies(bodies, touched.subspan(begin, end - begin), std::span(solver_bodies_).subspan(begin, end - begin));
  });
  grow(constraints_, contacts.size());
  grow(states, contacts.size());
  grow(sums_, contacts.size());
  grow(directions_, contacts.size());
  for_chunks(contacts.size(), kContactsPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = islands_.order()[k];
      // Constructed in place: copying them costs as much as making them.
      new (&constraints_[k]) ContactConstraint(
          make_constraint(bodies, contacts[i], islands_.place_of_a(i), islands_.place_of_b(i), solver_bodies_));
      new (&states[k]) typename Law::State(state_of(law, contacts[i]));
      new (&sums_[k]) Sums{};
    }
  });
}

/// Starts a substep: sets the bounds of the impulses and their starting values.
template <class Law>
void ContactSolver::start(const Island& island, const Law& law, bool is_first, int threads) {
  auto& states = std::get<States<Law>>(states_);
  for_parts(island, threads, [&](std::size_t, ContactRange range) {
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      sums_[k].before = speeds_at(constraints_[k], solver_bodies_);
      begin_substep(law, sums_[k].before, is_first, states[k], constraints_[k]);
    }
  });
  for_parts(island, threads, [&](std::size_t, ContactRange range) {
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      ContactConstraint& c = constraints_[k];
      for (int end = 0; end < 2; ++end)
        c.normal_impulse[end] = std::min(start_impulse(law, states[k], c, end, is_first), c.limit);
      const double most = c.friction * (c.normal_impulse[0] + c.normal_impulse[1]);
      const bool is_kept = !is_first || is_large(island);
      c.slip_impulse = is_kept ? std::clamp(start_slip(law, states[k], c, is_first), -most, most) : 0;
      apply_impulses(c, c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse, solver_bodies_);
    }
  });
}

/// Sweeps over an island until it is solved or all sweeps are used. Returns the residual [m/s].
template <class Law>
double ContactSolver::sweep(const Island& island, const Law& law, const SolverSettings& settings) {
  const int to_jam = sweeps_to_jam(island);
  Search search;
  double residual = 0;
  for (int round = 0; round < settings.max_iterations; ++round) {
    const bool is_plain = round < kPlainSweeps;
    const Swept swept = sweep_once(island, law, search, is_plain, settings.threads);
    search.is_due = false;
    residual = swept.residual;
    if (residual <= settings.tolerance || round + 1 >= settings.max_iterations) break;
    if (Law::kHasJams && round % to_jam == to_jam - 1) {
      if constexpr (Law::kHasJams) {
        solve_jam(island, settings, residual);
        // A sweep would add up the deviations of single contacts: its residual depends on the path of the sweep.
        const double missed = missed_speed(island, law);
        if (missed <= settings.tolerance) return missed;
      }
      search.sweeps = 0;
    } else if (!is_plain) {
      search.follow(swept.change);
    }
  }
  return residual;
}

/// Makes one sweep, from extrapolated impulses if an extrapolation is due.
template <class Law>
ContactSolver::Swept ContactSolver::sweep_once(const Island& island, const Law& law, const Search& search,
                                               bool is_plain, int threads) {
  if (search.is_due && island.is_divided()) extrapolate(island.between(), search);
  Swept swept[3];
  for_parts(island, threads, [&](std::size_t part, ContactRange range) {
    if (search.is_due && part < 2) extrapolate(range, search);
    swept[part] = sweep_range(range, law, is_plain);
  });
  return {std::max({swept[0].residual, swept[1].residual, swept[2].residual}),
          swept[0].change + swept[1].change + swept[2].change};
}

template <class Law>
ContactSolver::Swept ContactSolver::sweep_range(ContactRange range, const Law& law, bool is_plain) {
  auto& states = std::get<States<Law>>(states_);
  Swept swept;
  for (std::uint32_t k = range.begin; k < range.end; ++k) {
    ContactConstraint& c = constraints_[k];
    const double before[3] = {c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse};
    swept.residual = std::max(swept.residual, solve_block(law, states[k], c, solver_bodies_));
    if (is_plain) continue;
    std::ranges::copy(before, directions_[k].before);
    const double d[3] = {c.normal_impulse[0] - before[0], c.normal_impulse[1] - before[1], c.slip_impulse - before[2]};
    swept.change +=
        d[0] * d[0] * c.inverse_mass_at[0] + d[1] * d[1] * c.inverse_mass_at[1] + d[2] * d[2] * c.inverse_slip_mass;
  }
  return swept;
}

/// Returns by how much the contacts of an island deviate from the law, all at their present speeds [m/s].
double ContactSolver::missed_speed(const Island& island, const CrushLaw& law) const {
  const auto& states = std::get<States<CrushLaw>>(states_);
  double largest = 0;
  for (std::uint32_t k = island.first; k < island.first + island.count; ++k)
    largest = std::max(largest, dynamics::missed_speed(law, states[k], constraints_[k], solver_bodies_));
  return largest;
}

void ContactSolver::solve_jam(const Island& island, const SolverSettings& settings, double residual) {
  const auto& states = std::get<States<CrushLaw>>(states_);
  const std::span constraints = std::span(constraints_).subspan(island.first, island.count);
  std::vector<EndLaws> laws(constraints.size());
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    const CrushLaw::State& state = states[island.first + k];
    const double(&inverse_mass)[2] = constraints[k].inverse_mass_at;
    laws[k] = state.is_rigid ? EndLaws{rigid_law(inverse_mass[0]), rigid_law(inverse_mass[1])} : state.ends;
  }
  const std::int32_t kept = memory_of_island_[static_cast<std::size_t>(&island - islands_.islands().data())];
  std::optional<JamMemory> own;
  JamMemory& memory = kept < 0 ? own.emplace() : jam_memories_[static_cast<std::size_t>(kept)].memory;
  dynamics::solve_jam(constraints, laws, solver_bodies_, kSlipShare * settings.tolerance, residual, memory,
                      settings.threads);
}

/// Gives large islands the memory that they had in the step before, which is recognised by their first contact.
void ContactSolver::give_memories(const std::vector<Contact>& contacts) {
  const std::vector<Island>& islands = islands_.islands();
  memory_of_island_.assign(islands.size(), -1);
  for (KeptMemory& kept : jam_memories_) kept.is_taken = false;
  const auto give = [&](auto is_wanted) {
    for (std::size_t i = 0; i < islands.size(); ++i) {
      if (islands[i].count < kLeastKept || memory_of_island_[i] >= 0) continue;
      const Contact& first = contacts[islands_.order()[islands[i].first]];
      const auto found = std::ranges::find_if(
          jam_memories_, [&](const KeptMemory& kept) { return !kept.is_taken && is_wanted(kept, first); });
      if (found == jam_memories_.end()) continue;
      found->is_taken = true;
      found->a = first.a, found->b = first.b;
      memory_of_island_[i] = static_cast<std::int32_t>(found - jam_memories_.begin());
    }
  };
  give([](const KeptMemory& kept, const Contact& first) { return kept.a == first.a && kept.b == first.b; });
  const auto large = std::ranges::count_if(islands, [](const Island& island) { return island.count >= kLeastKept; });
  if (static_cast<std::size_t>(large) > jam_memories_.size()) jam_memories_.resize(static_cast<std::size_t>(large));
  give([](const KeptMemory&, const Contact&) { return true; });
}

/// Continues the search after a sweep whose changes have this squared size.
void ContactSolver::Search::follow(double change) {
  const bool is_first = sweeps++ == 0;
  const bool has_grown = change > last_change * (1 + 1e-6);
  share = is_first || has_grown ? 0 : std::min(1.0, change / last_change);
  last_change = change;
  is_due = true;
}

/// Extrapolates impulses along their search direction, within their bounds. Jams need this, because their impulses grow
/// by little in each sweep.
void ContactSolver::extrapolate(ContactRange range, const Search& search) {
  const bool is_first = search.sweeps == 1;
  const double share = search.share;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    ContactConstraint& c = constraints_[i];
    Direction& direction = directions_[i];
    const double p[3] = {c.normal_impulse[0], c.normal_impulse[1], c.slip_impulse};
    double extrapolated[3];
    for (int k = 0; k < 3; ++k) {
      const double along = is_first ? 0 : share * direction.along[k];
      extrapolated[k] = p[k] + along;
      direction.along[k] = along + (p[k] - direction.before[k]);
    }
    if (share == 0) continue;
    for (int end = 0; end < 2; ++end) c.normal_impulse[end] = std::clamp(extrapolated[end], c.least[end], c.limit);
    const double most = c.friction * (c.normal_impulse[0] + c.normal_impulse[1]);
    c.slip_impulse = std::clamp(extrapolated[2], -most, most);
    const double change[3] = {c.normal_impulse[0] - p[0], c.normal_impulse[1] - p[1], c.slip_impulse - p[2]};
    if (change[0] == 0 && change[1] == 0 && change[2] == 0) continue;  // most contacts of a jam carry no force
    apply_impulses(c, change[0], change[1], change[2], solver_bodies_);
  }
}

/// Ends a substep: sums up its impulses and their work. Together the impulses change the kinetic energy by each impulse
/// times the mean of its speeds before and after.
template <class Law>
void ContactSolver::finish(const Island& island, const Law& law, int threads) {
  auto& states = std::get<States<Law>>(states_);
  for_parts(island, threads, [&](std::size_t, ContactRange range) {
    for (std::uint32_t k = range.begin; k < range.end; ++k) {
      const ContactConstraint& constraint = constraints_[k];
      Sums& sums = sums_[k];
      const ConstraintSpeeds after = speeds_at(constraint, solver_bodies_);
      for (int end = 0; end < 2; ++end) {
        const double p = constraint.normal_impulse[end];
        sums.impulse[end] += p;
        sums.normal_work += 0.5 * p * (sums.before.apart[end] + after.apart[end]);
      }
      sums.slip_impulse += constraint.slip_impulse;
      sums.slip_work += 0.5 * constraint.slip_impulse * (sums.before.slip + after.slip);
      end_substep(law, sums.before, after, constraint, states[k]);
    }
  });
}

/// Adds the energy that compression took from the bodies of an island to the stored energy of its contacts, in
/// proportion to what each took. A contact that only passes on the pressure of others may have given energy; the others
/// then store less by that amount. Returns the stored energy of all contacts [J].
double ContactSolver::store_energy(const Island& island) {
  auto& states = std::get<States<RestitutionLaw>>(states_);
  const ContactRange range = island.all();
  double taken_by_all = 0, taken_by_some = 0;
  for (std::uint32_t k = range.begin; k < range.end; ++k) {
    const double taken = energy_taken(sums_[k].before, speeds_at(constraints_[k], solver_bodies_), constraints_[k]);
    states[k].taken_energy = std::max(0.0, taken);
    taken_by_all += taken;
    taken_by_some += states[k].taken_energy;
  }
  const double share = taken_by_all > 0 ? taken_by_all / taken_by_some : 0;
  double stored = 0;
  for (std::uint32_t k = range.begin; k < range.end; ++k)
    stored += states[k].stored_energy += share * states[k].taken_energy;
  return stored;
}

/// Gives back the impulses that the contacts of an island owe, as far as the stored energy of all of them lasts.
/// Returns true if any impulse was given.
bool ContactSolver::restore(const Island& island, const RestitutionLaw& law, bool is_converged) {
  auto& states = std::get<States<RestitutionLaw>>(states_);
  const ContactRange range = island.all();
  const double stored = store_energy(island);
  double left = stored;
  bool has_given = false;
  for (std::uint32_t k = range.begin; k < range.end; ++k)
    has_given |= dynamics::restore(law, is_converged, left, states[k], constraints_[k], solver_bodies_);
  const double share_left = stored > 0 ? std::max(0.0, left / stored) : 0;  // below 0 by rounding
  for (std::uint32_t k = range.begin; k < range.end; ++k) states[k].stored_energy *= share_left;
  return has_given;
}

template <class Law>
double ContactSolver::solve_island(const Island& island, const Law& law, const SolverSettings& settings) {
  double residual = 0;
  for (int substep = 0; substep < substeps_of(law); ++substep) {
    start(island, law, substep == 0, settings.threads);
    residual = std::max(residual, sweep(island, law, settings));
    if constexpr (Law::kRestores) {
      const bool is_converged = residual <= settings.tolerance;
      const bool has_given = restore(island, law, is_converged);
      if (has_given) residual = std::max(residual, sweep(island, law, settings));
    }
    finish(island, law, settings.threads);
  }
  return residual;
}

template <class Law>
void ContactSolver::write_back(Bodies& bodies, std::vector<Contact>& contacts, const Law& law, int threads) {
  const auto& states = std::get<States<Law>>(states_);
  for_chunks(contacts.size(), kContactsPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Contact& contact = contacts[islands_.order()[k]];
      const Sums& sums = sums_[k];
      std::ranges::copy(sums.impulse, contact.normal_impulse);
      contact.slip_impulse = sums.slip_impulse;
      contact.normal_work = sums.normal_work;
      contact.slip_work = sums.slip_work;
      contact.prescribed_work = prescribed_work(constraints_[k], solver_bodies_, bodies, contact);
      dynamics::write_back(law, states[k], constraints_[k], contact);
    }
  });
  const std::span touched = islands_.bodies_touched();
  for_chunks(touched.size(), kContactsPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    give_back_bodies(std::span(solver_bodies_).subspan(begin, end - begin), touched.subspan(begin, end - begin),
                     bodies);
  });
}

SolverResult ContactSolver::solve(Bodies& bodies, std::vector<Contact>& contacts, const ResponseLaw& any_law,
                                  const SolverSettings& settings) {
  islands_.find(bodies, contacts);
  const std::vector<Island>& islands = islands_.islands();
  residuals_.assign(islands.size(), 0);
  const auto solve_by = [&](const auto& law) {
    fill(bodies, contacts, law, settings.threads);
    if constexpr (std::decay_t<decltype(law)>::kHasJams) give_memories(contacts);
    const auto solve_some = [&](std::size_t, std::size_t begin, std::size_t end) {  // those that begin there
      auto island = std::ranges::lower_bound(islands, begin, {}, &Island::first);
      for (; island != islands.end() && island->first < end; ++island)
        residuals_[static_cast<std::size_t>(island - islands.begin())] = solve_island(*island, law, settings);
    };
    for_chunks(contacts.size(), kContactsPerChunk, settings.threads, solve_some);
    write_back(bodies, contacts, law, settings.threads);
  };
  std::visit(solve_by, any_law);
  SolverResult result;
  for (const double residual : residuals_) {
    result.unconverged += residual > settings.tolerance;
    result.residual = std::max(result.residual, residual);
  }
  return result;
}

}  // namespace polynya::dynamics
