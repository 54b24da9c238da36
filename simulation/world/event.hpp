#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "fracture/decision.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

// What happens in a run. A kind is a struct of what it alone has, with its name in records; its fields on
// record, their units and meanings are listed in io/run/event_records.hpp.

using FloeId = std::int64_t;
inline constexpr FloeId kNoFloe = -1;

/// What decides that an overlap becomes brash: it is large, and no motion of the bodies reduces it, since the
/// gradient of its area is small or nothing moves the two, or it was crushed (docs/theory/contact.md).
struct GrindCriterion {
  double overlap_area = 0;  ///< [m²]
  double least_area = 0;    ///< a smaller overlap is left [m²]
  double width = 0;         ///< |R|, by which the area falls per metre of motion [m]
  double least_width = 0;   ///< a wider overlap is left to its contact [m]; 0 where it was crushed
};

/// What decides that a floe goes under.
struct TiltCriterion {
  double deflection = 0;        ///< w of its edge [m]
  double least_deflection = 0;  ///< c_g h; 0 of a cusp, which goes under as it breaks off [m]
  double vertical_force = 0;    ///< V on it in the step [N]
  double capacity = 0;          ///< V_rot [N]
  double covered_share = 0;     ///< of its area what the hull covers: more than half is under too [-]
};

/// What decides that ice comes up, or stays under.
struct ResurfaceCriterion {
  double path = 0;          ///< s, how far the ship has come over it [m]
  double least_path = 0;    ///< s̄, of the hull [m]
  double waited = 0;        ///< for room [s]
  double longest_wait = 0;  ///< [s]
};

/// What all that happens to ice has.
struct IceEvent {
  FloeId floe = kNoFloe;     ///< that broke (its children's parent), went under or came up
  FloeId by_floe = kNoFloe;  ///< that ground or split it, where no ship did
  std::vector<FloeId> children = {};
  geometry::Vector normal_in_world = {};  ///< unit, from the hull into the ice; 0 where nothing pressed
  double penetration = 0;                 ///< ξ when it broke [m]
  double submerged_area = 0;              ///< gone under the ship for good [m²]
  double brash_area = 0;                  ///< pieces below the size limit and slivers [m²]
  double rounding_defect = 0;             ///< [m²]
};

/// A cusp broke off.
struct Bend : IceEvent {
  static constexpr std::string_view kName = "bend";
  fracture::FailureCriteria criterion = {};
  double cusp_radius = 0;      ///< R [m]
  double under_hull_area = 0;  ///< gone under the hull, to come up [m²]
};

struct Split : IceEvent {
  static constexpr std::string_view kName = "split";
  fracture::FailureCriteria criterion = {};
};

/// An overlap that no contact could part was ground to brash, or one that was crushed was cut off.
struct Grind : IceEvent {
  static constexpr std::string_view kName = "grind";
  GrindCriterion criterion = {};
};

/// What a cut that geometry refused was asked to do. Written as an input of `polynya cut`.
struct CutInput {
  std::int64_t number = 0;                     ///< of the run's rejected cuts, from 1
  geometry::Polygon polygon_in_body;           ///< of the floe
  geometry::Ring cusp_in_body;                 ///< of a bend; empty of a split [m]
  std::vector<geometry::Point> crack_in_body;  ///< of a split [m]
};

/// A cut that geometry refused: the floe is as it was.
struct RejectedCut : IceEvent {
  static constexpr std::string_view kName = "rejected_cut";
  std::variant<fracture::FailureCriteria, GrindCriterion> criterion = {};
  double cusp_radius = 0;  ///< R of a bend, else 0 [m]
  std::string reason = {};
  CutInput input = {};  ///< not in events.ndjson
};

/// A floe or a broken cusp went under a hull.
struct Submerge : IceEvent {
  static constexpr std::string_view kName = "submerge";
  TiltCriterion criterion = {};
  double under_hull_area = 0;  ///< [m²]
};

/// It came up behind it.
struct Resurface : IceEvent {
  static constexpr std::string_view kName = "resurface";
  ResurfaceCriterion criterion = {};
};

/// It found no room and stays under the ice.
struct StayUnder : IceEvent {
  static constexpr std::string_view kName = "stay_under";
  ResurfaceCriterion criterion = {};
  double under_ice_area = 0;  ///< [m²]
};

/// The first contact of two ships, or of a ship and a structure.
struct HullContact {
  static constexpr std::string_view kName = "ship_contact";
  int other = 0;               ///< index in the scene, greater than the event's ship
  double closing_speed = 0;    ///< along the contact's normal, before the contact acts [m/s]
  double relative_speed = 0;   ///< of the two at that point [m/s]
  bool is_prescribed = false;  ///< the motion of both is: they pass through each other without a force
};

/// A mooring broke; its ship is adrift from the end of that step.
struct MooringBreak {
  static constexpr std::string_view kName = "mooring_break";
  geometry::Vector offset_in_moored_place;  ///< of the ship from it, along and across its heading [m]
  double force = 0;                         ///< with which the mooring held the ship, horizontal [N]
  double break_load = 0;                    ///< which that force exceeds [N]
};

/// A line of events.ndjson.
struct Event {
  double time = 0;                 ///< [s]
  int ship = 0;                    ///< index in the scene; -1 where a floe did it
  geometry::Point point_in_world;  ///< of contact; of a mooring the ship's centre of gravity [m]
  std::variant<HullContact, MooringBreak, Bend, Split, Grind, RejectedCut, Submerge, Resurface, StayUnder>
      what;  ///< at first a HullContact: the one that states keep (state_fields.hpp)

  template <class Kind>
  bool is() const {
    return std::holds_alternative<Kind>(what);
  }
  /// Whether ice broke in it.
  bool is_fracture() const { return is<Bend>() || is<Split>() || is<Grind>(); }
  /// Whether it ends the life of its floe.
  bool ends_floe() const { return is_fracture() || is<Resurface>() || is<StayUnder>(); }
  /// What happened to ice; null where only ships are in it.
  const IceEvent* ice() const;
  IceEvent* ice() { return const_cast<IceEvent*>(std::as_const(*this).ice()); }
  /// Both sides of what decided that ice bends or splits; all 0 where something else did.
  const fracture::FailureCriteria& criteria() const;
};

/// The kind's.
std::string_view name_of(const Event& event);

/// What decided that ice bent or split, as every view shows it.
struct DecidingLoad {
  std::string_view name;           ///< of the load
  std::string_view comparison;     ///< ">" or ">="
  std::string_view capacity_name;  ///< of what it reached
  double load = 0;                 ///< [N]
  double capacity = 0;             ///< [N]
};
DecidingLoad deciding_load(const fracture::FailureCriteria& criteria, bool is_split);

}  // namespace polynya::simulation
