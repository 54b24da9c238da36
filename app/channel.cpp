#include "io/channel.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "app/exit_code.hpp"
#include "app/run_commands.hpp"
#include "app/tell.hpp"
#include "io/channel_text.hpp"
#include "io/output_file.hpp"
#include "io/run_folder.hpp"

namespace polynya::app {
namespace {

int fail(ExitCode code, const std::string& words) {
  tell("polynya: {}\n", words);
  return code;
}

}  // namespace

int channel(const ChannelOptions& options) {
  std::signal(SIGPIPE, SIG_IGN);
  const auto run = io::read_run(options.run);
  if (!run) return fail(kInputOutput, run.error());
  io::ChannelOptions wanted{
      .ship = 0, .time = options.at, .spacing = options.spacing, .reach = options.reach};
  const auto& ships = run->scene.scene.ships;
  if (!options.ship.empty()) {
    const auto found = std::ranges::find(ships, options.ship, &simulation::ShipSpec::name);
    if (found == ships.end()) return fail(kUsage, fmt::format("the run has no ship \"{}\"", options.ship));
    wanted.ship = static_cast<std::size_t>(found - ships.begin());
  }
  const auto channel = io::measure_channel(*run, wanted);
  if (!channel) return fail(kUsage, channel.error());
  const std::filesystem::path folder = options.out.empty() ? options.run : options.out;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const auto& [name, text] : {std::pair{io::run_file::kChannelCsv, to_csv(*channel)},
                                   std::pair{io::run_file::kChannel, to_geojson(*channel)}}) {
    if (const std::string wrong = io::write_whole_file(folder / name, text); !wrong.empty())
      return fail(kInputOutput, wrong);
  }
  say(options.format == "json"  ? to_json_text(*channel)
      : options.format == "csv" ? to_csv(*channel)
                                : to_table(*channel));
  return std::fflush(stdout) == 0 && !std::ferror(stdout) ? kDone : kInputOutput;
}

}  // namespace polynya::app
