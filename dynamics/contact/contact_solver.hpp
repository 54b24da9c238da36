#pragma once

#include <tuple>
#include <variant>
#include <vector>

#include "dynamics/contact/contact_islands.hpp"
#include "dynamics/contact/crush_law.hpp"
#include "dynamics/contact/jam_solver.hpp"
#include "dynamics/contact/restitution_law.hpp"

namespace polynya::dynamics {

/// The law by which bodies in contact push each other apart.
using ResponseLaw = std::variant<CrushLaw, RestitutionLaw>;

struct SolverSettings {
  /// Largest number of sweeps over an island in each substep. Smaller: more islands are left unsolved. With at most 24,
  /// or 48 for islands of up to 64 contacts, Newton's method is not used.
  int max_iterations = 30;
  double tolerance = 1e-7;  ///< residual at which an island is solved; smaller values take more sweeps [m/s]
  int threads = 1;          ///< number of threads, which solve islands in parallel
};

struct SolverResult {
  int unconverged = 0;  ///< number of islands whose residual is above the tolerance after all sweeps
  double residual = 0;  ///< largest residual of all islands [m/s]
  bool is_converged() const { return unconverged == 0; }
};

/// Finds the impulses of all contacts of one step by a response law, together with Coulomb friction, and
/// applies them. A contact lies on a line with the ends e = 0, 1; its normal n points from body a into b.
///
///   v, M          velocities (x, y, rotation) and masses of its two bodies
///   r_a,e, r_b,e  from the centres of mass to end e [m]
///   J_e           = (−n, −r_a,e × n, n, r_b,e × n): the row that gives the separating speed, `apart` [m/s]
///   u_e           = −J_e v, the closing speed at end e [m/s]
///   λ_e           ≥ 0, the normal impulse on b at end e, `normal_impulse` [N s]
///   K             = J M⁻¹ Jᵀ, the 2 × 2 mobility of the ends: impulses λ slow them by K λ [1/kg]
///   û             = u + K λ, the trial closing speeds, without the contact's own impulses
///   s, K_t        the slip along the line, and the speed that a slip impulse changes it by [m/s], [1/kg]
///   λ_t           the slip impulse on b along perpendicular(n), |λ_t| ≤ μ (λ_0 + λ_1) [N s]
///   τ             a substep [s]
///
/// The law gives λ = λ(û − K λ) of one contact, both ends together. Islands of touching bodies are solved separately,
/// by sweeps over their contacts: projected Gauss–Seidel [Catto2005]. The residual of a sweep is the largest change of
/// a speed at a contact, max(|Δλ_e| K_ee, |Δλ_t| K_t); an island is solved when it is within the tolerance. After the
/// first sweeps, each sweep is extrapolated along the search direction of the nonsmooth nonlinear conjugate gradients
/// of [Silcowitz2010]. Jams of crushing ice are solved by Newton's method (jam_solver.hpp). Islands are solved in
/// parallel. A large island is swept in two halves, in parallel, and then between them.
///
/// A response law L is a value with L::State for what it keeps of a contact within a step, and with the functions that
/// crush_law.hpp and restitution_law.hpp declare: substeps_of, state_of, begin_substep (bounds of λ), start_impulse,
/// start_slip, solve_block (one contact), end_substep, and write_back (results for contact and record). A law with
/// kRestores gives impulses after the compression. The State of a law with kHasJams has the members is_rigid and ends.
class ContactSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const ResponseLaw& law,
                     const SolverSettings& settings);

 private:
  struct Direction {   // of a constraint's impulses: two normal ones and the slip impulse
    double before[3];  // at the start of the sweep
    double along[3];   // the search direction
  };
  struct Search {
    double last_change = 0;  // squared size of the last sweep's changes
    int sweeps = 0;          // sweeps since the search started
    double share = 0;        // fraction of the last direction that the next one keeps
    bool is_due = false;     // impulses are to be extrapolated before the next sweep
    void follow(double change);
  };
  struct Swept {
    double residual = 0;  // [m/s]
    double change = 0;    // squared size of the changes, measured as kinetic energy
  };
  struct Sums {  // of one contact, over the substeps
    ConstraintSpeeds before;
    double impulse[2], slip_impulse;  // [N s]
    double normal_work, slip_work;    // [J]
  };
  struct KeptMemory {
    BodyIndex a = -1, b = -1;  // first contact of the island that had the memory last
    bool is_taken = false;     // taken in this step
    JamMemory memory;
  };
  template <class Law>
  using States = std::vector<typename Law::State>;

  template <class Law>
  void fill(const Bodies& bodies, const std::vector<Contact>& contacts, const Law& law, int threads);
  template <class Law>
  double solve_island(const Island& island, const Law& law, const SolverSettings& settings);
  template <class Law>
  void start(const Island& island, const Law& law, bool is_first, int threads);
  template <class Law>
  double sweep(const Island& island, const Law& law, const SolverSettings& settings);
  template <class Law>
  Swept sweep_once(const Island& island, const Law& law, const Search& search, bool is_plain, int threads);
  template <class Law>
  Swept sweep_range(ContactRange range, const Law& law, bool is_plain);
  void extrapolate(ContactRange range, const Search& search);
  void give_memories(const std::vector<Contact>& contacts);
  double missed_speed(const Island& island, const CrushLaw& law) const;
  void solve_jam(const Island& island, const SolverSettings& settings, double residual);
  double store_energy(const Island& island);
  bool restore(const Island& island, const RestitutionLaw& law, bool is_converged);
  template <class Law>
  void finish(const Island& island, const Law& law, int threads);
  template <class Law>
  void write_back(Bodies& bodies, std::vector<Contact>& contacts, const Law& law, int threads);

  ContactIslands islands_;
  std::vector<SolverBody> solver_bodies_;       // by their places in the islands
  std::vector<ContactConstraint> constraints_;  // in the order of the islands, as all that follows
  std::tuple<States<CrushLaw>, States<RestitutionLaw>> states_;
  std::vector<Sums> sums_;
  std::vector<Direction> directions_;
  std::vector<double> residuals_;  // residual of each island
  std::vector<KeptMemory> jam_memories_;
  std::vector<std::int32_t> memory_of_island_;  // index of each island's memory among them; −1: none is kept
};

}  // namespace polynya::dynamics
