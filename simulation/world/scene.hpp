#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dynamics/bodies.hpp"
#include "dynamics/water/flow.hpp"
#include "dynamics/water/water_drag.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/characteristic_length.hpp"
#include "fracture/materials.hpp"
#include "fracture/splitting.hpp"
#include "fracture/tilting.hpp"
#include "geometry/shape/polygon.hpp"
#include "simulation/ship/sailing_settings.hpp"

namespace polynya::simulation {

// A scene in the form that the simulation reads: all defaults are filled in, and all floes are listed. Units are SI and
// angles are in radians. Module io reads the JSON form; docs/scene.md lists its fields. "The paper" is [Sawamura2017];
// equations have the paper's numbers.

/// Time step and duration of a run.
struct StepSettings {
  double step = 0.005;  ///< length of a tick, the longest time step; parts.hpp divides ticks into shorter steps [s]
  double until = 550;   ///< simulated time at which the run ends, rounded up to a whole tick [s]
  friend bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// A current whose speed grows linearly across its direction. It adds to the uniform drift and is carried along by it.
/// At a point x the current flows along `direction` with the speed rate · d, where d is the distance of x from the line
/// through `origin` along `direction`, positive to port of it.
struct ShearSettings {
  double rate = 0;         ///< increase of the speed per distance to port [1/s]
  double direction = 0;    ///< direction to which the current flows, counter-clockwise from the x axis [rad]
  geometry::Point origin;  ///< position at the start of a point that moves with the drift alone, world frame [m]
  friend bool operator==(const ShearSettings&, const ShearSettings&) = default;
};

/// Water of a scene: its properties, its drag on floes and its motion.
struct WaterSettings {
  fracture::Water water;
  double drag_coefficient = 0.5;                             ///< drag coefficient C_D of Eq. (6) [-]
  dynamics::DragArea drag_area = dynamics::DragArea::kEdge;  ///< reading of the drag area A of Eq. (6)
  /// Coefficient C_w of the skin drag on a floe's area in plan, which adds to Eq. (6) [-].
  double skin_drag_coefficient = 0;
  geometry::Vector drift;                     ///< uniform velocity of the water over ground; carries the ice [m/s]
  std::vector<dynamics::FlowRow> drift_rows;  ///< drift over time; replaces `drift` unless empty
  std::optional<dynamics::Tide> tide;         ///< tidal velocity, which adds to the drift
  ShearSettings shear;                        ///< sheared current, which adds to the drift
  friend bool operator==(const WaterSettings&, const WaterSettings&) = default;

