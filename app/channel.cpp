#include "analysis/channel.hpp"

#include <algorithm>
#include <filesystem>

#include "analysis/channel_text.hpp"
#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/run_commands.hpp"
#include "app/write_output.hpp"
#include "io/run/run_folder.hpp"

namespace polynya::app {
namespace {

int fail(ExitCode code, const std::string& words) {
  print_err("polynya: {}\n", words);
  return code;
}

}  // namespace

int channel(const ChannelOptions& options) {
  const auto run = io::read_run(options.run);
  if (!run) return fail(kInputOutput, run.error());
  analysis::ChannelOptions wanted{
      .ship = 0, .time = options.at, .spacing = options.spacing, .reach = options.reach};
  const auto& ships = run->scene.scene.ships;
  if (!options.ship.empty()) {
    const auto found = std::ranges::find(ships, options.ship, &simulation::ShipSpec::name);
    if (found == ships.end()) return fail(kUsage, fmt::format("the run has no ship \"{}\"", options.ship));
    wanted.ship = static_cast<std::size_t>(found - ships.begin());
  }
  const auto channel = analysis::measure_channel(*run, wanted);
  if (!channel) return fail(kUsage, channel.error());
  std::error_code error;
  if (!options.out.empty()) std::filesystem::create_directories(options.out, error);
  for (const auto& [name, text] : {std::pair{io::run_file::kChannelCsv, to_csv(*channel)},
                                   std::pair{io::run_file::kChannel, to_geojson(*channel)}}) {
    if (const std::string wrong = write_product(options.out, options.run, name, text); !wrong.empty())
      return fail(kInputOutput, wrong);
  }
  write_out(options.format == "json"  ? to_json_text(*channel)
            : options.format == "csv" ? to_csv(*channel)
                                      : to_table(*channel));
  return kDone;
}

}  // namespace polynya::app
