#include <memory>
#include <string>

#include "app/choice_option.hpp"
#include "app/command_line.hpp"
#include "app/geometry_commands.hpp"
#include "app/number_option.hpp"

namespace polynya::app {

Command add_cut(CLI::App& app) {
  auto* command = app.add_subcommand("cut", "Cut floes exactly, with every square metre accounted for");
  command->footer(
      "Examples:\n"
      "  polynya cut floes.geojson --disc 10,5,3 --out pieces.geojson        ledger to stdout\n"
      "  polynya cut floes.wkt --crack 0,0,30 --out - --ledger ledger.json   pieces to stdout\n"
      "  polynya cut - --polygon channel.geojson --keep both --out pieces.ndjson < floes.ndjson\n"
      "  polynya cut floes.geojson --ops cuts.json --repair even-odd --out pieces.geojson\n"
      "\n"
      "Exit codes: 0 all were cut, 2 usage, 4 some polygons were refused (the others are cut), 5 "
      "input/output.\n");
  auto options = std::make_shared<CutOptions>();
  command->add_option("floes", options->floes, "GeoJSON, NDJSON or WKT, told apart by content; - for stdin")
      ->required()
      ->type_name("FLOES");
  const auto tool = [&](const char* name, std::string& value, const char* meaning, const char* type) {
    command->add_option(name, value, meaning)->type_name(type)->group("Tools, one of them");
  };
  tool("--disc", options->disc, "The disc of that centre and radius [m]", "X,Y,R");
  tool("--crack", options->crack, "The straight line through that point, across every floe", "X,Y,ANGLE_DEG");
  tool("--line", options->line, "From end to end; separates where it crosses ice fully", "X0,Y0,X1,Y1");
  tool("--polygon", options->polygon, "Polygons, with holes or not, in any format of FLOES", "FILE");
  tool("--ops", options->ops, "A JSON list of cuts, in order, each of all pieces", "FILE");
  set_choices<io::Keep>(
      *command->add_option("--keep", options->keep,
                           "Which side of a disc or polygon stays; outside if not given"),
      {{"outside", io::Keep::kOutside}, {"inside", io::Keep::kInside}, {"both", io::Keep::kBoth}});
  command
      ->add_option("--sagitta", options->sagitta,
                   "By how much a disc's polygon may stay inside it [m]; 0.02, or radius/250 if that is less")
      ->type_name("M")
      ->check(between(1e-12, 1e6));
  command
      ->add_option("--out", options->out, "The pieces; format by extension, else that of FLOES; - for stdout")
      ->type_name("FILE");
  command->add_option("--ledger", options->ledger, "The ledger, JSON; stdout if not given")
      ->type_name("FILE");
  set_choices<geometry::FillRule>(
      *command->add_option("--repair", options->repair,
                           "Make valid polygons of those that are not, exactly, by what the rule fills; else "
                           "they are refused"),
      {{"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}});
  return [options] { return cut(*options); };
}

Command add_inspect(CLI::App& app) {
  auto* command = app.add_subcommand("inspect", "Look at the floes of a run");
  command->footer(
      "Examples:\n"
      "  polynya inspect runs/level-plate                        the floes at the end, a line each\n"
      "  polynya inspect runs/level-plate --at 30                at 30 s\n"
      "  polynya inspect runs/level-plate --floe 17 --format svg > floe-17.svg\n"
      "  polynya inspect runs/level-plate --lineage 17           the fractures that led to it\n"
      "  polynya inspect runs/level-plate --check                validity, areas, overlaps, exactly\n"
      "  polynya inspect runs/level-plate --fsd                  floe size distribution\n"
      "  polynya inspect runs/level-plate --json                 each of these but a shape as JSON\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 4 --check found a shape or an area wrong, 5 input/output.\n");
  auto options = std::make_shared<InspectOptions>();
  command->add_option("run", options->run, "The run folder")->required()->type_name("RUN");
  command->add_option("--at", options->at, "At that time; the end of the run if not given [s]")
      ->type_name("T")
      ->check(finite());
  auto* floe = command
                   ->add_option("--floe", options->floe,
                                "The shape of one floe: in its body frame, or with "
                                "--at where it was in the world")
                   ->type_name("N");
  auto* lineage =
      command->add_option("--lineage", options->lineage, "The tree of fractures that led to a floe")
          ->type_name("N");
  auto* check =
      command->add_flag("--check", options->check, "Re-derive validity, areas and overlaps of the whole run");
  auto* fsd = command->add_flag("--fsd", options->fsd, "The distribution of floe sizes");
  auto* format = command->add_option("--format", options->format, "Of --floe; wkt if not given");
  format->needs(floe);
  set_choices<ShapeFormat>(
      *format, {{"wkt", ShapeFormat::kWkt}, {"geojson", ShapeFormat::kGeojson}, {"svg", ShapeFormat::kSvg}});
  auto* json =
      command->add_flag("--json", options->json, "Print the report as JSON; a shape: --format geojson");
  floe->excludes(lineage)->excludes(check)->excludes(fsd)->excludes(json);
  lineage->excludes(check)->excludes(fsd);
  check->excludes(fsd);
  return [options] { return inspect(*options); };
}

}  // namespace polynya::app
