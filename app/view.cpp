#include "app/view.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "app/exit_code.hpp"
#include "io/output_file.hpp"
#include "io/player_page.hpp"
#include "io/run_folder.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

int fail(ExitCode code, const std::string& words) {
  fmt::print(stderr, "polynya: {}\n", words);
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
  const io::PlayerData data = player_data(*run, wanted);
  if (data.frames == 0 && !run->frames.empty())
    return fail(kUsage, fmt::format("no frame of the run is in that part; they go from {:g} to {:g} s",
                                    run->start_time(), run->end_time()));
  const std::string page = player_page(*run, data);
  const double megabytes = static_cast<double>(page.size()) / 1e6;
  if (megabytes > options.most_megabytes) return fail(kUsage, too_large(megabytes, options));
  const fs::path out =
      options.out.empty() ? fs::path(options.run) / io::run_file::kView : fs::path(options.out);
  if (const std::string failure = io::write_whole_file(out, page); !failure.empty())
    return fail(kInputOutput, failure);
  fmt::print("{}  {:.1f} MB, {} frames, {} floes, {} events; open it in a browser\n", out.string(), megabytes,
             data.frames, run->floes.size(), run->events.size());
  return std::fflush(stdout) == 0 ? kDone : kInputOutput;
}

}  // namespace polynya::app
