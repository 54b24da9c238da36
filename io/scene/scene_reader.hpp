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

/// Longest scene that is read [bytes]. It also limits the resolved text with the floes of all files, because that is
/// the scene.json of a run, which must be read back. It is twice kLongestFloesFile, so that any single floe file fits.
/// A larger limit needs a larger kLongestText, a smaller one refuses large scenes that could run.
inline constexpr std::size_t kLongestScene = kLongestText;
/// Longest floe file that is read [bytes]. It limits the memory that a wrong file can take. With a larger one,
/// kLongestScene must grow too.
inline constexpr std::size_t kLongestFloesFile = std::size_t{256} << 20;
/// Largest number of floes of a scene; a scene with more is refused. Making the floes of such a scene takes half a
/// minute, and a larger limit would let a wrong number in a scene block the program.
inline constexpr std::size_t kMostFloes = 1'000'000;

/// Result of representing the brash ice of a channel by a layer of pieces.
struct BrashReport {
  double least_thickness = 0;    ///< thickness of the thinnest piece [m]
  double largest_thickness = 0;  ///< thickness of the thickest piece [m]
  double volume = 0;             ///< volume of the pieces [m³]
  double asked_volume = 0;       ///< volume of ice, without pores, in the brash that the scene describes [m³]
};

/// Result of placing the floes of a random field, or the pieces of a channel of brash.
struct FieldReport {
  std::size_t group = 0;                 ///< index in the scene's "floes"
  double gap = 0;                        ///< least distance between its floes, as the scene sets it [m]
  simulation::FloeFieldOutcome outcome;  ///< outcome without the floes, which are in the scene
  std::optional<BrashReport> brash;      ///< of a channel of brash only
};

/// Result of reading a floe file of the scene.
struct FileReport {
  std::size_t group = 0;                    ///< index in the scene's "floes"
  PlaneReport plane = {};                   ///< how the floes were brought to the scene's plane
  std::optional<double> run_time = {};      ///< simulated time at which a run wrote the floes [s]; none: no run did
  std::optional<ImportTotals> totals = {};  ///< only if the file was imported
  std::size_t floes = 0;                    ///< number of floes of the file
  std::size_t with_thickness = 0;           ///< number of these floes that have their own thickness
  std::vector<NearMiss> near_misses = {};  ///< properties that are not read, but whose names are nearly those of others
  std::vector<std::string> notes = {};     ///< values that were converted when they were read, in words
  std::string place = {};    ///< place on the Earth of the file's coordinates, in words; empty: not stated
  std::uint32_t offset = 0;  ///< position of the file's name in the scene [bytes]
};

/// Summary of the values of an ice property that were drawn for the floes of one entry.
struct IceReport {
  std::size_t group = 0;     ///< index in the scene's "floes"
  std::size_t property = 0;  ///< index of the property (floe_properties.hpp)
  fracture::ScatterMeasures measures;
};

/// A scene that was read, with everything that was computed or noticed while reading.
struct LoadedScene {
  simulation::Scene scene;
  std::string description;  ///< the scene's "description"; empty if it has none
  /// JSON with all defaults, the values that override it and the floes of files, the scene.json of a run. It is read
  /// back to the same scene.
  std::string resolved_text;
  std::string hash;  ///< hash of resolved_text: 16 hexadecimal digits, FNV-1a; summary.json names the scene by it
  /// Hash of resolved_text without time.until_s, equal for runs that differ only by their end. A checkpoint can only be
  /// resumed by a scene with the same one.
  std::string course_hash;
  std::vector<FieldReport> fields;  ///< random fields and channels of brash, by group
  std::vector<FileReport> files;    ///< floe files, by group
  std::vector<IceReport> ice;       ///< values that were drawn for ice properties, by group and property
  bool is_step_chosen = false;      ///< true if time.step_s is not given and was chosen (simulation::default_tick)
  std::vector<Problem> hints;       ///< warnings and hints in the order of their places (io/scene/scene_check.hpp)
};

