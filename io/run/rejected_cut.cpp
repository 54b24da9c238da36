#include "io/run/rejected_cut.hpp"

#include <fmt/format.h>

#include "io/run/run_folder.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/output_file.hpp"

namespace polynya::io {
namespace {

std::string floe_text(double time, const simulation::RejectedCut& cut) {
  std::string text;
  JsonWriter json(text);
  json.open('{').key("type").value("Feature").key("properties").open('{').key("floe_id").value(cut.floe);
  json.key("t_s").value(time).key("reason").value(cut.reason);
  json.close('}').key("geometry").polygon(cut.input.polygon_in_body).close('}');
  return text + "\n";
}

std::string ops_text(const simulation::CutInput& cut) {
  std::string text;
  JsonWriter json(text);
  json.open('[').open('{');
  if (cut.cusp_in_body.empty()) {
    json.key("line").value(cut.crack_in_body);
  } else {
    json.key("polygon").polygon({cut.cusp_in_body, {}}).key("keep").value("both");
  }
  json.key("must_cut").value(true).close('}').close(']');
  return text + "\n";
}

constexpr std::string_view kFloeEnding = ".geojson";
constexpr std::string_view kOpsEnding = "-ops.json";

/// Whether write_rejected_cut() gives a file that name, or left it when it was killed.
bool is_name_of_ours(std::string_view name) {
  constexpr std::string_view kPart = ".part";
  constexpr std::size_t kDigits = 6;
  if (name.ends_with(kPart)) name.remove_suffix(kPart.size());
  const bool is_numbered = name.size() > kDigits && name.find_first_not_of("0123456789") == kDigits;
  return is_numbered && (name.substr(kDigits) == kFloeEnding || name.substr(kDigits) == kOpsEnding);
}

/// The folder for rejected cuts, which may be missing.
Result<std::filesystem::path> folder_in(const std::filesystem::path& run_folder) {
  std::filesystem::path folder = run_folder / run_file::kRejectedCuts;
  std::error_code ignored;
  if (!std::filesystem::is_symlink(std::filesystem::symlink_status(folder, ignored))) return folder;
  return fail(
      fmt::format("{}: a link; polynya writes through no link in a run folder; remove it", folder.string()));
}

}  // namespace

Result<> write_rejected_cut(const std::filesystem::path& run_folder, double time,
                            const simulation::RejectedCut& cut) {
  if (cut.input.number > kMostRejectedCuts) return {};
  const auto folder = folder_in(run_folder);
  if (!folder) return fail(folder.error());
  std::error_code error;
  std::filesystem::create_directory(*folder, error);
  if (error) return fail(fmt::format("{}: {}", folder->string(), error.message()));
  const auto write = [&](std::string_view ending, const std::string& text) {
    return write_whole_file(*folder / fmt::format("{:06}{}", cut.input.number, ending), text,
                            Durability::kSynced);
  };
  if (auto written = write(kFloeEnding, floe_text(time, cut)); !written) return written;
  return write(kOpsEnding, ops_text(cut.input));
}

Result<> remove_rejected_cuts(const std::filesystem::path& run_folder) {
  const auto folder = folder_in(run_folder);
  if (!folder) return fail(folder.error());
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(*folder, error))
    if (is_name_of_ours(entry.path().filename().string())) files.push_back(entry.path());
  for (const auto& file : files) {
    std::filesystem::remove(file, error);
    if (error) return fail(fmt::format("{}: {}", file.string(), error.message()));
  }
  std::filesystem::remove(*folder, error);  // unless something else is in it
  return {};
}

}  // namespace polynya::io
