#include "app/database_input.hpp"

#include <algorithm>
#include <numbers>
#include <thread>
#include <utility>

#include "app/console.hpp"
#include "fracture/bending/database_text.hpp"
#include "fracture/crushing.hpp"
#include "io/text/source_text.hpp"

namespace polynya::app {
namespace {

using DatabasePointer = std::shared_ptr<const fracture::BendingDatabase>;

constexpr double kRadian = std::numbers::pi / 180;

constexpr double kNarrowestWedge = 0.1;  ///< as --wedge-angle allows [deg]

tl::unexpected<ExitCode> usage(const std::string& problem) {
  return tl::unexpected(fail(kUsage, problem));
}

}  // namespace

void add_threads(CommandLine& command, int& threads) {
  command.option("--threads", threads, "N",
                 "As many as the machine runs at once if not given; no result depends on it", whole(1, 1024));
}

void add_database_file(CommandLine& command, std::string& file) {
  command.option("--database", file, "FILE", "The database; the shipped one if not given", not_empty());
}

void add_load(CommandLine& command, DatabaseLoadOptions& load) {
  command.option("--wedge-angle", load.wedge_angle_deg, "DEG", "Opening angle of the wedge of ice",
                 between(kNarrowestWedge, 179.9));
  command.option("--front-angle", load.front_angle_deg, "DEG",
                 "Instead: from the inward normal to the front edge", between(0, 89.9));
  command.option("--back-angle", load.back_angle_deg, "DEG", "and to the back edge", between(0, 89.9));
  const auto add = [&command](const char* name, double& value, const char* unit, const char* meaning,
                              double least, double most) {
    command.option(name, value, unit, meaning, between(least, most))
        .in_group("Ice and water")
        .shows_default();
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
    auto added = command.option(name, value, unit, meaning, between(least, most));
    if (is_required)
      added.required();
    else
      added.shows_default();
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
  load.front_half_angle = kRadian * options.front_angle_deg.value_or(half_angle);
  load.back_half_angle = kRadian * options.back_angle_deg.value_or(half_angle);
  load.hull_angle = kRadian * options.hull_angle_deg;
  load.mean_approach_speed = options.speed;
  load.vertical_to_crushing =
      fracture::crushing_shares(load.hull_angle, load.ice.friction, options.speed, options.slip_speed)
          .vertical;
  return load;
}

std::string describe(const fracture::BendingLoad& load) {
  const double front = load.front_half_angle / kRadian, back = load.back_half_angle / kRadian;
  const std::string wedge = front == back ? fmt::format("{:g} deg wedge", front + back)
                                          : fmt::format("wedge of {:g} + {:g} deg", front, back);
  return fmt::format("{:g} m of ice, {}, hull {:g} deg from the vertical, v_n {:g} m/s", load.ice.thickness,
                     wedge, load.hull_angle / kRadian, load.mean_approach_speed);
}

int thread_count(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace polynya::app
