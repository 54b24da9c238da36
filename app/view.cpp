#include "app/view.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/write_output.hpp"
#include "io/run/run_folder.hpp"
#include "io/text/output_file.hpp"
#include "views/player/player_page.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

int fail(ExitCode code, const std::string& words) {
  print_err("polynya: {}\n", words);
  return code;
}

std::string too_large(double megabytes, const ViewOptions& options) {
  return fmt::format(
      "the page would have {:.0f} MB, the limit is {:g}: take fewer frames with --every {}, a part of the "
      "run with --from and --until, or allow more with --limit {:.0f}",
      megabytes, options.most_megabytes,
      static_cast<int>(std::ceil(options.every * megabytes / options.most_megabytes)) + 1,
      std::ceil(megabytes));
}

}  // namespace

int view(const ViewOptions& options) {
  const auto run = io::read_run(options.run);
  if (!run) return fail(kInputOutput, run.error());
  io::FrameSelection wanted;
  wanted.every = options.every;
  if (options.from) wanted.from = *options.from;
  if (options.until) wanted.until = *options.until;
  const views::PlayerData data = views::player_data(*run, wanted);
  if (data.frames == 0 && !run->frames.empty())
    return fail(kUsage, fmt::format("no frame of the run is in that part; they go from {:g} to {:g} s",
                                    run->start_time(), run->end_time()));
  const std::string page = player_page(*run, data);
  const double megabytes = static_cast<double>(page.size()) / 1e6;
  if (megabytes > options.most_megabytes) return fail(kUsage, too_large(megabytes, options));
  const fs::path in_run = fs::path(options.run) / io::run_file::kView;
  const std::string failure =
      options.out.empty() ? io::write_whole_file(in_run, page) : write_output(options.out, page);
  if (!failure.empty()) return fail(kInputOutput, failure);
  const bool is_on_stdout = !options.out.empty() && is_stdout(options.out);
  (is_on_stdout ? write_err : write_out)(
      fmt::format("{}  {:.1f} MB, {} frames, {} floes, {} events; open it in a browser\n",
                  options.out.empty() ? in_run.string() : options.out, megabytes, data.frames,
                  run->floes.size(), run->events.size()));
  return kDone;
}

}  // namespace polynya::app
