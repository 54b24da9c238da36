#pragma once

#include <compare>
#include <vector>

#include "dynamics/contact.hpp"

namespace polynya::dynamics {

struct SolverSettings {
  double restitution = 0.1;      ///< ε of Eq. (5) [-]
  int most_sweeps = 30;          ///< over all contacts of a step
  double tolerance = 1e-7;       ///< stop when no impulse changes the velocity at its contact by more [m/s]
  double separation_time = 1.0;  ///< over which left-over overlap decays [s]
  double slop = 1e-4;            ///< overlap that is left alone [m]
};

struct SolverResult {
  int unconverged = 0;  ///< islands that used all their sweeps
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
/// symmetric.
class ImpulseSolver {
 public:
  SolverResult solve(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings);

  /// Moves overlapping bodies apart without giving them speed (split impulse): along the normals, in
  /// proportion to their inverse masses, the overlap beyond what crushing made decays over separation_time.
  /// Returns how many contacts it moved.
  int separate(Bodies& bodies, std::vector<Contact>& contacts, const SolverSettings& settings, double dt);

 private:
  struct Mover {  // a body's velocity while it is being solved for
    geometry::Vector velocity;
    double angular_velocity;
    double inverse_mass;
    double inverse_moment;
  };
  struct Row {          // one end of one contact line; directions as seen by its two bodies
    std::int32_t a, b;  // movers
    geometry::Vector normal;
    double normal_turn_a, normal_turn_b;    // arm × normal [m]
    double tangent_turn_a, tangent_turn_b;  // arm × perpendicular(normal) [m]
    double normal_mass, tangent_mass;       // [kg]
    double least;                           // of the normal impulse: what restitution gave [N s]
    double limit;                           // [N s]
    double friction;
    double normal_impulse, tangent_impulse;
  };
  struct Place {
    std::int32_t island;  // its root among the movers
    std::uint32_t contact;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Island {
    std::uint32_t first = 0;  // rows
    std::uint32_t count = 0;
  };

  void find_islands(const Bodies& bodies, const std::vector<Contact>& contacts);
  std::int32_t mover_of(const Bodies& bodies, BodyIndex body);
  Row row_of(const Bodies& bodies, const Contact& contact, int end) const;
  void fill_rows(const Bodies& bodies, std::vector<Contact>& contacts, double restitution);
  void push(const Row& row, double normal_impulse, double tangent_impulse);
  double apart_at(const Row& row) const;
  void press(Row& row, double normal_impulse);
  double visit_normals(Row* ends, double coupling);
  double visit_friction(Row& row);
  double isolated_impulse(const Row* ends, double coupling) const;
  bool sweep(const Island& island, const SolverSettings& settings, SolverResult& result);
  bool give_back(const Island& island, std::vector<Contact>& contacts, double restitution, bool is_converged);
  void write_back(Bodies& bodies, std::vector<Contact>& contacts);

  std::vector<Mover> movers_;
  std::vector<BodyIndex> body_of_mover_;
  std::vector<std::int32_t> mover_of_body_;    // −1 where the body has none
  std::vector<std::int32_t> island_of_mover_;  // union-find parents, then island numbers
  std::vector<Place> order_;                   // contacts, island by island
  std::vector<Island> islands_;
  std::vector<Row> rows_;          // two for each contact, in order_
  std::vector<double> couplings_;  // how an impulse at one end moves the other, per contact in order_ [1/kg]
};

}  // namespace polynya::dynamics
