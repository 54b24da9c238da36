#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fracture/scatter.hpp"
#include "geometry/shape/polygon.hpp"
#include "io/import/floe_import.hpp"
#include "io/import/floe_properties.hpp"
#include "io/import/gdal.hpp"
#include "io/scene/record.hpp"
#include "simulation/field/floe_field.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

// A scene as its JSON describes it. Values that the simulation stores unchanged are read into its structs. The structs
// here hold the rest: main dimensions of hulls, groups of floes, and values that are computed from others if they are
// not given (scene_check.hpp). All are in SI units, angles in radians counter-clockwise, points in the world frame
// unless stated otherwise. Their descriptions (record.hpp), in describe_*.cpp, define everything that a scene may
// contain: keys, units, ranges, and meanings for users.

/// The scene except its ships, structures, walls and floes. The items of these lists are read one by one, because a
/// scene may have a million floes.
struct SceneInput {
  std::string name = "scene";
  simulation::Scene scene;  ///< without bodies
  std::string description;  ///< for people; a run ignores it
};

/// Hull by main dimensions: a bow of two straight flanks, and a parallel body with a straight stern.
struct WedgeBow {
  double length = 0;          ///< length of the waterline [m]
  double beam = 0;            ///< beam of the waterline [m]
  double entrance_angle = 0;  ///< angle between a flank of the bow and the centreline [rad]
};
/// Hull by its waterline.
struct HullOutline {
  /// Waterline in the hull's frame, in either direction, closed or open [m]. Of a ship, the origin is the centre of
  /// gravity, x points forward and y to port.
  geometry::Ring waterline;
  /// Angle of the hull from the vertical at each vertex [rad]. Empty: computed from the stem angle. A structure has one
  /// angle for all vertices instead, StructureInput::slope.
  std::vector<double> angles_from_vertical;
};

/// Propulsion by an engine. The diameter gives the size of the race on a rudder, and the bollard pull if that is
/// missing.
struct EngineInput {
  dynamics::Engine engine;          ///< a bollard pull of 0 is computed from power, diameter and number of propellers
  double propeller_diameter = 0;    ///< diameter of one propeller [m]; 0: a fraction of the draught, only for the race
  int propellers = 1;               ///< number of equal propellers
  std::optional<bool> has_nozzles;  ///< ducted propellers; not given: false
};

/// Mooring of a ship.
struct MooringInput {
  simulation::MooringSettings settings;     ///< without position and heading
  std::optional<geometry::Point> position;  ///< position without a pull of the mooring [m]; none: the initial position
  std::optional<double> heading;            ///< heading without a pull of the mooring [rad]; none: the initial heading
};

/// One entry of the scene's "ships".
struct ShipInput {
  std::string name = "ship-#";               ///< # is replaced by the number of the entry, from 1
  simulation::Ship spec;                     ///< a mass or moment of inertia of 0 is computed from the hull
  std::variant<WedgeBow, HullOutline> form;  ///< the scene gives exactly one
  std::optional<double> sway_speed;          ///< initial speed over ground to port [m/s]; not given: 0
  std::optional<double> yaw_rate;            ///< initial yaw rate [rad/s]; not given: 0
  /// What drives the ship; the scene gives exactly one. A ship with a constant speed keeps it whatever the ice does.
  std::variant<simulation::ConstantThrust, simulation::ConstantSpeed, EngineInput> propulsion;
  std::optional<simulation::Steering> steering;    ///< needs an engine; not given: the ship cannot be steered
  std::optional<simulation::PilotSettings> pilot;  ///< needs an engine; not given: full ahead, rudder amidships
  std::optional<MooringInput> mooring;             ///< not given: the ship floats freely
};

/// A cylinder or cone.
struct Cylinder {
  double radius = 0;  ///< radius at the waterline [m]
};
/// One entry of the scene's "structures".
struct StructureInput {
  std::string name = "structure-#";  ///< # is replaced by the number of the entry, from 1
  simulation::Structure spec;
  std::variant<Cylinder, HullOutline> form;
  /// Angle of all sides from the vertical [rad]. With 0 the structure only crushes ice; with a larger angle it presses
  /// ice down.
  double slope = 0;
};

