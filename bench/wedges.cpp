// The tables of docs/theory/bending.md that direct solutions of wedges make.
//   polynya_bench_wedges fluid|couple [THICKNESS_M]
//   polynya_bench_wedges accuracy [POINTS [SEED [INNER_RADIUS_L [ELEMENTS]]]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "bench/wedge_studies.hpp"
#include "fracture/bending/database.hpp"
#include "fracture/crushing.hpp"
#include "geometry/shape/angle.hpp"

namespace polynya::bench {
namespace {

using fracture::AccuracyRow;
using fracture::BendingForecast;
using fracture::BendingLoad;

constexpr double kSpeeds[] = {0.05, 0.1, 0.2, 0.5, 1, 2, 4};  // v_n [m/s]

/// Returns a load of the paper's ice: a 90° wedge and a hull 60° from the vertical.
BendingLoad paper_load(double thickness) {
  BendingLoad load;
  load.ice.thickness = thickness;
  load.hull_angle = 60 * geometry::kRadiansPerDegree;
  load.vertical_to_crushing = fracture::crushing_shares(load.hull_angle, load.ice.friction, 1, 0).vertical;
  return load;
}

void study_fluid(const BendingLoad& load) {
  std::printf("| v_n m/s | winkler | local-mass | potential | free-surface |\n|---|---|---|---|---|\n");
  for (const fracture::FluidStudyRow& row : fluid_study(load, kSpeeds, {})) {
    std::printf("| %g |", row.speed);
    for (const auto& forecast : row.by_fluid) {
      if (forecast)
        std::printf(" %.2f, %.3f |", forecast->capacity.vertical_force / 1e3, forecast->capacity.cusp_radius);
      else
        std::printf(" does not break |");
    }
    std::printf("\n");
  }
}

void print_cells(const std::optional<BendingForecast>& forecast) {
  if (!forecast) return static_cast<void>(std::printf(" does not break | | |"));
  const auto& [force, radius, in_range, crack] = forecast->capacity;
  std::printf(" %.2f | %.3f | %.*f |", force / 1e3, radius, forecast->time < 0.1 ? 4 : 3, forecast->time);
}

void study_couple(const BendingLoad& load) {
  std::printf("| v_n m/s | V kN | R m | t s | coupled: V kN | R m | t s |\n|---|---|---|---|---|---|---|\n");
  for (const fracture::FeedbackStudyRow& row : feedback_study(load, kSpeeds, {})) {
    std::printf("| %g |", row.speed);
    print_cells(row.ignored);
    print_cells(row.coupled);
    std::printf("\n");
  }
}

void print_errors(const char* name, const std::vector<AccuracyRow>& rows, double AccuracyRow::*error) {
  const auto size = [error](const AccuracyRow& row) { return std::abs(row.*error); };
  std::vector<double> sizes;
  for (const AccuracyRow& row : rows) sizes.push_back(100 * size(row));
  std::ranges::sort(sizes);
  std::printf("| %s |", name);
  for (const double share : {0.5, 0.9, 0.99, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::max(0.0, std::ceil(share * static_cast<double>(sizes.size())) - 1));
    std::printf(" %.2f |", sizes[rank]);
  }
  const fracture::WedgeGroups& worst = std::ranges::max_element(rows, {}, size)->groups;
  std::printf(" %.1f deg, %.4f, %.3g, %.3g |\n", worst.opening_angle * geometry::kDegreesPerRadian, worst.mass_ratio,
              worst.softness, worst.froude);
}

void study_accuracy(const std::vector<double>& settings) {
  const auto setting = [&](std::size_t i, double usual) { return i < settings.size() ? settings[i] : usual; };
  const fracture::BendingDatabase& database = fracture::default_database();
  const fracture::SolverSettings& own = database.settings();
  const auto points = static_cast<int>(setting(0, 200));
  const auto seed = static_cast<std::uint64_t>(setting(1, 20170611));
  fracture::SolverSettings reference = with_inner_radius(own, setting(2, own.inner_radius / 4));
  if (settings.size() > 3) reference = with_elements(reference, static_cast<int>(settings[3]));
  const auto threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const std::vector<AccuracyRow> rows = accuracy_study(database, reference, points, seed, threads).rows;
  for (const auto& [what, mesh] : {std::pair{"Table", own}, {" against solution", reference}})
    std::printf("%s (%d elements from %g l)", what, mesh.radial_elements, mesh.inner_radius);
  std::printf("\nat %d random points of the whole box, seed %g; errors in %%\n\n", points, static_cast<double>(seed));
  std::printf(
      "| | median | 90 of 100 | 99 of 100 | worst | worst at 2a, m, softness, Fr |\n|---|---|---|---|---|---|\n");
  print_errors("force", rows, &AccuracyRow::force_error);
  print_errors("radius", rows, &AccuracyRow::radius_error);
}

}  // namespace
}  // namespace polynya::bench

int main(int count, char** words) {
  const std::string study = count > 1 ? words[1] : "";
  std::vector<double> settings;
  for (int i = 2; i < count; ++i) settings.push_back(std::atof(words[i]));
  const polynya::fracture::BendingLoad load = polynya::bench::paper_load(settings.empty() ? 0.5 : settings.front());
  if (study == "fluid")
    polynya::bench::study_fluid(load);
  else if (study == "couple")
    polynya::bench::study_couple(load);
  else if (study == "accuracy")
    polynya::bench::study_accuracy(settings);
  else
    return std::fprintf(stderr, "polynya_bench_wedges fluid|couple|accuracy, as bench/wedges.cpp says\n"), 2;
  return 0;
}
