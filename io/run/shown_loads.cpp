#include "io/run/shown_loads.hpp"

#include <fmt/format.h>

namespace polynya::io {
namespace {

std::array<const ForceColumn*, 2> columns_of(std::string_view middle) {
  return {&force_column(fmt::format("surge{}_N", middle)), &force_column(fmt::format("sway{}_N", middle))};
}

}  // namespace

std::vector<ShownLoad> shown_loads(const simulation::Scene& scene) {
  const std::string mean = fmt::format("mean over {:.6g} s", recording_interval(scene));
  const std::string step = fmt::format("single step of {:.6g} s", scene.time.step);
  std::vector<ShownLoad> loads{{mean, true, columns_of("")}, {step, true, columns_of("_max")}};
  if (is_shown(ShownWhere::kAmongShips, scene)) {
    loads.push_back({mean, false, columns_of("_from_ships")});
    loads.push_back({step, false, columns_of("_from_ships_max")});
  }
  if (is_shown(ShownWhere::kWhereItSplits, scene))
    loads.push_back({"j/τ_c of the paper", true, columns_of("_j_over_tau_c")});
  return loads;
}

}  // namespace polynya::io
