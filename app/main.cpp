#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/run/load_scene.hpp"
#include "io/run/summary.hpp"

namespace polynya::app {
namespace {

Commands add_commands(CommandLine& app) {
  Commands commands;  // in the order of the help
  for (const auto add : {add_run, add_resume, add_validate, add_schema, add_ships, add_init, add_view, add_channel,
                         add_export, add_inspect, add_cut, add_import, add_database, add_fmu})
    commands.push_back(add(app));
  add_python_commands(app, commands);
  commands.push_back(add_read_json(app));
  commands.push_back(add_read_run(app));
  return commands;
}

constexpr auto kExamples =
    "Examples:\n"
    "  polynya run scenes/sawamura2017-fig4b.json     the paper's voyage, to runs/sawamura2017-fig4b\n"
    "  polynya init my-scene.json                     write a commented scene to start from\n"
    "  polynya validate my-scene.json                 all errors of a scene\n"
    "  polynya inspect runs/my-scene --check          check the floes of a run\n"
    "  polynya view runs/my-scene                     a page that plays the run in a browser\n"
    "  polynya channel runs/my-scene                  width of the channel behind the ship\n"
    "  polynya figures runs/my-scene                  pictures for print: ice, loads, motion, sizes\n"
    "  polynya export runs/my-scene --vtk paraview    for ParaView; --geojson for QGIS\n"
    "  polynya cut floes.geojson --disc 10,5,3        cut floes outside any simulation\n"
    "  polynya import mapped.shp --origin 78.2,15.6 --out floes.geojson   a floe file from mapped ice\n"
    "  polynya fmu scene.json --out ship.fmu          a co-simulation unit for other simulators\n"
    "  polynya study plan study.json                  many runs of one scene, on this machine or a cluster\n"
    "\n"
    "Polynya simulates an icebreaker in pack ice: floes are pushed, plates break by bending and splitting.\n";

constexpr auto kCodes =
    "Exit codes: 0 done, 2 usage, 3 scene invalid, 4 numerical failure, geometry refused or out of memory, "
    "5 input/output, 75 stopped on a "
    "signal with a checkpoint (polynya resume), 70 a defect of polynya itself, 141 the reader of stdout or "
    "stderr closed the pipe.\n"
    "Data goes to stdout, messages to stderr.\n";

int report_out_of_memory() {
  try {
    print_err("polynya: {}\n", out_of_memory());
  } catch (const std::bad_alloc&) {
    write_err("polynya: out of memory\n");
  }
  return kOutOfMemory;
}

/// Runs the command line. Exceptions of the standard library become exit codes.
int command_line(int count, char** words) {
  try {
    const std::string commit = kCommit.empty() ? "" : fmt::format(" ({})", kCommit);
    return run_command_line({kExamples, kCodes, fmt::format("polynya {}{}", io::version(), commit)}, add_commands,
                            count, words);
  } catch (const std::bad_alloc&) {
    return report_out_of_memory();
  } catch (const std::length_error&) {
    return report_out_of_memory();
  } catch (const std::system_error& error) {
    print_err("polynya: {}\n", error.what());
    return kInputOutput;
  }
}

}  // namespace
}  // namespace polynya::app

int main(int count, char** words) {
  polynya::app::open_streams();
  return polynya::app::close_streams(polynya::app::command_line(count, words));
}
