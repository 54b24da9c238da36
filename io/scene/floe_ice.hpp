#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fracture/scatter.hpp"
#include "io/import/floe_properties.hpp"
#include "io/scene/scene_input.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

/// Writes the properties that a floe may have of its own as members of the object at hand.
void append_ice(JsonWriter& json, const fracture::Ice& ice);

/// The ice of one entry of the scene's "floes". What a floe's feature gives comes before the entry's own, and
/// that before the scene's.
class GroupIce {
 public:
  /// The scene's ice is complete. Nothing where the entry's is wrong, which is reported; `path` is the
  /// entry's, `item` its JSON.
  static std::optional<GroupIce> of(const simulation::Scene& scene, const FloeGroup& group, const JsonValue& item,
                                    const std::string& path, ProblemCollector& problems);

  /// The index in the scene's own_ice of the floe that is added next.
  std::int32_t add_to(simulation::Scene& scene, const FloeProperties& given);

  /// What was drawn of each law, in the order of the properties.
  std::vector<IceReport> reports(std::size_t group) const;

  /// The entry's and the feature's properties of the floe that was added last; none where it has none.
  std::optional<IceInput> spelled_out(const simulation::Scene& scene, const FloeProperties& given) const;

 private:
  struct Law {
    std::size_t property = 0;
    fracture::ScatterLaw law;
    std::vector<double> drawn;
  };
  std::vector<Law> laws_;
  std::uint64_t seed_ = 0;
};

}  // namespace polynya::io
