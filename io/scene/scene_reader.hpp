#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fracture/scatter.hpp"
#include "io/import/floe_import.hpp"
#include "io/scene/floe_files.hpp"
#include "io/scene/ship_estimates.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"
#include "io/text/source_text.hpp"
#include "simulation/field/floe_field.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// Of a scene with its floe files read in, too, since that is the scene.json of its run [bytes]. Any one floe
/// file has room in it.
inline constexpr std::size_t kLongestScene = std::size_t{512} << 20;
inline constexpr std::size_t kLongestFloesFile = std::size_t{256} << 20;  ///< [bytes]
inline constexpr std::size_t kMostFloes = 1'000'000;

/// How the brash ice of a channel came out as a layer of pieces.
struct BrashReport {
  double least_thickness = 0;    ///< of a piece [m]
  double largest_thickness = 0;  ///< [m]
  double volume = 0;             ///< of the pieces [m³]
  double asked_volume = 0;       ///< of the ice in the brash that was asked for [m³]
};

/// How a random field of the scene came out.
struct FieldReport {
  std::size_t group = 0;                 ///< index in the scene's "floes"
  double gap = 0;                        ///< at least between its floes [m]
  simulation::FloeFieldOutcome outcome;  ///< without its floes; they are the scene's
  std::optional<BrashReport> brash;      ///< of a channel
};

/// How a floe file of the scene came to it.
struct FileReport {
  std::size_t group = 0;  ///< index in the scene's "floes"
  PlaneReport plane = {};
  std::optional<double> run_time = {};      ///< of floes of a run [s]
  std::optional<ImportTotals> totals = {};  ///< where it was imported
  std::size_t floes = 0;                    ///< that it gave
  std::size_t with_thickness = 0;           ///< of their own
  std::vector<NearMiss> near_misses = {};
  std::vector<std::string> notes = {};  ///< what was read otherwise than it stands in the file, in words
  std::string place = {};               ///< where on the Earth the file's metres lie, in words; empty: it does not say
  std::uint32_t offset = 0;             ///< of its name in the scene
};

/// How a property of the floes of one entry came out that was drawn.
struct IceReport {
  std::size_t group = 0;     ///< index in the scene's "floes"
  std::size_t property = 0;  ///< its number (floe_properties.hpp)
  fracture::ScatterMeasures measures;
};

struct LoadedScene {
  simulation::Scene scene;
  std::string description;
  std::string resolved_text;  ///< JSON with every default filled in and files read in; reads back to the same scene
  std::string hash;           ///< of resolved_text: 16 hexadecimal digits, FNV-1a
  std::string course_hash;    ///< of it without time.until_s: runs of one course that end at other times have the same
  std::vector<FieldReport> fields;
  std::vector<FileReport> files;
  std::vector<IceReport> ice;   ///< what was drawn of it, by floe groups and properties
  bool is_step_chosen = false;  ///< time.step_s is not given, but chosen (simulation::default_tick)
  std::vector<Problem> hints;   ///< warnings and hints, by their places (io/scene/scene_check.hpp)
};

/// A ship as scenes have it, of a file of its own.
struct LoadedShip {
  JsonValue given;     ///< as written
  JsonValue resolved;  ///< with its preset's particulars and every default filled in
  std::string preset;  ///< its name, or empty
  std::optional<simulation::Engine> engine;
  std::vector<Estimate> estimates;  ///< particulars that the text does not state; for kLevelIce alone
};

/// What a ship is read for.
enum class ShipUse {
  kScene,
  kLevelIce,  ///< `polynya performance`: needs main dimensions, draught and engine, and no mooring; what can be
              ///< estimated is (ship_estimates.hpp)
};

/// A value in place of the scene's own, of one key by its path.
struct Assignment {
  std::string path;              ///< "ice.thickness_m", "ships[0].position_m[1]"
  JsonValue value;               ///< its offsets are in the text that the assignment was read from
  std::uint32_t key_offset = 0;  ///< in that text
  PlacedText text;
};

/// "ice.thickness_m=0.7": the value is JSON or, where it is not, a text without quotes. `option` is its name
/// in problems. The error says what is no KEY=VALUE.
Result<Assignment> parse_assignment(std::string_view words, std::string_view option = "--set");

/// One line of a file of cases: {"ice.thickness_m": 0.7, "seed": 3}. `line` counts from 1.
tl::expected<std::vector<Assignment>, Problem> parse_case(std::string_view text, const std::string& file, int line);

/// What the command line puts in place of the scene's own.
struct SceneOverrides {
  std::optional<double> until;  ///< [s]
  std::optional<std::uint64_t> seed;
  std::vector<Assignment> assignments;      ///< put before the others
  std::optional<double> panel_length = {};  ///< of all ships and structures [m]
};

using SceneOutcome = tl::expected<LoadedScene, std::vector<Problem>>;

/// Reads a scene's text: JSON, comments allowed. All problems at once, each with its place (docs/scene.md). `name`
/// stands in messages; `files` gives the floe files that the scene names. A scene whose resolved text is longer than
/// `longest` [bytes] could not be read back, and is refused. Scenes of files are read by io/scene/scene_file.hpp.
SceneOutcome read_scene(std::string text, const std::string& name, const FloeFiles& files,
                        const SceneOverrides& overrides = {}, std::size_t longest = kLongestScene);

inline constexpr std::size_t kLongestShip = std::size_t{16} << 20;  ///< [bytes]

/// Reads an entry of a scene's "ships" that is a text of its own, as read_scene() reads it in a scene whose
/// other keys have their defaults. Paths of problems are those below the ship: "hull.length_m".
tl::expected<LoadedShip, std::vector<Problem>> read_ship(std::string text, const std::string& name,
                                                         ShipUse use = ShipUse::kScene);

/// A file's stem as a scene's or a run's name.
std::string name_from(const std::string& file);

}  // namespace polynya::io