  /// Returns true if the drift is the same at all times.
  bool is_steady() const { return drift_rows.empty() && !tide; }
  /// Returns the drift over ground at a time [s], with the tide and without the sheared current [m/s].
  geometry::Vector drift_at(double time) const;
  /// Returns the displacement of the water by that drift from time 0 to a time [s] [m].
  geometry::Vector drift_path(double time) const;
  /// Returns an upper bound of the speed of the drift at all times [m/s].
  double fastest_drift() const;
};

/// Rule for the normal of a contact (docs/theory/contact.md, "One contact for each overlap").
enum class ContactNormal {
  kBoundary,       ///< the normal is the direction in which the overlap's area decreases fastest
  kCircleCentres,  ///< the normal is the line between the centres of two contact circles, the paper's rule
};

/// Law of the normal force between two bodies in contact (docs/theory/contact.md).
enum class ContactLaw {
  kCrush,    ///< force of crushing ice while the bodies approach each other, none at rest or when they part
  kImpulse,  ///< the paper's rigid impulses, Eq. (5), limited to the force of crushing ice
};

/// Detection and solution of contacts. The coefficient of friction belongs to the ice (fracture::Ice).
struct ContactSettings {
  ContactLaw law = ContactLaw::kCrush;
  /// For kCrush: number of substeps of a time step, solved one after the other. More substeps follow the growth of the
  /// crushing force more closely and take more time.
  int substeps = 1;
  /// For kCrush: residual at which an island of bodies in contact counts as solved [m/s]. Smaller values take more
  /// sweeps.
  double tolerance = 1e-4;
  /// For kCrush: true if the solver starts from the impulses of the previous step, false if it starts from 0. The
  /// solution does not depend on it.
  bool is_warm_started = true;
  /// Radius of the contact circles that cover the boundaries of bodies [m]. Smaller circles need more memory and, at
  /// hulls, shorter steps (kDisplacementOverRadius).
  double circle_radius = 1.0;
  ContactNormal normal = ContactNormal::kBoundary;
  /// Coefficient of restitution ε of Eq. (5) [-]. For kCrush it affects only the collision force j/τ_c.
  double restitution = 0.1;
  /// Contact time τ_c by which the impulse j of Eq. (5) becomes the paper's collision force j/τ_c [s]. The motion
  /// depends on it only where that force decides splits (fracture::SplittingModel::kMichel).
  double contact_time = 0.5;
  /// For kImpulse: decay time of overlaps that no contact presses together any more [s].
  double separation_time = 1.0;
  /// Largest number of sweeps of the contact solver over an island of bodies in contact, in each substep.
  int iterations = 100;
  friend bool operator==(const ContactSettings&, const ContactSettings&) = default;
};

/// Model of the bending capacity of an ice edge: NevelModel, KashtelyanModel or FsiDatabaseModel (fracture/bending).
enum class BendingModelKind { kNevel, kKashtelyan, kFsiDatabase };
/// Fate of a cusp that breaks off at a hull.
enum class CuspFate {
  kSubmerge,   ///< the cusp goes under for good and is removed, the paper's rule
  kFloat,      ///< the cusp becomes a floe
  kUnderHull,  ///< the cusp lies under the hull until it surfaces; it is removed if the hull has no draught
};

/// Floes that tilt and go under inclined hulls with a draught.
struct GoingUnderSettings {
  bool is_enabled = false;         ///< true if floes can go under
  fracture::TiltSettings tilting;  ///< parameters of the tilting
  friend bool operator==(const GoingUnderSettings&, const GoingUnderSettings&) = default;
};

/// Ice that surfaces after the hull has passed over it.
struct ResurfaceSettings {
  /// True if ice surfaces behind the hull. If false, it stays under the ice for good, unless the ship backs off it.
  bool is_enabled = false;
  double retry = 1;        ///< time between two attempts to surface [s]
  double give_up = 120;    ///< waiting time for space after which a piece stays under the ice for good [s]
  double rim_loss = 0.05;  ///< fraction of a piece's area that becomes brash, taken evenly off its rim [-]
  /// Scatter of the place and angle at which a piece surfaces [-]: standard deviation of each coordinate divided by
  /// √area, and standard deviation of the angle divided by half a turn. 0: pieces surface where they are.
  double scatter = 0.2;
  friend bool operator==(const ResurfaceSettings&, const ResurfaceSettings&) = default;
};

/// Breaking of ice, and the fate of the broken ice.
struct FractureSettings {
  /// Reading of the characteristic length l of Eq. (7).
  fracture::CharacteristicLength characteristic_length = fracture::CharacteristicLength::kFourthRoot;
  /// Factor κ on l [-]. Floes with √area < κ l are pushed and neither bend nor split. With SplittingModel::kLefm,
  /// slender ones may still break across as beams, unless κ l exceeds (D/ρ_w g)^¼ (IceLimits).
  double breakable_size_factor = 1.0;
  BendingModelKind bending = BendingModelKind::kFsiDatabase;
  /// For kFsiDatabase: effect of the radial crack that opens below a wide edge before its cusp breaks off.
  fracture::RadialCracks radial_cracks = fracture::RadialCracks::kSplitWedge;
  /// For kFsiDatabase with ContactLaw::kCrush: part of the ice's outline that decides where the edge breaks.
  fracture::EdgeOutline outline = fracture::EdgeOutline::kSections;
  /// For ContactLaw::kCrush: true if ice that bends under a hull recedes from it, so that less ice crushes.
  bool follows_deflection = true;
  /// For ContactLaw::kCrush with CuspFate::kUnderHull: true if water reaches the deck of a turning cusp only through
  /// the gaps that open at its edges, and the hull carries the missing water pressure. If false, water covers the deck
  /// at once, and the hull carries no such load.
  bool floods_decks = true;
  /// Scatter of the flexural strength among bending events, log-normal: standard deviation / mean [-].
  double bending_scatter = 0;
  fracture::SplittingModel splitting = fracture::SplittingModel::kLefm;
  double splitting_shape_factor = 0.25;  ///< shape factor n of Eq. (4) [-]
  /// Smallest piece that a crack may leave on either side; cracks that would leave less do not run.
  fracture::LeastPiece least_piece;
  CuspFate cusp_fate = CuspFate::kSubmerge;
  GoingUnderSettings going_under;
  ResurfaceSettings resurface;
  /// Largest distance of a cusp's polygon from its circle [m]. Smaller values give cusps more corners, which cost time.
  double cusp_sagitta = 0.02;
  double smallest_floe_area = 0.1;  ///< area below which a piece becomes brash instead of a floe [m²]
  friend bool operator==(const FractureSettings&, const FractureSettings&) = default;
};

/// Shape of a hull in its own frame. The frame of a ship has its origin at the centre of gravity, x forward and y to
/// port.
struct Hull {
  geometry::Ring waterline;                         ///< vertices of the waterline, counter-clockwise [m]
  double stem_angle = 30 * std::numbers::pi / 180;  ///< angle φ of the stem from the horizontal [rad]
  double draught = 0;                               ///< draught T; with 0, no ice goes under this hull [m]
  /// True if the resistance of ice under the hull grows with speed by Lindqvist's factor.
  bool has_speed_factor = true;
  /// Angle θ_s of the hull from the vertical at each vertex of the waterline [rad]. If empty, it follows from the stem
  /// angle.
  std::vector<double> angles_from_vertical;
  friend bool operator==(const Hull&, const Hull&) = default;
};

/// Propulsion by a constant thrust.
struct ConstantThrust {
  double thrust = 0;  ///< thrust along the ship's heading; negative astern [N]
  friend bool operator==(const ConstantThrust&, const ConstantThrust&) = default;
};
/// Prescribed motion: the velocity over ground and the yaw rate keep their values of the start. The reported thrust is
/// the force that holds the ship at its speed.
struct ConstantSpeed {
  double speed = 0;  ///< speed over ground along the heading at the start; negative astern [m/s]
  friend bool operator==(const ConstantSpeed&, const ConstantSpeed&) = default;
};
using dynamics::Engine;
using Propulsion = std::variant<ConstantThrust, ConstantSpeed, Engine>;

using dynamics::BodyKind;

/// Panels of a hull on which the loads of the ice are recorded. They are counted along the waterline from the stem.
struct PanelSettings {
  double length = 0;   ///< length of a panel along the waterline [m]
  double bottom = -2;  ///< height of the lowest row's bottom above the water [m]
  double top = 1;      ///< height of the highest row's top above the water [m]
  int rows = 1;        ///< number of rows of equal height between bottom and top
  friend bool operator==(const PanelSettings&, const PanelSettings&) = default;
};

/// Members that ships, structures and walls have in common: a hull and its place at the start.
struct PlacedHull {
  std::string name;
  Hull hull;
  /// Position of the origin of the hull's frame at the start, in the world frame; of a ship its centre of gravity [m].
  geometry::Point position_in_world;
  double heading = 0;                   ///< heading at the start, counter-clockwise from the x axis [rad]
  std::optional<PanelSettings> panels;  ///< panels for recorded loads, if any
  friend bool operator==(const PlacedHull&, const PlacedHull&) = default;
};

/// A ship.
struct Ship : PlacedHull {
  static constexpr BodyKind kKind = BodyKind::kShip;
  double mass = 0;               ///< mass of the ship [kg]
  double moment_of_inertia = 0;  ///< moment of inertia about the vertical axis through the centre of gravity [kg m²]
  /// Speed over ground along the heading at the start [m/s]. ConstantSpeed uses its own speed instead.
  double speed = 0;
  double sway_speed = 0;  ///< speed over ground to port at the start [m/s]
  double yaw_rate = 0;    ///< yaw rate at the start, counter-clockwise [rad/s]
  Propulsion propulsion;
  HullWaterSettings water;                 ///< forces of the water on the hull
  Steering steering;                       ///< rudder or thrusters that turn, if any
  PilotSettings pilot;                     ///< pilot, for a ship with an engine
  std::optional<MooringSettings> mooring;  ///< mooring, if any
  friend bool operator==(const Ship&, const Ship&) = default;
};

/// A structure that stands on the ground and never moves.
struct Structure : PlacedHull {
  static constexpr BodyKind kKind = BodyKind::kStructure;
  friend bool operator==(const Structure&, const Structure&) = default;
};

/// Load with which a wall presses on the ice along its normal. It represents a wide ice pack behind the wall.
struct WallPressure {
  /// Load q per length of a wall that stands still over ground [N/m]. It falls linearly with the wall's speed, to 0 at
  /// closing_speed.
  double line_load = 0;
  double closing_speed = 0.1;  ///< speed over ground that the wall reaches if no ice resists [m/s]
  /// Mass that moves with the wall, per length [kg/m]. Larger values hit the ice harder when the wall reaches it;
  /// smaller ones may need shorter steps (longest_step_by_walls).
  double mass_per_length = 4.5e5;
  friend bool operator==(const WallPressure&, const WallPressure&) = default;
};

/// A straight boundary that ice cannot pass. A wall stands still, moves at a prescribed velocity, or presses on the
/// ice. A wall that presses moves only along its normal, the x axis of its frame (docs/theory/wind-and-walls.md).
struct Wall : PlacedHull {
  static constexpr BodyKind kKind = BodyKind::kWall;
  double length = 0;                     ///< length of the wall's face [m]
  geometry::Vector velocity;             ///< prescribed velocity over ground; 0 for a wall that presses [m/s]
  std::optional<WallPressure> pressure;  ///< load of a wall that presses

