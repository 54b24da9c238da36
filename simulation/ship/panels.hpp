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

/// What the ice does to a panel of a hull over a recording interval, in the hull's frame.
struct PanelLoads {
  dynamics::Planar impulse;       ///< [N s, N m s]
  double normal = 0;              ///< along the normals of its contacts [N s]
  double largest = 0;             ///< of that, in a single step, as a force [N]
  double loaded = 0;              ///< how long it pressed [s]
  CarriedLoad carried;            ///< of normal, what was missed before contacts were found
  dynamics::Planar carried_load;  ///< of impulse, the same [N s, N m s]
  double step = 0;                ///< along the normals in the present step, without what was missed [N s]
  double step_missed = 0;         ///< what was missed [N s]
};

/// Those of one hull: columns from the farthest to starboard on, the rows of each from the bottom, then what acts above
/// and below all rows.
using HullPanels = std::vector<PanelLoads>;

/// Empty, for each hull; of one without panels no loads.
std::vector<HullPanels> panels_of(const Setup& setup);

/// Adds the step's contacts with ice. A contact's impulse is spread over its width, each end's evenly over its half,
/// and over the height of the ice that presses. While the hulls are where they were when the contacts were found.
void load_panels(const Setup& setup, const Step& step, const Population& population, const StepData& data,
                 std::vector<HullPanels>& panels);

/// Records the panels that ice pressed in the interval [s] that ends now, and begins the next.
void sample_panels(const Setup& setup, const Clock& clock, double interval, std::vector<HullPanels>& panels,
                   Journal& journal);

}  // namespace polynya::simulation