/// A ship in a file of its own, written like a ship of a scene.
struct LoadedShip {
  JsonValue given;                           ///< as written, without the values of its preset
  JsonValue resolved;                        ///< with all defaults, estimates and the values of its preset
  std::string preset;                        ///< name of its preset; empty if it names none
  std::optional<simulation::Engine> engine;  ///< its engine, if it has one
  /// Values that the text does not state and that were estimated; only with kLevelIce.
  std::vector<Estimate> estimates;
};

/// Purpose for which a ship is read.
enum class ShipUse {
  kScene,  ///< a run of a scene; nothing is estimated
  /// `polynya performance`. It needs main dimensions, draught and engine, and accepts no mooring. Missing values are
  /// estimated where possible (ship_estimates.hpp).
  kLevelIce,
};

/// A value that replaces the scene's value of one key.
struct Assignment {
  std::string path;              ///< "ice.thickness_m", "ships[0].position_m[1]"
  JsonValue value;               ///< new value; its offsets refer to the text from which the assignment was read
  std::uint32_t key_offset = 0;  ///< position of the key in that text [bytes]
  PlacedText text;               ///< the option or the line of a file, as the place of problems
};

/// Parses "ice.thickness_m=0.7". The value is JSON, or if it is not JSON a text without quotes. `option` is the name of
/// the option in messages. Fails if the words are not KEY=VALUE. An empty value is an empty text. Whether the key
/// exists and the value is allowed is checked when the scene is read.
Result<Assignment> parse_assignment(std::string_view words, std::string_view option = "--set");

/// Parses one line of a file of cases: {"ice.thickness_m": 0.7, "seed": 3}. `file` is its name in messages, and `line`
/// counts from 1. The assignments are in the order of the text. Fails, with the place in that file, if the line is not
/// JSON, not an object, or has a key twice. An empty object gives no assignments.
tl::expected<std::vector<Assignment>, Problem> parse_case(std::string_view text, const std::string& file, int line);

/// Values of the command line that replace those of the scene. Those that are not given leave the scene unchanged.
struct SceneOverrides {
  std::optional<double> until;          ///< replaces time.until_s [s]
  std::optional<std::uint64_t> seed;    ///< replaces the scene's seed
  std::vector<Assignment> assignments;  ///< applied in order, before the other values, which therefore win
  /// Length of the panels of all ships and structures [m]. Hulls without panels get panels. Not given: panels stay as
  /// in the scene.
  std::optional<double> panel_length = {};
};

/// A scene, or all its problems in the order of their places. Warnings and hints of a valid scene are in
/// LoadedScene::hints.
using SceneOutcome = tl::expected<LoadedScene, std::vector<Problem>>;

/// Reads a scene: JSON with comments. Returns the scene, or all its problems, each with its place (docs/scene.md).
/// `name` names the text in messages, and the scene if it has no name (name_from); `files` returns the floe files that
/// the scene names. A scene whose resolved text is longer than `longest` [bytes] is refused, because it could not be
/// read back. io/scene/scene_file.hpp reads scene files.
SceneOutcome read_scene(std::string text, const std::string& name, const FloeFiles& files,
                        const SceneOverrides& overrides = {}, std::size_t longest = kLongestScene);

/// Longest ship file that is read [bytes]. It limits the memory that a wrong file can take; a ship needs some
/// kilobytes.
inline constexpr std::size_t kLongestShip = std::size_t{16} << 20;

/// Reads a text with one entry of a scene's "ships". It is checked as part of a scene whose other keys have their
/// defaults. `name` names the text in messages. Paths of problems begin at the ship: "hull.length_m". A text that is a
/// whole scene is refused. Fails with all problems; warnings and hints are not returned.
tl::expected<LoadedShip, std::vector<Problem>> read_ship(std::string text, const std::string& name,
                                                         ShipUse use = ShipUse::kScene);

/// Returns the name of a scene or run for a file: the file's name without folder and extension, at most 100 bytes, in
/// which characters other than letters, digits, '.', '_' and '-' are replaced by '-'. It is "scene" if it would not
/// begin with a letter or a digit.
std::string name_from(const std::string& file);

}  // namespace polynya::io