  /// Returns the load with which the wall presses while it stands still over ground; 0 without pressure [N].
  double load() const { return pressure ? pressure->line_load * length : 0; }
  friend bool operator==(const Wall&, const Wall&) = default;
};

/// Value of an index in Scene::own_ice that means Scene::ice.
inline constexpr std::int32_t kSceneIce = -1;

/// A floe of the scene at the start.
struct FloeSpec {
  geometry::Polygon polygon_in_world;  ///< outline, a valid polygon [m]
  /// Velocity of the centre of mass relative to the water at that point; of fast ice, over ground [m/s].
  geometry::Vector velocity;
  double angular_velocity = 0;       ///< angular velocity relative to the rotation of the water [rad/s]
  bool is_fast = false;              ///< true for fast ice: a prescribed, constant velocity without rotation
  std::int32_t own_ice = kSceneIce;  ///< index of the floe's ice in Scene::own_ice
  /// True if the floe may overlap other bodies, and the ice in these overlaps counts as already crushed.
  bool has_crushed_overlaps = false;
  std::int64_t source_floe = -1;  ///< id of the floe in the file that the floe was read from; negative: none
  int under_ship = -1;            ///< ship under whose hull the floe is; negative: the floe floats
  double under_path = 0;          ///< distance that this ship has moved over the floe [m]
  friend bool operator==(const FloeSpec&, const FloeSpec&) = default;
};

/// Contacts that are recorded at each frame.
enum class RecordedContacts {
  kNone,   ///< no contacts; peaks of contact forces are not recorded either
  kShips,  ///< contacts with a hull
  kAll,    ///< all contacts, also between floes
};

/// Records that a run writes.
struct RecordSettings {
  double forces_interval = 0.1;  ///< time between two rows of forces.csv [s]
  double frames_interval = 2.0;  ///< time between two frames [s]
  RecordedContacts contacts = RecordedContacts::kShips;
  double least_peak = 1e3;  ///< smallest peak of a contact's force that is recorded [N]
  /// Time constant of the first-order gauge that smooths a contact's force before peaks are found [s]. With 0, peaks
  /// are those of the mean force of each step. Much smaller values make peaks depend on the time step, because a floe
  /// that tilts takes its impulse in a single step, however short.
  double peak_response = 0.02;
  friend bool operator==(const RecordSettings&, const RecordSettings&) = default;
};

/// Place of the scene's plane on the Earth. The simulation does not use it; imports and exports do.
struct GeographicOrigin {
  double latitude = 0;                           ///< latitude of the scene's origin, WGS 84, north positive [rad]
  double longitude = 0;                          ///< longitude of the scene's origin, east positive [rad]
  double heading = 90 * std::numbers::pi / 180;  ///< direction of the scene's x axis, clockwise from true north [rad]
  friend bool operator==(const GeographicOrigin&, const GeographicOrigin&) = default;
};

/// All input of a run.
struct Scene {
  std::string name;
  std::optional<GeographicOrigin> origin;
  std::uint64_t seed = 1;  ///< seed of all random numbers of the scene and of the run
  StepSettings time;
  WaterSettings water;
  dynamics::Wind wind;
  fracture::Ice ice;
  ContactSettings contact;
  FractureSettings fracture;
  RecordSettings record;
  // Hulls are numbered in this order: ships, structures, walls. The bodies of a run have the same order, then the
  // floes.
  std::vector<Ship> ships;
  std::vector<Structure> structures;
  std::vector<Wall> walls;
  std::vector<FloeSpec> floes;
  /// Ice of floes whose thickness, density, strengths or toughness differ from the scene's ice. Their other properties
  /// are equal to the scene's.
  std::vector<fracture::Ice> own_ice;
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Returns the ice of a floe by its index in Scene::own_ice, or the scene's ice for kSceneIce.
inline const fracture::Ice& ice_of(const Scene& scene, std::int32_t own_ice) {
  return own_ice == kSceneIce ? scene.ice : scene.own_ice[static_cast<std::size_t>(own_ice)];
}

/// Calls `use` with the ship, structure or wall that has the given hull number, and returns the result of the call.
/// Throws std::out_of_range if there is no such hull.
template <class Use>
decltype(auto) visit_hull(const Scene& scene, std::size_t hull, Use use) {
  if (hull < scene.ships.size()) return use(scene.ships[hull]);
  hull -= scene.ships.size();
  if (hull < scene.structures.size()) return use(scene.structures[hull]);
  return use(scene.walls.at(hull - scene.structures.size()));
}

/// Returns the number of hulls: ships, structures and walls.
std::size_t hull_count(const Scene& scene);
/// Returns the hull with the given number. Throws std::out_of_range if there is none.
const PlacedHull& hull_of(const Scene& scene, std::size_t hull);
/// Returns the kind of the hull with the given number. Throws std::out_of_range if there is none.
BodyKind kind_of_hull(const Scene& scene, std::size_t hull);
/// Returns the number of the hull with the given name, or −1 if there is none.
int hull_named(const Scene& scene, std::string_view name);

/// Returns the velocity over ground of ice that moves freely, at a time [s] [m/s]. It is the drift of the water plus
/// the velocity at which the skin drag of the water below the ice balances the stress of the wind above it. Without
/// wind or without skin drag it is the drift of the water.
geometry::Vector free_drift(const Scene& scene, double time);

/// Returns the nominal time that a row of forces.csv covers [s]: RecordSettings::forces_interval, or the tick if that
/// is longer. Each row ends at a whole tick, so single rows may differ from it by up to a tick.
double recording_interval(const Scene& scene);

/// Returns true if the paper's collision force j/τ_c decides splits. Views show that force only in this case.
bool splits_by_j_over_tau_c(const Scene& scene);

/// Methods that save computing time. They are not part of a scene; tests switch them off and compare the results.
struct Shortcuts {
  bool culls = true;   ///< true if contacts are searched only between bodies that can touch; results do not change
  bool sleeps = true;  ///< true if floes at rest without contacts are not moved (kRestSpeed)
  /// True if a tick is divided into parts where one step would be too long (parts.hpp). With false, each tick is one
  /// step, and results differ.
  bool takes_parts = true;
};

/// Returns true if the ship has water around its hull, an engine or a mooring, so that ship/sailing.hpp moves it.
bool sails(const Ship& ship);

/// Returns true if a wind blows or a wall presses. Saved states then contain BoundaryFlows.
bool has_wind_or_walls(const Scene& scene);
/// Returns true if a ship of the scene has a mooring.
bool has_moorings(const Scene& scene);

/// Returns a wall that stands still. Its face runs from one point to another in the world frame [m], with the ice to
/// the left of that direction and the wall's body of the given depth [m] to the right. The origin of the wall's frame
/// is the middle of the face; its x axis is the normal into the ice.
Wall wall_between(geometry::Point from, geometry::Point to, double depth);

/// Returns true if the hull of any ship has a draught, so that ice can go under it.
bool has_draught(const Scene& scene);

/// Returns the waterline of a ship with a wedge bow, by length [m], beam [m] and the entrance angle of the bow's flanks
/// from the centreline [rad]: straight flanks, a parallel midbody and a square stern. The origin is amidships.
geometry::Ring wedge_bow_waterline(double length, double beam, double entrance_angle);

/// Returns the waterline of a vertical or conical cylinder by its radius at the waterline [m]: a polygon about the
/// origin with at least 24 corners on the circle. It deviates from the circle by at most 1 cm.
geometry::Ring cylinder_waterline(double radius);

}  // namespace polynya::simulation
