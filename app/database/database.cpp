#include "app/database/database.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "fracture/bending/database_text.hpp"
#include "fracture/crushing.hpp"
#include "geometry/shape/angle.hpp"
#include "io/text/output_file.hpp"
#include "io/text/source_text.hpp"

namespace polynya::app {
namespace {

using DatabasePointer = std::shared_ptr<const fracture::BendingDatabase>;

constexpr double kNarrowestWedge = 0.1;  ///< as --wedge-angle allows [deg]

tl::unexpected<ExitCode> usage(const std::string& problem) {
  return tl::unexpected(fail(kUsage, problem));
}

// ---- polynya database build

constexpr std::size_t kMostWedgeAngles = 64;  ///< what the file's reader takes

constexpr auto kBuildExamples =
    "Examples:\n"
    "  polynya database build                     byte for byte the database that ships with Polynya\n"
    "  polynya database build --fluid winkler --wedge-angles 30,60,90,120 --out winkler.txt\n";

struct BuildOptions {
  std::string out = "icebreaking-database.txt";
  fracture::FluidModel fluid = fracture::FluidModel::kPotential;
  std::vector<double> wedge_angles_deg;  ///< 2α; empty: the shipped database's
  int threads = 0;                       ///< 0: as many as the machine runs at once
  ProgressKind progress = ProgressKind::kAuto;
  bool overwrite = false;
};

/// Whether a file may be written there, before the work.
io::Result<> check_target(const std::filesystem::path& path, bool overwrite) {
  std::error_code ignored;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) return io::fail(folder.string() + ": no such folder");
  if (!std::filesystem::exists(path, ignored)) return {};
  if (!std::filesystem::is_regular_file(path, ignored)) return io::fail(path.string() + ": it is not a file");
  if (!overwrite) return io::fail(path.string() + ": it exists already; --overwrite replaces it");
  return {};
}

ProgressReport report(std::size_t done, std::size_t total, double wall) {
  const double part = static_cast<double>(done) / static_cast<double>(total);
  const double left = part > 0 ? wall * (1 - part) / part : 0;
  return {part, fmt::format("{:3.0f} %  {} of {} wedges  {} left", 100 * part, done, total, clock_time(left)),
          fmt::format(R"({{"wedges":{},"wedges_total":{},"wall_time_s":{:.3f},"time_left_s":{:.1f}}})", done, total,
                      wall, left)};
}

int build(const BuildOptions& options) {
  fracture::DatabaseGrid grid = fracture::default_grid();
  if (const auto& angles = options.wedge_angles_deg; !angles.empty()) {
    if (!fracture::is_grid_axis(angles) || angles.size() > kMostWedgeAngles)
      return fail(kUsage,
                  fmt::format("--wedge-angles takes 2 to {} angles, each above the one before", kMostWedgeAngles));
    grid.opening_angles_deg = angles;
  }
  if (const auto target = check_target(options.out, options.overwrite); !target)
    return fail(kInputOutput, target.error());

  fracture::SolverSettings settings;
  settings.fluid = options.fluid;
  const std::size_t wedges = grid.opening_angles_deg.size() * grid.mass_ratios.size();
  const int threads = std::min(thread_count(options.threads), static_cast<int>(wedges));
  ProgressOutput output(options.progress);
  const auto built = fracture::build_database(settings, grid, threads, [&](std::size_t done, std::size_t total) {
    if (output.is_due()) output.show(report(done, total, output.wall_time()));
  });
  if (!built) return fail(kNumericalFailure, built.error().message + "; nothing was written");
  const double wall = output.wall_time();
  output.finish(report(wedges, wedges, wall));

  const std::string text = fracture::write_database(*built);
  watch_signals();  // a signal waits for the write
  auto written = check_target(options.out, options.overwrite);
  if (written) written = io::write_named_file(options.out, text);
  if (!written) return fail(kInputOutput, written.error());
  print_out("database    {}, {} bytes\n", options.out, text.size());
  print_out("solved      {}, {}, fluid {}, in {:.3g} s on {}\n", counted(wedges, "wedge"),
            counted(built->entries().size(), "push", "pushes"), fracture::fluid_name(options.fluid), wall,
            counted(threads, "thread"));
  print_out("hash        fnv1a64 {}\n", fracture::database_hash(*built));
  if (text == fracture::default_database_text())
    print_out("            byte for byte the database that ships with Polynya\n");
  return kDone;
}

}  // namespace

void add_threads(CommandLine& command, int& threads) {
  command.option("--threads", &threads, "N",
                 "As many as the machine runs at once if not given; no result depends on it", whole(1, 1024));
}

void add_database_file(CommandLine& command, std::string& file) {
  command.option("--database", &file, "FILE", "The database; the shipped one if not given", not_empty());
}

void add_load(CommandLine& command, DatabaseLoadOptions& load) {
  command.option("--wedge-angle", &load.wedge_angle_deg, "DEG", "Opening angle of the wedge of ice",
                 between(kNarrowestWedge, 179.9));
  command.option("--front-angle", &load.front_angle_deg, "DEG", "Instead: from the inward normal to the front edge",
                 between(0, 89.9));
  command.option("--back-angle", &load.back_angle_deg, "DEG", "and to the back edge", between(0, 89.9));
  const auto add = [&command](const char* name, double& value, const char* unit, const char* meaning, double least,
                              double most) {
    command.option(name, &value, unit, meaning, between(least, most),
                   {.shows_default = true, .group = "Ice and water"});
  };
  add("--density", load.ice.density, "KG_PER_M3", "of the ice", 1, 5000);
  add("--youngs-modulus", load.ice.youngs_modulus, "PA", "of the ice", 1e3, 1e12);
  add("--poisson-ratio", load.ice.poisson_ratio, "NU", "of the ice", 0, 0.5);
  add("--flexural-strength", load.ice.flexural_strength, "PA", "of the ice", 1, 1e9);
  add("--compressive-strength", load.ice.compressive_strength, "PA", "of the ice", 1, 1e9);
  add("--friction", load.ice.friction, "MU", "hull on ice", 0, 2);
  add("--water-density", load.water.density, "KG_PER_M3", "", 1, 5000);
}

