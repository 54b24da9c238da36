#include "io/run/run_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/run/checkpoint.hpp"
#include "io/run/checksums.hpp"
#include "io/run/event_records.hpp"
#include "io/run/summary.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

namespace fs = std::filesystem;

/// Contents of a folder that is to be used for a new run.
enum class Contents {
  kNothing,  ///< nothing, or the remains of a run that was killed before it had its scene
  kRemains,  ///< part of a run: --overwrite was killed while it removed the files
  kRun,      ///< a run, finished or not
  kForeign,
};

Result<Contents> contents_of(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return fail(folder.string() + ": not a folder");
  const bool is_marked = is_marked_run_folder(folder);
  const auto is_beginning = [&](const fs::path& entry) {
    const std::string name = entry.filename().string();
    return is_marked && (name == run_file::kLock || name == std::string(run_file::kScene) + ".part");
  };
  bool is_empty = true;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    is_empty = is_empty && is_beginning(entry->path());
  if (error) return fail(fmt::format("{}: {}", folder.string(), error.message()));
  if (is_empty) return Contents::kNothing;
  const bool has_scene = fs::is_regular_file(folder / run_file::kScene, error);
  if (has_scene && (is_marked || fs::is_regular_file(folder / run_file::kSummary, error))) return Contents::kRun;
  return is_marked && !has_scene ? Contents::kRemains : Contents::kForeign;
}

/// Fails if a new run cannot use a folder with such contents.
Result<> check_claim(const fs::path& folder, Contents contents, bool overwrite) {
  const std::string name = folder.string();
  if (contents == Contents::kForeign)
    return fail(fmt::format("{}: it is not empty and not a run folder; name another folder with --out{}", name,
                            overwrite ? ", since --overwrite replaces only runs" : ""));
  if (overwrite || contents == Contents::kNothing) return {};
  if (contents == Contents::kRemains)
    return fail(
        fmt::format("{}: there are parts of a run in it, without its scene; name another folder with --out, or replace "
                    "them with --overwrite",
                    name));
  if (finished_run(folder))
    return fail(
        fmt::format("{}: there is a run in it already; name another folder with --out, or replace the run with "
                    "--overwrite",
                    name));
  return fail(
      fmt::format("{0}: there is a run in it that is not finished; continue it with: polynya resume {0}, or "
                  "replace it with "
                  "--overwrite, or name another folder with --out",
                  name));
}

/// Makes a folder and the missing folders above it, and waits until the disk has stored them.
Result<> make_folder(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path path = fs::absolute(folder, error); !fs::exists(path, error); path = path.parent_path()) {
    missing.push_back(path);
    if (path == path.parent_path()) break;
  }
  std::ranges::reverse(missing);
  for (const fs::path& path : missing) {
    fs::create_directory(path, error);
    if (error) return fail(fmt::format("{}: {}", folder.string(), error.message()));
    if (auto synced = sync_folder(path.parent_path()); !synced) return synced;
  }
  return {};
}

/// Removes a file and the temporary file that a crash may have left.
Result<> remove_with_part(const fs::path& path) {
  const auto removed = remove_file(temporary_name(path));
  return removed ? remove_file(path) : removed;
}

/// Returns the names of the files that a run writes at its end and that commands write later. The folder `loads` is
/// listed behind its files, if it has no others.
std::vector<fs::path> made_at_end(const fs::path& folder) {
  std::vector<fs::path> names{run_file::kFailure};
  if (std::error_code ignored; fs::is_directory(fs::symlink_status(folder / run_file::kLoads, ignored))) {
    bool is_ours = true;
    for (const auto& entry : fs::directory_iterator(folder / run_file::kLoads, ignored)) {
      const bool is_of_loads = entry.path().filename().string().starts_with("loads");
      is_ours = is_ours && is_of_loads;
      if (is_of_loads) names.push_back(fs::path(run_file::kLoads) / entry.path().filename());
    }
    if (is_ours) names.emplace_back(run_file::kLoads);
  }
  for (const fs::path figure : run_file::kFigures) {
    names.push_back(figure);
    for (const char* suffix : {".png", ".pdf"}) names.push_back(fs::path(figure).replace_extension(suffix));
  }
  names.insert(names.end(), run_file::kMadeAtEnd.begin(), run_file::kMadeAtEnd.end());
  return names;
}

