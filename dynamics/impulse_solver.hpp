#pragma once

#include <vector>

#include "dynamics/contact.hpp"

namespace polynya::dynamics {

struct SolverSettings {
  double restitution = 0.1;       ///< ε of Eq. (5) [-]
  int most_sweeps = 30;           ///< over all contacts of a step
  double tolerance = 1e-12;       ///< stop when no impulse changes the velocity at its contact by more [m/s]
  double separation_time = 1.0;   ///< over which left-over overlap decays [s]
  double slop = 1e-4;             ///< overlap that is left alone [m]
};

struct SolverResult {
  int sweeps = 0;
  bool is_converged = true;
};

/// Finds the impulses of all contacts of one step together and applies them: sequential impulses [Baraff1997,
/// Catto2005] over both ends of every contact line, each end with Eq. (5) corrected, normal impulses within
/// [0, limit/2], friction within the Coulomb cone. A floe pinched between two bodies so feels both.
/// Compression first: impulses that end every approach. Then restitution, as Poisson's share of the compression: a
/// contact gives back ε times the impulse that compressed it, so one that is not limited leaves with v⁺ = −ε v⁻ in one
/// step as Eq. (5) says, and one that crushes gets there over as many steps as the ice needs. Last, whatever the
/// restitution pushed together is held apart. Writes the impulses into the contacts and what is still to be given back
/// into their records.
class ImpulseSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);

  /// Moves overlapping bodies apart without giving them speed (split impulse): along the normals, in proportion to
  /// their inverse masses, the overlap beyond what crushing made decays over separation_time. Returns how many
  /// contacts it moved.
  int separate(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings, double dt);

 private:
  struct Row {  // one end of one contact line
    BodyIndex a, b;
    geometry::Vector arm_a, arm_b, normal;
    double normal_mass, tangent_mass;
    double least;    // of the normal impulse: what restitution gave [N s]
    double limit;    // [N s]
    double friction;
    double normal_impulse, tangent_impulse;
  };
  void fill_rows(const Bodies& bodies, const std::vector<Contact>& contacts);
  void sweep_until_converged(Bodies& bodies, const SolverSettings& settings, SolverResult& result);
  bool give_back(Bodies& bodies, const std::vector<Contact>& contacts, double restitution);
  std::vector<Row> rows_;
};

}  // namespace polynya::dynamics
