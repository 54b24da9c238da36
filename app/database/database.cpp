#include "fracture/bending/database.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "analysis/database_slices.hpp"
#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/fsi_database_model.hpp"
#include "fracture/crushing.hpp"
#include "fracture/materials.hpp"
#include "geometry/shape/angle.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/output_file.hpp"
#include "io/text/source_text.hpp"

namespace polynya::app {
namespace {

using analysis::SlicePoint;
using fracture::BendingCapacity;
using fracture::BendingDatabase;
using fracture::BendingLoad;
using fracture::FsiDatabaseModel;
using geometry::kDegreesPerRadian;
using geometry::kRadiansPerDegree;
using DatabasePointer = std::shared_ptr<const BendingDatabase>;

// ---- common to the commands: the wedge of ice, the database, threads

constexpr double kNarrowestWedge = 0.1;  ///< least value of --wedge-angle [deg]
constexpr double kUsualWedgeAngle = 90;  ///< value if none is given [deg]

/// Options for a wedge of floating ice and the hull that it meets.
struct DatabaseLoadOptions {
  fracture::Ice ice;
  fracture::Water water;
  double speed = 1;                       ///< v_n, normal to the waterline of the hull [m/s]
  double slip_speed = 0;                  ///< v_t, along the waterline [m/s]
  std::optional<double> wedge_angle_deg;  ///< 2α; each edge has half of it
  std::optional<double> front_angle_deg;  ///< θ_wf
  std::optional<double> back_angle_deg;   ///< θ_wb
  double hull_angle_deg = 60;             ///< θ_s, from the vertical
};

/// Adds the options of the ice, the water and the hull. Their defaults are those of the paper.
void add_load(CommandLine& command, DatabaseLoadOptions& load) {
  command.option("--wedge-angle", &load.wedge_angle_deg, "DEG", "Opening angle of the wedge of ice",
                 between(kNarrowestWedge, 179.9));
  command.option("--front-angle", &load.front_angle_deg, "DEG",
                 "Instead of --wedge-angle: angle from the inward normal to the front edge", between(0, 89.9));
  command.option("--back-angle", &load.back_angle_deg, "DEG",
                 "Angle from the inward normal to the back edge, with --front-angle", between(0, 89.9));
  const auto add = [&command](const char* name, double& value, const char* unit, const char* meaning,
                              const auto& allowed) {
    command.option(name, &value, unit, meaning, allowed, {.shows_default = true, .group = "Ice and water"});
  };
  add("--density", load.ice.density, "KG_PER_M3", "Density of the ice", between(1, 5000));
  add("--youngs-modulus", load.ice.youngs_modulus, "PA", "Young's modulus of the ice", between(1e3, 1e12));
  add("--poisson-ratio", load.ice.poisson_ratio, "NU", "Poisson ratio of the ice", between(0, 0.5));
  add("--flexural-strength", load.ice.flexural_strength, "PA", "Flexural strength of the ice", between(1, 1e9));
  add("--compressive-strength", load.ice.compressive_strength, "PA", "Compressive strength of the ice",
      between(1, 1e9));
  add("--friction", load.ice.friction, "MU", "Coefficient of friction between hull and ice", between(0, 2));
  add("--water-density", load.water.density, "KG_PER_M3", "Density of the water", between(1, 5000));
}

/// Adds the options for the thickness and speed of the load. They are required, or have the defaults of a slice.
void add_point(CommandLine& command, DatabaseLoadOptions& load, bool is_required) {
  const auto add = [&](const char* name, double& value, const char* unit, const char* meaning, const auto& allowed) {
    command.option(name, &value, unit, meaning, allowed, {.is_required = is_required, .shows_default = !is_required});
  };
  add("--thickness", load.ice.thickness, "M", "Thickness of the ice", between(1e-3, 100));
  add("--speed", load.speed, "M_PER_S", "Speed of approach, normal to the hull's waterline", between(0, 100));
  add("--hull-angle", load.hull_angle_deg, "DEG", "Inclination of the hull from the vertical", between(0, 89.9));
}

/// Loads the database in a file, or the shipped one if the name is empty. If the file cannot be read, or is no database
/// of this version, reports it on stderr and returns kInputOutput.
Outcome<DatabasePointer> load_database(const std::string& file) {
  // The shipped database exists as long as the program, so there is nothing to delete.
  if (file.empty()) return DatabasePointer(DatabasePointer(), &fracture::default_database());
  const auto text = io::read_text_file(file, fracture::kLargestFile);
  if (!text) return failure(kInputOutput, fmt::format("{}: {}", file, text.error()));
  auto database = fracture::parse_database(*text);
  if (database) return std::make_shared<const BendingDatabase>(*std::move(database));
  print_err("polynya: {}:{}: {}\n", file, database.error().line, database.error().message);
  return failure(kInputOutput, file + " is not an icebreaking database that this version reads");
}

std::string database_title(const std::string& file) {
  return file.empty() ? "the one that ships with Polynya" : file;
}

/// Returns the load, with c_V from the hull's angle, the friction and the slip. Reports options that contradict each
/// other on stderr.
Outcome<BendingLoad> bending_load(const DatabaseLoadOptions& options) {
  const bool has_edges = options.front_angle_deg || options.back_angle_deg;
  if (has_edges && !(options.front_angle_deg && options.back_angle_deg))
    return failure(kUsage, "--front-angle and --back-angle go together");
  if (has_edges && options.wedge_angle_deg)
    return failure(kUsage, "--wedge-angle and the pair --front-angle, --back-angle exclude each other");
  if (has_edges && *options.front_angle_deg + *options.back_angle_deg < kNarrowestWedge)
    return failure(kUsage, "between --front-angle and --back-angle there is no ice");
  if (options.ice.density >= options.water.density)
    return failure(kUsage, fmt::format("ice of {:g} kg/m3 does not float in water of {:g} kg/m3", options.ice.density,
                                       options.water.density));
  BendingLoad load;
  load.ice = options.ice;
  load.water = options.water;
  const double half_angle = 0.5 * options.wedge_angle_deg.value_or(kUsualWedgeAngle);
  load.front_half_angle = kRadiansPerDegree * options.front_angle_deg.value_or(half_angle);
  load.back_half_angle = kRadiansPerDegree * options.back_angle_deg.value_or(half_angle);
  load.hull_angle = kRadiansPerDegree * options.hull_angle_deg;
  load.mean_approach_speed = options.speed;
  load.vertical_to_crushing =
      fracture::crushing_shares(load.hull_angle, load.ice.friction, options.speed, options.slip_speed).vertical;
  return load;
}

/// Returns "0.5 m of ice, 90 deg wedge, hull 60 deg from the vertical, v_n 1 m/s".
std::string describe(const BendingLoad& load) {
  const double front = load.front_half_angle / kRadiansPerDegree;
  const double back = load.back_half_angle / kRadiansPerDegree;
  const std::string wedge = front == back ? fmt::format("{:g} deg wedge", front + back)
                                          : fmt::format("wedge of {:g} + {:g} deg", front, back);
  return fmt::format("{:g} m of ice, {}, hull {:g} deg from the vertical, v_n {:g} m/s", load.ice.thickness, wedge,
                     load.hull_angle / kRadiansPerDegree, load.mean_approach_speed);
}

// ---- polynya database build

constexpr std::size_t kMostWedgeAngles = 64;  ///< the reader of the file accepts no more

constexpr auto kBuildExamples =
    "Examples:\n"
    "  polynya database build                     byte for byte the database that ships with Polynya\n"
    "  polynya database build --fluid winkler --wedge-angles 30,60,90,120 --out winkler.txt\n";

struct BuildOptions {
  std::string out = "icebreaking-database.txt";
  fracture::FluidModel fluid = fracture::FluidModel::kPotential;
  std::vector<double> wedge_angles_deg;  ///< 2α; empty: those of the shipped database
  int threads = 0;                       ///< 0: as many as the machine can run at once
  ProgressKind progress = ProgressKind::kAuto;
  bool overwrite = false;
};

/// Checks before the computation that the file can be written.
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
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int threads = std::min(options.threads > 0 ? options.threads : machine, static_cast<int>(wedges));
  ProgressOutput output(options.progress);
  const auto built = fracture::build_database(settings, grid, threads, [&](std::size_t done, std::size_t total) {
    if (output.is_due()) output.show(report(done, total, output.wall_time()));
  });
  if (!built) return fail(kNumericalFailure, built.error().message + "; nothing was written");
  const double wall = output.wall_time();
  output.finish(report(wedges, wedges, wall));

