#pragma once

#include <vector>

#include "dynamics/contact_islands.hpp"
#include "dynamics/contact_row.hpp"

namespace polynya::dynamics {

struct SolverSettings {
  double restitution = 0.1;  ///< ε of Eq. (5) [-]
  int max_iterations = 30;   ///< over all contacts of a step
  int threads = 1;           ///< for islands side by side
  double tolerance = 1e-7;   ///< stop when no impulse changes the velocity at its contact by more [m/s]
};

struct SolverResult {
  int unconverged = 0;  ///< islands that used all their sweeps
  double residual = 0;  ///< the most that the last sweep over one of these changed a velocity by [m/s]
  bool is_converged() const { return unconverged == 0; }
};

/// Finds the impulses of all contacts of one step together and applies them: sequential impulses [Baraff1997,
/// Catto2005] over both ends of every contact line, each end with Eq. (5) corrected, normal impulses within
/// [0, limit/2], friction within the Coulomb cone. A floe pinched between two bodies so feels both. Bodies
/// that touch make islands, and each island is swept until it has converged. Compression first: impulses that
/// end every approach, starting from what the last two steps foretell (a steady apply_impulses goes on, a
/// blow does not). Then restitution, as Poisson's share of the compression: a contact gives back ε times the
/// impulse that compressed it, so one that is not limited leaves with v⁺ = −ε v⁻ in one step as Eq. (5) says,
/// and one that crushes gets there over as many steps as the ice needs; never more than twice ε times what
/// would have ended the approach of its two bodies alone, so a squeeze from elsewhere does not charge it.
/// Last, whatever the restitution pushed together is held apart. Writes the impulses into the contacts, and
/// what the next step needs into their records. The two ends of a line are solved together, so that a
/// symmetric apply_impulses stays symmetric; they slip alike, since the line is the direction of slip, so
/// friction has one impulse.
class ImpulseSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);

 private:
  struct Direction {  // of a constraint's impulses through the sweeps
    double before[3];
    double along[3];
  };
  struct Momentum {
    double last = 0;  // size of the last sweep's changes
    int steps = 0;
  };

  void fill_constraints(const Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);
  void warm_start(const Island& island, const std::vector<Contact>& contacts);
  void accelerate(const Island& island, Momentum& momentum);
  double sweep(const Island& island, const SolverSettings& settings);
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
