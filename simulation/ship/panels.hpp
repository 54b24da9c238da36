#pragma once

#include <vector>

#include "dynamics/planar.hpp"
#include "simulation/ship/carried_load.hpp"

namespace polynya::simulation {

struct Accounts;
struct Clock;
struct Step;
struct Journal;
struct Population;
struct Setup;
struct StepData;

/// Loads of the ice on a panel of a hull over a recording interval, in the hull's frame.
struct PanelLoads {
  dynamics::Planar impulse{};     ///< impulse on the panel [N s, N m s]
  double normal = 0;              ///< impulse along the normals of its contacts [N s]
  double largest = 0;             ///< largest force along the normals in a single step [N]
  double loaded = 0;              ///< time during which ice pressed on the panel [s]
  CarriedLoad carried;            ///< part of `normal` that was missed before contacts were found and is not booked yet
  dynamics::Planar carried_load;  ///< the same part of `impulse` [N s, N m s]
  double step = 0;                ///< impulse along the normals in the present step, without the missed part [N s]
  double step_missed = 0;         ///< missed part found in the present step [N s]
};

/// The loads of all panels of one hull. Columns are ordered from the farthest to starboard to the farthest to port.
/// Each column has its rows from the bottom, followed by one element for the ice above and below all rows.
using HullPanels = std::vector<PanelLoads>;

/// Returns the loads of all hulls, which are 0. A hull without panels has an empty list.
std::vector<HullPanels> panels_of(const Setup& setup);

/// Adds the contacts with ice of a step. The normal impulse of each end is spread evenly over its half of the contact
/// line, and over the height of the ice that presses. Must be called before the hulls move, because contacts are in the
/// positions at which they were found.
void load_panels(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                 std::vector<HullPanels>& panels);

/// Records the panels on which ice pressed in the interval that ends now, of the given length [s], and starts the next
/// interval.
void sample_panels(const Setup& setup, const Clock& clock, double interval, std::vector<HullPanels>& panels,
                   Journal& journal);

}  // namespace polynya::simulation
