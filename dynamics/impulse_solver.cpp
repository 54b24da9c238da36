#include "dynamics/impulse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "dynamics/collision.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Vector;

Mobility mobility(const Bodies& bodies, BodyIndex i, Vector arm) {
  return {bodies.inverse_mass[i], bodies.inverse_moment[i], arm};
}

/// Friction while sliding can raise the impulse that ends an approach above the frictionless one; seldom to
/// twice it.
constexpr double kFrictionSlack = 2;

/// How much of an unconverged step's impulses the next one starts from: a wrong guess must die out, not build
/// up.
constexpr double kTrustUnconverged = 0.5;

std::int32_t root_of(std::vector<std::int32_t>& parent, std::int32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

std::int32_t ImpulseSolver::mover_of(const Bodies& bodies, BodyIndex body) {
  std::int32_t& mover = mover_of_body_[body];
  if (mover < 0) {
    mover = static_cast<std::int32_t>(movers_.size());
    movers_.push_back({bodies.velocity[body], bodies.angular_velocity[body], bodies.inverse_mass[body],
                       bodies.inverse_moment[body]});
    body_of_mover_.push_back(body);
    island_of_mover_.push_back(mover);
  }
  return mover;
}

/// Groups the contacts by islands, islands in the order of their first contact. A held body joins nothing.
void ImpulseSolver::find_islands(const Bodies& bodies, const std::vector<Contact>& contacts) {
  movers_.clear();
  body_of_mover_.clear();
  island_of_mover_.clear();
  islands_.clear();
  mover_of_body_.resize(static_cast<std::size_t>(bodies.size()), -1);
  for (const Contact& c : contacts) {
    const std::int32_t a = mover_of(bodies, c.a);
    const std::int32_t b = mover_of(bodies, c.b);
    if (bodies.inverse_mass[c.a] == 0 || bodies.inverse_mass[c.b] == 0) continue;
    const std::int32_t ra = root_of(island_of_mover_, a);
    const std::int32_t rb = root_of(island_of_mover_, b);
    island_of_mover_[std::max(ra, rb)] = std::min(ra, rb);
  }
  const auto island_root = [&](const Contact& c) {
    const BodyIndex free_body = bodies.inverse_mass[c.a] != 0 ? c.a : c.b;
    return root_of(island_of_mover_, mover_of_body_[free_body]);
  };
  order_.clear();
  for (std::uint32_t i = 0; i < contacts.size(); ++i) order_.push_back({island_root(contacts[i]), i});
  std::sort(order_.begin(), order_.end());
  std::int32_t previous = -1;
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    const std::int32_t root = order_[i].island;
    if (root != previous) islands_.push_back({2 * i, 0});
    previous = root;
    islands_.back().count += 2;
  }
}

ImpulseSolver::Row ImpulseSolver::row_of(const Bodies& bodies, const Contact& c, int end) const {
  const Vector arm_a = c.ends[end] - bodies.position[c.a];
  const Vector arm_b = c.ends[end] - bodies.position[c.b];
  const Vector tangent = perpendicular(c.normal);
  Row row;
  row.a = mover_of_body_[c.a];
  row.b = mover_of_body_[c.b];
  row.normal = c.normal;
  row.normal_turn_a = cross(arm_a, c.normal);
  row.normal_turn_b = cross(arm_b, c.normal);
  row.tangent_turn_a = cross(arm_a, tangent);
  row.tangent_turn_b = cross(arm_b, tangent);
  row.normal_mass = effective_mass(mobility(bodies, c.a, arm_a), mobility(bodies, c.b, arm_b), c.normal);
  row.tangent_mass = effective_mass(mobility(bodies, c.a, arm_a), mobility(bodies, c.b, arm_b), tangent);
  row.least = 0;
  row.limit = 0.5 * c.impulse_limit;
  row.friction = c.friction;
  row.normal_impulse = row.tangent_impulse = 0;
  if (c.record != nullptr) row.normal_impulse = std::min(c.record->start_impulse[end], row.limit);
  return row;
}

void ImpulseSolver::fill_rows(const Bodies& bodies, std::vector<Contact>& contacts, double restitution) {
  rows_.clear();
  couplings_.clear();
  for (const auto [island, i] : order_) {
    for (int end = 0; end < 2; ++end) rows_.push_back(row_of(bodies, contacts[i], end));
    const Row* ends = &rows_[rows_.size() - 2];
    const Mover& a = movers_[ends[0].a];
    const Mover& b = movers_[ends[0].b];
    couplings_.push_back(a.inverse_mass + b.inverse_mass +
                         ends[0].normal_turn_a * ends[1].normal_turn_a * a.inverse_moment +
                         ends[0].normal_turn_b * ends[1].normal_turn_b * b.inverse_moment);
    if (ContactRecord* record = contacts[i].record; record != nullptr) {
      record->most_to_give = std::max(
          record->most_to_give, kFrictionSlack * restitution * isolated_impulse(ends, couplings_.back()));
    }
  }
  for (const Row& row : rows_) {
    if (row.normal_impulse != 0) push(row, row.normal_impulse, 0);
  }
}

