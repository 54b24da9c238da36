#include "app/run/load_scene.hpp"

#include <cmath>
#include <filesystem>
#include <utility>

#include "io/run/run_folder.hpp"
#include "io/scene/scene_file.hpp"
#include "simulation/world/memory_estimate.hpp"

namespace polynya::app {
namespace {

using simulation::EqualSizes;
using simulation::FieldStatistics;
using simulation::LognormalSizes;
using simulation::PowerLawSizes;

std::string against(const EqualSizes& law, const FieldStatistics& field) {
  return fmt::format("equal sizes of {:g} m requested, largest deviation {:.2g} %", law.size,
                     100 * field.distance_to_law);
}

std::string against(const LognormalSizes& law, const FieldStatistics& field) {
  const auto* fitted = field.fitted ? std::get_if<LognormalSizes>(&*field.fitted) : nullptr;
  if (!fitted) return against(EqualSizes{law.mean}, field);
  return fmt::format(
      "log-normal sizes of {:g} m ± {:.3g} % requested, {:.4g} m ± {:.3g} % fitted; Kolmogorov-Smirnov distance "
      "{:.4f}",
      law.mean, 100 * law.spread, fitted->mean, 100 * fitted->spread, field.distance_to_law);
}

std::string against(const PowerLawSizes& law, const FieldStatistics& field) {
  const auto* fitted = field.fitted ? std::get_if<PowerLawSizes>(&*field.fitted) : nullptr;
  return fmt::format(
      "power law of exponent {:g} from {:g} to {:g} m requested, exponent {:.4g} fitted; Kolmogorov-Smirnov "
      "distance {:.4f}",
      law.exponent, law.least, law.largest, fitted ? fitted->exponent : 0, field.distance_to_law);
}

/// Returns an amount of memory as "2.15 GB".
std::string amount_of_memory(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

}  // namespace

void print_problems(const std::string& name, const std::vector<io::Problem>& problems) {
  print_lines(problems);
  print_err("polynya: {} in {}; nothing was written\n", counted(problems.size(), "problem"), name);
}

Outcome<io::LoadedScene> load_scene(const std::string& file, const io::SceneOverrides& overrides, ProgressKind progress,
                                    bool as_json) {
  const std::string name = input_name(file);
  auto text = with_progress(progress, "reading the scene", [&] { return read_input(file, io::kLongestScene); });
  if (!text) {
    if (as_json) write_out(io::to_json_text({{.file = name, .sentence = text.error()}}));
    return failure(kInputOutput, fmt::format("{}: {}", name, text.error()));
  }
  auto loaded = with_progress(progress, "making the scene", [&] {
    return io::read_scene(std::move(*text), name, std::filesystem::path(file).parent_path(), overrides);
  });
  if (loaded) return std::move(*loaded);
  if (as_json)
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
    if (const auto& brash = field.brash)
      print_out("floes[{}]: pieces {:.4g} to {:.4g} m thick, {:.6g} m³ of ice, {:+.2f} % of what the brash holds\n",
                field.group, brash->least_thickness, brash->largest_thickness, brash->volume,
                std::round(1e4 * (brash->volume / brash->asked_volume - 1)) / 100 + 0.0);
    if (!outcome.statistics) continue;
    const FieldStatistics& statistics = *outcome.statistics;
    const std::string law = std::visit([&](const auto& asked) { return against(asked, statistics); }, statistics.law);
    print_out("floes[{}]: {}\n", field.group, law);
    print_out(
        "floes[{}]: sizes {:.4g} to {:.4g} m, length / width {:.3g} and {:.3g} corners on average, overlap 0, gaps "
        "of {:g} m and more\n",
        field.group, statistics.least_size, statistics.largest_size, statistics.mean_aspect, statistics.mean_corners,
        field.gap);
  }
}

bool may_fit(const simulation::Scene& scene, const std::string& name, const io::MemoryAvailable& available) {
  const simulation::MemoryEstimate needed = simulation::estimate_memory(scene);
  if (needed.at_start > available.bytes) {
    print_err("polynya: {}: {} need at least {} of memory, and {} are available ({}); nothing was written; {}\n", name,
              counted(scene.floes.size(), "floe"), amount_of_memory(needed.at_start), amount_of_memory(available.bytes),
              available.source, kToNeedLessMemory);
    return false;
  }
  if (needed.all_moving > available.bytes) {
    print_err(
        "note: {}: the run takes about {} of memory if all floes move and touch each other, and {} are available "
        "({})\n",
        name, amount_of_memory(needed.all_moving), amount_of_memory(available.bytes), available.source);
  }
  return true;
}

void print_folder_size(const simulation::Scene& scene, bool has_final_geojson) {
  if (scene.floes.size() <= io::kMostFloesInFinal) return;
  const io::FolderSize size = io::estimate_folder_size(scene);
  print_err("note: for {}, floes.ndjson starts with about {}; final.geojson, about {}, {}\n",
            counted(scene.floes.size(), "floe"), amount_of_memory(size.floes), amount_of_memory(size.final_geojson),
            has_final_geojson ? "is written at the end" : "is written only with --final-geojson");
}

std::string out_of_memory() {
  const io::MemoryAvailable available = io::memory_available();
  if (!std::isfinite(available.bytes)) return "out of memory";
  return fmt::format("out of memory: {} are available in total ({})", amount_of_memory(available.bytes),
                     available.source);
}

}  // namespace polynya::app
