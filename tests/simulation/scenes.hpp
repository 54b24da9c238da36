#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <type_traits>
#include <vector>

#include "simulation/simulation.hpp"
#include "simulation/world/world.hpp"
#include "tests/only.hpp"
#include "tests/shapes.hpp"

namespace polynya::simulation::scenes {

using shapes::kDegree;
using shapes::rectangle;
using tests::only;

enum class Laws {
  kDefault,  ///< contacts crush, wedges are split by radial cracks, cracks by LEFM
  kPaper,    ///< [Sawamura2017]'s: rigid impulses with restitution, j/τ_c, no radial cracks
};

inline constexpr Laws kBothLaws[] = {Laws::kDefault, Laws::kPaper};

inline FloeSpec floe(const geometry::Polygon& polygon, geometry::Vector velocity = {}, double angular_velocity = 0) {
  return {polygon, velocity, angular_velocity};
}

/// A floe that is held at its velocity.
FloeSpec fast(const geometry::Polygon& polygon, geometry::Vector velocity = {});

/// The paper's ship, its stem at `stem`, heading along x.
Ship icebreaker(geometry::Point stem, const Propulsion& propulsion, double speed = 1);

/// The same ship with vertical walls: it crushes and splits ice but does not bend it.
Ship steep_icebreaker(geometry::Point stem, const Propulsion& propulsion, double speed = 1);

/// A box-shaped ship with vertical walls, which can only crush ice.
Ship barge(geometry::Point middle_of_bow, const Propulsion& propulsion, double speed = 1);

/// Returns the ship with a draught of 6 m, so that ice goes under her.
Ship with_draught(Ship ship);

/// Returns the ship with the forces of the water switched on.
Ship in_water(Ship ship);

inline constexpr Engine kEngine{.bollard_pull = 1e6, .open_water_speed = 8, .power = 12e6, .propeller_area = 25};

/// Gives a whole hull one angle from the vertical [rad].
void set_hull_angle(PlacedHull& ship, double angle);

/// Springs [N/m, N m/rad] and dampers [N s/m, N m s/rad] along, across and about a ship whose place is `at`.
MooringSettings moored(geometry::Point at, const dynamics::Planar& stiffness, const dynamics::Planar& damping = {},
                       double break_load = 0, double heading = 0);

/// Motion of a wall. By default it stands still.
struct WallMotion {
  geometry::Vector velocity;  ///< [m/s]
  std::optional<WallPressure> pressure;
};
WallMotion pressing(double line_load);         ///< [N/m]
WallMotion moving(geometry::Vector velocity);  ///< [m/s]

/// Builds a scene in two or three lines: each call adds something and returns the scene. The default laws apply.
class Build : public Scene {
 public:
  Build() = default;
  explicit Build(Laws laws);
  Build& step(double seconds) { return set(time.step, seconds); }
  Build& ship(const Ship& ship) { return add(ships, ship); }
  /// Adds a fixed waterline about a point. The angle of its walls is from the vertical [rad].
  Build& structure(const geometry::Ring& waterline, geometry::Point at = {}, double wall_angle = 0);
  Build& pile(geometry::Point at, double radius, double wall_angle = 0) {
    return structure(cylinder_waterline(radius), at, wall_angle);
  }
  /// Adds a wall with the ice to its left, 5 m deep.
  Build& wall(geometry::Point from, geometry::Point to, const WallMotion& motion = {});
  Build& floe(const FloeSpec& spec) { return add(floes, spec); }
  Build& floe(const geometry::Polygon& polygon, geometry::Vector velocity = {}, double spin = 0) {
    return floe(scenes::floe(polygon, velocity, spin));
  }
  /// Square floes of a side, their lower left corners `pitch` apart from `low` on.
  Build& grid(geometry::Point low, int columns, int rows, double side, double pitch);
  /// Gives the last floe its own ice properties.
  Build& of(const fracture::Ice& own_ice);
  /// Makes contacts the only cause of velocity changes.
  Build& without_drag() { return set(water.drag_coefficient, 0); }
  Build& unbreakable() { return set(fracture.breakable_size_factor, 1e9); }
  Build& thickness(double metres) { return set(ice.thickness, metres); }
  Build& splitting(fracture::SplittingModel model) { return set(fracture.splitting, model); }
  /// Switches splits off, for ice without end.
  Build& without_splits() { return splitting(fracture::SplittingModel::kNone); }
  Build& cusps(CuspFate fate) { return set(fracture.cusp_fate, fate); }
  /// Lets cusps and floes go under hulls and, if `come_up`, surface behind them.
  Build& under_hulls(bool come_up = true);
  /// Steps of one length for all.
  Build& restitution(double share) { return set(contact.restitution, share); }
  /// Forces are recorded so often, by default in each step [s].
  Build& recorded_every(double interval) { return set(record.forces_interval, interval); }
  Build& recorded_each_step() { return recorded_every(time.step); }
  Build& drift(geometry::Vector velocity) { return set(water.drift, velocity); }
  Build& shear(double rate, double direction = 0, geometry::Point through = {}) {
    return set(water.shear, {rate, direction, through});
  }

