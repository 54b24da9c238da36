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

// Events of a run. Each kind of event is a struct with its own members and its name in records.
// io/run/event_records.hpp lists the recorded fields of each kind, their units and their meanings.

/// Identity of a floe: its number in the order of creation, from 0. A number is never reused.
using FloeId = std::int64_t;
/// Value of a FloeId that means "no floe".
inline constexpr FloeId kNoFloe = -1;

/// Criterion by which an overlap of two bodies is cut off a floe and becomes brash. The overlap must have a minimum
/// area, and one of these conditions must hold: its area hardly changes when the bodies move, so that no contact can
/// part them; ice was crushed there; a hull pierced the floe; or both bodies have prescribed motion
/// (docs/theory/contact.md).
struct GrindCriterion {
  double overlap_area = 0;  ///< area of the overlap [m²]
  double least_area = 0;    ///< smallest area that is cut off; a smaller overlap is left [m²]
  /// Width of the overlap |R|: decrease of its area per metre of relative motion [m]. If a hull of prescribed motion
  /// carves a channel, it is the length of the contact line; it is 0 for other crushed or pierced ice.
  double width = 0;
  /// Width below which the overlap is cut off because no contact can part it; a wider one is left to its contact [m].
  /// 0 if the width is not what decides, as for crushed ice.
  double least_width = 0;
};

/// Criterion by which a floe or a cusp goes under a hull. All values are 0 for a cusp, which goes under as it breaks
/// off, and for a floe that the scene puts under a hull at the start.
struct TiltCriterion {
  double deflection = 0;        ///< downward deflection w of the floe's edge [m]
  double least_deflection = 0;  ///< deflection at which it goes under, TiltSettings::edge_deflection × thickness [m]
  double vertical_force = 0;    ///< downward force V of the hull on the edge, mean of the step [N]
  double capacity = 0;          ///< largest vertical force V_rot that the floe resists [N]
  double covered_share = 0;     ///< fraction of the floe's area inside the hull; above 0.5 the floe goes under [-]
};

/// Criterion by which ice under a hull surfaces, or stays under the ice for good.
struct ResurfaceCriterion {
  double path = 0;          ///< distance s that the ship has moved over the piece; negative if it backed off [m]
  double least_path = 0;    ///< value s̄ of that distance, for this hull, at which a piece may surface [m]
  double waited = 0;        ///< time that the piece has waited for space to surface [s]
  double longest_wait = 0;  ///< waiting time after which the piece stays under the ice [s]
};

/// Members that all events of ice have in common.
struct IceEvent {
  FloeId floe = kNoFloe;              ///< floe that broke, went under or surfaced; parent of `children`
  FloeId by_floe = kNoFloe;           ///< floe that caused the event; kNoFloe if a hull did
  std::vector<FloeId> children = {};  ///< floes that the event created from `floe`
  /// Unit normal of the contact from the hull, or the other floe, into the ice. It is zero if no contact pressed, and
  /// for ground overlaps other than carved channels.
  geometry::Vector normal_in_world = {};
  /// Penetration depth of the contact [m]. For a bend, or a split by SplittingModel::kMichel, it is ξ, the part of the
  /// overlap's depth that crushed. For other events it is the depth of the overlap, or 0 where `normal_in_world` is
  /// zero.
  double penetration = 0;
  double submerged_area = 0;   ///< area of ice that went under the ship for good [m²]
  double brash_area = 0;       ///< area of ice that became brash: small pieces, slivers, ground overlaps and rims [m²]
  double rounding_defect = 0;  ///< area added (+) or removed (−) by rounding the coordinates of the cut [m²]
};

/// Event: a cusp broke off a floe.
struct Bend : IceEvent {
  static constexpr std::string_view kName = "bend";
  fracture::FailureCriteria criterion = {};
  double cusp_radius = 0;      ///< radius R of the cusp [m]
  double under_hull_area = 0;  ///< area of the ice that went under the hull and may surface again [m²]
};

/// Event: a crack ran through a floe.
struct Split : IceEvent {
  static constexpr std::string_view kName = "split";
  fracture::FailureCriteria criterion = {};
};

/// Event: an overlap of a floe with another body was cut off and became brash (GrindCriterion).
struct Grind : IceEvent {
  static constexpr std::string_view kName = "grind";
  GrindCriterion criterion = {};
};

/// Input of a cut that geometry refused, so that the cut can be repeated with `polynya cut`. All coordinates are in the
/// floe's body frame.
struct CutInput {
  std::int64_t number = 0;            ///< number of the rejected cut in the run, from 1
  geometry::Polygon polygon_in_body;  ///< outline of the floe [m]
  /// Outline along which the floe was to be cut: the cusp of a bend, or the other body of a ground overlap. Empty for a
  /// split [m].
  geometry::Ring cusp_in_body;
  std::vector<geometry::Point> crack_in_body;  ///< path of the crack; used if `cusp_in_body` is empty [m]
};

