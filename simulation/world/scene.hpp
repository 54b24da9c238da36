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

/// A scene as the simulation needs it: all defaults and all floes explicit. SI units, angles in radians. The
/// JSON form and its field table are io's (docs/scene.md).

struct StepSettings {
  double step = 0.005;  ///< the tick, which is taken in equal parts where it is too long for what happens in it [s]
  double until = 550;   ///< simulated time to run to; a whole number of ticks is taken [s]
  friend bool operator==(const StepSettings&, const StepSettings&) = default;
};

/// A current that grows linearly across its direction, on top of the uniform drift and carried by it: at x it
/// runs along `direction` at rate · (distance of x from the line through `origin`, to port of the direction).
struct ShearSettings {
  double rate = 0;         ///< [1/s]
  double direction = 0;    ///< of the current, from the x axis, counter-clockwise [rad]
  geometry::Point origin;  ///< a point that moves with the drift alone, where it is at the start [m]
  friend bool operator==(const ShearSettings&, const ShearSettings&) = default;
};

struct WaterSettings {
  fracture::Water water;
  double drag_coefficient = 0.5;                             ///< C_D of Eq. (6) [-]
  dynamics::DragArea drag_area = dynamics::DragArea::kEdge;  ///< A of Eq. (6)
  double skin_drag_coefficient = 0;                          ///< C_w, of a floe's area in plan, beside Eq. (6) [-]
  geometry::Vector drift;                                    ///< velocity of the water, and of all ice with it [m/s]
  std::vector<dynamics::FlowRow> drift_rows;                 ///< if any, in its place
  std::optional<dynamics::Tide> tide;                        ///< on top
  ShearSettings shear;
  friend bool operator==(const WaterSettings&, const WaterSettings&) = default;

  bool is_steady() const { return drift_rows.empty() && !tide; }  ///< whether the drift is the same at all times
  geometry::Vector drift_at(double time) const;                   ///< [m/s]
  geometry::Vector drift_path(double time) const;                 ///< where it takes the water from time 0 [m]
  double fastest_drift() const;                                   ///< no slower than the drift ever is [m/s]
};

/// How the normal of a contact is found.
enum class ContactNormal {
  kBoundary,       ///< from the boundary pieces the touching circles stand for
  kCircleCentres,  ///< along the line between the circles' centres, the paper's own rule
};

/// How bodies push each other apart (docs/theory/contact.md).
enum class ContactLaw {
  kCrush,    ///< what crushing ice carries while bodies close, nothing at rest or parting
  kImpulse,  ///< the paper's rigid impulses, Eq. (5), up to what crushing ice carries
};

struct ContactSettings {
  ContactLaw law = ContactLaw::kCrush;
  int substeps = 1;             ///< of kCrush: parts of a step, solved one after the other
  double tolerance = 1e-4;      ///< of kCrush: largest violation of the law that is left [m/s]
  bool is_warm_started = true;  ///< of kCrush: from the impulses of the step before
  double circle_radius = 1.0;   ///< [m]
  ContactNormal normal = ContactNormal::kBoundary;
  double restitution = 0.1;      ///< ε of Eq. (5) [-]; friction is the ice's μ
  double contact_time = 0.5;     ///< τ_c, only for the paper's peak force j/τ_c [s]
  double separation_time = 1.0;  ///< decay time of overlap that nothing presses together any more [s]
  int iterations = 100;          ///< most sweeps of the contact solver over an island
  friend bool operator==(const ContactSettings&, const ContactSettings&) = default;
};

enum class BendingModelKind { kNevel, kKashtelyan, kFsiDatabase };
enum class CuspFate {
  kSubmerge,   ///< gone, the paper's
  kFloat,      ///< a floe
  kUnderHull,  ///< under the hull until it comes up behind; gone at a hull without a draught
};

/// How floes go under inclined hulls with a draught.
struct GoingUnderSettings {
  bool is_enabled = false;
  fracture::TiltSettings tilting;
  friend bool operator==(const GoingUnderSettings&, const GoingUnderSettings&) = default;
};