void add_point(CommandLine& command, DatabaseLoadOptions& load, bool is_required) {
  const auto add = [&](const char* name, double& value, const char* unit, const char* meaning, double least,
                       double most) {
    command.option(name, &value, unit, meaning, between(least, most),
                   {.is_required = is_required, .shows_default = !is_required});
  };
  add("--thickness", load.ice.thickness, "M", "of the ice", 1e-3, 100);
  add("--speed", load.speed, "M_PER_S", "of approach, normal to the hull's waterline", 0, 100);
  add("--hull-angle", load.hull_angle_deg, "DEG", "the hull's inclination from the vertical", 0, 89.9);
}

tl::expected<DatabasePointer, ExitCode> load_database(const std::string& file) {
  // The shipped one lives as long as the program: nothing to delete.
  if (file.empty()) return DatabasePointer(DatabasePointer(), &fracture::default_database());
  const auto text = io::read_text_file(file, fracture::kLargestFile);
  if (!text) return tl::unexpected(fail(kInputOutput, fmt::format("{}: {}", file, text.error())));
  auto database = fracture::parse_database(*text);
  if (database) return std::make_shared<const fracture::BendingDatabase>(*std::move(database));
  print_err("polynya: {}:{}: {}\n", file, database.error().line, database.error().message);
  return tl::unexpected(fail(kInputOutput, file + " is not an icebreaking database that this version reads"));
}

std::string database_title(const std::string& file) {
  return file.empty() ? "the one that ships with Polynya" : file;
}

tl::expected<fracture::BendingLoad, ExitCode> bending_load(const DatabaseLoadOptions& options) {
  const bool has_edges = options.front_angle_deg || options.back_angle_deg;
  if (has_edges && !(options.front_angle_deg && options.back_angle_deg))
    return usage("--front-angle and --back-angle go together");
  if (has_edges && options.wedge_angle_deg)
    return usage("--wedge-angle and the pair --front-angle, --back-angle exclude each other");
  if (has_edges && *options.front_angle_deg + *options.back_angle_deg < kNarrowestWedge)
    return usage("between --front-angle and --back-angle there is no ice");
  if (options.ice.density >= options.water.density)
    return usage(fmt::format("ice of {:g} kg/m3 does not float in water of {:g} kg/m3", options.ice.density,
                             options.water.density));
  fracture::BendingLoad load;
  load.ice = options.ice;
  load.water = options.water;
  const double half_angle = 0.5 * options.wedge_angle_deg.value_or(kUsualWedgeAngle);
  load.front_half_angle = geometry::kRadiansPerDegree * options.front_angle_deg.value_or(half_angle);
  load.back_half_angle = geometry::kRadiansPerDegree * options.back_angle_deg.value_or(half_angle);
  load.hull_angle = geometry::kRadiansPerDegree * options.hull_angle_deg;
  load.mean_approach_speed = options.speed;
  load.vertical_to_crushing =
      fracture::crushing_shares(load.hull_angle, load.ice.friction, options.speed, options.slip_speed).vertical;
  return load;
}

std::string describe(const fracture::BendingLoad& load) {
  const double front = load.front_half_angle / geometry::kRadiansPerDegree;
  const double back = load.back_half_angle / geometry::kRadiansPerDegree;
  const std::string wedge = front == back ? fmt::format("{:g} deg wedge", front + back)
                                          : fmt::format("wedge of {:g} + {:g} deg", front, back);
  return fmt::format("{:g} m of ice, {}, hull {:g} deg from the vertical, v_n {:g} m/s", load.ice.thickness, wedge,
                     load.hull_angle / geometry::kRadiansPerDegree, load.mean_approach_speed);
}

int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

static Command add_build(CommandLine& app) {
  CommandLine command = app.add_command("build", "Solve the wedges and write a database", kBuildExamples);
  auto options = std::make_shared<BuildOptions>();
  command.option("--out", &options->out, "FILE", "The file to write", not_empty(), {.shows_default = true});
  command.choice<fracture::FluidModel>("--fluid", options->fluid, "What the water does; potential if not given",
                                       {{"winkler", fracture::FluidModel::kWinkler},
                                        {"local-mass", fracture::FluidModel::kLocalMass},
                                        {"potential", fracture::FluidModel::kPotential},
                                        {"free-surface", fracture::FluidModel::kFreeSurface}});
  command.option("--wedge-angles", &options->wedge_angles_deg, "DEG,DEG,...",
                 "Opening angles of the wedges, ascending; the shipped database's if not given [deg]", between(5, 180),
                 {.delimiter = ','});
  add_threads(command, options->threads);
  add_progress(command, options->progress);
  command.flag("--overwrite", options->overwrite, "Replace the file");
  return {command, [options] { return build(*options); }};
}

Command add_database(CommandLine& app) {
  CommandLine command = app.add_command(
      "database", "Build, show and query the icebreaking database",
      "Examples:\n"
      "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
      "  polynya database show --svg plots\n"
      "  polynya database build --fluid free-surface\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 4 a wedge does not break, 5 input/output, or a file that is no such "
      "database.\n");
  command.require_command();
  auto commands = std::make_shared<Commands>();
  for (const auto add : {add_build, add_database_show, add_database_query}) commands->push_back(add(command));
  return {command, [commands] { return run_chosen(*commands); }};
}

}  // namespace polynya::app