 private:
  template <class T>
  Build& set(T& member, const std::type_identity_t<T>& value) {
    member = value;
    return *this;
  }
  template <class T>
  Build& add(std::vector<T>& list, const T& entry) {
    list.push_back(entry);
    return *this;
  }
};

/// A ship under thrust in drifting water, into loose floes and a plate behind them.
Build ship_in_pack(Laws laws = Laws::kDefault);

/// Everything a run recorded.
struct Story {
  std::vector<Event> bends() const { return of_kind<Bend>(); }
  std::vector<Event> splits() const { return of_kind<Split>(); }
  std::vector<Event> grinds() const { return of_kind<Grind>(); }
  std::vector<Event> submerged() const { return of_kind<Submerge>(); }
  std::vector<Event> resurfaced() const { return of_kind<Resurface>(); }
  std::vector<Event> stayed_under() const { return of_kind<StayUnder>(); }
  std::vector<Event> rejected_cuts() const { return of_kind<RejectedCut>(); }
  template <class Kind>
  std::vector<Event> of_kind() const {
    std::vector<Event> found;
    std::ranges::copy_if(events, std::back_inserter(found), &Event::is<Kind>);
    return found;
  }

  std::vector<Event> events;
  std::vector<Birth> births;
  std::vector<Death> deaths;
  std::vector<HullSample> samples;
  std::vector<LoadPeak> peaks;
  std::vector<PanelSample> panels;
};

/// A simulation and all its records.
struct Trial {
  Simulation simulation;
  Story story;
};

/// Takes the records that the simulation made since the last call.
void listen(Simulation& simulation, Story& story);

Story run(Simulation& simulation, double until);
Trial run(const Scene& scene, double until, Shortcuts shortcuts = {});

/// Does the same, and calls a function after each step.
Trial run(const Scene& scene, double until, const std::function<void(const Simulation&)>& after_step);

/// Steps until something holds after a step, or to a time.
Trial run_until(const Scene& scene, double until, const std::function<bool(const Trial&)>& is_enough);

/// Steps to the first event, or to a time.
Trial run_to_first_event(const Scene& scene, double until);

/// Advances the simulation and discards its records.
void skip(Simulation& simulation, int steps = 1);

/// Returns the first bend of a run. The test fails if nothing bends.
Event first_bend(const Scene& scene, double until = 20);

/// The mean of a load over a ship's samples from a time on.
double mean(const Story& story, dynamics::Planar HullSample::*load, int ship = 0, double from = 0,
            double dynamics::Planar::*direction = &dynamics::Planar::surge);
/// Returns the largest magnitude of a load's surge component.
double largest(const Story& story, dynamics::Planar HullSample::*load, int ship = 0);

/// Returns the largest force of all contacts in the last step [N].
double largest_contact_force(const Simulation& simulation);

/// Returns the smallest area of the floes that an event made [m²].
double least_child(const Story& story, const Event& event);

/// All accounts close: areas, masses, energy and momentum.
void expect_closed(const Simulation& simulation);

/// Checks that a run that is saved at `from` and resumed ends at `until` in the state of an uninterrupted run, to the
/// bit. Returns the resumed run with its records from there on.
Trial expect_resumes(const Scene& scene, double from, double until, int threads = 1);
Simulation resumed(const Scene& scene, const Simulation& simulation);

}  // namespace polynya::simulation::scenes
