#include "app/read/view_scene.hpp"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "io/run/run_loop.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/output_file.hpp"
#include "views/player/player_page.hpp"
#include "views/player/scene_plan.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kBetweenLooks = std::chrono::milliseconds(300);

/// A folder for a run of one frame, which the page is made of; it goes with this.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (fs::temp_directory_path() / "polynya-scene-XXXXXX").string();
    if (const char* made = ::mkdtemp(name.data())) path_ = made;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  fs::path run() const { return path_ / "run"; }

 private:
  fs::path path_;
};

/// The run of a scene before its first step.
io::Result<io::Run> first_frame(const io::LoadedScene& scene) {
  const ScratchFolder folder;
  auto run = io::start_run(folder.run(), scene);
  if (!run) return io::fail(run.error());
  io::RunRecorder(run->simulation, run->writer, scene).begin(run->simulation.journal());
  const auto summary = io::summarise(run->simulation, run->writer, "not run", 0);
  if (const auto written = run->writer.finish(summary, nullptr); !written) return io::fail(written.error());
  return io::read_run(folder.run());
}

/// The page beside its scene, and with `watch` the script by which pages that are open learn of it.
io::Result<> write_page(const io::LoadedScene& scene, const std::string& out, bool watch) {
  const auto run = first_frame(scene);
  if (!run) return io::fail(run.error());
  const std::string stamp = fmt::format("{:x}", std::chrono::system_clock::now().time_since_epoch().count());
  const fs::path stamp_file = watch ? fs::path(out + ".js") : fs::path();
  const std::string plan = views::scene_plan(scene, stamp, stamp_file.filename().string());
  auto written = write_output(out, player_page(*run, views::player_data(*run, {}), plan));
  if (written && watch)
    written = io::write_named_file(stamp_file, fmt::format("window.polynyaStamp = \"{}\";\n", stamp));
  return written;
}

int write_once(const std::string& file, const std::string& out, bool watch) {
  const auto scene = io::read_scene_file(file);
  for (const io::Problem& problem : scene ? scene->hints : scene.error()) print_err("{}\n", to_string(problem));
  if (!scene) return kSceneInvalid;
  if (const auto written = write_page(*scene, out, watch); !written) return fail(kInputOutput, written.error());
  const std::string words =
      fmt::format("{}  {}, {}; open it in a browser\n", out, counted(scene->scene.floes.size(), "floe"),
                  counted(hull_count(scene->scene), "hull"));
  (is_stdout(out) ? write_err : write_out)(words);
  flush_out();
  return kDone;
}

}  // namespace

int write_scene_view(const std::string& scene, const std::string& out, bool watch) {
  const std::string page = out.empty() ? fs::path(scene).replace_extension(".html").string() : out;
  int code = write_once(scene, page, watch);
  if (!watch || code == kInputOutput) return code;
  watch_signals();
  std::error_code error;
  for (auto last = fs::last_write_time(scene, error); stop_signal() == 0; std::this_thread::sleep_for(kBetweenLooks)) {
    const auto now = fs::last_write_time(scene, error);  // an editor may have the file away for an instant
    if (error || now == last) continue;
    last = now;
    code = write_once(scene, page, watch);  // what is wrong is on stderr; the page stays as it was
  }
  if (fs::remove(page + ".js", error); error) return fail(kInputOutput, error.message());
  return code;
}

}  // namespace polynya::app
