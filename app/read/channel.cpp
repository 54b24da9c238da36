#include "analysis/channel.hpp"

#include <algorithm>
#include <memory>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "io/run/run_folder.hpp"

namespace polynya::app {
namespace {

constexpr auto kChannelExamples =
    "Examples:\n"
    "  polynya channel runs/sawamura2017-fig4b                 also writes channel.csv and channel.geojson "
    "there\n"
    "  polynya channel runs/sawamura2017-fig4b --at 300 --out /tmp\n"
    "  polynya channel runs/sawamura2017-fig4b --json | jq .mean_width_m\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 5 input/output.\n";

struct MeasureOptions {
  std::string run;
  std::string out;  ///< folder for channel.csv and channel.geojson; empty: the run's
  std::string ship;
  analysis::ChannelOptions measure;
  std::string format = "table";  ///< of stdout
  bool is_json = false;          ///< likewise
  ProgressKind progress = ProgressKind::kAuto;
};

int measure(const MeasureOptions& options) {
  const auto run = read_run(options.run, options.progress);
  if (!run) return fail(kInputOutput, run.error());
  analysis::ChannelOptions wanted = options.measure;
  if (!options.ship.empty()) {
    const int ship = hull_named(run->scene.scene, options.ship);
    if (ship < 0) return fail(kUsage, fmt::format("the run has no ship \"{}\"", options.ship));
    wanted.ship = static_cast<std::size_t>(ship);
  }
  const auto channel =
      with_progress(options.progress, "measuring the channel", [&] { return analysis::measure_channel(*run, wanted); });
  if (!channel) return fail(kUsage, channel.error());
  for (const auto& [name, text] : {std::pair{io::run_file::kChannelCsv, to_csv(*channel)},
                                   std::pair{io::run_file::kChannel, to_geojson(*channel)}}) {
    if (const auto written = write_product(options.out, options.run, name, text); !written)
      return fail(kInputOutput, written.error());
  }
  write_out(options.is_json || options.format == "json" ? to_json_text(*channel)
            : options.format == "csv"                   ? to_csv(*channel)
                                                        : to_table(*channel));
  return kDone;
}

}  // namespace

Command add_channel(CommandLine& app) {
  CommandLine command = app.add_command("channel", "Measure the channel behind a ship", kChannelExamples);
  auto options = std::make_shared<MeasureOptions>();
  add_run_folder(command, options->run);
  command.option("--at", &options->measure.time, "S", "At that time instead of the end [s]", finite());
  command.option("--ship", &options->ship, "NAME", "Which ship; the first one if not given");
  command.option("--spacing", &options->measure.spacing, "M", "Length of a station [m]; the beam if not given",
                 between(0.1, 1e5));
  command.option("--reach", &options->measure.reach, "M",
                 "How far from the track ice is searched [m]; four beams if not given", between(0.1, 1e5));
  command.choice<std::string>("--format", options->format, "What stdout gets; json: as --json",
                              {{"table", "table"}, {"csv", "csv"}, {"json", "json"}});
  command.flag("--json", options->is_json, "Print the sums as JSON instead of the table", {.excludes = {"--format"}});
  command.option("--out", &options->out, "DIR", "Folder for channel.csv and channel.geojson; the run's if not given");
  add_progress(command, options->progress);
  return {command, [options] { return measure(*options); }};
}

}  // namespace polynya::app
