#include "dynamics/impulse_solver.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {
namespace {

/// Friction while sliding can raise the impulse that ends an approach above the frictionless one; seldom to
/// twice it.
constexpr double kFrictionSlack = 2;

/// How much of an unconverged step's impulses the next one starts from: a wrong guess must die out, not build
/// up.
constexpr double kTrustUnconverged = 0.5;

/// Contacts that one thread takes at a time: fewer are not worth another thread.
constexpr std::size_t kContactsPerChunk = 256;

}  // namespace

void ImpulseSolver::fill_rows(const Bodies& bodies, std::vector<Contact>& contacts,
                              const SolverSettings& settings) {
  movers_.clear();
  for (const BodyIndex body : islands_.bodies_touched()) {
    movers_.push_back({bodies.velocity[body], bodies.angular_velocity[body], bodies.inverse_mass[body],
                       bodies.inverse_moment[body]});
  }
  rows_.resize(contacts.size());
  ways_.resize(contacts.size());
  before_.resize(contacts.size());
  for_chunks(
      rows_.size(), kContactsPerChunk, settings.threads,
      [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
          const std::uint32_t i = islands_.order()[k];
          rows_[k] = make_row(bodies, contacts[i], islands_.place_of_a(i), islands_.place_of_b(i), movers_);
          before_[k] = speeds_at(rows_[k], movers_);
          ContactRecord* record = contacts[i].record;
          if (record == nullptr) continue;
          record->most_to_give = std::max(record->most_to_give, kFrictionSlack * settings.restitution *
                                                                    isolated_impulse(rows_[k], before_[k]));
        }
      });
}

/// Starts an island from the impulses that its last steps foretell.
void ImpulseSolver::start(const Island& island, const std::vector<Contact>& contacts) {
  for (std::uint32_t k = island.first; k < island.first + island.count; ++k) {
    const ContactRecord* record = contacts[islands_.order()[k]].record;
    if (record == nullptr || (record->start_impulse[0] == 0 && record->start_impulse[1] == 0)) continue;
    ContactRow& row = rows_[k];
    for (int end = 0; end < 2; ++end)
      row.normal_impulse[end] = std::min(record->start_impulse[end], row.limit);
    push(row, row.normal_impulse[0], row.normal_impulse[1], 0, movers_);
  }
}

/// Moves all impulses of an island on along the way they are taking, as far as the sweeps' shrinking steps
/// tell: the nonsmooth nonlinear conjugate gradient of [Silcowitz2010]. Jammed floes want it, whose impulses
/// grow by little in each sweep.
void ImpulseSolver::go_on(const Island& island, Momentum& momentum) {
  double now = 0;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    const ContactRow& row = rows_[i];
    const Way& way = ways_[i];
    const double change[3] = {row.normal_impulse[0] - way.before[0], row.normal_impulse[1] - way.before[1],
                              row.slip_impulse - way.before[2]};
    now += change[0] * change[0] * row.softness[0] + change[1] * change[1] * row.softness[1] +
           change[2] * change[2] * row.slip_softness;
  }
  const bool is_start = momentum.steps++ == 0;
  const double share = is_start || now > momentum.last * (1 + 1e-6) ? 0 : std::min(1.0, now / momentum.last);
  momentum.last = now;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    ContactRow& row = rows_[i];
    Way& way = ways_[i];
    const double p[3] = {row.normal_impulse[0], row.normal_impulse[1], row.slip_impulse};
    double on[3];
    for (int k = 0; k < 3; ++k) {
      const double along = is_start ? 0 : share * way.along[k];
      on[k] = p[k] + along;
      way.along[k] = along + (p[k] - way.before[k]);
    }
    if (share == 0) continue;
    row.normal_impulse[0] = std::clamp(on[0], row.least[0], row.limit);
    row.normal_impulse[1] = std::clamp(on[1], row.least[1], row.limit);
    const double most = row.friction * (row.normal_impulse[0] + row.normal_impulse[1]);
    row.slip_impulse = std::clamp(on[2], -most, most);
    push(row, row.normal_impulse[0] - p[0], row.normal_impulse[1] - p[1], row.slip_impulse - p[2], movers_);
  }
}

