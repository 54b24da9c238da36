#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fracture/materials.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// What a floe file states of a floe beside its outline. What it does not state is the scene's.
struct FloeProperties {
  std::optional<std::int64_t> floe_id;
  std::optional<double> thickness;             ///< [m]
  std::optional<double> density;               ///< [kg/m³]
  std::optional<double> flexural_strength;     ///< [Pa]
  std::optional<double> compressive_strength;  ///< [Pa]
  std::optional<double> tensile_strength;      ///< [Pa]
  std::optional<double> fracture_toughness;    ///< [Pa √m]
  std::optional<double> velocity_x;            ///< over ground, along the coordinates' first axis [m/s]
  std::optional<double> velocity_y;            ///< [m/s]
  std::optional<double> angular_velocity;      ///< counter-clockwise [°/s]
  std::optional<bool> is_fast;                 ///< held at its velocity
  std::optional<std::string> under_hull_of;    ///< the ship that it is under
  std::optional<double> under_hull_path;       ///< then how far that has come over it [m]
  friend bool operator==(const FloeProperties&, const FloeProperties&) = default;
};

/// A number among the properties. The names and ranges are those of the scene's keys.
struct FloeProperty {
  std::string_view key;   ///< in the file
  std::string_view unit;  ///< as shown to people
  double low = 0;         ///< least value
  double high = 0;
  std::optional<double> FloeProperties::*member = nullptr;
  double fracture::Ice::*ice = nullptr;  ///< of those of the ice
};
std::span<const FloeProperty> floe_properties();

inline constexpr std::size_t kFloeIceProperties = 6;  ///< of ice, that a floe may have of its own: the first ones
/// A property of ice that a floe may have of its own: a key of the scene's "ice", of an entry of "floes" and of a
/// feature's properties in a floe file, and of the floes that a run writes.
inline std::span<const FloeProperty> floe_ice_properties() {
  return floe_properties().first(kFloeIceProperties);
}

/// Writes them as members of the object at hand.
void append_ice(JsonWriter& json, const fracture::Ice& ice);

/// Under which other names, and in which other units, a file has a property.
struct PropertyName {
  std::string name;   ///< in the file
  double factor = 1;  ///< of its values
  /// Values of codes, where the file has codes: {"93", 1.6}. A code that is not among them stands for no value.
  std::vector<std::pair<std::string, double>> codes = {};
};
using PropertyNames = std::map<std::string, PropertyName, std::less<>>;  ///< by Polynya's key

/// How the properties of a file are read.
struct PropertyRules {
  PropertyNames names;
  std::vector<double> no_data = {};              ///< numbers that stand for no value: -9, -9999
  std::string no_data_in_words = "--nodata {}";  ///< how a user names one, in messages
};

/// Adds a property's key, the file's name for it, and a factor or codes where there are any: "thickness_m=CM*0.01",
/// "thickness_m=SA[91:0.95 93:1.6]".
Result<> add_property_name(std::string_view words, PropertyNames& names);

/// Reads the properties of many features. A text that is a number is read as one.
class PropertyReader {
 public:
  explicit PropertyReader(PropertyRules rules) : rules_(std::move(rules)) {}

  /// Reads the properties of a feature; null and a blank text are none. What a floe cannot have is appended to `wrong`:
  /// "property thickness_m: found -0.4, allowed: a number from 0.001 to 20 [m]". An id that is no whole number is no
  /// fault: floe_id is then none.
  FloeProperties read(const JsonValue& properties, std::string& wrong);

  /// What was read otherwise than it stands in the file, in words, once for each property and kind.
  std::vector<std::string> notes() const;

 private:
  enum class Reading { kText, kNoData, kUnlistedCode };
  struct Note {
    std::string key;   ///< Polynya's
    std::string name;  ///< the file's
    Reading reading;
    std::string example;
    std::size_t floes = 0;
  };
  std::optional<double> number_in(std::string_view key, const PropertyName& name, const JsonValue& value,
                                  bool& is_wrong);
  void note(std::string_view key, const std::string& name, Reading reading, const JsonValue& value);

  PropertyRules rules_;
  std::vector<Note> notes_;
};

/// A property that is not read, though its name is near that of one that is.
struct NearMiss {
  std::string key;        ///< in the file
  std::string meant;      ///< Polynya's
  double factor = 1;      ///< to Polynya's unit, by the unit in its name
  std::size_t floes = 0;  ///< that have it, and none by the meant name
};

/// Finds near misses among the properties of many floes.
class NearMisses {
 public:
  explicit NearMisses(PropertyNames names) : names_(std::move(names)) {}
  /// Adds the properties of a floe, and what was read of them.
  void add(const JsonValue& properties, const FloeProperties& read);
  /// By their first occurrence.
  const std::vector<NearMiss>& found() const { return found_; }

 private:
  PropertyNames names_;
  std::map<std::string, std::optional<std::size_t>, std::less<>> index_;  ///< in found_, by the file's key
  std::vector<NearMiss> found_;
};

/// "thickness_m=thickness_cm*0.01", for add_property_name().
std::string as_property_name(const NearMiss& miss);

}  // namespace polynya::io
