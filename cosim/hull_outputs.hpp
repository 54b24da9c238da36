#pragma once

#include <span>
#include <string_view>

#include "simulation/world/journal.hpp"

namespace polynya::cosim {

/// Outputs of a ship or structure after a communication step.
struct HullOutputs {
  simulation::HullSample sample;  ///< motion at the end of the step, and mean loads over it
  double largest_contact = 0;     ///< largest force of one contact with ice in the step, of whole ticks [N]
  double cover_ahead = 0;         ///< share of the water ahead that ice covers at the end of the step [-]
};

/// One output of a ship or structure.
struct HullOutput {
  std::string_view name;  ///< behind the name of the hull and a dot
  std::string_view unit;
  std::string_view meaning;
  bool is_count = false;     ///< true for a whole number
  bool is_of_ships = false;  ///< true if structures, which never move, do not have it
  double (*value)(const HullOutputs&) = nullptr;
};

/// All outputs of a hull, in their order.
std::span<const HullOutput> hull_outputs();

}  // namespace polynya::cosim
