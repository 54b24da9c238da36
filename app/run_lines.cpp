#include <memory>

#include "app/choice_option.hpp"
#include "app/command_line.hpp"
#include "app/number_option.hpp"
#include "app/run_commands.hpp"

namespace polynya::app {

Command add_channel(CLI::App& app) {
  auto* command = app.add_subcommand("channel", "Measure the channel behind a ship");
  command->footer(
      "Examples:\n"
      "  polynya channel runs/sawamura2017-fig4b                 also writes channel.csv and channel.geojson "
      "there\n"
      "  polynya channel runs/sawamura2017-fig4b --at 300 --out /tmp\n"
      "  polynya channel runs/sawamura2017-fig4b --json | jq .mean_width_m\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 5 input/output.\n");
  auto options = std::make_shared<ChannelOptions>();
  command->add_option("run", options->run, "The run folder")->required()->type_name("RUN");
  command->add_option("--at", options->at, "At that time instead of the end [s]")
      ->type_name("S")
      ->check(finite());
  command->add_option("--ship", options->ship, "Which ship; the first one if not given")->type_name("NAME");
  command->add_option("--spacing", options->spacing, "Length of a station [m]; the beam if not given")
      ->type_name("M")
      ->check(between(0.1, 1e5));
  command
      ->add_option("--reach", options->reach,
                   "How far from the track ice is looked for [m]; four beams if not given")
      ->type_name("M")
      ->check(between(0.1, 1e5));
  auto* format = command->add_option("--format", options->format, "What stdout gets; json: as --json");
  set_choices(*format, {"table", "csv", "json"});
  command
      ->add_flag_callback(
          "--json", [options] { options->format = "json"; }, "Print the sums as JSON instead of the table")
      ->excludes(format);
  command
      ->add_option("--out", options->out,
                   "Folder for channel.csv and channel.geojson; the run's if not given")
      ->type_name("DIR");
  return [options] { return channel(*options); };
}

Command add_figures(CLI::App& app) {
  auto* command = app.add_subcommand("figures", "Draw a run, or several side by side, for print");
  command->footer(
      "Examples:\n"
      "  polynya figures runs/sawamura2017-fig4b                       figure-floes.svg, -loads, -motion, "
      "...\n"
      "  polynya figures runs/sawamura2017-fig4b --at 0,185,285,550\n"
      "  polynya figures runs/6a runs/6b --out figures                 side by side, in one scale\n"
      "\n"
      "  polynya figures runs/6a runs/6b --label \"10 m\",\"20 m\" --width-mm 85 --title \"\"\n"
      "\n"
      "A PNG and a PDF are made beside each SVG where rsvg-convert is installed.\n"
      "Exit codes: 0 done, 2 usage, 5 input/output.\n");
  auto options = std::make_shared<FiguresOptions>();
  command->add_option("runs", options->runs, "The run folders")->required()->type_name("RUN");
  command->add_option("--at", options->at, "Moments of the maps [s]; chosen if not given")
      ->type_name("S,S,...")
      ->delimiter(',')
      ->check(finite());
  set_choices(
      *command->add_option(
          "--load", options->load,
          "True force of the ice (mean of each recorded interval and largest step, or one of the two), "
          "force of other ships and structures, or the paper's j/tau_c"),
      {"true", "mean", "max", "ships", "j-over-tau-c"});
  command->add_option("--label", options->labels, "Names of the runs; their scenes' if not given")
      ->type_name("NAME,...")
      ->delimiter(',');
  command->add_option("--title", options->title, "Title of the figures instead of their own; \"\" for none")
      ->type_name("TEXT");
  command
      ->add_option("--width-mm", options->width,
                   "Width on paper, on which text has 7 to 9 pt; 170 if not given")
      ->type_name("MM")
      ->check(between(60, 400));
  command
      ->add_option("--window", options->window,
                   "The part of the world that the maps show [m]; all if not given")
      ->type_name("X0,Y0,X1,Y1")
      ->delimiter(',')
      ->expected(4)
      ->check(finite());
  command->add_option("--out", options->out, "Folder for the figures; the first run's if not given")
      ->type_name("DIR");
  return [options] { return figures(*options); };
}

Command add_export(CLI::App& app) {
  auto* command = app.add_subcommand("export", "Write a run for ParaView or QGIS");
  command->footer(
      "Examples:\n"
      "  polynya export runs/sawamura2017-fig4b --vtk paraview         open paraview/run.pvd in ParaView\n"
      "  polynya export runs/at-sea --geojson qgis --at 300            longitude, latitude from the scene's "
      "origin\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 5 input/output.\n");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("run", options->run, "The run folder")->required()->type_name("RUN");
  command->add_option("--vtk", options->vtk, "Folder for run.pvd and its .vtp frames")->type_name("DIR");
  command->add_option("--every", options->every, "Of VTK only each N-th frame, and the last")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option(
          "--geojson", options->geojson,
          "Folder for floes, fractures, tracks and channel as GeoJSON: longitude and latitude where the "
          "scene has an origin, metres where not")
      ->type_name("DIR");
  command->add_option("--at", options->at, "Moment of the GeoJSON [s]; the end if not given")
      ->type_name("S")
      ->check(finite());
  command->add_flag("--metres", options->is_in_metres, "GeoJSON in metres though the scene has an origin");
  return [options] { return export_run(*options); };
}

}  // namespace polynya::app
