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

// A scene as its JSON has it. What the simulation's own structs hold is read into them; the rest, main
// dimensions of hulls, groups of floes, what follows from something else where it is not given, is in the
// structs here. SI units, angles in radians. Their descriptions are the one table of all that a scene may
// hold (record.hpp).

/// All but its lists, whose items are read one by one: there may be a million floes.
struct SceneInput {
  std::string name = "scene";
  simulation::Scene scene;
  std::string description;
};

struct WedgeBow {
  double length = 0;          ///< of the waterline [m]
  double beam = 0;            ///< [m]
  double entrance_angle = 0;  ///< of a flank from the centreline [rad]
};
struct HullOutline {
  geometry::Ring waterline;                  ///< it may run either way and may be closed [m]
  std::vector<double> angles_from_vertical;  ///< [rad]
};

struct EngineInput {
  dynamics::Engine engine;        ///< bollard pull 0: by power, diameter and number
  double propeller_diameter = 0;  ///< of one; 0: by the draught [m]
  int propellers = 1;
  std::optional<bool> has_nozzles;
};

struct MooringInput {
  simulation::MooringSettings settings;
  std::optional<geometry::Point> position;  ///< none: the ship's at the start [m]
  std::optional<double> heading;            ///< likewise [rad]
};

struct ShipInput {
  std::string name = "ship-#";
  simulation::Ship spec;  ///< mass and moment of inertia 0: by the hull's form
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
  double slope = 0;  ///< of its walls from the vertical [rad]
};

struct WallInput {
  std::string name = "wall-#";
  geometry::Point from, to;  ///< [m]
  double depth = 10;         ///< [m]
  std::optional<geometry::Vector> velocity;
  std::optional<simulation::WallPressure> pressure;
};

/// How a property of floes' ice is drawn, in its unit; what is not given follows from the scene and the law.
struct LawInput {
  fracture::ScatterKind kind = fracture::ScatterKind::kLogNormal;
  std::optional<double> mean, spread, least, most;
};
using NumberOrLaw = std::variant<double, LawInput>;

/// Of the ice of an entry's floes, what is not the scene's.
struct IceInput {
  std::array<std::optional<NumberOrLaw>, kFloeIceProperties> properties;  ///< in the order of floe_ice_properties()
  std::uint64_t seed = 0;
};

struct LatticeInput {
  geometry::Point origin;  ///< corner of its area [m]
  int columns = 1;         ///< along x
  int rows = 1;            ///< along y
  geometry::Vector pitch;  ///< [m]
  geometry::Vector size;   ///< of a floe [m]
};
struct RectangleInput {
  geometry::Point corner;  ///< [m]
  geometry::Vector size;   ///< [m]
  double angle = 0;        ///< about the corner [rad]
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
/// A random field; what has an optional here depends on whether the field has a law of sizes.
struct FieldInput {
  std::variant<FieldRectangle, FieldOutline, FieldChannel> region;
  simulation::FloeField field;  ///< concentration, gap, law and seed
  std::optional<double> floe_size, size_spread;
  std::optional<int> most_corners, least_corners;
  std::optional<double> aspect, orientation, packing;
  std::vector<geometry::Ring> keep_clear;  ///< [m]
};
/// A channel of brash ice between fast ice. What is left out is filled in when the scene is read.
struct ChannelInput {
  FieldInput brash;                              ///< pieces of the equivalent layer; its region is a FieldChannel
  double thickness = 0;                          ///< of the brash in the middle, pores included [m]
  std::optional<double> side_thickness;          ///< of the brash at the sides, pores included; as in the middle [m]
  double porosity = 0.2;                         ///< of the brash [-]
  std::optional<double> cover;                   ///< of the equivalent layer; 1 − porosity [-]
  std::optional<double> consolidated_thickness;  ///< of a frozen layer on the brash [m]
  std::optional<double> fast_ice_thickness;      ///< of the ice beside the channel; the scene's [m]
  double fast_ice_width = 30;                    ///< on each side; 0: none [m]
};
/// How the floes of a file come to the scene.
struct FileImport {
  ImportSettings settings;  ///< without the plane's origin and words
  Selection selection;
  std::string properties;       ///< "thickness_m=CM*0.01, floe_id=FID"
  std::vector<double> no_data;  ///< numbers that stand for no value in a property
};
struct FileInput {
  std::string name;  ///< in the scene's folder
  std::optional<FileImport> import;
};

/// One entry of the scene's "floes".
struct FloeGroup {
  std::variant<LatticeInput, RectangleInput, geometry::Polygon, FieldInput, ChannelInput, FileInput> form = {};
  bool is_fast = false;         ///< then the velocity is over ground
  geometry::Vector velocity;    ///< relative to the water [m/s]
  double angular_velocity = 0;  ///< [rad/s]
  std::optional<IceInput> ice = {};
  std::optional<bool> has_crushed_overlaps;
  std::optional<std::int64_t> source_floe;
  std::optional<std::string> under_hull_of;  ///< the name of a ship
  std::optional<double> under_hull_path;     ///< [m]
};

extern const Description<SceneInput> kSceneDescription;
extern const Description<ShipInput> kShipDescription;
extern const Description<StructureInput> kStructureDescription;
extern const Description<WallInput> kWallDescription;
extern const Description<FloeGroup> kFloesDescription;
extern const Description<fracture::Ice> kIceDescription;
extern const Description<IceInput> kFloeIceDescription;
extern const Description<LawInput> kLawDescription;

/// Where a body of the scene stands in the text, for messages.
struct Origin {
  std::size_t source = 0;       ///< index in the ProblemCollector's sources
  std::uint32_t offset = 0;     ///< byte in that source
  std::size_t group = 0;        ///< index in the scene's list of its kind
  int member = -1;              ///< which floe of a lattice or file; −1: the only one
  bool is_known_valid = false;  ///< by construction
  simulation::BodyKind kind = simulation::BodyKind::kFloe;
};

/// A scene while it is put together: what is checked as a whole.
struct SceneDraft {
  simulation::Scene scene;
  std::vector<Origin> hull_origins;
  std::vector<Origin> floe_origins;
};

/// The descriptions of a scene (scene_input.hpp) in other forms.

std::string scene_schema();     ///< JSON Schema, draft 2020-12
std::string scene_tables();     ///< Markdown tables, as they stand in docs/scene.md
std::string commented_scene();  ///< a scene with every setting, its default and its meaning, ready to run

}  // namespace polynya::io
