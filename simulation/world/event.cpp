#include "simulation/world/event.hpp"

#include <type_traits>

namespace polynya::simulation {

const IceEvent* Event::ice() const {
  return std::visit(
      []<class Kind>(const Kind& kind) -> const IceEvent* {
        if constexpr (std::is_base_of_v<IceEvent, Kind>) return &kind;
        return nullptr;
      },
      what);
}

const fracture::FailureCriteria& Event::criteria() const {
  static const fracture::FailureCriteria kNone;
  if (const auto* bend = std::get_if<Bend>(&what)) return bend->criterion;
  if (const auto* split = std::get_if<Split>(&what)) return split->criterion;
  const auto* cut = std::get_if<RejectedCut>(&what);
  const auto* criteria = cut ? std::get_if<fracture::FailureCriteria>(&cut->criterion) : nullptr;
  return criteria ? *criteria : kNone;
}

std::string_view name_of(const Event& event) {
  return std::visit([](const auto& kind) { return kind.kName; }, event.what);
}

DecidingLoad deciding_load(const fracture::FailureCriteria& c, bool is_split) {
  if (!is_split) return {"vertical force", ">=", "bending capacity", c.vertical_force, c.bending_capacity};
  if (c.splitting_force > 0) return {"collision force", ">", "splitting force", c.collision_force, c.splitting_force};
  if (c.section_stress > 0) {
    const double capacity = c.contact_force * c.flexural_strength / c.section_stress;
    return {"contact force", ">=", "force that breaks a beam", c.contact_force, capacity};
  }
  return {"opening force", ">=", "opening capacity", c.opening_force, c.opening_capacity};
}

}  // namespace polynya::simulation