/// Event: geometry refused a cut, and the floe is unchanged.
struct RejectedCut : IceEvent {
  static constexpr std::string_view kName = "rejected_cut";
  /// Criterion of the event that the cut belonged to: a bend or split, or a grind.
  std::variant<fracture::FailureCriteria, GrindCriterion> criterion = {};
  double cusp_radius = 0;   ///< radius R of the cusp of a bend; 0 for other cuts [m]
  std::string reason = {};  ///< reason why geometry refused the cut, in words
  CutInput input = {};      ///< input of the cut, written to separate files and not to events.ndjson
};

/// Event: a floe, or a cusp that has just broken off, went under a hull.
struct Submerge : IceEvent {
  static constexpr std::string_view kName = "submerge";
  TiltCriterion criterion = {};
  double under_hull_area = 0;  ///< area of the piece [m²]
};

/// Event: a piece of ice from under a hull surfaced.
struct Resurface : IceEvent {
  static constexpr std::string_view kName = "resurface";
  ResurfaceCriterion criterion = {};
};

/// Event: a piece of ice from under a hull stays under the ice for good, because it found no space to surface or
/// because the scene lets no ice surface (ResurfaceSettings::is_enabled).
struct StayUnder : IceEvent {
  static constexpr std::string_view kName = "stay_under";
  ResurfaceCriterion criterion = {};
  double under_ice_area = 0;  ///< area of the piece [m²]
};

/// Event: two hulls (ships, structures or walls) touched for the first time in the run.
struct HullContact {
  static constexpr std::string_view kName = "ship_contact";
  int other = 0;              ///< number of the other hull in the scene, greater than Event::ship
  double closing_speed = 0;   ///< closing speed along the contact's normal before the contact acts [m/s]
  double relative_speed = 0;  ///< relative speed of the two hulls at the contact point [m/s]
  /// True if the motion of both hulls is prescribed. They then pass through each other, and no force is computed.
  bool is_prescribed = false;
};

/// Event: a mooring broke. Its ship is adrift from the end of that step.
struct MooringBreak {
  static constexpr std::string_view kName = "mooring_break";
  /// Offset of the ship from its moored place, along and across the moored heading [m].
  geometry::Vector offset_in_moored_place;
  double force = 0;       ///< horizontal force of the mooring on the ship [N]
  double break_load = 0;  ///< horizontal force above which the mooring breaks [N]
};

/// An event of a run, recorded as one line of events.ndjson.
struct Event {
  double time = 0;  ///< end of the step of the event; 0 for floes that the scene puts under a hull [s]
  int ship = 0;     ///< number of the hull in the scene that caused the event; −1 if a floe did
  /// Place of the event in the world frame [m]: the contact point, or the point where the crack of a split begins. For
  /// a mooring it is the ship's centre of gravity; for ice that surfaces, stays under, or goes under without a contact,
  /// it is the centre of mass of the ice.
  geometry::Point point_in_world;
  /// Kind of the event with its members. The first alternative must be HullContact, because saved states contain only
  /// that kind and read it into a default-constructed Event (state_fields.hpp).
  std::variant<HullContact, MooringBreak, Bend, Split, Grind, RejectedCut, Submerge, Resurface, StayUnder> what;

  template <class Kind>
  bool is() const {
    return std::holds_alternative<Kind>(what);
  }
  /// Returns true if ice broke in the event.
  bool is_fracture() const { return is<Bend>() || is<Split>() || is<Grind>(); }
  /// Returns true if the event ends the life of its floe; the children, if any, replace the floe.
  bool ends_floe() const { return is_fracture() || is<Resurface>() || is<StayUnder>(); }
  /// Returns the members that all events of ice have in common, or null if the event concerns hulls only.
  const IceEvent* ice() const;
  IceEvent* ice() { return const_cast<IceEvent*>(std::as_const(*this).ice()); }
  /// Returns the loads and capacities by which ice bent or split, also for a rejected cut of that kind. All values are
  /// 0 for other events.
  const fracture::FailureCriteria& criteria() const;
};

/// Returns the name of the event's kind in records.
std::string_view name_of(const Event& event);

/// Load and capacity that decided that ice bends or splits. All views of an event show this pair.
struct DecidingLoad {
  std::string_view name;           ///< name of the load
  std::string_view comparison;     ///< comparison of the load with the capacity: ">" or ">="
  std::string_view capacity_name;  ///< name of the capacity
  double load = 0;                 ///< value of the load [N]
  double capacity = 0;             ///< value of the capacity [N]
};
/// Returns the deciding load of a bend, or of a split if `is_split` is true. That of a split is the collision force if
/// the paper's rule decides splits, the contact force if the floe broke as a beam, and otherwise the opening force of
/// the crack.
DecidingLoad deciding_load(const fracture::FailureCriteria& criteria, bool is_split);

}  // namespace polynya::simulation
