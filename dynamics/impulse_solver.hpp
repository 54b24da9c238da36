#pragma once

#include <vector>

#include "dynamics/contact_islands.hpp"
#include "dynamics/contact_row.hpp"

namespace polynya::dynamics {

struct SolverSettings {
  double restitution = 0.1;  ///< ε of Eq. (5) [-]
  int most_sweeps = 30;      ///< over all contacts of a step
  int threads = 1;           ///< for islands side by side
  double tolerance = 1e-7;   ///< stop when no impulse changes the velocity at its contact by more [m/s]
};

struct SolverResult {
  int unconverged = 0;   ///< islands that used all their sweeps
  double left_over = 0;  ///< the most that the last sweep over one of these changed a velocity by [m/s]
  bool is_converged() const { return unconverged == 0; }
};

/// Finds the impulses of all contacts of one step together and applies them: sequential impulses [Baraff1997,
/// Catto2005] over both ends of every contact line, each end with Eq. (5) corrected, normal impulses within
/// [0, limit/2], friction within the Coulomb cone. A floe pinched between two bodies so feels both. Bodies
/// that touch make islands, and each island is swept until it has converged. Compression first: impulses that
/// end every approach, starting from what the last two steps foretell (a steady push goes on, a blow does
/// not). Then restitution, as Poisson's share of the compression: a contact gives back ε times the impulse
/// that compressed it, so one that is not limited leaves with v⁺ = −ε v⁻ in one step as Eq. (5) says, and one
/// that crushes gets there over as many steps as the ice needs; never more than twice ε times what would have
/// ended the approach of its two bodies alone, so a squeeze from elsewhere does not charge it. Last, whatever
/// the restitution pushed together is held apart. Writes the impulses into the contacts, and what the next
/// step needs into their records. The two ends of a line are solved together, so that a symmetric push stays
/// symmetric; they slip alike, since the line is the direction of slip, so friction has one impulse.
class ImpulseSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);

 private:
  struct Way {  // of a row's impulses through the sweeps
    double before[3];
    double along[3];
  };
  struct Momentum {
    double last = 0;  // size of the last sweep's changes
    int steps = 0;
  };

  void fill_rows(const Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);
  void start(const Island& island, const std::vector<Contact>& contacts);
  void go_on(const Island& island, Momentum& momentum);
  double sweep(const Island& island, const SolverSettings& settings);
  bool give_back(const Island& island, std::vector<Contact>& contacts, double restitution, bool is_converged);
  void write_back(Bodies& bodies, std::vector<Contact>& contacts);

  ContactIslands islands_;
  std::vector<Mover> movers_;      // by their places in the islands
  std::vector<ContactRow> rows_;   // in the islands' order
  std::vector<double> left_over_;  // of the islands
  std::vector<Way> ways_;          // of the rows
  std::vector<RowSpeeds> before_;  // of the rows, before any impulse
};

}  // namespace polynya::dynamics