/// How ice comes up that went under a hull.
struct ResurfaceSettings {
  bool is_enabled = false;
  double retry = 1;        ///< time between two tries where there was no room [s]
  double give_up = 120;    ///< time without room after which it stays under the ice [s]
  double rim_loss = 0.05;  ///< share of a piece's area that becomes brash, evenly off its rim [-]
  double scatter = 0.2;    ///< deviation of its place, of √area, and of its turn, of a half turn [-]
  friend bool operator==(const ResurfaceSettings&, const ResurfaceSettings&) = default;
};

/// Calibration to tests of a ship; 1: as computed.
struct BendingFactors {
  double load = 1;         ///< on V_b [-]
  double cusp_radius = 1;  ///< on R [-]
  friend bool operator==(const BendingFactors&, const BendingFactors&) = default;
};

struct FractureSettings {
  fracture::CharacteristicLength characteristic_length = fracture::CharacteristicLength::kFourthRoot;
  double breakable_size_factor = 1.0;  ///< κ: floes with √area < κ l are pushed, never broken [-]
  BendingModelKind bending = BendingModelKind::kFsiDatabase;
  fracture::RadialCracks radial_cracks = fracture::RadialCracks::kSplitWedge;  ///< of kFsiDatabase
  fracture::EdgeOutline outline = fracture::EdgeOutline::kSections;  ///< of kFsiDatabase and ContactLaw::kCrush
  BendingFactors factors;                                            ///< for all hulls
  bool follows_deflection = true;  ///< of ContactLaw::kCrush: ice that bends under a hull recedes from it
  bool floods_decks = true;        ///< likewise: water reaches the deck of a turning cusp only through what opens
  double bending_scatter = 0;      ///< deviation / mean of each bending event's flexural strength, log-normal [-]
  fracture::SplittingModel splitting = fracture::SplittingModel::kLefm;
  double splitting_shape_factor = 0.25;  ///< n of Eq. (4) [-]
  fracture::LeastPiece least_piece;      ///< that a crack leaves on either side
  CuspFate cusp_fate = CuspFate::kSubmerge;
  GoingUnderSettings going_under;
  ResurfaceSettings resurface;
  double cusp_sagitta = 0.02;       ///< a cusp's polygon stays this close to its circle [m]
  double smallest_floe_area = 0.1;  ///< smaller pieces leave the floe list as brash [m²]
  friend bool operator==(const FractureSettings&, const FractureSettings&) = default;
};

/// A waterline in the ship's frame (origin at the centre of gravity, x forward, y to port) [m].
struct Hull {
  geometry::Ring waterline;                         ///< counter-clockwise
  double stem_angle = 30 * std::numbers::pi / 180;  ///< φ, of the stem from the horizontal [rad]
  double draught = 0;                               ///< T; 0: no ice goes under this hull [m]
  bool has_speed_factor = true;                     ///< Lindqvist's factor of speed on the load of ice under it
  std::vector<double> angles_from_vertical;         ///< θ_s per waterline vertex [rad]; empty: from the stem angle
  friend bool operator==(const Hull&, const Hull&) = default;
};

/// Thrust along the ship's heading [N].
struct ConstantThrust {
  double thrust = 0;
  friend bool operator==(const ConstantThrust&, const ConstantThrust&) = default;
};
/// Velocity over ground and heading are prescribed; the forces reported are what that takes.
struct ConstantSpeed {
  double speed = 0;  ///< [m/s]
  friend bool operator==(const ConstantSpeed&, const ConstantSpeed&) = default;
};
using dynamics::Engine;
using Propulsion = std::variant<ConstantThrust, ConstantSpeed, Engine>;

using dynamics::BodyKind;

/// Panels of a hull, counted along its waterline from the stem, on which the loads of the ice are recorded.
struct PanelSettings {
  double length = 0;   ///< along the waterline [m]
  double bottom = -2;  ///< above the water [m]
  double top = 1;      ///< [m]
  int rows = 1;        ///< between the two
  friend bool operator==(const PanelSettings&, const PanelSettings&) = default;
};

/// What ships, structures and walls have in common: a hull, and where it is at the start.
struct PlacedHull {
  std::string name;
  Hull hull;
  geometry::Point position_in_world;  ///< of the origin of its frame, of a ship its centre of gravity [m]
  double heading = 0;                 ///< from the x axis, counter-clockwise [rad]
  std::optional<PanelSettings> panels;
  friend bool operator==(const PlacedHull&, const PlacedHull&) = default;
};

