#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "app/command_line.hpp"
#include "app/geometry_commands.hpp"

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
  auto* tools = command->add_option_group("Tool", "One of");
  tools->add_option("--disc", options->disc, "The disc of that centre and radius [m]")->type_name("X,Y,R");
  tools->add_option("--crack", options->crack, "The straight line through that point, across every floe")
      ->type_name("X,Y,ANGLE_DEG");
  tools->add_option("--line", options->line, "From end to end; separates where it crosses ice fully")
      ->type_name("X0,Y0,X1,Y1");
  tools->add_option("--polygon", options->polygon, "Polygons, with holes or not, in any format of FLOES")
      ->type_name("FILE");
  tools->add_option("--ops", options->ops, "A JSON list of cuts, in order, each of all pieces")
      ->type_name("FILE");
  tools->require_option(1);
  static const std::map<std::string, io::Keep> kKeeps{
      {"outside", io::Keep::kOutside}, {"inside", io::Keep::kInside}, {"both", io::Keep::kBoth}};
  command->add_option("--keep", options->keep, "Which side of a disc or polygon stays; outside if not given")
      ->type_name("outside|inside|both")
      ->transform(CLI::CheckedTransformer(kKeeps).description(""));
  command
      ->add_option("--sagitta", options->sagitta,
                   "By how much a disc's polygon may stay inside it [m]; 0.02, or radius/250 if that is less")
      ->type_name("M")
      ->check(CLI::Range(1e-12, 1e6));
  command
      ->add_option("--out", options->out, "The pieces; format by extension, else that of FLOES; - for stdout")
      ->type_name("FILE");
  command->add_option("--ledger", options->ledger, "The ledger, JSON; stdout if not given")
      ->type_name("FILE");
  static const std::map<std::string, geometry::FillRule> kRules{{"even-odd", geometry::FillRule::kEvenOdd},
                                                                {"non-zero", geometry::FillRule::kNonZero}};
  command
      ->add_option(
          "--repair", options->repair,
          "Make valid polygons of those that are not, exactly, by what the rule fills; else they are refused")
      ->type_name("even-odd|non-zero")
      ->transform(CLI::CheckedTransformer(kRules).description(""));
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
      "\n"
      "Exit codes: 0 done, 2 usage, 4 --check found a shape or an area wrong, 5 input/output.\n");
  auto options = std::make_shared<InspectOptions>();
  command->add_option("run", options->run, "The run folder")->required()->type_name("RUN");
  command->add_option("--at", options->at, "At that time; the end of the run if not given [s]")
      ->type_name("T");
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
  static const std::map<std::string, ShapeFormat> kFormats{
      {"wkt", ShapeFormat::kWkt}, {"geojson", ShapeFormat::kGeojson}, {"svg", ShapeFormat::kSvg}};
  command->add_option("--format", options->format, "Of --floe; wkt if not given")
      ->type_name("wkt|geojson|svg")
      ->transform(CLI::CheckedTransformer(kFormats).description(""))
      ->needs(floe);
  floe->excludes(lineage)->excludes(check)->excludes(fsd);
  lineage->excludes(check)->excludes(fsd);
  check->excludes(fsd);
  return [options] { return inspect(*options); };
}

}  // namespace polynya::app
