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

/// Properties of a floe in a floe file, apart from its outline. The scene's values apply to properties that the file
/// does not have.
struct FloeProperties {
  std::optional<std::int64_t> floe_id;         ///< id of the floe in the file, a whole number from 0 to 2^53 − 1
  std::optional<double> thickness;             ///< [m]
  std::optional<double> density;               ///< [kg/m³]
  std::optional<double> flexural_strength;     ///< [Pa]
  std::optional<double> compressive_strength;  ///< [Pa]
  std::optional<double> tensile_strength;      ///< [Pa]
  std::optional<double> fracture_toughness;    ///< [Pa √m]
  /// Velocity over ground along the first axis of the coordinates [m/s]. An import turns it to the axes of the plane.
  /// If only one component is given, the other one is 0.
  std::optional<double> velocity_x;
  std::optional<double> velocity_y;          ///< along the second axis [m/s]
  std::optional<double> angular_velocity;    ///< counter-clockwise [°/s]
  std::optional<bool> is_fast;               ///< true: fast ice, which keeps its velocity whatever presses on it
  std::optional<std::string> under_hull_of;  ///< name of the ship under which the floe is, if it is submerged
  std::optional<double> under_hull_path;  ///< distance that this ship's hull has moved over it since it went under [m]
  friend bool operator==(const FloeProperties&, const FloeProperties&) = default;
};

/// A number among the properties. Keys and ranges are those of the scene.
struct FloeProperty {
  std::string_view key;   ///< in the file
  std::string_view unit;  ///< unit in messages
  /// Smallest value that is allowed, in that unit. An import refuses floes with smaller ones.
  double low = 0;
  double high = 0;                                          ///< largest value that is allowed
  std::optional<double> FloeProperties::*member = nullptr;  ///< where a value that was read is stored
  double fracture::Ice::*ice = nullptr;                     ///< member of Ice; null if it is no property of ice
};
/// Returns all properties that are numbers, except floe_id. The properties of ice come first.
std::span<const FloeProperty> floe_properties();

/// Number of properties of ice, which come first in floe_properties(). Only these have a member of Ice. It must be
/// raised with a new one; if it is too large, null members are used.
inline constexpr std::size_t kFloeIceProperties = 6;
/// Returns the properties of ice that a single floe may have. Each is a key of the scene's "ice", of an entry of
/// "floes", of the properties of a feature in a floe file, and of the floes that a run writes.
inline std::span<const FloeProperty> floe_ice_properties() {
  return floe_properties().first(kFloeIceProperties);
}

/// Writes the properties of ice as members of the object that is open, all of them, in SI units.
void append_ice(JsonWriter& json, const fracture::Ice& ice);

/// Name and unit of a property in a file that uses other ones than Polynya.
struct PropertyName {
  std::string name;   ///< name of the property in the file
  double factor = 1;  ///< by which its values are multiplied to give Polynya's unit; not 0; floe_id ignores it
  /// Values of codes, if the file has codes instead of numbers: {"93", 1.6}, in Polynya's unit; `factor` is not used. A
  /// code that is not listed means that there is no value.
  std::vector<std::pair<std::string, double>> codes = {};
};
/// Names of properties by Polynya's key. A key that is missing here has its own name in the file.
using PropertyNames = std::map<std::string, PropertyName, std::less<>>;

/// How the properties of a file are read.
struct PropertyRules {
  PropertyNames names;
  /// Numbers in the file that mean "no value", such as -9 or -9999. They are compared before factors and codes apply,
  /// and in all properties except floe_id, fast_ice and under_hull_of.
  std::vector<double> no_data = {};
  /// How a user states such a number, with {} in its place, for the advice in messages about values like -9.
  std::string no_data_in_words = "--nodata {}";
};

/// Adds the name of a property in the file, with a factor or codes if there are any: "thickness_m=CM*0.01",
/// "thickness_m=SA[91:0.95 93:1.6]". A second name for the same key replaces the first. Fails with a message, and adds
/// nothing, if the words are not of this form, the factor is 0, or the key is none of those of floe_properties() and
/// not floe_id: fast_ice and under_hull_of cannot be renamed.
Result<> add_property_name(std::string_view words, PropertyNames& names);

/// Reads the properties of many features. A text that is only a number is read as the number, except for floe_id.
class PropertyReader {
 public:
  explicit PropertyReader(PropertyRules rules) : rules_(std::move(rules)) {}

  /// Reads the properties of one feature, a JSON object. null and a blank text mean "no value". A value that a floe
  /// cannot have leaves its member empty and is appended to `wrong`, and an import then refuses the floe: "property
  /// thickness_m: found -0.4, allowed: a number from 0.001 to 20 [m]". `wrong` is not cleared, and several faults are
  /// separated by "; ". An id that is not a whole number from 0 on is no error; floe_id then has no value.
  FloeProperties read(const JsonValue& properties, std::string& wrong);

  /// Returns notes on values that were converted or left out when they were read (a text as a number, "no value", a
  /// code that is not listed), one for each property and kind.
  std::vector<std::string> notes() const;

 private:
  /// Kinds of notes: a text was read as a number, a number means "no value", or a code is not listed.
  enum class Reading { kText, kNoData, kUnlistedCode };
  /// Floes with one property and one kind of reading.
  struct Note {
    std::string key;   ///< Polynya's key
    std::string name;  ///< name in the file
    Reading reading;
    std::string example;    ///< value of the first of these floes, as messages show it
    std::size_t floes = 0;  ///< number of these floes
  };
  /// Returns the number that a value means, in Polynya's unit; none if it means "no value", or is wrong (`is_wrong` is
  /// then true). "No value" wins over codes, and codes over the factor.
  std::optional<double> number_in(std::string_view key, const PropertyName& name, const JsonValue& value,
                                  bool& is_wrong);
  /// Counts a floe for the note on a property and kind.
  void note(std::string_view key, const std::string& name, Reading reading, const JsonValue& value);

  PropertyRules rules_;
  std::vector<Note> notes_;  ///< in the order of their first floes
};

/// A property that is not read although its name resembles one that is.
struct NearMiss {
  std::string key;        ///< name in the file
  std::string meant;      ///< Polynya's key that may be meant
  double factor = 1;      ///< by which its values give Polynya's unit, from the unit in its name; 1 if that is unknown
  std::size_t floes = 0;  ///< number of floes that have it but not the property that is meant
};

/// Finds properties with nearly the right name among the properties of many floes, for a hint to the user; they are not
/// read. A name resembles a key if it has another unit, capital letters or few wrong letters after the first one, and
/// any name with "thick" resembles thickness_m. Names of up to four letters must be equal except for unit and capitals,
/// because short names all resemble each other.
class NearMisses {
 public:
  /// `names` are those that are read, so that none of them is a near miss.
  explicit NearMisses(PropertyNames names) : names_(std::move(names)) {}
  /// Adds the properties of a floe and the values that were read from them.
  void add(const JsonValue& properties, const FloeProperties& read);
  /// Returns the near misses in the order of their first occurrence.
  const std::vector<NearMiss>& found() const { return found_; }

 private:
  PropertyNames names_;
  /// Index in found_ by the key in the file; none for a key that resembles no other.
  std::map<std::string, std::optional<std::size_t>, std::less<>> index_;
  std::vector<NearMiss> found_;
};

/// Returns the words that make the import read it, for add_property_name(): "thickness_m=thickness_cm*0.01". Without a
/// known unit they have no factor, and the user must check the unit.
std::string as_property_name(const NearMiss& miss);

}  // namespace polynya::io
