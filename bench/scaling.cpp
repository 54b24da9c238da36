// How the cost of a step grows: with floes, awake floes, touching pairs and boundary vertices.
//   polynya_bench_scaling [--quick] [--csv FILE]
//   bench/scaling_figure.py draws the table
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <numbers>
#include <string>
#include <thread>

#include "bench/voyage_run.hpp"
#include "simulation/field/floe_field.hpp"

namespace polynya::bench {
namespace {

struct Sample {
  double x = 0;
  RunCost cost;
};
struct Sweep {
  std::string name;
  std::vector<Sample> samples;
};

std::vector<simulation::FloeSpec> field_floes(int count, double concentration) {
  simulation::FloeField field;
  field.concentration = concentration;
  const double mean_area = 225 * (1 + field.size_spread * field.size_spread);
  const double side = std::sqrt(count * mean_area / concentration);
  field.region = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  std::vector<simulation::FloeSpec> floes;
  for (auto& polygon : simulation::make_floe_field(field).floes) floes.push_back({std::move(polygon), {}, 0});
  return floes;
}

/// Returns the voyage of field-10000 in a field of 2000 floes, with copies of the field beside it in which nothing
/// happens.
simulation::Scene voyage_beside(int copies) {
  simulation::Scene scene = load("field-10000.json");
  scene.floes = field_floes(2000, 0.53);
  const double side = std::sqrt(2000 * 225 * 1.0625 / 0.53);
  scene.ships.front().position_in_world.y = 0.5 * side;
  const std::size_t count = scene.floes.size();
  for (int copy = 1; copy < copies; ++copy) {
    for (std::size_t i = 0; i < count; ++i) {
      simulation::FloeSpec floe = scene.floes[i];
      for (geometry::Point& p : floe.polygon_in_world.outer) p.y += copy * (side + 20);
      scene.floes.push_back(std::move(floe));
    }
  }
  return scene;
}

/// Floes that all move, in a sheared current, without a structure.
simulation::Scene sheared(int floes, double concentration) {
  simulation::Scene scene = load("cylinder-shear.json");
  scene.structures.clear();
  scene.floes = field_floes(floes, concentration);
  scene.water.shear.rate = 0.002;
  return scene;
}

simulation::Scene round_plate(int corners) {
  simulation::Scene scene = load("level-plate.json");
  geometry::Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.3) / corners;
    ring.push_back({150 + 150 * std::cos(angle), 150 * std::sin(angle)});
  }
  scene.floes.front().polygon_in_world = {ring, {}};
  return scene;
}

std::vector<Sweep> run_sweeps(bool is_quick) {
  std::vector<Sweep> sweeps{{"floes", {}}, {"awake", {}}, {"contacts", {}}, {"vertices", {}}, {"threads", {}}};
  const double part = is_quick ? 0.1 : 1;
  const auto measure = [&](Sweep& sweep, double x, const simulation::Scene& scene, double until, int threads = 1) {
    simulation::Scene in_fine_steps = scene;
    take_fine_step(in_fine_steps);
    const Limits limits{1e9, part * until, threads};
    RunCost cost = run_polynya(in_fine_steps, limits, kWithoutParts);
    keep_quieter(cost, run_polynya(in_fine_steps, limits, kWithoutParts));
    std::fprintf(stderr, "%s %g: %.1f us\n", sweep.name.c_str(), x, 1e6 * cost.mean_tick());
    sweep.samples.push_back({x > 0 ? x : cost.mean_contacts, std::move(cost)});
  };
  for (const int copies : {1, 2, 5, 15, 50}) measure(sweeps[0], 2000 * copies, voyage_beside(copies), 200);
  for (const int floes : {100, 300, 1000, 3000, 10000}) measure(sweeps[1], floes, sheared(floes, 0.8), 100);
  for (const double concentration : {0.5, 0.6, 0.7, 0.8, 0.9}) measure(sweeps[2], 0, sheared(2000, concentration), 100);
  for (const int corners : {30, 100, 300, 1000, 3000, 10000}) measure(sweeps[3], corners, round_plate(corners), 100);
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  for (int threads = 1; threads <= cores; threads *= 2) measure(sweeps[4], threads, sheared(10000, 0.8), 100, threads);
  return sweeps;
}

}  // namespace
}  // namespace polynya::bench

int main(int count, char** words) {
  using namespace polynya::bench;
  bool is_quick = false;
  std::string csv;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(words[i], "--quick") == 0) is_quick = true;
    if (std::strcmp(words[i], "--csv") == 0 && i + 1 < count) csv = words[++i];
  }
  const auto sweeps = run_sweeps(is_quick);
  std::ofstream table(csv.empty() ? "/dev/stdout" : csv);
  table << "sweep,x,mean_us,median_us,mean_awake,mean_contacts\n";
  for (const Sweep& sweep : sweeps) {
    for (const Sample& s : sweep.samples) {
      table << sweep.name << ',' << s.x << ',' << 1e6 * s.cost.mean_tick() << ',' << 1e6 * s.cost.median_tick() << ','
            << s.cost.mean_awake << ',' << s.cost.mean_contacts << '\n';
    }
  }
}
