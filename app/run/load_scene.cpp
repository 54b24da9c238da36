#include "app/run/load_scene.hpp"

#include <filesystem>
#include <utility>

#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"

namespace polynya::app {
namespace {

using simulation::EqualSizes;
using simulation::FieldStatistics;
using simulation::LognormalSizes;
using simulation::PowerLawSizes;

std::string against(const EqualSizes& law, const FieldStatistics& field) {
  return fmt::format("equal sizes of {:g} m asked for, none further off than {:.2g} %", law.size,
                     100 * field.distance_to_law);
}

std::string against(const LognormalSizes& law, const FieldStatistics& field) {
  const auto* fitted = field.fitted ? std::get_if<LognormalSizes>(&*field.fitted) : nullptr;
  if (!fitted) return against(EqualSizes{law.mean}, field);
  return fmt::format(
      "log-normal sizes of {:g} m ± {:.3g} % asked for, {:.4g} m ± {:.3g} % likeliest; Kolmogorov-Smirnov "
      "distance "
      "{:.4f}",
      law.mean, 100 * law.spread, fitted->mean, 100 * fitted->spread, field.distance_to_law);
}

std::string against(const PowerLawSizes& law, const FieldStatistics& field) {
  const auto* fitted = field.fitted ? std::get_if<PowerLawSizes>(&*field.fitted) : nullptr;
  return fmt::format(
      "power law of exponent {:g} from {:g} to {:g} m asked for, exponent {:.4g} likeliest; "
      "Kolmogorov-Smirnov "
      "distance {:.4f}",
      law.exponent, law.least, law.largest, fitted ? fitted->exponent : 0, field.distance_to_law);
}

}  // namespace

void print_problems(const std::string& name, const std::vector<io::Problem>& problems) {
  print_lines(problems);
  print_err("polynya: {} in {}; nothing was written\n", counted(problems.size(), "problem"), name);
}

tl::expected<io::LoadedScene, ExitCode> load_scene(const std::string& file, const io::SceneOverrides& overrides,
                                                   ProblemFormat format, ProgressKind progress) {
  const bool is_json = format == ProblemFormat::kJson;
  const std::string name = input_name(file);
  auto text = with_progress(progress, "reading the scene", [&] { return read_input(file, io::kLongestScene); });
  if (!text) {
    if (is_json) write_out(io::to_json_text({{.file = name, .sentence = text.error()}}));
    return tl::unexpected(fail(kInputOutput, fmt::format("{}: {}", name, text.error())));
  }
  auto loaded = with_progress(progress, "making the scene", [&] {
    return io::read_scene(std::move(*text), name, std::filesystem::path(file).parent_path(), overrides);
  });
  if (loaded) return std::move(*loaded);
  if (is_json)
    write_out(io::to_json_text(loaded.error()));
  else
    print_problems(name, loaded.error());
  return tl::unexpected(kSceneInvalid);
}

void print_fields(const io::LoadedScene& scene) {
  for (const io::FieldReport& field : scene.fields) {
    const simulation::FloeFieldOutcome& outcome = field.outcome;
    print_out("floes[{}]: {}, sizes {:.4g} m ± {:.3g} %, {:.4g} % of {:.6g} m² covered, {} left out\n", field.group,
              counted(outcome.count, "floe"), outcome.mean_size, 100 * outcome.size_spread,
              100 * outcome.concentration(), outcome.region_area, outcome.left_out);
    if (!outcome.statistics) continue;
    const FieldStatistics& statistics = *outcome.statistics;
    const std::string law = std::visit([&](const auto& asked) { return against(asked, statistics); }, statistics.law);
    print_out("floes[{}]: {}\n", field.group, law);
    print_out(
        "floes[{}]: sizes {:.4g} to {:.4g} m, length / width {:.3g} and {:.3g} corners on average, overlap "
        "0, gaps "
        "of {:g} m and more\n",
        field.group, statistics.least_size, statistics.largest_size, statistics.mean_aspect, statistics.mean_corners,
        field.gap);
  }
}

}  // namespace polynya::app