/// Changes the velocities by impulses on b, and their opposites on a.
inline void ImpulseSolver::push(const Row& row, double normal_impulse, double tangent_impulse) {
  const Vector impulse = normal_impulse * row.normal + tangent_impulse * perpendicular(row.normal);
  Mover& a = movers_[row.a];
  Mover& b = movers_[row.b];
  a.velocity -= a.inverse_mass * impulse;
  b.velocity += b.inverse_mass * impulse;
  a.angular_velocity -=
      a.inverse_moment * (normal_impulse * row.normal_turn_a + tangent_impulse * row.tangent_turn_a);
  b.angular_velocity +=
      b.inverse_moment * (normal_impulse * row.normal_turn_b + tangent_impulse * row.tangent_turn_b);
}

/// Normal velocity of b away from a at one end [m/s].
inline double ImpulseSolver::apart_at(const Row& row) const {
  const Mover& a = movers_[row.a];
  const Mover& b = movers_[row.b];
  return dot(b.velocity - a.velocity, row.normal) + b.angular_velocity * row.normal_turn_b -
         a.angular_velocity * row.normal_turn_a;
}

inline void ImpulseSolver::press(Row& row, double normal_impulse) {
  if (normal_impulse == row.normal_impulse) return;
  push(row, normal_impulse - row.normal_impulse, 0);
  row.normal_impulse = normal_impulse;
}

/// What would bring both ends to rest, if no other body were there: the solution p of K p = approach, p ≥ 0
/// [N s].
double ImpulseSolver::isolated_impulse(const Row* ends, double coupling) const {
  const double approach[2] = {-apart_at(ends[0]), -apart_at(ends[1])};
  const double k0 = 1 / ends[0].normal_mass;
  const double k1 = 1 / ends[1].normal_mass;
  const double determinant = k0 * k1 - coupling * coupling;
  if (determinant > 1e-9 * k0 * k1) {
    const double p0 = (k1 * approach[0] - coupling * approach[1]) / determinant;
    const double p1 = (k0 * approach[1] - coupling * approach[0]) / determinant;
    if (p0 >= 0 && p1 >= 0) return p0 + p1;
  }
  return std::max({0.0, approach[0] / k0, approach[1] / k1});
}

/// Brings both ends of a contact line to rest within their bounds. Returns by how much that changed a
/// velocity [m/s].
inline double ImpulseSolver::visit_normals(Row* ends, double coupling) {
  Row& r0 = ends[0];
  Row& r1 = ends[1];
  const double before[2] = {r0.normal_impulse, r1.normal_impulse};
  const double apart[2] = {apart_at(r0), apart_at(r1)};
  const double k0 = 1 / r0.normal_mass;
  const double k1 = 1 / r1.normal_mass;
  const double determinant = k0 * k1 - coupling * coupling;
  bool is_done = false;
  if (determinant > 1e-9 * k0 * k1) {
    const double p0 = before[0] - (k1 * apart[0] - coupling * apart[1]) / determinant;
    const double p1 = before[1] - (k0 * apart[1] - coupling * apart[0]) / determinant;
    const bool is_within = p0 >= r0.least && p1 >= r1.least && p0 <= r0.limit && p1 <= r1.limit;
    const bool is_beyond = (p0 > r0.limit && p1 > r1.limit) || (p0 < r0.least && p1 < r1.least);
    is_done = is_within || is_beyond;
    if (is_done) {
      press(r0, std::clamp(p0, r0.least, r0.limit));
      press(r1, std::clamp(p1, r1.least, r1.limit));
    }
  }
  if (!is_done) {
    press(r0, std::clamp(before[0] - apart[0] * r0.normal_mass, r0.least, r0.limit));
    press(r1, std::clamp(before[1] - apart_at(r1) * r1.normal_mass, r1.least, r1.limit));
  }
  return std::max(std::abs(r0.normal_impulse - before[0]) * k0, std::abs(r1.normal_impulse - before[1]) * k1);
}

/// Brings the slip at one end to rest within the Coulomb cone. Returns by how much that changed the velocity
/// [m/s].
inline double ImpulseSolver::visit_friction(Row& row) {
  if (row.normal_impulse == 0 && row.tangent_impulse == 0) return 0;
  const Mover& a = movers_[row.a];
  const Mover& b = movers_[row.b];
  const double slip = dot(b.velocity - a.velocity, perpendicular(row.normal)) +
                      b.angular_velocity * row.tangent_turn_b - a.angular_velocity * row.tangent_turn_a;
  const double most = row.friction * row.normal_impulse;
  const double tangent_impulse = std::clamp(row.tangent_impulse - slip * row.tangent_mass, -most, most);
  const double change = tangent_impulse - row.tangent_impulse;
  if (change != 0) push(row, 0, change);
  row.tangent_impulse = tangent_impulse;
  return std::abs(change) / row.tangent_mass;
}

