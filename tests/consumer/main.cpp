// Reads a scene, runs it for a second and cuts a floe: every room of the installed library links.
#include <cmath>
#include <cstdio>

#include "fracture/characteristic_length.hpp"
#include "geometry/cut/cut.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"

int main(int count, char** words) {
  if (count < 2) return 2;
  auto loaded = polynya::io::read_scene_file(words[1]);
  if (!loaded) {
    for (const auto& problem : loaded.error()) std::puts(to_string(problem).c_str());
    return 3;
  }
  polynya::simulation::Simulation simulation(loaded->scene);
  while (simulation.time() < 1) simulation.step();
  const auto ledger = simulation.area_ledger();

  const polynya::geometry::Polygon square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
  const auto cut = polynya::geometry::cut_along({square}, {{5, -1}, {5, 11}});
  const double length =
      polynya::fracture::characteristic_length(loaded->scene.ice, loaded->scene.water.water);
  std::printf("%.0f m2 of ice after %g s, %zu pieces, l = %.3f m\n", ledger.floe_area, simulation.time(),
              cut ? cut->pieces.size() : 0, length);
  return cut && cut->pieces.size() == 2 && std::abs(ledger.imbalance) < 1e-6 ? 0 : 1;
}
