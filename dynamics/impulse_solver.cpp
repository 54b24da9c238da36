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

void push(Bodies& bodies, BodyIndex a, BodyIndex b, Vector arm_a, Vector arm_b, Vector impulse_on_b) {
  bodies.velocity[a] -= bodies.inverse_mass[a] * impulse_on_b;
  bodies.angular_velocity[a] -= bodies.inverse_moment[a] * cross(arm_a, impulse_on_b);
  bodies.velocity[b] += bodies.inverse_mass[b] * impulse_on_b;
  bodies.angular_velocity[b] += bodies.inverse_moment[b] * cross(arm_b, impulse_on_b);
}

Vector relative_velocity(const Bodies& bodies, BodyIndex a, BodyIndex b, Vector arm_a, Vector arm_b) {
  return velocity_at(bodies, b, arm_b) - velocity_at(bodies, a, arm_a);
}

}  // namespace

void ImpulseSolver::fill_rows(const Bodies& bodies, const std::vector<Contact>& contacts) {
  rows_.clear();
  for (const Contact& c : contacts) {
    for (const geometry::Point end : c.ends) {
      Row row;
      row.a = c.a;
      row.b = c.b;
      row.arm_a = end - bodies.position[c.a];
      row.arm_b = end - bodies.position[c.b];
      row.normal = c.normal;
      const Mobility ma = mobility(bodies, c.a, row.arm_a);
      const Mobility mb = mobility(bodies, c.b, row.arm_b);
      row.normal_mass = effective_mass(ma, mb, c.normal);
      row.tangent_mass = effective_mass(ma, mb, perpendicular(c.normal));
      row.least = 0;
      row.limit = 0.5 * c.impulse_limit;
      row.friction = c.friction;
      row.normal_impulse = row.tangent_impulse = 0;
      rows_.push_back(row);
    }
  }
}

void ImpulseSolver::sweep_until_converged(Bodies& bodies, const SolverSettings& settings, SolverResult& result) {
  for (int sweep = 0; sweep < settings.most_sweeps; ++sweep) {
    ++result.sweeps;
    double largest_change = 0;
    for (Row& row : rows_) {
      const double apart = dot(relative_velocity(bodies, row.a, row.b, row.arm_a, row.arm_b), row.normal);
      const double normal_impulse = std::clamp(row.normal_impulse - apart * row.normal_mass, row.least, row.limit);
      const double change = normal_impulse - row.normal_impulse;
      row.normal_impulse = normal_impulse;
      if (change != 0) push(bodies, row.a, row.b, row.arm_a, row.arm_b, change * row.normal);
      largest_change = std::max(largest_change, std::abs(change) / row.normal_mass);
    }
    for (Row& row : rows_) {
      const Vector tangent = perpendicular(row.normal);
      const double slip = dot(relative_velocity(bodies, row.a, row.b, row.arm_a, row.arm_b), tangent);
      const double most = row.friction * row.normal_impulse;
      const double tangent_impulse = std::clamp(row.tangent_impulse - slip * row.tangent_mass, -most, most);
      const double change = tangent_impulse - row.tangent_impulse;
      row.tangent_impulse = tangent_impulse;
      if (change != 0) push(bodies, row.a, row.b, row.arm_a, row.arm_b, change * tangent);
      largest_change = std::max(largest_change, std::abs(change) / row.tangent_mass);
    }
    if (largest_change <= settings.tolerance) return;
  }
  result.is_converged = false;
}

bool ImpulseSolver::give_back(Bodies& bodies, const std::vector<Contact>& contacts, double restitution) {
  bool gave = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    Row* ends = &rows_[2 * i];
    const double compression = ends[0].normal_impulse + ends[1].normal_impulse;
    double owed = restitution * compression;
    if (contacts[i].record != nullptr) owed += contacts[i].record->owed_impulse;
    if (owed <= 0) continue;
    double still_owed = 0;
    for (int end = 0; end < 2; ++end) {
      Row& row = ends[end];
      const double share = owed * (compression > 0 ? row.normal_impulse / compression : 0.5);
      row.least = std::min(row.normal_impulse + share, row.limit);
      const double given = row.least - row.normal_impulse;
      still_owed += share - given;
      row.normal_impulse = row.least;
      push(bodies, row.a, row.b, row.arm_a, row.arm_b, given * row.normal);
      gave = gave || given > 0;
    }
    if (contacts[i].record != nullptr) contacts[i].record->owed_impulse = still_owed;
  }
  return gave;
}

SolverResult ImpulseSolver::solve(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings) {
  SolverResult result;
  fill_rows(bodies, contacts);
  sweep_until_converged(bodies, settings, result);
  if (give_back(bodies, contacts, settings.restitution)) sweep_until_converged(bodies, settings, result);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (int end = 0; end < 2; ++end) {
      contacts[i].normal_impulse[end] = rows_[2 * i + end].normal_impulse;
      contacts[i].tangent_impulse[end] = rows_[2 * i + end].tangent_impulse;
    }
  }
  return result;
}

int ImpulseSolver::separate(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings,
                            double dt) {
  // Each contact moves its own bodies by its own share, one after the other: a relaxation, not a solution, since
  // left-over overlap is a few centimetres that may take a second to go.
  int moved = 0;
  const double share = std::min(1.0, dt / settings.separation_time);
  for (const Contact& c : contacts) {
    const double excess = c.depth - std::max(settings.slop, c.record != nullptr ? c.record->crushed_depth : 0.0);
    if (excess <= 0) continue;
    const Vector arm_a = c.middle() - bodies.position[c.a];
    const Vector arm_b = c.middle() - bodies.position[c.b];
    const double push_mass = effective_mass(mobility(bodies, c.a, arm_a), mobility(bodies, c.b, arm_b), c.normal);
    const double p = share * excess * push_mass;  // [kg m]: an impulse times a second
    for (const auto& [body, arm, sign] : {std::tuple{c.a, arm_a, -1.0}, std::tuple{c.b, arm_b, 1.0}}) {
      const Vector shift = sign * p * bodies.inverse_mass[body] * c.normal;
      const double turn = sign * p * bodies.inverse_moment[body] * cross(arm, c.normal);
      bodies.position[body] += shift;
      bodies.angle[body] += turn;
      bodies.rotation[body] = geometry::Rotation::by(bodies.angle[body]);
      bodies.travel[body] += length(shift) + std::abs(turn) * bodies.bounding_radius[body];
    }
    ++moved;
  }
  return moved;
}

}  // namespace polynya::dynamics