/// One entry of the scene's "walls".
struct WallInput {
  std::string name = "wall-#";               ///< # is replaced by the number of the entry, from 1
  geometry::Point from, to;                  ///< ends of the face; the ice is on the left of the way to `to` [m]
  double depth = 10;                         ///< depth of the wall's body behind the face [m]
  std::optional<geometry::Vector> velocity;  ///< constant velocity over ground [m/s]; not given: 0
  /// Load that moves the wall instead; excludes a velocity. Without both the wall stands still.
  std::optional<simulation::WallPressure> pressure;
};

/// Law from which an ice property is drawn for each floe, in the unit of the property (fracture::ScatterLaw). Values
/// that are not given follow from the scene and the kind of law.
struct LawInput {
  fracture::ScatterKind kind = fracture::ScatterKind::kLogNormal;
  /// Mean, standard deviation / mean [-], smallest and largest value. Mean and spread are those before the law is cut
  /// off at the other two.
  std::optional<double> mean, spread, least, most;
};
/// An ice property of the floes of an entry: one value for all, or a law.
using NumberOrLaw = std::variant<double, LawInput>;

/// Ice properties of the floes of an entry that differ from those of the scene.
struct IceInput {
  std::array<std::optional<NumberOrLaw>, kFloeIceProperties> properties;  ///< in the order of floe_ice_properties()
  std::uint64_t seed = 0;  ///< seed of the draws, to which the scene's seed is added; another one draws other values
};

/// Equal rectangular floes in rows and columns.
struct LatticeInput {
  geometry::Point origin;  ///< corner of the lattice with the smallest x and y [m]
  int columns = 1;         ///< number of floes along x
  int rows = 1;            ///< number of floes along y
  geometry::Vector pitch;  ///< distances between the centres of neighbouring floes along x and y [m]
  geometry::Vector size;   ///< size of a floe, at most the pitch [m]
};
/// One rectangular floe.
struct RectangleInput {
  geometry::Point corner;  ///< corner with the smallest x and y before the rotation [m]
  geometry::Vector size;   ///< sides along x and y before the rotation [m]
  double angle = 0;        ///< rotation about the corner [rad]
};
/// Region of a random field: a rectangle along the axes.
struct FieldRectangle {
  geometry::Point corner;   ///< corner with the smallest x and y [m]
  geometry::Vector extent;  ///< sides along x and y [m]
};
/// Region of a random field: a polygon without holes.
struct FieldOutline {
  geometry::Ring ring;  ///< outline of the region [m]
};
/// Region of a random field: a strip along a line, such as the channel of an earlier ship.
struct FieldChannel {
  std::vector<geometry::Point> centreline;  ///< points of its middle line, at least two [m]
  double width = 0;                         ///< across the middle line, half of it on each side [m]
};
/// A random field of convex floes. Sizes are √area. The field has either a mean size or a law of sizes
/// (FloeField::law), on which the defaults of the other optional values depend; least_corners, aspect, orientation and
/// packing need a law.
struct FieldInput {
  std::variant<FieldRectangle, FieldOutline, FieldChannel> region;  ///< where the floes are; exactly one is given
  simulation::FloeField field;                                      ///< concentration, gap, law of sizes and seed
  std::optional<double> floe_size, size_spread;    ///< mean size [m], and standard deviation / mean of the sizes [-]
  std::optional<int> most_corners, least_corners;  ///< largest and smallest number of corners of a floe
  /// Mean length / width of the floes [-], direction of their length from the x axis [rad], and concentration between
  /// the openings [-].
  std::optional<double> aspect, orientation, packing;
  std::vector<geometry::Ring> keep_clear;  ///< regions into which no floe may extend, in addition to hulls [m]
};
/// A channel of brash ice between fast ice. Values that are left out are filled in when the scene is read.
struct ChannelInput {
  FieldInput brash;      ///< pieces of the equivalent layer; its region is a FieldChannel
  double thickness = 0;  ///< thickness of the brash in the middle, with its pores [m]
  /// Thickness of the brash at the sides, with its pores [m]; not given: as in the middle.
  std::optional<double> side_thickness;
  double porosity = 0.2;  ///< fraction of the brash that is water [-]; larger: less ice
  /// Fraction of the channel that the pieces cover [-]; not given: 1 − porosity, but at most 0.9. A smaller cover makes
  /// thicker pieces.
  std::optional<double> cover;
  /// Thickness of a frozen layer on the brash [m]. With it, one plate of fast ice replaces the pieces.
  std::optional<double> consolidated_thickness;
  std::optional<double> fast_ice_thickness;  ///< thickness of the ice beside the channel [m]; not given: the scene's
  double fast_ice_width = 30;                ///< width of the fast ice on each side; 0: none [m]
};
/// Import of the floes of a file, as `polynya import` does it (docs/import.md).
struct FileImport {
  ImportSettings settings;      ///< without the origin of the plane, which is the scene's, and the words for messages
  Selection selection;          ///< which features of the file are imported
  std::string properties;       ///< names of properties in the file: "thickness_m=CM*0.01, floe_id=FID"
  std::vector<double> no_data;  ///< numbers that mean "no value" in a property: the scene's values apply then
};
/// The floes of a file.
struct FileInput {
  std::string name;                  ///< name of the file in the scene's folder or below
  std::optional<FileImport> import;  ///< none: the floes are only brought to the plane, and an invalid one is an error
};

