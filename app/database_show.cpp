#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/database_input.hpp"
#include "app/database_plots.hpp"
#include "app/python.hpp"
#include "app/write_output.hpp"
#include "fracture/bending/database_text.hpp"
#include "fracture/bending/studies.hpp"
#include "io/text/output_file.hpp"

namespace polynya::app {
namespace {

using fracture::BendingDatabase;
using fracture::BendingLoad;
using fracture::FsiDatabaseModel;
using fracture::SliceAxis;
using fracture::SlicePoint;

struct Options {
  std::string file;        ///< empty: the shipped one
  std::string svg_folder;  ///< empty: no pictures
  DatabaseLoadOptions load;
};

void print_parameters(const BendingDatabase& database, const std::string& file) {
  const fracture::SolverSettings& settings = database.settings();
  const std::string hash = fracture::database_hash(database);
  const bool is_shipped = !file.empty() && hash == fracture::database_hash(fracture::default_database());
  print_out("database        {}{}\n", database_title(file),
            is_shipped ? ", the one that ships with Polynya" : "");
  print_out("format          polynya-bending-database 1\n");
  print_out("hash            fnv1a64 {}\n", hash);
  print_out("fluid           {}\n", fracture::fluid_name(settings.fluid));
  print_out("Poisson ratio   {:g}\n", settings.poisson_ratio);
  if (settings.fluid == fracture::FluidModel::kLocalMass)
    print_out("added mass      {:g} rho_w l\n", settings.local_mass);
  print_out("plate           {} elements from {:g} l to {:g} l, {} angular terms\n", settings.radial_elements,
            settings.inner_radius, settings.outer_radius, settings.angular_terms);
  print_out("water           {} x {} panels on the half wedge", settings.panel_rings, settings.panel_columns);
  if (settings.fluid == fracture::FluidModel::kFreeSurface)
    print_out(", x {} on the open water", settings.free_surface_columns);
  print_out("\nmarch           {} steps to failure\n", settings.steps_to_failure);
}

void print_axis(const char* name, const std::vector<double>& values) {
  std::string line = fmt::format("{:<16}{:>2}:", name, values.size());
  for (const double value : values) line += fmt::format(" {:g}", value);
  print_out("{}\n", line);
}

void print_grids(const BendingDatabase& database) {
  const fracture::DatabaseGrid& grid = database.grid();
  print_axis("2a [deg]", grid.opening_angles_deg);
  print_axis("m", grid.mass_ratios);
  print_axis("softness", grid.softnesses);
  print_axis("Fr", grid.froude_numbers);
  print_out("entries         {}: V/(sigma_f h2), R/l, crack ratio\n", database.entries().size());
}

/// A star where the table had to be left.
std::string_view star(bool is_in_range) {
  return is_in_range ? "" : "*";
}

void print_slice(const FsiDatabaseModel& model, const BendingLoad& load, SliceAxis axis, const char* abscissa,
                 std::span<const double> values) {
  print_out("\n| {} | V kN | R m | t s | crack first | Nevel V kN | R m | Kashtelyan V kN | R m |\n",
            abscissa);
  print_out("|---|---|---|---|---|---|---|---|---|\n");
  const double scale = axis == SliceAxis::kOpeningAngle ? kDegree : 1;
  for (const SlicePoint& point : slice(model, load, axis, values)) {
    const auto& [x, forecast, nevel, kashtelyan] = point;
    print_out("| {:g} | {:.4g}{} | {:.3f} | {:.3g} | {} | {:.4g}{} | {:.3f} | {:.4g}{} | {:.3f} |\n",
              x * scale, forecast.capacity.vertical_force / 1e3, star(forecast.capacity.is_in_range),
              forecast.capacity.cusp_radius, forecast.time,
              forecast.capacity.radial_crack_first ? "yes" : "no", nevel.vertical_force / 1e3,
              star(nevel.is_in_range), nevel.cusp_radius, kashtelyan.vertical_force / 1e3,
              star(kashtelyan.is_in_range), kashtelyan.cusp_radius);
  }
}

void print_slices(const FsiDatabaseModel& model, const BendingLoad& load) {
  print_out("\nSlices through {}; * outside of the table, or of the published form's range\n",
            describe(load));
  constexpr double kSpeeds[] = {0.05, 0.1, 0.2, 0.5, 1, 2, 4, 8};
  constexpr double kThicknesses[] = {0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3};
  std::vector<double> angles{20, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165};
  for (double& angle : angles) angle /= kDegree;
  print_slice(model, load, SliceAxis::kSpeed, "v_n m/s", kSpeeds);
  print_slice(model, load, SliceAxis::kOpeningAngle, "2a deg", angles);
  print_slice(model, load, SliceAxis::kThickness, "h m", kThicknesses);
}

/// The slices into slices.json of the folder, which is made where it is missing; Python draws them.
int draw_slices(const std::string& slices, const std::filesystem::path& folder) {
  if (const auto made = make_folder(folder); !made) return fail(kInputOutput, made.error());
  const std::filesystem::path file = folder / "slices.json";
  if (const auto written = io::write_named_file(file, slices); !written)
    return fail(kInputOutput, written.error());
  print_out("\nnumbers         {}\n", file.string());
  return become_python({"database", file.string()});
}

int show(const Options& options) {
  const auto load = bending_load(options.load);
  if (!load) return load.error();
  if (load->vertical_to_crushing <= 0)
    return fail(kUsage, fmt::format("a hull {:g} deg from the vertical only crushes ice of friction {:g}",
                                    load->hull_angle * kDegree, load->ice.friction));
  const auto database = load_database(options.file);
  if (!database) return database.error();
  const FsiDatabaseModel model(*database);
  print_parameters(**database, options.file);
  print_grids(**database);
  print_slices(model, *load);
  if (options.svg_folder.empty()) return kDone;
  const std::string title = fmt::format("{}, fluid {}", options.file.empty() ? "shipped" : options.file,
                                        fracture::fluid_name((*database)->settings().fluid));
  return draw_slices(database_slices(model, title, *load), options.svg_folder);
}

}  // namespace

Command add_database_show(CommandLine& app) {
  CommandLine command =
      app.add_command("show", "Print a database's parameters, grids and slices, and plot them",
                      "Examples:\n"
                      "  polynya database show                      the database that ships with Polynya\n"
                      "  polynya database show winkler.txt --svg plots --thickness 1\n");
  auto options = std::make_shared<Options>();
  command.option("file", options->file, "FILE", "The database; the shipped one if not given", not_empty());
  command.option(
      "--svg", options->svg_folder, "DIR",
      "Draw the slices to speed.svg, wedge-angle.svg, thickness.svg, with their numbers in slices.json "
      "(needs "
      "Python and matplotlib: ./setup.sh python)",
      not_empty());
  add_point(command, options->load, false);
  add_load(command, options->load);
  return {command, [options] { return show(*options); }};
}

}  // namespace polynya::app
