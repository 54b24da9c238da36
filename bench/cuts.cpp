// Polynya's exact cuts beside the libraries people would use instead, all in one run.
//   build/bench/bench/polynya_bench_cuts [ROUNDS]
// The rounds go around the libraries in turn, so that a busy machine is busy for all; the least time of each
// counts.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "bench/cut_cases.hpp"

namespace polynya::bench {
namespace {

template <typename Case>
struct Contender {
  const char* name;
  Result (*run)(const Case&);
  double least_s = std::numeric_limits<double>::infinity();
  Result result;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <typename Case>
void compare(const char* title, const Case& data, std::vector<Contender<Case>> contenders, int rounds, int repeats) {
  for (int round = 0; round < rounds; ++round) {
    for (Contender<Case>& contender : contenders) {
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < repeats; ++i) contender.result = contender.run(data);
      contender.least_s = std::min(contender.least_s, seconds_since(start) / repeats);
    }
  }
  std::printf("%s\n  %-16s %12s %10s %18s %9s\n", title, "library", "least [ms]", "vs ours", "area [m2]", "vertices");
  for (const Contender<Case>& c : contenders) {
    std::printf("  %-16s %12.4f %9.2fx %18.9f %9zu\n", c.name, c.least_s * 1e3, c.least_s / contenders.front().least_s,
                c.result.area, c.result.vertices);
  }
}

}  // namespace
}  // namespace polynya::bench

int main(int argc, char** argv) {
  using namespace polynya::bench;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  compare<March>("500 overlapping cusps around a 110 m x 200 m plate", march_of_cusps(),
                 {{"polynya", polynya_cuts::march},
                  {"Boost.Geometry", boost_geometry::march},
                  {"GEOS OverlayNG", geos::march},
                  {"Clipper 6", clipper::march}},
                 rounds, 1);
  compare<Split>("a 2000-vertex floe split by a line", split_of_floe(),
                 {{"polynya", polynya_cuts::split},
                  {"Boost.Geometry", boost_geometry::split},
                  {"GEOS OverlayNG", geos::split},
                  {"Clipper 6", clipper::split}},
                 rounds, 20);
  using Seconds = double (*)(int);
  const std::vector<std::pair<const char*, Seconds>> columns{{"find_defect", polynya_cuts::seconds_to_validate},
                                                             {"crack, whole", polynya_cuts::seconds_to_cut_generally},
                                                             {"crack", polynya_cuts::seconds_to_cut_locally},
                                                             {"2 discs, whole", polynya_cuts::seconds_to_cut_by_two}};
  std::printf("exact cost by size of the floe [ms], least of %d\n  %10s", rounds, "vertices");
  for (const auto& [name, run] : columns) std::printf(" %16s", name);
  for (const int vertices : {1250, 2500, 5000, 10000, 100000}) {
    std::vector<double> least(columns.size(), std::numeric_limits<double>::infinity());
    for (int round = 0; round < (vertices > 10000 ? 1 : rounds); ++round) {
      for (std::size_t i = 0; i < columns.size(); ++i) least[i] = std::min(least[i], columns[i].second(vertices));
    }
    std::printf("\n  %10d", vertices);
    for (const double seconds : least) std::printf(" %16.3f", seconds * 1e3);
  }
  std::printf("\n");
  return 0;
}
