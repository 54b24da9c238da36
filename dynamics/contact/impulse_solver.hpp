#pragma once

#include <vector>

#include "dynamics/contact/contact_constraint.hpp"
#include "dynamics/contact/contact_islands.hpp"

namespace polynya::dynamics {

struct SolverSettings {
  double restitution = 0.1;  ///< ε of Eq. (5) [-]
  int max_iterations = 30;   ///< over the contacts of an island
  int threads = 1;           ///< for islands side by side
  double tolerance = 1e-7;   ///< stop when no impulse changes the velocity at its contact by more [m/s]
};

struct SolverResult {
  int unconverged = 0;  ///< islands that used all iterations
  double residual = 0;  ///< largest change of a velocity in the last iteration of these [m/s]
  bool is_converged() const { return unconverged == 0; }
};

/// Finds the impulses of all contacts of one step together and applies them: sequential impulses [Baraff1997,
/// Catto2005]. The two ends of a contact line are solved together, each with Eq. (5) corrected, normal
/// impulses within [0, limit/2], friction within the Coulomb cone; a symmetric push stays symmetric. The ends
/// slip alike, since the line is the direction of slip, so friction has one impulse. Bodies that touch make
/// islands, and each is iterated until it has converged:
///   1. Compression: impulses that end every approach, started from what the last two steps predict (a steady
///      push continues, a blow does not).
///   2. Restitution, as Poisson's share of the compression: ε times the impulse that compressed the contact.
///      One that is not limited leaves with v⁺ = −ε v⁻ in one step as Eq. (5) says; one that crushes, over as
///      many steps as the ice needs. Never more than twice ε times what would end the approach of its two
///      bodies alone, so that a squeeze from elsewhere does not charge it.
///   3. Compression again, of what restitution pushed together.
/// Writes the impulses into the contacts, and what the next step needs into their records.
class ImpulseSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);

 private:
  struct Direction {   // of a constraint's impulses: two normal, one of slip
    double before[3];  // at the start of the iteration
    double along[3];   // the search direction
  };
  struct SearchState {
    double last_change = 0;  // squared size of the last iteration's changes
    int iterations = 0;
  };

  void fill_constraints(const Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);
  void warm_start(const Island& island, const std::vector<Contact>& contacts);
  void accelerate(const Island& island, SearchState& search);
  double iterate(const Island& island, const SolverSettings& settings);
  bool apply_restitution(const Island& island, std::vector<Contact>& contacts, double restitution,
                         bool is_converged);
  void write_back(Bodies& bodies, std::vector<Contact>& contacts);

  ContactIslands islands_;
  std::vector<SolverBody> solver_bodies_;       // by their places in the islands
  std::vector<ContactConstraint> constraints_;  // in the islands' order
  std::vector<double> residuals_;               // of the islands
  std::vector<Direction> directions_;           // of the constraints
  std::vector<ConstraintSpeeds> before_;        // of the constraints, before any impulse
};

}  // namespace polynya::dynamics
