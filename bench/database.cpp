// Benchmarks of the icebreaking database: one query, one direct solution, and the whole table.
//   polynya_bench_database [--benchmark_filter=REGEX]
#include "fracture/bending/database.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <benchmark/benchmark.h>

#include "bench/wedge_studies.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/crushing.hpp"

namespace polynya::bench {
namespace {

using fracture::BendingLoad;

constexpr std::size_t kLoads = 4096;  ///< more than a branch predictor remembers

/// Loads as a run meets them: any wedge, hull and speed, ice of 0.2 to 2 m. Seed fixed.
const std::array<BendingLoad, kLoads>& loads() {
  static const std::array<BendingLoad, kLoads> made = [] {
    std::mt19937_64 random(4);
    const auto uniform = [&random](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
    };
    std::array<BendingLoad, kLoads> some;
    for (BendingLoad& load : some) {
      load.ice.thickness = uniform(0.2, 2);
      load.front_half_angle = uniform(0.2, 1.4);
      load.back_half_angle = uniform(0.2, 1.4);
      load.hull_angle = uniform(0.5, 1.2);
      load.mean_approach_speed = uniform(0.05, 4);
      load.penetration = uniform(0.01, 0.5);
      load.vertical_to_crushing =
          fracture::crushing_shares(load.hull_angle, load.ice.friction, load.mean_approach_speed, uniform(0, 2))
              .vertical;
    }
    return some;
  }();
  return made;
}

/// A query of the table alone, by dimensionless groups.
void LookUp(benchmark::State& state) {
  const fracture::BendingDatabase& database = fracture::default_database();
  static const std::array<fracture::WedgeGroups, kLoads> groups = [] {
    std::array<fracture::WedgeGroups, kLoads> made;
    for (std::size_t i = 0; i < kLoads; ++i) made[i] = fracture::scaled(loads()[i]).groups;
    return made;
  }();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(database.look_up(groups[i++ % kLoads]));
}
BENCHMARK(LookUp);

/// One query of the simulation, from a physical load to newtons and metres.
void Query(benchmark::State& state) {
  const fracture::FsiDatabaseModel model;
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.capacity(loads()[i++ % kLoads]));
}
BENCHMARK(Query);

/// One `polynya database query`: a whole push at constant speed.
void Forecast(benchmark::State& state) {
  const fracture::FsiDatabaseModel model;
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.forecast(loads()[i++ % kLoads]));
}
BENCHMARK(Forecast);

/// The work that the table saves: computing the modes of one wedge …
void DirectModes(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(fracture::wedge_of(BendingLoad{}, {}));
}
BENCHMARK(DirectModes)->Unit(benchmark::kMillisecond);

/// … and one time integration with these modes.
void DirectMarch(benchmark::State& state) {
  BendingLoad load;
  load.mean_approach_speed = 1;
  const fracture::WedgeSolver solver = fracture::wedge_of(load, {});
  for (auto _ : state) benchmark::DoNotOptimize(fracture::direct_forecast(solver, load));
}
BENCHMARK(DirectMarch)->Unit(benchmark::kMillisecond);

/// Solving the whole shipped table, with the number of threads given by the argument.
void BuildTable(benchmark::State& state) {
  for (auto _ : state) {
    const auto built = fracture::build_database({}, fracture::default_grid(), static_cast<int>(state.range(0)));
    if (!built || fracture::write_database(*built) != fracture::default_database_text())
      state.SkipWithError("the table is not the shipped one");
  }
}
BENCHMARK(BuildTable)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Iterations(1)
    ->UseRealTime()
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace polynya::bench

BENCHMARK_MAIN();