/// Sweeps over an island until it has converged or the sweeps are used up. Returns the most that the last one
/// changed a velocity by where it had not, 0 where it had [m/s].
double ImpulseSolver::sweep(const Island& island, const SolverSettings& settings) {
  constexpr int kPlainSweeps = 4;  // most islands need no more
  const std::span<ContactRow> rows(rows_.data() + island.first, island.count);
  const std::span<Mover> movers(movers_);
  Momentum momentum;
  double largest_change = 0;
  for (int sweep = 0; sweep < settings.most_sweeps; ++sweep) {
    largest_change = 0;
    const bool is_plain = sweep < kPlainSweeps;
    if (!is_plain) {
      for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
        const ContactRow& row = rows_[i];
        ways_[i].before[0] = row.normal_impulse[0];
        ways_[i].before[1] = row.normal_impulse[1];
        ways_[i].before[2] = row.slip_impulse;
      }
    }
    for (ContactRow& row : rows) largest_change = std::max(largest_change, visit(row, movers));
    if (largest_change <= settings.tolerance) return 0;
    if (!is_plain && sweep + 1 < settings.most_sweeps) go_on(island, momentum);
  }
  return largest_change;
}

bool ImpulseSolver::give_back(const Island& island, std::vector<Contact>& contacts, double restitution,
                              bool is_converged) {
  bool gave = false;
  for (std::uint32_t i = island.first; i < island.first + island.count; ++i) {
    ContactRow& row = rows_[i];
    ContactRecord* record = contacts[islands_.order()[i]].record;
    const double compression = row.normal_impulse[0] + row.normal_impulse[1];
    double owed = restitution * compression;
    if (record != nullptr) {
      owed = std::min(owed + record->owed_impulse, record->most_to_give - record->given_impulse);
      for (int end = 0; end < 2; ++end) {
        // The next step's, as the last two foretell it: steady or falling in proportion, never more than
        // both.
        const double last = record->last_impulse[end];
        const double now = row.normal_impulse[end];
        const double start = now < last ? now * (now / last) : last;
        record->start_impulse[end] = is_converged ? start : kTrustUnconverged * start;
        record->last_impulse[end] = now;
      }
    }
    if (owed <= 0) continue;
    double given[2];
    double still_owed = 0;
    const double owed_per_compression = compression > 0 ? owed / compression : 0;
    for (int end = 0; end < 2; ++end) {
      const double share = compression > 0 ? owed_per_compression * row.normal_impulse[end] : 0.5 * owed;
      row.least[end] = std::min(row.normal_impulse[end] + share, row.limit);
      given[end] = row.least[end] - row.normal_impulse[end];
      still_owed += share - given[end];
      row.normal_impulse[end] = row.least[end];
      gave = gave || given[end] > 0;
    }
    push(row, given[0], given[1], 0, movers_);
    if (record != nullptr) {
      record->owed_impulse = still_owed;
      record->given_impulse += owed - still_owed;
    }
  }
  return gave;
}

void ImpulseSolver::write_back(Bodies& bodies, std::vector<Contact>& contacts) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ContactRow& row = rows_[i];
    Contact& c = contacts[islands_.order()[i]];
    c.normal_impulse[0] = row.normal_impulse[0];
    c.normal_impulse[1] = row.normal_impulse[1];
    c.slip_impulse = row.slip_impulse;
    // Impulses together change the kinetic energy by each one times the mean of the speeds before and after.
    const RowSpeeds& before = before_[i];
    const RowSpeeds after = speeds_at(row, movers_);
    c.normal_work = 0.5 * (row.normal_impulse[0] * (before.apart[0] + after.apart[0]) +
                           row.normal_impulse[1] * (before.apart[1] + after.apart[1]));
    c.slip_work = 0.5 * row.slip_impulse * (before.slip + after.slip);
    const bool is_held = movers_[row.a].inverse_mass == 0 || movers_[row.b].inverse_mass == 0;
    c.held_work = is_held ? held_work(row, movers_, bodies, c) : 0;
  }
  for (std::size_t place = 0; place < movers_.size(); ++place) {
    const BodyIndex body = islands_.bodies_touched()[place];
    bodies.velocity[body] = movers_[place].velocity;
    bodies.angular_velocity[body] = movers_[place].angular_velocity;
  }
}

SolverResult ImpulseSolver::solve(Bodies& bodies, std::vector<Contact>& contacts,
                                  const SolverSettings& settings) {
  islands_.find(bodies, contacts);
  fill_rows(bodies, contacts, settings);
  left_over_.assign(islands_.islands().size(), 0);
  const int threads = contacts.size() < 2 * kContactsPerChunk ? 1 : settings.threads;
  for_chunks(islands_.islands().size(), 4, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Island& island = islands_.islands()[k];
      start(island, contacts);
      left_over_[k] = sweep(island, settings);
      if (give_back(island, contacts, settings.restitution, left_over_[k] == 0))
        left_over_[k] = std::max(left_over_[k], sweep(island, settings));
    }
  });
  write_back(bodies, contacts);
  SolverResult result;
  for (const double left_over : left_over_) {
    result.unconverged += left_over > 0;
    result.left_over = std::max(result.left_over, left_over);
  }
  return result;
}

}  // namespace polynya::dynamics
