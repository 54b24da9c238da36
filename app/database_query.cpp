#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/database_input.hpp"
#include "fracture/bending/database_text.hpp"
#include "fracture/bending/scaled_load.hpp"
#include "fracture/bending/studies.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::app {
namespace {

using fracture::BendingCapacity;
using fracture::BendingDatabase;
using fracture::BendingLoad;
using fracture::SlicePoint;

constexpr auto kExamples =
    "Examples:\n"
    "  polynya database query --thickness 0.5 --speed 0.89 --wedge-angle 90 --hull-angle 60\n"
    "  polynya database query --thickness 1 --speed 2 --front-angle 30 --back-angle 70 --hull-angle 50 "
    "--json\n";

struct Options {
  std::string file;  ///< empty: the shipped one
  DatabaseLoadOptions load;
  bool json = false;
};

/// Whether the hull presses the ice down at all; where it does not, the ice crushes and never bends.
bool can_bend(const BendingLoad& load) {
  return load.vertical_to_crushing > 0;
}

// ---- as JSON

/// A member; null where the ice cannot bend.
void write_number(io::JsonWriter& json, std::string_view key, double value, bool is_known) {
  json.key(key).value(is_known ? std::optional(value) : std::nullopt);
}

void write_published(io::JsonWriter& json, std::string_view name, const BendingCapacity& capacity,
                     bool is_known) {
  json.key(name).open('{');
  write_number(json, "vertical_force_N", capacity.vertical_force, is_known);
  write_number(json, "cusp_radius_m", capacity.cusp_radius, is_known);
  json.key("in_range").value(is_known && capacity.is_in_range).close('}');
}

void write_outside(io::JsonWriter& json, const std::vector<fracture::OutsideRange>& ranges, bool is_known) {
  json.key("outside").open('[');
  if (!is_known) json.value("hull angle");
  for (const fracture::OutsideRange& range : ranges)
    if (is_known) json.value(range.name);
  json.close(']');
}

void write_load(io::JsonWriter& json, const DatabaseLoadOptions& options, const BendingLoad& load) {
  json.key("load").open('{');
  const auto item = [&json](std::string_view key, double value) { json.key(key).value(value); };
  item("thickness_m", load.ice.thickness);
  item("density_kg_per_m3", load.ice.density);
  item("youngs_modulus_Pa", load.ice.youngs_modulus);
  item("poisson_ratio", load.ice.poisson_ratio);
  item("flexural_strength_Pa", load.ice.flexural_strength);
  item("compressive_strength_Pa", load.ice.compressive_strength);
  item("friction", load.ice.friction);
  item("water_density_kg_per_m3", load.water.density);
  item("speed_m_per_s", load.mean_approach_speed);
  const double half_angle_deg = 0.5 * options.wedge_angle_deg.value_or(0);
  item("front_angle_deg", options.front_angle_deg.value_or(half_angle_deg));
  item("back_angle_deg", options.back_angle_deg.value_or(half_angle_deg));
  item("hull_angle_deg", options.hull_angle_deg);
  item("slip_speed_m_per_s", options.slip_speed);
  item("vertical_to_crushing", load.vertical_to_crushing);
  json.close('}');
}

void write_groups(io::JsonWriter& json, const fracture::ScaledLoad& scaled,
                  const fracture::BendingForecast& forecast) {
  json.key("groups").open('{');
  json.key("opening_angle_deg").value(scaled.groups.opening_angle * kDegree);
  json.key("mass_ratio").value(scaled.groups.mass_ratio);
  json.key("softness").value(scaled.groups.softness);
  json.key("equivalent_softness").value(forecast.equivalent_softness);
  json.key("froude").value(scaled.groups.froude);
  json.key("characteristic_length_m").value(scaled.length_scale).close('}');
}

void print_json(const Options& options, const BendingDatabase& database, const BendingLoad& load,
                const SlicePoint& answer) {
  std::string text;
  io::JsonWriter json(text, io::JsonWriter::Layout::kIndented);
  const bool is_known = can_bend(load);
  const fracture::BendingForecast& forecast = answer.database;
  json.open('{');
  const auto item = [&](std::string_view key, double value) { write_number(json, key, value, is_known); };
  item("vertical_force_N", forecast.capacity.vertical_force);
  item("normal_force_N", forecast.normal_force);
  item("time_s", forecast.time);
  item("cusp_radius_m", forecast.capacity.cusp_radius);
  item("penetration_m", forecast.penetration);
  json.key("radial_crack_first").value(is_known && forecast.capacity.radial_crack_first);
  json.key("in_range").value(is_known && forecast.capacity.is_in_range);
  write_outside(json, forecast.outside, is_known);
  write_published(json, "nevel", answer.nevel, is_known);
  write_published(json, "kashtelyan", answer.kashtelyan, is_known);
  write_load(json, options.load, load);
  write_groups(json, fracture::scaled(load), forecast);
  json.key("database").open('{').key("file");
  json.value(options.file.empty() ? std::nullopt : std::optional(options.file));
  json.key("fluid").value(fracture::fluid_name(database.settings().fluid));
  json.key("hash").value("fnv1a64 " + fracture::database_hash(database)).close('}');
  json.close('}');
  print_out("{}\n", text);
}

// ---- for people

std::string kilonewtons(const BendingCapacity& capacity) {
  return fmt::format("{:.4g} kN", capacity.vertical_force / 1e3);
}

std::string metres(double length) {
  return fmt::format("{:.4g} m", length);
}

void print_row(const char* what, const std::string& database, const std::string& nevel = "",
               const std::string& kashtelyan = "") {
  const std::string line = fmt::format("{:<22}{:<20}{:<20}{}", what, database, nevel, kashtelyan);
  print_out("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
}

void print_table(const SlicePoint& answer) {
  const auto& [abscissa, forecast, nevel, kashtelyan] = answer;
  print_row("", "database", "Nevel", "Kashtelyan");
  print_row("vertical force", kilonewtons(forecast.capacity), kilonewtons(nevel), kilonewtons(kashtelyan));
  print_row("cusp radius", metres(forecast.capacity.cusp_radius), metres(nevel.cusp_radius),
            metres(kashtelyan.cusp_radius));
  print_row("normal force", fmt::format("{:.4g} kN", forecast.normal_force / 1e3));
  print_row("penetration", metres(forecast.penetration));
  print_row("time to the break",
            std::isfinite(forecast.time) ? fmt::format("{:.4g} s", forecast.time) : "never: at rest");
  print_row("radial crack first", forecast.capacity.radial_crack_first ? "yes" : "no");
  const auto in_range = [](bool is_in_range) { return is_in_range ? "yes" : "no"; };
  print_row("in range", in_range(forecast.capacity.is_in_range), in_range(nevel.is_in_range),
            in_range(kashtelyan.is_in_range));
}

void print_for_people(const Options& options, const BendingDatabase& database, const BendingLoad& load,
                      const SlicePoint& answer) {
  const fracture::ScaledLoad scaled = fracture::scaled(load);
  print_out("load      {}\n", describe(load));
  print_out("groups    2a {:g} deg, m {:.4g}, softness {:.4g}, Fr {:.4g}; l {:.4g} m\n",
            scaled.groups.opening_angle * kDegree, scaled.groups.mass_ratio, scaled.groups.softness,
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

/// "softness 0.2, the table's 3e-05 to 0.1; Poisson ratio 0.25, the table's 0.3"
std::string with_ranges(const std::vector<fracture::OutsideRange>& ranges) {
  std::vector<std::string> parts;
  parts.reserve(ranges.size());
  for (const auto& [name, value, least, most] : ranges)
    parts.push_back(fmt::format("{} {:.4g}, the table's {:g}", name, value, least) +
                    (most > least ? fmt::format(" to {:g}", most) : ""));
  return fmt::format("{}", fmt::join(parts, "; "));
}

int query(const Options& options) {
  if (!options.load.wedge_angle_deg && !options.load.front_angle_deg && !options.load.back_angle_deg)
    return fail(kUsage, "the wedge needs --wedge-angle, or --front-angle and --back-angle");
  const auto load = bending_load(options.load);
  if (!load) return load.error();
  const auto database = load_database(options.file);
  if (!database) return database.error();
  const SlicePoint answer = fracture::compare_models(fracture::FsiDatabaseModel(*database), *load);
  if (options.json)
    print_json(options, **database, *load, answer);
  else
    print_for_people(options, **database, *load, answer);
  if (!can_bend(*load))
    print_err("note: a hull {:g} deg from the vertical only crushes ice of friction {:g}\n",
              load->hull_angle * kDegree, load->ice.friction);
  else if (!answer.database.outside.empty())
    print_err("note: outside the database: {}; the answer is its nearest edge's\n",
              with_ranges(answer.database.outside));
  return kDone;
}

}  // namespace

Command add_database_query(CommandLine& app) {
  CommandLine command = app.add_command(
      "query", "What a wedge of ice bears, by the database and by published forms", kExamples);
  auto options = std::make_shared<Options>();
  add_point(command, options->load, true);
  add_load(command, options->load);
  command
      .option("--slip-speed", options->load.slip_speed, "M_PER_S", "along the hull's waterline",
              between(-100, 100))
      .shows_default();
  add_database_file(command, options->file);
  command.flag("--json", options->json, "Answer as JSON, in SI units");
  return {command, [options] { return query(*options); }};
}

}  // namespace polynya::app