/// One entry of the scene's "floes": one floe or many, and the values that they have in common. Values that a floe of a
/// file has itself replace those of its entry. Exceptions: a floe is fast if one of both says so, and a given
/// has_crushed_overlaps or source_floe of the entry wins.
struct FloeGroup {
  /// Exactly one of these is given; a polygon is a single floe [m].
  std::variant<LatticeInput, RectangleInput, geometry::Polygon, FieldInput, ChannelInput, FileInput> form = {};
  bool is_fast = false;              ///< true: fast ice, and the velocity is over ground
  geometry::Vector velocity;         ///< velocity relative to the water, for fast ice over ground [m/s]
  double angular_velocity = 0;       ///< angular velocity relative to the rotation of the water [rad/s]
  std::optional<IceInput> ice = {};  ///< not given: all ice properties are the scene's or the file's
  /// True: the floes may overlap other bodies where ice was crushed, as a run left them. Not given: true for floes of a
  /// file that a run wrote, or else false.
  std::optional<bool> has_crushed_overlaps;
  std::optional<std::int64_t> source_floe;  ///< id of the floe in the file from which it was read; none: no file
  /// Name of the ship under whose hull the floes are at the start; not given: they float.
  std::optional<std::string> under_hull_of;
  /// Distance that this ship's hull has moved over them since they went under [m]; not given: 0.
  std::optional<double> under_hull_path;
};

// Keys, units, ranges, defaults and meanings of the records above, of the scene and of its ice. A change here changes
// the scenes that are accepted, the schema and docs/scene.md together.
extern const Description<SceneInput> kSceneDescription;
extern const Description<ShipInput> kShipDescription;
extern const Description<StructureInput> kStructureDescription;
extern const Description<WallInput> kWallDescription;
extern const Description<FloeGroup> kFloesDescription;
extern const Description<fracture::Ice> kIceDescription;
extern const Description<IceInput> kFloeIceDescription;
extern const Description<LawInput> kLawDescription;

/// Position of a body of the scene in the text, for messages.
struct Origin {
  std::size_t source = 0;    ///< index in the ProblemCollector's sources: 0 is the scene, others are floe files
  std::uint32_t offset = 0;  ///< position in that source [bytes]
  std::size_t group = 0;     ///< index in the scene's list of its kind
  int member = -1;  ///< number of the floe in its lattice, field, channel or file; −1: the only one of its entry
  bool is_known_valid = false;  ///< true if the outline is valid by construction, so that it is not checked again
  simulation::BodyKind kind = simulation::BodyKind::kFloe;  ///< list to which `group` refers
};

/// A scene that has been read and must still be checked as a whole.
struct SceneDraft {
  simulation::Scene scene;
  std::vector<Origin> hull_origins;  ///< by number of the hull: ships, structures, walls
  std::vector<Origin> floe_origins;  ///< by index in Scene::floes
};

// The description of scenes in other forms.

std::string scene_schema();     ///< JSON Schema of a scene, which `polynya schema` prints
std::string scene_tables();     ///< Markdown tables of docs/scene.md, which `polynya schema --markdown` prints
std::string commented_scene();  ///< a scene with every setting, its default and its meaning, which can be run

}  // namespace polynya::io
