#include "views/player/player_page.hpp"

#include <algorithm>
#include <filesystem>

#include "io/run/run_loop.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::views {
namespace {

/// Makes JSON safe inside a script element: without "<", which could end it or start a comment.
std::string in_script(const std::string& json) {
  std::string text;
  for (const char c : json) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

/// Returns a template with its marks replaced. The marks and their texts are in the order in which the marks occur. The
/// template must contain every mark.
std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& fillings) {
  std::string text;
  for (const auto& [mark, filling] : fillings) {
    const std::size_t at = page.find(mark);
    text += page.substr(0, at);
    text += filling;
    page.remove_prefix(at + mark.size());
  }
  text += page;
  return text;
}

/// Returns the names of the two runs, and the times that their common axes show [s].
std::string pair_info(const std::array<ShownRun, 2>& runs) {
  std::string text;
  io::JsonWriter json(text);
  const auto& [first, second] = runs;
  json.open('{').key("labels").list(std::array{first.label, second.label});
  json.key("axis_s").list(
      std::array{std::min(first.data.start, second.data.start), std::max(first.data.end, second.data.end)});
  json.close('}');
  return text;
}

}  // namespace

std::string player_page(const io::Run& run, const PlayerData& data, const std::string& options) {
  return filled(kPlayerTemplate, {{"{{title}}", io::escaped(run.scene.scene.name)},
                                  {"{{options}}", in_script(options)},
                                  {"{{info}}", in_script(data.info)},
                                  {"{{columns}}", io::to_base64(data.columns.bytes())}});
}

std::string pair_page(const std::array<ShownRun, 2>& runs) {
  const auto& [first, second] = runs;
  std::string player;
  io::JsonWriter(player).value(kPlayerTemplate);
  return filled(kPairTemplate, {{"{{title}}", io::escaped(first.label + " and " + second.label)},
                                {"{{pair}}", in_script(pair_info(runs))},
                                {"{{player}}", in_script(player)},
                                {"{{info}}", in_script(first.data.info)},
                                {"{{columns}}", io::to_base64(first.data.columns.bytes())},
                                {"{{info}}", in_script(second.data.info)},
                                {"{{columns}}", io::to_base64(second.data.columns.bytes())}});
}

namespace {

namespace fs = std::filesystem;

/// A temporary folder for a run of one frame, from which the page is made. The destructor removes it.
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
  /// False if the folder could not be made.
  bool is_made() const { return !path_.empty(); }
  fs::path run() const { return path_ / "run"; }

 private:
  fs::path path_;
};

/// Returns the run of a scene before its first step.
io::Result<io::Run> first_frame(const io::LoadedScene& scene) {
  const ScratchFolder folder;
  if (!folder.is_made())
    return io::fail(fs::temp_directory_path().string() + ": no folder can be made for the first frame of the scene");
  auto run = io::start_run(folder.run(), scene);
  if (!run) return io::fail(run.error());
  io::RunRecorder(run->simulation, run->writer, scene).begin(run->simulation.journal());
  const auto summary = io::summarise(run->simulation, run->writer, "not run", 0);
  if (const auto written = run->writer.finish(summary, nullptr); !written) return io::fail(written.error());
  return io::read_run(folder.run());
}

}  // namespace

io::Result<std::string> scene_page(const io::LoadedScene& scene, const std::string& stamp,
                                   const std::string& stamp_file) {
  const auto run = first_frame(scene);
  if (!run) return io::fail(run.error());
  return player_page(*run, player_data(*run, {}), scene_plan(scene, stamp, stamp_file));
}

}  // namespace polynya::views
