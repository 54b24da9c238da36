#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/database_input.hpp"
#include "fracture/bending/studies.hpp"

namespace polynya::app {
namespace {

using fracture::AccuracyRow;
using fracture::BendingDatabase;
using fracture::BendingForecast;
using fracture::BendingLoad;

constexpr auto kExamples =
    "Examples:\n"
    "  polynya database study fluid               what each fluid model changes against speed\n"
    "  polynya database study couple              what the ice's own deflection changes\n"
    "  polynya database study accuracy            table against finer solutions at random points\n"
    "  polynya database study accuracy --inner-radius 0.001 --elements 72\n";

enum class Study { kFluid, kCouple, kAccuracy };

struct Options {
  Study study = Study::kFluid;
  std::string file;  ///< empty: the shipped one
  DatabaseLoadOptions load;
  // The rest is for kAccuracy.
  int points = 200;
  std::uint64_t seed = 20170611;
  std::optional<double> inner_radius;  ///< of the solution compared with [l]; a quarter of the table's
  std::optional<int> elements;         ///< along its radius; as closely spaced as the table's
  int threads = 0;                     ///< 0: as many as the machine runs at once
};

constexpr double kSpeeds[] = {0.05, 0.1, 0.2, 0.5, 1, 2, 4};  // v_n [m/s]

std::string force(const BendingForecast& forecast) {
  return fmt::format("{:.2f}", forecast.capacity.vertical_force / 1e3);
}

std::string time(const BendingForecast& forecast) {
  return fmt::format("{:.{}f}", forecast.time, forecast.time < 0.1 ? 4 : 3);
}

void study_fluid(const BendingLoad& load, const fracture::SolverSettings& settings) {
  print_out("V kN, R m: {}\n\n", describe(load));
  print_out("| v_n m/s | winkler | local-mass | potential | free-surface |\n|---|---|---|---|---|\n");
  for (const fracture::FluidStudyRow& row : fluid_study(load, kSpeeds, settings)) {
    std::string line = fmt::format("| {:g} |", row.speed);
    for (const auto& forecast : row.by_fluid)
      line += forecast ? fmt::format(" {}, {:.3f} |", force(*forecast), forecast->capacity.cusp_radius)
                       : " does not break |";
    print_out("{}\n", line);
  }
}

std::string forecast_cells(const std::optional<BendingForecast>& forecast) {
  if (!forecast) return " does not break | | |";
  return fmt::format(" {} | {:.3f} | {} |", force(*forecast), forecast->capacity.cusp_radius,
                     time(*forecast));
}

void study_couple(const BendingLoad& load, const fracture::SolverSettings& settings) {
  print_out("{}\n\n", describe(load));
  print_out("| v_n m/s | V kN | R m | t s | coupled: V kN | R m | t s |\n|---|---|---|---|---|---|---|\n");
  for (const fracture::FeedbackStudyRow& row : feedback_study(load, kSpeeds, settings))
    print_out("| {:g} |{}{}\n", row.speed, forecast_cells(row.ignored), forecast_cells(row.coupled));
}

/// Below which this share of the values lies.
double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  const double place = share * static_cast<double>(values.size());
  const auto rank = static_cast<std::size_t>(std::max(0.0, std::ceil(place) - 1));
  return values[std::min(rank, values.size() - 1)];
}

void print_errors(const char* name, const std::vector<AccuracyRow>& rows, double AccuracyRow::*error) {
  std::vector<double> sizes;
  sizes.reserve(rows.size());
  for (const AccuracyRow& row : rows) sizes.push_back(100 * std::abs(row.*error));
  const AccuracyRow& worst =
      *std::ranges::max_element(rows, {}, [error](const AccuracyRow& row) { return std::abs(row.*error); });
  print_out("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} deg, {:.4f}, {:.3g}, {:.3g} |\n", name,
            quantile(sizes, 0.5), quantile(sizes, 0.9), quantile(sizes, 0.99), quantile(sizes, 1),
            worst.groups.opening_angle * kDegree, worst.groups.mass_ratio, worst.groups.softness,
            worst.groups.froude);
}

std::string mesh_of(const fracture::SolverSettings& settings) {
  return fmt::format("{} elements from {:g} l", settings.radial_elements, settings.inner_radius);
}

void study_accuracy(const BendingDatabase& database, const Options& options) {
  constexpr double kUsualRefinement = 4;
  const fracture::SolverSettings& own = database.settings();
  fracture::SolverSettings reference =
      with_inner_radius(own, options.inner_radius.value_or(own.inner_radius / kUsualRefinement));
  if (options.elements) reference = with_elements(reference, *options.elements);
  const fracture::AccuracyStudy study =
      accuracy_study(database, reference, options.points, options.seed, thread_count(options.threads));
  print_out("Table ({}) against solution ({})\n", mesh_of(own), mesh_of(reference));
  print_out("at {} random points of the whole box, seed {}; errors in %\n\n", options.points, options.seed);
  print_out(
      "| | median | 90 of 100 | 99 of 100 | worst | worst at 2a, m, softness, Fr "
      "|\n|---|---|---|---|---|---|\n");
  print_errors("force", study.rows, &AccuracyRow::force_error);
  print_errors("radius", study.rows, &AccuracyRow::radius_error);
}

int study(const Options& options) {
  const auto load = bending_load(options.load);
  if (!load) return load.error();
  const auto database = load_database(options.file);
  if (!database) return database.error();
  switch (options.study) {
    case Study::kFluid:
      study_fluid(*load, (*database)->settings());
      break;
    case Study::kCouple:
      study_couple(*load, (*database)->settings());
      break;
    case Study::kAccuracy:
      study_accuracy(**database, options);
      break;
  }
  return kDone;
}

}  // namespace

Command add_database_study(CommandLine& app) {
  CommandLine command = app.add_command("study", "Print the tables of docs/theory-bending.md", kExamples);
  auto options = std::make_shared<Options>();
  command.option("study", options->study, "", "Which one")
      .required()
      .one_of<Study>({{"fluid", Study::kFluid}, {"couple", Study::kCouple}, {"accuracy", Study::kAccuracy}});
  add_point(command, options->load, false);
  add_load(command, options->load);
  command.option("--points", options->points, "N", "of accuracy", whole(1, 100000)).shows_default();
  command.option("--seed", options->seed, "N", "of accuracy's points", whole(0, 9007199254740991))
      .shows_default();
  command.option("--inner-radius", options->inner_radius, "L",
                 "of the solution that accuracy compares with; a quarter of the table's if not given",
                 between(1e-6, 0.1));
  command.option("--elements", options->elements, "N",
                 "along its radius; as closely spaced as the table's if not given", whole(8, 400));
  add_threads(command, options->threads);
  add_database_file(command, options->file);
  return {command, [options] { return study(*options); }};
}

}  // namespace polynya::app
