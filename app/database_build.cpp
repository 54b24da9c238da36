#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/database_input.hpp"
#include "app/stop_signal.hpp"
#include "fracture/bending/database_text.hpp"
#include "io/text/output_file.hpp"

namespace polynya::app {
namespace {

constexpr std::size_t kMostWedgeAngles = 64;  ///< what the file's reader takes

constexpr auto kExamples =
    "Examples:\n"
    "  polynya database build                     byte for byte the database that ships with Polynya\n"
    "  polynya database build --fluid winkler --wedge-angles 30,60,90,120 --out winkler.txt\n";

struct Options {
  std::string out = "icebreaking-database.txt";
  fracture::FluidModel fluid = fracture::FluidModel::kPotential;
  std::vector<double> wedge_angles_deg;  ///< 2α; empty: the shipped database's
  int threads = 0;                       ///< 0: as many as the machine runs at once
  ProgressKind progress = ProgressKind::kAuto;
  bool overwrite = false;
};

/// Whether the file can be written there: tried before the work, with the temporary file that the write
/// begins with.
io::Result<> check_target(const std::filesystem::path& path, bool overwrite) {
  std::error_code ignored;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, ignored)) return io::fail(folder.string() + ": no such folder");
  if (!std::filesystem::exists(path, ignored)) return io::trial_of_named_file(path);
  if (!std::filesystem::is_regular_file(path, ignored)) return io::fail(path.string() + ": it is not a file");
  if (!overwrite) return io::fail(path.string() + ": it exists already; --overwrite replaces it");
  return io::trial_of_named_file(path);
}

ProgressReport report(std::size_t done, std::size_t total, double wall) {
  const double part = static_cast<double>(done) / static_cast<double>(total);
  const double left = part > 0 ? wall * (1 - part) / part : 0;
  return {part, fmt::format(" {:3.0f} %  {}/{} wedges  {} left", 100 * part, done, total, clock_time(left)),
          fmt::format("{:3.0f} %  {} of {} wedges, {} left", 100 * part, done, total, clock_time(left)),
          fmt::format(R"({{"wedges":{},"wedges_total":{},"wall_time_s":{:.3f},"time_left_s":{:.1f}}})", done,
                      total, wall, left)};
}

int build(const Options& options) {
  fracture::DatabaseGrid grid = fracture::default_grid();
  if (const auto& angles = options.wedge_angles_deg; !angles.empty()) {
    if (!fracture::is_grid_axis(angles) || angles.size() > kMostWedgeAngles)
      return fail(kUsage, fmt::format("--wedge-angles takes 2 to {} angles, each above the one before",
                                      kMostWedgeAngles));
    grid.opening_angles_deg = angles;
  }
  if (const auto target = check_target(options.out, options.overwrite); !target)
    return fail(kInputOutput, target.error());

  fracture::SolverSettings settings;
  settings.fluid = options.fluid;
  const std::size_t wedges = grid.opening_angles_deg.size() * grid.mass_ratios.size();
  const int threads = std::min(thread_count(options.threads), static_cast<int>(wedges));
  ProgressOutput output(options.progress);
  const auto built =
      fracture::build_database(settings, grid, threads, [&](std::size_t done, std::size_t total) {
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

Command add_database_build(CommandLine& app) {
  CommandLine command = app.add_command("build", "Solve the wedges and write a database", kExamples);
  auto options = std::make_shared<Options>();
  command.option("--out", options->out, "FILE", "The file to write", not_empty()).shows_default();
  command.option("--fluid", options->fluid, "", "What the water does; potential if not given")
      .one_of<fracture::FluidModel>({{"winkler", fracture::FluidModel::kWinkler},
                                     {"local-mass", fracture::FluidModel::kLocalMass},
                                     {"potential", fracture::FluidModel::kPotential},
                                     {"free-surface", fracture::FluidModel::kFreeSurface}});
  command
      .option("--wedge-angles", options->wedge_angles_deg, "DEG,DEG,...",
              "Opening angles of the wedges, ascending; the shipped database's if not given [deg]",
              between(5, 180))
      .separated_by(',');
  add_threads(command, options->threads);
  add_progress(command, options->progress);
  command.flag("--overwrite", options->overwrite, "Replace the file");
  return {command, [options] { return build(*options); }};
}

}  // namespace polynya::app