struct Ship : PlacedHull {
  static constexpr BodyKind kKind = BodyKind::kShip;
  double mass = 0;               ///< [kg]
  double moment_of_inertia = 0;  ///< about the vertical through the centre of gravity [kg m²]
  double speed = 0;              ///< along the heading over ground at the start [m/s]
  double sway_speed = 0;         ///< to port, likewise [m/s]
  double yaw_rate = 0;           ///< counter-clockwise at the start [rad/s]
  Propulsion propulsion;
  HullWaterSettings water;
  Steering steering;
  PilotSettings pilot;  ///< of a ship with an engine
  std::optional<MooringSettings> mooring;
  std::optional<BendingFactors> calibration;  ///< of the ice that this ship breaks
  friend bool operator==(const Ship&, const Ship&) = default;
};

/// Stands on the ground, whatever pushes it.
struct Structure : PlacedHull {
  static constexpr BodyKind kKind = BodyKind::kStructure;
  friend bool operator==(const Structure&, const Structure&) = default;
};

/// A load with which a wall presses on the ice along its normal.
struct WallPressure {
  double line_load = 0;            ///< q, over ground [N/m]
  double closing_speed = 0.1;      ///< at which q alone moves it [m/s]
  double mass_per_length = 4.5e5;  ///< of what moves with the wall [kg/m]
  friend bool operator==(const WallPressure&, const WallPressure&) = default;
};

/// A straight boundary that ice cannot pass: it stands, moves at a prescribed velocity, or presses on the
/// ice. A wall that presses moves along its normal alone, the x axis of its frame (docs/theory/wind-and-walls.md).
struct Wall : PlacedHull {
  static constexpr BodyKind kKind = BodyKind::kWall;
  double length = 0;          ///< of its face [m]
  geometry::Vector velocity;  ///< over ground; of one that presses 0 [m/s]
  std::optional<WallPressure> pressure;

  double load() const { return pressure ? pressure->line_load * length : 0; }  ///< [N]
  friend bool operator==(const Wall&, const Wall&) = default;
};

inline constexpr std::int32_t kSceneIce = -1;  ///< instead of an index in Scene::own_ice

struct FloeSpec {
  geometry::Polygon polygon_in_world;  ///< valid, at the start [m]
  geometry::Vector velocity;           ///< of the centre of mass relative to the water there, at the start [m/s]
  double angular_velocity = 0;         ///< relative to the water's own turning there, at the start [rad/s]
  bool is_fast = false;  ///< held at its velocity, which is then over ground, whatever pushes it; it does not turn
  std::int32_t own_ice = kSceneIce;   ///< index in Scene::own_ice
  bool has_crushed_overlaps = false;  ///< what it shares with other bodies at the start has pressed already
  std::int64_t source_floe = -1;      ///< its id in the file that it is from; < 0: none
  int under_ship = -1;                ///< the ship that it is under the hull of; < 0: it floats
  double under_path = 0;              ///< then how far that ship has come over it [m]
  friend bool operator==(const FloeSpec&, const FloeSpec&) = default;
};

/// Which contacts are recorded at each frame.
enum class RecordedContacts {
  kNone,
  kShips,  ///< those with a ship or a structure
  kAll,    ///< those between floes too
};

struct RecordSettings {
  double forces_interval = 0.1;  ///< between rows of forces.csv [s]
  double frames_interval = 2.0;  ///< between frames [s]
  RecordedContacts contacts = RecordedContacts::kShips;
  double least_peak = 1e3;  ///< of a contact's force that is recorded [N]
  /// Time constant of the gauge through which a contact's force is followed; 0: each step's own force [s]. With less,
  /// peaks are of the step: a floe that tilts takes its impulse in one, however short.
  double peak_response = 0.02;
  friend bool operator==(const RecordSettings&, const RecordSettings&) = default;
};

/// Where the scene's plane lies on the Earth. Nothing in the simulation depends on it.
struct GeographicOrigin {
  double latitude = 0;                           ///< of the scene's origin, WGS 84 [rad]
  double longitude = 0;                          ///< [rad]
  double heading = 90 * std::numbers::pi / 180;  ///< of the scene's x axis, from true north, clockwise [rad]
  friend bool operator==(const GeographicOrigin&, const GeographicOrigin&) = default;
};

