#include "io/run_folder.hpp"

#include <fmt/format.h>

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

}  // namespace polynya::io
