// Stages of a step, on a jam: 2000 floes of 15 m at 80 % that a sheared current has carried for 60 s. Also one cut, one
// question to the database, one random field.
//   polynya_bench_micro [--benchmark_filter=REGEX]
#include <cmath>
#include <memory>

#include <benchmark/benchmark.h>

#include "dynamics/water/water_drag.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "geometry/contact/near_boundaries.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/validity.hpp"
#include "simulation/field/floe_field.hpp"
#include "simulation/world/step.hpp"

namespace polynya::bench {
namespace {

using simulation::World;

simulation::FloeField field_of(int floes, double concentration) {
  simulation::FloeField field;
  field.concentration = concentration;
  const double side = std::sqrt(floes * 225 * (1 + field.size_spread * field.size_spread) / concentration);
  field.region = {{0, 0}, {side, 0}, {side, side}, {0, side}};
  return field;
}

/// A jam, ready for the stage that is measured.
std::unique_ptr<World> make_jam() {
  simulation::Scene scene;
  scene.time.step = 0.05;
  scene.water.shear.rate = 0.005;
  for (auto& polygon : simulation::make_floe_field(field_of(2000, 0.8)).floes)
    scene.floes.push_back({std::move(polygon), {}, 0});
  auto world = std::make_unique<World>(std::move(scene));
  while (world->clock.time() < 60) {
    simulation::step(*world);
    world->journal.clear();
  }
  return world;
}

/// Measures the time of one stage of a world that advances. Each tick is one step, and the other stages are not timed.
/// Every stage is timed over the same 400 steps, so that all see the same contacts.
void measure_stage(benchmark::State& state, std::string_view name) {
  const std::unique_ptr<World> jam = make_jam();
  World& world = *jam;
  double contacts = 0;
  for (auto _ : state) {
    state.PauseTiming();
    world.last_step = step_of(world.setup, world.clock, 0, 1);
    for (const simulation::Stage& stage : simulation::stages_of(world.setup.scene.contact.law)) {
      if (stage.name == name) state.ResumeTiming();
      stage.run(world, world.last_step);
      if (stage.name == name) state.PauseTiming();
    }
    ++world.clock.ticks;
    contacts += static_cast<double>(world.data.contacts.size());
    world.journal.clear();
    state.ResumeTiming();
  }
  state.counters["contacts"] = contacts / static_cast<double>(state.iterations());
  state.counters["awake"] = static_cast<double>(world.population.awake.size());
}

void FindPairs(benchmark::State& state) {
  measure_stage(state, "find pairs");
}
void FindContacts(benchmark::State& state) {
  measure_stage(state, "find contacts");
}
void SolveImpulses(benchmark::State& state) {
  measure_stage(state, "solve impulses");
}
void WaterDrag(benchmark::State& state) {
  measure_stage(state, "water and wind");
}
void Integrate(benchmark::State& state) {
  measure_stage(state, "integrate");
}
BENCHMARK(FindPairs)->Iterations(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(FindContacts)->Iterations(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(SolveImpulses)->Iterations(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(WaterDrag)->Iterations(400)->Unit(benchmark::kMicrosecond);
BENCHMARK(Integrate)->Iterations(400)->Unit(benchmark::kMicrosecond);

/// Cuts a cusp of 3 m off a round plate. The argument is the number of vertices of the plate.
void CutCusp(benchmark::State& state) {
  const auto corners = static_cast<int>(state.range(0));
  geometry::Shape plate;
  for (int i = 0; i < corners; ++i) {
    const geometry::Rotation r = geometry::Rotation::by(2 * 3.14159265358979 * i / corners);
    plate.polygon.outer.push_back({150 * r.cosine, 150 * r.sine});
  }
  plate.known_valid = true;
  const geometry::Ring disc = geometry::disc_polygon({150, 0.7}, 3, 0.02);
  for (auto _ : state) {
    const auto cut = geometry::cut_by_polygon(plate, {disc, {}});
    if (!cut) state.SkipWithError("the cut failed");
    benchmark::DoNotOptimize(cut);
  }
}
BENCHMARK(CutCusp)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond);

/// Cuts a crack through the middle of the same plate.
void SplitPlate(benchmark::State& state) {
  geometry::Shape plate{{{{0, 0}, {110, 0}, {110, 200}, {0, 200}}, {}}};
  for (auto _ : state) benchmark::DoNotOptimize(geometry::cut_along(plate, {{-1, 90}, {111, 103}}));
}
BENCHMARK(SplitPlate)->Unit(benchmark::kMicrosecond);

void QueryDatabase(benchmark::State& state) {
  const fracture::FsiDatabaseModel model;
  fracture::BendingLoad load;
  for (auto _ : state) {
    load.mean_approach_speed = load.mean_approach_speed > 2 ? 0.1 : load.mean_approach_speed + 0.01;
    benchmark::DoNotOptimize(model.capacity(load));
  }
}
BENCHMARK(QueryDatabase);

/// A ragged coast of 100 000 edges.
geometry::Polygon coast() {
  geometry::Polygon polygon;
  for (int i = 0; i < 100000; ++i) {
    const geometry::Rotation r = geometry::Rotation::by(2e-5 * 3.14159265358979 * i);
    const double radius = 5000 + 0.5 * std::sin(37.0 * i);
    polygon.outer.push_back({radius * r.cosine, radius * r.sine});
  }
  return polygon;
}

void SearchDefect(benchmark::State& state) {
  const geometry::Polygon polygon = coast();
  for (auto _ : state) benchmark::DoNotOptimize(geometry::find_defect(polygon));
}
BENCHMARK(SearchDefect)->Unit(benchmark::kMillisecond);

void SearchContactCircles(benchmark::State& state) {
  const geometry::EdgeList edges = geometry::edge_list(coast());
  const auto pieces = geometry::boundary_pieces(edges, 1);
  for (auto _ : state) benchmark::DoNotOptimize(geometry::sample_contact_circles(edges, pieces, 1));
}
BENCHMARK(SearchContactCircles)->Unit(benchmark::kMillisecond);

void SearchOverlappingPairs(benchmark::State& state) {
  const auto floes = simulation::make_floe_field(field_of(20000, 0.53)).floes;
  for (auto _ : state) benchmark::DoNotOptimize(geometry::find_overlapping_pairs(floes, 10));
}
BENCHMARK(SearchOverlappingPairs)->Unit(benchmark::kMillisecond);

void MakeField(benchmark::State& state) {
  const auto field = field_of(static_cast<int>(state.range(0)), 0.53);
  for (auto _ : state) benchmark::DoNotOptimize(simulation::make_floe_field(field));
}
BENCHMARK(MakeField)->Arg(1000)->Arg(100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace polynya::bench

BENCHMARK_MAIN();
