#pragma once

#include <memory>
#include <vector>

#include "dynamics/water/water_drag.hpp"
#include "simulation/simulation.hpp"

namespace polynya::bench {

/// The rigid bodies of a scene as another engine can take them: the same outlines, masses, places and
/// velocities that Polynya starts with, in the water frame. Nothing in them breaks or crushes.
struct PeerBody {
  geometry::Ring outline;  ///< convex, about the centre of mass, in the body's axes [m]
  double radius = 0;       ///< radius of a cylinder, which the peers take as a circle [m]; 0: see outline
  double mass = 0;         ///< [kg]
  double moment = 0;       ///< [kg m²]
  geometry::Point position;
  double angle = 0;  ///< [rad]
  geometry::Vector velocity;
  double angular_velocity = 0;
  bool is_prescribed = false;  ///< true if impulses do not change its velocity
  double thrust = 0;           ///< along its x axis [N]
  double drag = 0;             ///< ½ C_D ρ_w h [kg/m³]; 0: the water does not hold it back
  double rotational = 0;       ///< K of its drag shape [m⁴]
  std::vector<double> widths;  ///< across drag_direction(k), and the first again [m]
};

struct PeerScene {
  std::vector<PeerBody> bodies;
  dynamics::ShearCurrent current;
  double friction = 0;
  double restitution = 0;
  double step = 0;  ///< [s]
};

/// The bodies a simulation starts with. Outlines must be convex and without holes.
PeerScene peer_scene(const simulation::Simulation& simulation);

/// Cost of a step, and the work that it did.
struct StepReport {
  double seconds = 0;
  int awake = 0;     ///< bodies that moved
  int contacts = 0;  ///< pairs that touch; −1: not counted at this step
};

/// Cuts a convex ring along chords into convex pieces of at most `most_corners` corners.
std::vector<geometry::Ring> convex_pieces(const geometry::Ring& ring, std::size_t most_corners);

/// Box2D 2.4.1, in floats, with 8 velocity and 3 position iterations, as its manual recommends. Sleeping is on with its
/// own thresholds (1 cm/s, 2°/s, 0.5 s); continuous collision is off. Bodies at rest start asleep. The drag of Eq. (6)
/// is applied outside of the timed part.
class Box2dWorld {
 public:
  explicit Box2dWorld(const PeerScene& scene);
  ~Box2dWorld();
  StepReport step(bool counts_contacts);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Box2D 3.2, in floats, with 4 substeps, as its manual recommends, and one worker. Sleeping is on with Box2D 2.4.1's
/// threshold of 1 cm/s (its own would be 5 cm/s) and its own 0.5 s; continuous collision is off. Bodies at rest start
/// asleep. The drag of Eq. (6) is applied outside of the timed part. The number of touching contacts includes contacts
/// that it expects within 2 cm. This engine is built only if its sources are present (CMakeLists.txt).
class Box2d3World {
 public:
  explicit Box2d3World(const PeerScene& scene);
  ~Box2d3World();
  StepReport step(bool counts_contacts);
  std::vector<geometry::Point> places() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Chipmunk 7.0.3, in doubles, with 10 iterations, its default. Sleeping is on with Box2D's thresholds (it would be off
/// by default). The broad phase is its default, a tree of boxes. Bodies at rest start asleep. The drag of Eq. (6) is
/// applied in its velocity callback, inside the timed part.
class ChipmunkWorld {
 public:
  explicit ChipmunkWorld(const PeerScene& scene);
  ~ChipmunkWorld();
  StepReport step(bool counts_contacts);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Acceleration by the water of Eq. (6) on a body that moves with v at p and is turned by r [m/s²].
geometry::Vector drag_acceleration(const PeerBody& body, const dynamics::ShearCurrent& current, geometry::Point p,
                                   geometry::Vector v, geometry::Rotation r);
/// The same of its spin [rad/s²].
double drag_spin(const PeerBody& body, const dynamics::ShearCurrent& current, double angular_velocity);

}  // namespace polynya::bench