  const std::string text = fracture::write_database(*built);
  watch_signals();  // a signal takes effect after the write
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

Command add_build(CommandLine& app) {
  CommandLine command = app.add_command("build", "Solve the wedges and write a database", kBuildExamples);
  auto options = std::make_shared<BuildOptions>();
  command.option("--out", &options->out, "FILE", "The file to write", not_empty(), {.shows_default = true});
  command.choice<fracture::FluidModel>("--fluid", options->fluid, "Model of the water; potential if not given",
                                       {{"winkler", fracture::FluidModel::kWinkler},
                                        {"local-mass", fracture::FluidModel::kLocalMass},
                                        {"potential", fracture::FluidModel::kPotential},
                                        {"free-surface", fracture::FluidModel::kFreeSurface}});
  command.option("--wedge-angles", &options->wedge_angles_deg, "DEG,DEG,...",
                 "Opening angles of the wedges, ascending [deg]; those of the shipped database if not given",
                 between(5, 180), {.delimiter = ','});
  command.option("--threads", &options->threads, "N",
                 "Number of threads; as many as the machine can run at once if not given; results do not depend on it",
                 whole(1, 1024));
  add_progress(command, options->progress);
  command.flag("--overwrite", options->overwrite, "Replace an existing file");
  return {command, [options] { return build(*options); }};
}

// ---- polynya database query

constexpr auto kQueryExamples =
    "Examples:\n"
    "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
    "  polynya database query --thickness 1 --speed 2 --front-angle 30 --back-angle 70 --hull-angle 50 --json\n";

struct QueryOptions {
  std::string file;  ///< empty: the shipped database
  DatabaseLoadOptions load;
  bool json = false;
};

/// Returns true if the hull presses the ice down. Otherwise the ice crushes and never bends.
bool can_bend(const BendingLoad& load) {
  return load.vertical_to_crushing > 0;
}

void write_load(io::JsonWriter& json, const DatabaseLoadOptions& options, const BendingLoad& load) {
  const double half_angle_deg = 0.5 * options.wedge_angle_deg.value_or(0);
  for (const auto& [key, value] : {std::pair{"thickness_m", load.ice.thickness},
                                   {"density_kg_per_m3", load.ice.density},
                                   {"youngs_modulus_Pa", load.ice.youngs_modulus},
                                   {"poisson_ratio", load.ice.poisson_ratio},
                                   {"flexural_strength_Pa", load.ice.flexural_strength},
                                   {"compressive_strength_Pa", load.ice.compressive_strength},
                                   {"friction", load.ice.friction},
                                   {"water_density_kg_per_m3", load.water.density},
                                   {"speed_m_per_s", load.mean_approach_speed},
                                   {"front_angle_deg", options.front_angle_deg.value_or(half_angle_deg)},
                                   {"back_angle_deg", options.back_angle_deg.value_or(half_angle_deg)},
                                   {"hull_angle_deg", options.hull_angle_deg},
                                   {"slip_speed_m_per_s", options.slip_speed},
                                   {"vertical_to_crushing", load.vertical_to_crushing}})
    json.key(key).value(value);
}

void write_groups(io::JsonWriter& json, const fracture::ScaledLoad& scaled, const fracture::BendingForecast& forecast) {
  json.key("opening_angle_deg").value(scaled.groups.opening_angle * kDegreesPerRadian);
  json.key("mass_ratio").value(scaled.groups.mass_ratio).key("softness").value(scaled.groups.softness);
  json.key("equivalent_softness").value(forecast.equivalent_softness).key("froude").value(scaled.groups.froude);
  json.key("characteristic_length_m").value(scaled.length_scale);
}

/// Returns the answer as JSON. Numbers are null if the ice cannot bend.
std::string json_of(const QueryOptions& options, const BendingDatabase& database, const BendingLoad& load,
                    const SlicePoint& answer) {
  const bool is_known = can_bend(load);
  const auto write = [&](io::JsonWriter& json) {
    const auto number = [&](std::string_view key, double value) {
      json.key(key).value(is_known ? std::optional(value) : std::nullopt);
    };
    const auto published = [&](std::string_view key, const BendingCapacity& capacity) {
      json.key(key).object([&] {
        number("vertical_force_N", capacity.vertical_force);
        number("cusp_radius_m", capacity.cusp_radius);
        json.key("in_range").value(is_known && capacity.is_in_range);
      });
    };
    const fracture::BendingForecast& forecast = answer.database;
    number("vertical_force_N", forecast.capacity.vertical_force);
    number("normal_force_N", forecast.normal_force);
    number("time_s", forecast.time);
    number("cusp_radius_m", forecast.capacity.cusp_radius);
    number("penetration_m", forecast.penetration);
    json.key("radial_crack_first").value(is_known && forecast.capacity.radial_crack_first);
    json.key("in_range").value(is_known && forecast.capacity.is_in_range);
    std::vector<std::string_view> outside;
    for (const fracture::OutsideRange& range : forecast.outside) outside.push_back(range.name);
    json.key("outside").list(is_known ? outside : std::vector<std::string_view>{"hull angle"});
    published("nevel", answer.nevel);
    published("kashtelyan", answer.kashtelyan);
    json.key("load").object([&] { write_load(json, options.load, load); });
    json.key("groups").object([&] { write_groups(json, fracture::scaled(load), forecast); });
    json.key("database").open('{').key("file");
    json.value(options.file.empty() ? std::nullopt : std::optional(options.file));
    json.key("fluid").value(fracture::fluid_name(database.settings().fluid));
    json.key("hash").value("fnv1a64 " + fracture::database_hash(database)).close('}');
  };
  return io::json_object(write, io::JsonWriter::Layout::kIndented);
}

void print_table(const SlicePoint& answer) {
  const fracture::BendingForecast& forecast = answer.database;
  const auto row = [](const char* what, const std::string& database, const std::string& of_nevel = "",
                      const std::string& of_kashtelyan = "") {
    const std::string line = fmt::format("{:<22}{:<20}{:<20}{}", what, database, of_nevel, of_kashtelyan);
    print_out("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  };
  const auto row_of_all = [&](const char* what, auto show) {
    row(what, show(forecast.capacity), show(answer.nevel), show(answer.kashtelyan));
  };
  const auto yes_or_no = [](bool is_so) { return std::string(is_so ? "yes" : "no"); };
  row("", "database", "Nevel", "Kashtelyan");
  row_of_all("vertical force", [](const auto& c) { return fmt::format("{:.4g} kN", c.vertical_force / 1e3); });
  row_of_all("cusp radius", [](const auto& c) { return fmt::format("{:.4g} m", c.cusp_radius); });
  row("normal force", fmt::format("{:.4g} kN", forecast.normal_force / 1e3));
  row("penetration", fmt::format("{:.4g} m", forecast.penetration));
  row("time to the break", std::isfinite(forecast.time) ? fmt::format("{:.4g} s", forecast.time) : "never: at rest");
  row("radial crack first", yes_or_no(forecast.capacity.radial_crack_first));
  row_of_all("in range", [&](const auto& c) { return yes_or_no(c.is_in_range); });
}

void print_for_people(const QueryOptions& options, const BendingDatabase& database, const BendingLoad& load,
                      const SlicePoint& answer) {
  const fracture::ScaledLoad scaled = fracture::scaled(load);
  print_out("load      {}\n", describe(load));
  print_out("groups    2a {:g} deg, m {:.4g}, softness {:.4g}, Fr {:.4g}; l {:.4g} m\n",
            scaled.groups.opening_angle * kDegreesPerRadian, scaled.groups.mass_ratio, scaled.groups.softness,
            scaled.groups.froude, scaled.length_scale);
  if (answer.database.equivalent_softness != scaled.groups.softness)
    print_out("          crushes through the thickness: equivalent softness {:.4g}\n",
              answer.database.equivalent_softness);
  print_out("database  {}: fluid {}, hash {}\n", database_title(options.file),
            fracture::fluid_name(database.settings().fluid), fracture::database_hash(database));
  print_out("\n");
  if (can_bend(load))
    print_table(answer);
  else
    print_out("The ice only crushes: friction outweighs what presses it down.\n");
}

/// Returns "softness 0.2, the table's 3e-05 to 0.1; Poisson ratio 0.25, the table's 0.3".
std::string with_ranges(const std::vector<fracture::OutsideRange>& ranges) {
  std::vector<std::string> parts;
  parts.reserve(ranges.size());
  for (const auto& [name, value, least, most] : ranges)
    parts.push_back(fmt::format("{} {:.4g}, the table's {:g}", name, value, least) +
                    (most > least ? fmt::format(" to {:g}", most) : ""));
  return fmt::format("{}", fmt::join(parts, "; "));
}

int query(const QueryOptions& options) {
  if (!options.load.wedge_angle_deg && !options.load.front_angle_deg && !options.load.back_angle_deg)
    return fail(kUsage, "the opening of the wedge is missing: give --wedge-angle, or --front-angle and --back-angle");
  const auto load = bending_load(options.load);
  if (!load) return load.error();
  const auto database = load_database(options.file);
  if (!database) return database.error();
  const SlicePoint answer = analysis::compare_models(FsiDatabaseModel(*database), *load);
  if (options.json)
    write_out(json_of(options, **database, *load, answer));
  else
    print_for_people(options, **database, *load, answer);
  if (!can_bend(*load))
    print_err("note: a hull {:g} deg from the vertical only crushes ice of friction {:g}\n",
              load->hull_angle * kDegreesPerRadian, load->ice.friction);
  else if (!answer.database.outside.empty())
    print_err("note: outside the database: {}; the answer is its nearest edge's\n",
              with_ranges(answer.database.outside));
  return kDone;
}

Command add_query(CommandLine& app) {
  CommandLine command = app.add_command(
      "query", "Bending capacity of a wedge of ice by the database and by published formulas", kQueryExamples);
  auto options = std::make_shared<QueryOptions>();
  add_point(command, options->load, true);
  add_load(command, options->load);
  command.option("--slip-speed", &options->load.slip_speed, "M_PER_S", "Speed along the hull's waterline",
                 between(-100, 100), {.shows_default = true});
  command.option("--database", &options->file, "FILE", "File of the database; the shipped one if not given",
                 not_empty());
  command.flag("--json", options->json, "Print the answer as JSON in SI units");
  return {command, [options] { return query(*options); }};
}

// ---- polynya database show

struct ShowOptions {
  std::string file;        ///< empty: the shipped database
  std::string svg_folder;  ///< empty: no pictures
  DatabaseLoadOptions load;
};

void print_parameters(const BendingDatabase& database, const std::string& file) {
  const fracture::SolverSettings& settings = database.settings();
  const std::string hash = fracture::database_hash(database);
  const bool is_shipped = !file.empty() && hash == fracture::database_hash(fracture::default_database());
  print_out("database        {}{}\n", database_title(file), is_shipped ? ", the one that ships with Polynya" : "");
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

/// Writes the slices to slices.json in the folder, which is created if necessary. Python then draws them.
int draw_slices(const std::string& slices, const std::filesystem::path& folder) {
  if (const auto made = make_folder(folder); !made) return fail(kInputOutput, made.error());
  const std::filesystem::path file = folder / "slices.json";
  if (const auto written = io::write_named_file(file, slices); !written) return fail(kInputOutput, written.error());
  print_out("\nnumbers         {}\n", file.string());
  return become_python({"database", file.string()});
}

int show(const ShowOptions& options) {
  const auto load = bending_load(options.load);
  if (!load) return load.error();
  if (load->vertical_to_crushing <= 0)
    return fail(kUsage, fmt::format("a hull {:g} deg from the vertical only crushes ice of friction {:g}",
                                    load->hull_angle * kDegreesPerRadian, load->ice.friction));
  const auto database = load_database(options.file);
  if (!database) return database.error();
  print_parameters(**database, options.file);
  print_grids(**database);
  if (options.svg_folder.empty()) return kDone;
  const std::string title = fmt::format("{}, fluid {}", options.file.empty() ? "shipped" : options.file,
                                        fracture::fluid_name((*database)->settings().fluid));
  return draw_slices(analysis::database_slices(FsiDatabaseModel(*database), title, *load, describe(*load)),
                     options.svg_folder);
}

Command add_show(CommandLine& app) {
  CommandLine command =
      app.add_command("show", "Print a database's parameters and grids, and plot slices",
                      "Examples:\n"
                      "  polynya database show                      the database that ships with Polynya\n"
                      "  polynya database show winkler.txt --svg plots --thickness 1\n");
  auto options = std::make_shared<ShowOptions>();
  command.option("file", &options->file, "FILE", "File of the database; the shipped one if not given", not_empty());
  command.option("--svg", &options->svg_folder, "DIR",
                 "Draw slices to speed.svg, wedge-angle.svg and thickness.svg in this folder, with their numbers in "
                 "slices.json (needs Python and matplotlib: ./setup.sh python)",
                 not_empty());
  add_point(command, options->load, false);
  add_load(command, options->load);
  return {command, [options] { return show(*options); }};
}

}  // namespace

Command add_database(CommandLine& app) {
  CommandLine command = app.add_command(
      "database", "Build, show and query the icebreaking database",
      "Examples:\n"
      "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
      "  polynya database show --svg plots\n"
      "  polynya database build --fluid free-surface\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 4 a wedge does not break, 5 input/output, or a file that is no such database.\n");
  command.require_command();
  auto commands = std::make_shared<Commands>();
  for (const auto add : {add_build, add_show, add_query}) commands->push_back(add(command));
  return {command, [commands] { return run_chosen(*commands); }};
}

}  // namespace polynya::app