bool ImpulseSolver::sweep(const Island& island, const SolverSettings& settings, SolverResult& result) {
  for (int sweep = 0; sweep < settings.most_sweeps; ++sweep) {
    double largest_change = 0;
    for (std::uint32_t i = island.first; i < island.first + island.count; i += 2) {
      Row* ends = &rows_[i];
      largest_change = std::max(largest_change, visit_normals(ends, couplings_[i / 2]));
      largest_change = std::max(largest_change, visit_friction(ends[0]));
      largest_change = std::max(largest_change, visit_friction(ends[1]));
    }
    if (largest_change <= settings.tolerance) return true;
  }
  ++result.unconverged;
  return false;
}

bool ImpulseSolver::give_back(const Island& island, std::vector<Contact>& contacts, double restitution,
                              bool is_converged) {
  bool gave = false;
  for (std::uint32_t i = island.first; i < island.first + island.count; i += 2) {
    Row* ends = &rows_[i];
    ContactRecord* record = contacts[order_[i / 2].contact].record;
    const double compression = ends[0].normal_impulse + ends[1].normal_impulse;
    double owed = restitution * compression;
    if (record != nullptr) {
      owed = std::min(owed + record->owed_impulse, record->most_to_give - record->given_impulse);
      for (int end = 0; end < 2; ++end) {
        // The next step's, as the last two foretell it: steady or falling in proportion, never more than
        // both.
        const double last = record->last_impulse[end];
        const double now = ends[end].normal_impulse;
        const double start = now < last ? now * (now / last) : last;
        record->start_impulse[end] = is_converged ? start : kTrustUnconverged * start;
        record->last_impulse[end] = ends[end].normal_impulse;
      }
    }
    if (owed <= 0) continue;
    double still_owed = 0;
    for (int end = 0; end < 2; ++end) {
      Row& row = ends[end];
      const double share = owed * (compression > 0 ? row.normal_impulse / compression : 0.5);
      row.least = std::min(row.normal_impulse + share, row.limit);
      const double given = row.least - row.normal_impulse;
      still_owed += share - given;
      row.normal_impulse = row.least;
      push(row, given, 0);
      gave = gave || given > 0;
    }
    if (record != nullptr) {
      record->owed_impulse = still_owed;
      record->given_impulse += owed - still_owed;
    }
  }
  return gave;
}

void ImpulseSolver::write_back(Bodies& bodies, std::vector<Contact>& contacts) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    Contact& c = contacts[order_[i / 2].contact];
    c.normal_impulse[i % 2] = rows_[i].normal_impulse;
    c.tangent_impulse[i % 2] = rows_[i].tangent_impulse;
  }
  for (std::size_t mover = 0; mover < movers_.size(); ++mover) {
    const BodyIndex body = body_of_mover_[mover];
    bodies.velocity[body] = movers_[mover].velocity;
    bodies.angular_velocity[body] = movers_[mover].angular_velocity;
    mover_of_body_[body] = -1;
  }
}

SolverResult ImpulseSolver::solve(Bodies& bodies, std::vector<Contact>& contacts,
                                  const SolverSettings& settings) {
  SolverResult result;
  find_islands(bodies, contacts);
  fill_rows(bodies, contacts, settings.restitution);
  for (const Island& island : islands_) {
    const bool is_converged = sweep(island, settings, result);
    if (give_back(island, contacts, settings.restitution, is_converged)) sweep(island, settings, result);
  }
  write_back(bodies, contacts);
  return result;
}

int ImpulseSolver::separate(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings,
                            double dt) {
  // Each contact moves its own bodies by its own share, one after the other: a relaxation, not a solution,
  // since left-over overlap is a few centimetres that may take a second to go.
  int moved = 0;
  const double share = std::min(1.0, dt / settings.separation_time);
  for (const Contact& c : contacts) {
    const double excess =
        c.depth - std::max(settings.slop, c.record != nullptr ? c.record->crushed_depth : 0.0);
    if (excess <= 0) continue;
    const Vector arm_a = c.middle() - bodies.position[c.a];
    const Vector arm_b = c.middle() - bodies.position[c.b];
    const double push_mass =
        effective_mass(mobility(bodies, c.a, arm_a), mobility(bodies, c.b, arm_b), c.normal);
    const double p = share * excess * push_mass;  // [kg m]: an impulse times a second
    for (const auto& [body, arm, sign] : {std::tuple{c.a, arm_a, -1.0}, std::tuple{c.b, arm_b, 1.0}}) {
      move_body(bodies, body, sign * p * bodies.inverse_mass[body] * c.normal,
                sign * p * bodies.inverse_moment[body] * cross(arm, c.normal));
    }
    ++moved;
  }
  return moved;
}

}  // namespace polynya::dynamics