/// Removes the files that Polynya writes into a run folder. If the program is killed meanwhile, the remaining files are
/// either a run that `resume` starts from the beginning, or remains that --overwrite accepts. For this, summary.json,
/// which may call the run finished, is removed first, and scene.json last.
Result<> remove_run(const fs::path& folder) {
  std::vector<fs::path> names = made_at_end(folder);
  names.insert(names.end(), run_file::kGrowing.begin(), run_file::kGrowing.end());
  names.emplace_back(run_file::kScene);
  Result<> removed = remove_checksums(folder);
  if (removed) removed = remove_with_part(folder / run_file::kChecksums);
  if (removed) removed = remove_with_part(folder / run_file::kSummary);
  if (removed) removed = sync_folder(folder);
  if (removed) removed = remove_checkpoints(folder);
  if (removed) removed = remove_rejected_cuts(folder);
  for (const fs::path& name : names)
    if (removed) removed = remove_with_part(folder / name);
  return removed;
}

}  // namespace

std::span<const std::string_view> growing_files(const simulation::Scene& scene) {
  const std::span<const std::string_view> all = run_file::kGrowing;
  for (std::size_t hull = 0; hull < hull_count(scene); ++hull)
    if (hull_of(scene, hull).panels) return all;
  return all.first(all.size() - 1);
}

Result<RunLock> RunLock::take(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / run_file::kLock;
  const auto refuse = [&](const std::string& reason) { return fail(fmt::format("{}: {}", file.string(), reason)); };
  Descriptor descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666));
  if (descriptor < 0)
    return refuse(errno == ELOOP ? "a link; remove it if the folder is a run's" : std::strerror(errno));
  RunLock lock(std::move(descriptor), folder);
  struct stat status {};
  if (::fstat(lock.descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) return refuse("not a regular file");
  if (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    return fail(fmt::format("{}: another polynya is writing this run", folder.string()));
  // On file systems without locks the run continues without one.
  if (!lock.is_in_place()) return refuse("removed by another program meanwhile; try again");
  return lock;
}

FolderSize estimate_folder_size(const simulation::Scene& scene) {
  // A vertex has two numbers of 16 to 18 digits. The other members of a floe are those of append_birth and append_floe.
  constexpr double kVertex = 40, kBirth = 160, kState = 470;  // [bytes]
  double vertices = 0;
  for (const simulation::FloeSpec& floe : scene.floes)
    vertices += static_cast<double>(vertex_count(floe.polygon_in_world));
  const auto floes = static_cast<double>(scene.floes.size());
  return {kBirth * floes + kVertex * vertices, kState * floes + kVertex * (vertices + floes)};
}

Result<> set_end(const fs::path& folder, const LoadedScene& scene) {
  const auto text = read_text_file(folder / run_file::kSummary, kLongestScene);
  JsonValue summary = text ? parse_json(*text).root : JsonValue{};
  if (const auto removed = remove_checksums(folder); !removed) return removed;
  if (!finished_run(folder) && summary.has("scene_hash", scene.hash)) return {};
  if (!summary.is(JsonValue::Kind::kObject)) summary.data = JsonValue::Object{};
  std::erase_if(summary.members(), [](const JsonMember& m) { return m.key == "finished" || m.key == "stopped_by"; });
  summary.members().push_back({"finished", 0, {false}});
  summary.members().push_back({"stopped_by", 0, {std::string("resumed to another end, or killed then")}});
  Result<> done = write_whole_file(folder / run_file::kSummary, to_json_text(summary) + "\n", Durability::kSynced);
  for (const fs::path& name : made_at_end(folder))
    if (done) done = remove_with_part(folder / name);
  if (done) done = write_whole_file(folder / run_file::kScene, scene.resolved_text, Durability::kSynced);
  return done;
}

bool is_marked_run_folder(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(folder / run_file::kLock, error));
}

Result<RunLock> claim_run_folder(const fs::path& folder, bool overwrite) {
  if (const auto made = make_folder(folder); !made) return fail(made.error());
  // This is checked before taking the lock, which writes into the folder, and again after it, because another process
  // may have started a run meanwhile.
  const auto check = [&]() -> Result<Contents> {
    auto contents = contents_of(folder);
    if (!contents) return contents;
    if (const auto claimed = check_claim(folder, *contents, overwrite); !claimed) return fail(claimed.error());
    return contents;
  };
  if (const auto before = check(); !before) return fail(before.error());
  auto lock = RunLock::take(folder);
  if (!lock) return lock;
  const auto contents = check();
  if (!contents) return fail(contents.error());
  if (*contents == Contents::kNothing) return lock;
  if (const auto removed = remove_run(folder); !removed) return fail(removed.error());
  return lock;
}

}  // namespace polynya::io
