#pragma once

#include <vector>

#include "dynamics/contact/contact_constraint.hpp"
#include "dynamics/contact/contact_islands.hpp"
#include "dynamics/contact/crush_law.hpp"
#include "dynamics/contact/impulse_solver.hpp"

namespace polynya::dynamics {

struct CrushSettings {
  double step = 0;           ///< Δt [s]
  int substeps = 1;          ///< equal parts of the step, solved one after the other on the step's geometry
  int max_iterations = 100;  ///< sweeps over an island, each substep
  double tolerance = 1e-4;   ///< largest violation of the law that is left [m/s]
  int threads = 1;           ///< for islands side by side
  bool is_warm_started = true;  ///< from the impulses of the step before
};

/// Finds the impulses of all contacts of one step by the law of crush_law.hpp, together with Coulomb
/// friction, and applies them. Contacts that do not crush (Contact::is_rigid) end the approach of their
/// bodies. Sweeps over the contacts of each island (projected Gauss–Seidel [Catto2005], both ends of a line
/// together), accelerated as in [Silcowitz2010], until no contact misses its law by more than the tolerance.
/// Writes impulses, work and the crushed depth into the contacts.
class CrushSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const CrushSettings& settings);

 private:
  struct Crushing {           // of one contact, through the substeps
    double force, stiffness;  // [N], [N/m]
    double depth, loaded;     // overlap now, and the deepest that was loaded [m]
    double missed;            // impulse before the contact was found [N s]
    double breaking_force;    // [N]
    std::array<CrushResponse, 2> ends;
    CrushPieces pieces;           // of the ends, at the last solution
    double total[2], total_slip;  // impulses of the substeps so far [N s]
    double normal_work, slip_work;
    bool is_rigid, is_broken;
  };
  struct Direction {
    double before[3], along[3];
  };

  void fill(const Bodies& bodies, const std::vector<Contact>& contacts, const CrushSettings& settings);
  void warm_start(const Island& island, const std::vector<Contact>& contacts, bool is_first, bool is_warm);
  void begin_substep(const Island& island, double tau, bool is_first);
  static double impulse_to_breaking(const Crushing& crushing, const ConstraintSpeeds& speeds, double tau);
  void end_substep(const Island& island, double tau);
  double sweep(const Island& island, const CrushSettings& settings);
  void solve_jam(const Island& island, double tolerance);
  void accelerate(const Island& island, double& last, bool is_first);
  void write_back(Bodies& bodies, std::vector<Contact>& contacts, double step);

  ContactIslands islands_;
  std::vector<SolverBody> solver_bodies_;
  std::vector<ContactConstraint> constraints_;
  std::vector<Crushing> crushing_;
  std::vector<ConstraintSpeeds> before_;
  std::vector<Direction> directions_;
  std::vector<double> residuals_;
};

}  // namespace polynya::dynamics