struct Scene {
  std::string name;
  std::optional<GeographicOrigin> origin;
  std::uint64_t seed = 1;
  StepSettings time;
  WaterSettings water;
  dynamics::Wind wind;
  fracture::Ice ice;
  ContactSettings contact;
  FractureSettings fracture;
  RecordSettings record;
  // Its hulls are numbered in this order, and so are the bodies of a run: the floes follow.
  std::vector<Ship> ships;
  std::vector<Structure> structures;
  std::vector<Wall> walls;
  std::vector<FloeSpec> floes;
  /// Of floes whose thickness, density, strengths or toughness are not the scene's; the rest of it is.
  std::vector<fracture::Ice> own_ice;
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// The ice of a floe by its index in the scene's own_ice.
inline const fracture::Ice& ice_of(const Scene& scene, std::int32_t own_ice) {
  return own_ice == kSceneIce ? scene.ice : scene.own_ice[static_cast<std::size_t>(own_ice)];
}

/// Calls `use` with a hull by its number: the ship, the structure or the wall that it is.
template <class Use>
decltype(auto) visit_hull(const Scene& scene, std::size_t hull, Use use) {
  if (hull < scene.ships.size()) return use(scene.ships[hull]);
  hull -= scene.ships.size();
  if (hull < scene.structures.size()) return use(scene.structures[hull]);
  return use(scene.walls.at(hull - scene.structures.size()));
}

std::size_t hull_count(const Scene& scene);
const PlacedHull& hull_of(const Scene& scene, std::size_t hull);
BodyKind kind_of_hull(const Scene& scene, std::size_t hull);
/// The number of a hull by its name; −1: there is none.
int hull_named(const Scene& scene, std::string_view name);

/// The velocity over ground of free ice: it goes with the drift, and through the water as fast as the friction
/// below it bears the wind's above it [m/s].
geometry::Vector free_drift(const Scene& scene, double time);

/// What the loads and cusps of ice that a hull breaks are multiplied with: the scene's factors, and the ship's.
BendingFactors bending_factors_of(const Scene& scene, std::size_t hull);
bool is_calibrated(const Scene& scene);
/// The scene's name, as outputs show it: with ", calibrated" where it is.
std::string shown_name(const Scene& scene);

/// What a row of forces.csv covers: a whole number of steps [s].
double recording_interval(const Scene& scene);

/// Does the paper's collision force j/τ_c decide splits? Views show it beside the true force only then.
bool splits_by_j_over_tau_c(const Scene& scene);

/// Work that a run skips because it would change nothing. Not part of a scene: tests switch it off and
/// compare.
struct Shortcuts {
  bool culls = true;        ///< pairs of bodies are not collided while they cannot touch
  bool sleeps = true;       ///< floes at rest that touch nothing are not stepped
  bool takes_parts = true;  ///< ticks are taken in parts where one step would be too long: this changes results
};

/// Whether anything beside ice, other ships and a prescribed thrust or speed moves the ship: water around the
/// hull, an engine, a mooring.
bool sails(const Ship& ship);

/// Whether a wind blows or a wall presses: both do work, which states keep.
bool has_wind_or_walls(const Scene& scene);

/// A wall that stands, whose face runs from one point to another, with the ice to its left, and its body of a
/// depth [m] to its right. Its frame: the face's middle, x along the normal into the ice.
Wall wall_between(geometry::Point from, geometry::Point to, double depth);

/// Whether ice can go under a ship's hull.
bool has_draught(const Scene& scene);

/// A wedge-bowed waterline of the given length and beam [m]: straight flanks from the stem at the entrance
/// angle from the centreline [rad], a parallel midbody, a square stern. Origin amidships.
geometry::Ring wedge_bow_waterline(double length, double beam, double entrance_angle);

/// The waterline of a vertical or conical cylinder about the origin [m], as a polygon of at least 24 corners
/// that stays within 1 cm of the circle, corners on it.
geometry::Ring cylinder_waterline(double radius);

}  // namespace polynya::simulation
