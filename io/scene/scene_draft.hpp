#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fracture/scatter.hpp"
#include "geometry/shape/polygon.hpp"
#include "io/import/floe_import.hpp"
#include "io/text/json_value.hpp"
#include "simulation/floe_field.hpp"
#include "simulation/scene.hpp"

namespace polynya::io {

inline constexpr std::size_t kFloeIceProperties = 6;  ///< of ice, that a floe may have of its own

/// Properties that a feature of a floe file gives, by their numbers (floe_ice.hpp).
using GivenIce = std::vector<std::pair<std::uint8_t, double>>;

/// The "ice" of such an entry as it is written: numbers and laws.
struct IceDraft {
  std::array<std::optional<JsonValue>, kFloeIceProperties> properties;
  std::uint64_t seed = 0;
};

/// How the floes of an entry's file come to the scene: the members of its "import".
struct FloeFileSettings {
  bool is_import = false;                   ///< it has one
  ImportSettings import;                    ///< without the plane's origin and words
  std::string layer;                        ///< of a file with several; or empty
  std::vector<std::string> property_names;  ///< "thickness_m=CM*0.01"
};

/// One entry of the scene's "floes" while it is read. The fields of the chosen form are filled in.
struct FloeGroup {
  enum class Form { kLattice, kRectangle, kPolygon, kFile, kField };
  Form form = Form::kPolygon;
  geometry::Point origin;     ///< lattice: corner of its area; rectangle: its corner [m]
  int columns = 1;            ///< along x
  int rows = 1;               ///< along y
  geometry::Vector pitch;     ///< [m]
  geometry::Vector size;      ///< [m]
  double angle = 0;           ///< rectangle, about its corner [rad]
  geometry::Polygon polygon;  ///< as written: rings may run either way and may be closed [m]
  std::string file;           ///< in the scene's folder
  FloeFileSettings file_settings;
  simulation::FloeField field;
  geometry::Vector extent;  ///< field: of its region; 0 where that is an outline or a channel [m]
  std::vector<geometry::Point> centreline;  ///< field: of a channel; empty for other regions [m]
  double width = 0;                         ///< field: of a channel [m]
  geometry::Vector velocity;                ///< relative to the water [m/s]
  double angular_velocity = 0;              ///< [rad/s]
  bool is_fast = false;                     ///< then the velocity is over ground
  IceDraft ice;
  bool has_crushed_overlaps = false;
  std::int64_t source_floe = -1;
};

/// A ship's engine while it is read: the bollard pull follows from the rest where it is not given.
struct DriveDraft {
  double power = 0;               ///< [W]
  double propeller_diameter = 0;  ///< of one [m]
  int propellers = 1;
  bool has_nozzles = false;
};

/// One entry of the scene's "walls" while it is read.
struct WallDraft {
  std::string name;
  geometry::Point from, to;  ///< [m]
  double depth = 0;          ///< [m]
  simulation::Wall wall;
};

/// Where a ship or a floe of the scene stands in the text, for messages.
struct Origin {
  std::size_t source = 0;       ///< index in the ProblemCollector's sources
  std::uint32_t offset = 0;     ///< byte in that source
  std::size_t group = 0;        ///< index in the scene's "floes", or in `list`
  int member = -1;              ///< which floe of a lattice or file; −1: the only one
  bool is_known_valid = false;  ///< by construction
  bool is_structure = false;    ///< or a wall
  std::string_view list = "ships";
};

/// How a property of the floes of one entry came out that was drawn.
struct IceReport {
  std::size_t group = 0;     ///< index in the scene's "floes"
  std::size_t property = 0;  ///< its number (floe_ice.hpp)
  fracture::ScatterMeasures measures;
};

/// A scene while it is read: the field table's setters write into it.
struct SceneDraft {
  simulation::Scene scene;
  std::string description;
  double hull_length = 0;  ///< of the ship being read; 0 where its waterline is given point by point [m]
  double hull_beam = 0;    ///< [m]
  double hull_entrance_angle = 0;  ///< [rad]
  DriveDraft drive;                ///< of the ship being read
  double structure_radius = 0;     ///< of the structure being read; 0 where its outline is given [m]
  double structure_slope = 0;      ///< of its wall from the vertical [rad]
  WallDraft wall;
  FloeGroup group;
  std::vector<Origin> ship_origins;
  std::vector<Origin> floe_origins;

  simulation::ShipSpec& ship() { return scene.ships.back(); }
};

}  // namespace polynya::io
