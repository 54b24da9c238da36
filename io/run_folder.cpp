#include "io/run_folder.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "io/checkpoint.hpp"

namespace polynya::io {

namespace fs = std::filesystem;

std::string prepare_run_folder(const fs::path& folder, bool overwrite) {
  std::error_code error;
  const auto failed = [&] { return fmt::format("{}: {}", folder.string(), error.message()); };
  if (!fs::exists(folder, error)) {
    fs::create_directories(folder, error);
    return error ? failed() : "";
  }
  if (!fs::is_directory(folder, error)) return fmt::format("{}: it is not a folder", folder.string());
  const bool is_empty = fs::is_empty(folder, error);
  if (error) return failed();
  if (is_empty) return "";
  const bool is_run =
      fs::is_regular_file(folder / run_file::kScene) && fs::is_regular_file(folder / run_file::kSummary);
  if (!overwrite)
    return fmt::format("{}: there is {} in it already; name another folder with --out{}", folder.string(),
                       is_run ? "a run" : "something", is_run ? ", or replace the run with --overwrite" : "");
  if (!is_run)
    return fmt::format("{}: it is not empty and not a run's folder; --overwrite replaces only runs",
                       folder.string());
  if (const auto lock = RunLock::take(folder); !lock) return lock.error();
  remove_checkpoints(folder);
  fs::remove(folder / run_file::kFailure, error);
  fs::remove_all(folder / run_file::kRejectedCuts, error);
  for (const auto name : run_file::kAll) {
    fs::remove(folder / name, error);
    if (error) return failed();
  }
  for (const auto name : run_file::kFigures) {
    for (const fs::path& file : {folder / name, (folder / name).replace_extension(".png")})
      fs::remove(file, error);
    if (error) return failed();
  }
  return "";
}

tl::expected<RunLock, std::string> RunLock::take(const fs::path& folder) {
  const fs::path scene = folder / run_file::kScene;
  const int descriptor = ::open(scene.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return tl::unexpected(fmt::format("{}: {}", scene.string(), std::strerror(errno)));
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(descriptor);
    return tl::unexpected(fmt::format("{}: another polynya is at this run", folder.string()));
  }
  return RunLock(descriptor);  // file systems without locks go without
}

RunLock::~RunLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace polynya::io
