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
// not given. All are in SI units, angles in radians. Their descriptions (record.hpp) define everything that a scene may
// contain.

/// The scene except its lists. Their items are read one by one, because a scene may have a million floes.
struct SceneInput {
  std::string name = "scene";
  simulation::Scene scene;
  std::string description;
};

/// Hull by main dimensions: a bow of two straight flanks, and a parallel body.
struct WedgeBow {
  double length = 0;          ///< length of the waterline [m]
  double beam = 0;            ///< [m]
  double entrance_angle = 0;  ///< angle between a flank of the bow and the centreline [rad]
};
/// Hull by its waterline.
struct HullOutline {
  geometry::Ring waterline;  ///< in either direction, closed or open [m]
  /// Angle of the hull from the vertical at each vertex, or one for all [rad].
  std::vector<double> angles_from_vertical;
};

struct EngineInput {
  dynamics::Engine engine;        ///< a bollard pull of 0 is computed from power, diameter and number of propellers
  double propeller_diameter = 0;  ///< diameter of one propeller [m]; 0: computed from the draught
  int propellers = 1;
  std::optional<bool> has_nozzles;
};

struct MooringInput {
  simulation::MooringSettings settings;
  std::optional<geometry::Point> position;  ///< none: the ship's initial position [m]
  std::optional<double> heading;            ///< none: the ship's initial heading [rad]
};

struct ShipInput {
  std::string name = "ship-#";
  simulation::Ship spec;  ///< a mass or moment of inertia of 0 is computed from the hull
  std::variant<WedgeBow, HullOutline> form;
  std::optional<double> sway_speed;  ///< [m/s]
  std::optional<double> yaw_rate;    ///< [rad/s]
  std::variant<simulation::ConstantThrust, simulation::ConstantSpeed, EngineInput> propulsion;
  std::optional<simulation::Steering> steering;
  std::optional<simulation::PilotSettings> pilot;
  std::optional<MooringInput> mooring;
};

struct Cylinder {
  double radius = 0;  ///< at the waterline [m]
};
struct StructureInput {
  std::string name = "structure-#";
  simulation::Structure spec;
  std::variant<Cylinder, HullOutline> form;
  double slope = 0;  ///< angle of its side from the vertical [rad]
};

struct WallInput {
  std::string name = "wall-#";
  geometry::Point from, to;  ///< [m]
  double depth = 10;         ///< [m]
  std::optional<geometry::Vector> velocity;
  std::optional<simulation::WallPressure> pressure;
};

/// Law from which an ice property is drawn for each floe, in the unit of the property. Values that are not given follow
/// from the scene and the kind of law.
struct LawInput {
  fracture::ScatterKind kind = fracture::ScatterKind::kLogNormal;
  std::optional<double> mean, spread, least, most;
};
using NumberOrLaw = std::variant<double, LawInput>;

/// Ice properties of the floes of an entry that differ from those of the scene.
struct IceInput {
  std::array<std::optional<NumberOrLaw>, kFloeIceProperties> properties;  ///< in the order of floe_ice_properties()
  std::uint64_t seed = 0;
};

struct LatticeInput {
  geometry::Point origin;  ///< corner of the lattice with the smallest x and y [m]
  int columns = 1;         ///< along x
  int rows = 1;            ///< along y
  geometry::Vector pitch;  ///< distance between neighbouring cells [m]
  geometry::Vector size;   ///< size of a floe [m]
};
struct RectangleInput {
  geometry::Point corner;  ///< [m]
  geometry::Vector size;   ///< [m]
  double angle = 0;        ///< rotation about the corner [rad]
};
struct FieldRectangle {
  geometry::Point corner;   ///< [m]
  geometry::Vector extent;  ///< [m]
};
struct FieldOutline {
  geometry::Ring ring;  ///< [m]
};
struct FieldChannel {
  std::vector<geometry::Point> centreline;  ///< [m]
  double width = 0;                         ///< [m]
};
/// A random field of floes. Defaults of the optional values depend on whether the field has a law of sizes.
struct FieldInput {
  std::variant<FieldRectangle, FieldOutline, FieldChannel> region;
  simulation::FloeField field;  ///< concentration, gap, law of sizes and seed
  std::optional<double> floe_size, size_spread;
  std::optional<int> most_corners, least_corners;
  std::optional<double> aspect, orientation, packing;
  std::vector<geometry::Ring> keep_clear;  ///< [m]
};
/// A channel of brash ice between fast ice. What is left out is filled in when the scene is read.
struct ChannelInput {
  FieldInput brash;                      ///< pieces of the equivalent layer; its region is a FieldChannel
  double thickness = 0;                  ///< thickness of the brash in the middle, with its pores [m]
  std::optional<double> side_thickness;  ///< thickness of the brash at the sides, with its pores; as in the middle [m]
  double porosity = 0.2;                 ///< porosity of the brash [-]
  std::optional<double> cover;           ///< cover of the equivalent layer; 1 − porosity [-]
  std::optional<double> consolidated_thickness;  ///< thickness of a frozen layer on the brash [m]
  std::optional<double> fast_ice_thickness;      ///< thickness of the ice beside the channel; the scene's [m]
  double fast_ice_width = 30;                    ///< width of the fast ice on each side; 0: none [m]
};
/// Import of the floes of a file.
struct FileImport {
  ImportSettings settings;  ///< without the origin of the plane and the words for messages
  Selection selection;
  std::string properties;       ///< names of properties in the file: "thickness_m=CM*0.01, floe_id=FID"
  std::vector<double> no_data;  ///< numbers that mean "no value" in a property
};
struct FileInput {
  std::string name;  ///< name of the file in the scene's folder
  std::optional<FileImport> import;
};

/// One entry of the scene's "floes".
struct FloeGroup {
  std::variant<LatticeInput, RectangleInput, geometry::Polygon, FieldInput, ChannelInput, FileInput> form = {};
  bool is_fast = false;         ///< true: fast ice, and the velocity is over ground
  geometry::Vector velocity;    ///< velocity relative to the water, for fast ice over ground [m/s]
  double angular_velocity = 0;  ///< [rad/s]
  std::optional<IceInput> ice = {};
  std::optional<bool> has_crushed_overlaps;
  std::optional<std::int64_t> source_floe;
  std::optional<std::string> under_hull_of;  ///< name of the ship under whose hull the floes are
  /// Distance that this ship's hull has moved over them since they went under [m].
  std::optional<double> under_hull_path;
};

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
  std::size_t source = 0;       ///< index in the ProblemCollector's sources
  std::uint32_t offset = 0;     ///< position in that source [bytes]
  std::size_t group = 0;        ///< index in the scene's list of its kind
  int member = -1;              ///< number of the floe in a lattice or file; −1: the only one of its entry
  bool is_known_valid = false;  ///< true if the outline is valid by construction
  simulation::BodyKind kind = simulation::BodyKind::kFloe;
};

/// A scene that has been read and must still be checked as a whole.
struct SceneDraft {
  simulation::Scene scene;
  std::vector<Origin> hull_origins;
  std::vector<Origin> floe_origins;
};

/// The description of scenes in other forms.

std::string scene_schema();     ///< Markdown tables of docs/scene.md
std::string scene_tables();     ///< a scene with every setting, its default and its meaning, which can be run
std::string commented_scene();  ///< a scene with every setting, its default and its meaning, ready to run

}  // namespace polynya::io
