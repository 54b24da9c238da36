#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cosim/packing.hpp"
#include "cosim/variables.hpp"
#include <link.h>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/run/load_scene.hpp"
#include "io/scene/scene_file.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

constexpr auto kFmuExamples =
    "Examples:\n"
    "  polynya fmu scenes/route-in-ice.json --out ship.fmu      a unit for FMI 2.0 co-simulation, on linux64\n"
    "  polynya fmu my-scene.json --out ship.fmu --set ice.thickness_m=0.8\n"
    "  polynya fmu my-scene.json --out ship.fmu --win64 build/windows/cosim_unit/polynya.dll      also for Windows\n"
    "\n"
    "docs/couple.md explains its inputs and outputs.\n"
    "Exit codes: 0 done, 2 usage, 3 scene invalid, 5 input/output.\n";

struct FmuOptions {
  std::string scene;
  std::string out;
  std::string windows_library;  ///< empty: none
  std::vector<std::string> set;
};

/// Adds the path of a loaded library to a list, if it is one of the two that the unit needs.
int add_needed(dl_phdr_info* info, std::size_t, void* list) {
  const fs::path path = info->dlpi_name;
  const std::string name = path.filename().string();
  if (name.starts_with("libgmp.so.") || name.starts_with("libmpfr.so."))
    static_cast<std::vector<fs::path>*>(list)->push_back(path);
  return 0;
}

/// Returns the library of the unit, and the shared libraries of GMP and MPFR that this program uses. The unit's library
/// is beside the program's folder in the build tree, and below lib/polynya in an installation.
io::Result<std::vector<cosim::UnitLibrary>> unit_libraries() {
  std::error_code error;
  const fs::path above = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
  std::vector<fs::path> files;
  for (const char* place : {"cosim_unit", "lib/polynya/cosim_unit"})
    if (files.empty() && fs::exists(above / place / "polynya.so", error)) files.push_back(above / place / "polynya.so");
  if (files.empty())
    return io::fail(
        fmt::format("the library of co-simulation units, polynya.so, is neither in {0}/cosim_unit nor in "
                    "{0}/lib/polynya/cosim_unit; build or install polynya again",
                    above.string()));
  dl_iterate_phdr(add_needed, &files);
  std::ranges::sort(files.begin() + 1, files.end());
  if (files.size() != 3) return io::fail("this program runs without shared libraries of GMP and MPFR to pack");
  std::vector<cosim::UnitLibrary> libraries;
  for (const fs::path& file : files) libraries.push_back({file, "linux64", file.filename().string()});
  return libraries;
}

int make_unit(const FmuOptions& options) {
  const std::string name = input_name(options.scene);
  auto text = read_input(options.scene, io::kLongestScene);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", name, text.error()));
  io::SceneOverrides overrides;
  overrides.assignments = assignments_of(options.set);
  const auto scene = io::read_scene(*text, name, fs::path(options.scene).parent_path(), overrides);
  if (!scene) {
    print_problems(name, scene.error());
    return kSceneInvalid;
  }
  if (scene->scene.ships.empty() && scene->scene.structures.empty())
    return fail(kUsage, fmt::format("{}: a unit needs a ship or a structure; the scene has neither", name));
  // The unit gets the scene as the user wrote it, so that values that follow from its keys also follow from parameters.
  // With floe files or values of the command line it gets the resolved scene, because only that contains them.
  const bool is_whole = scene->files.empty() && options.set.empty();
  auto libraries = unit_libraries();
  if (!libraries) return fail(kInputOutput, libraries.error());
  if (!options.windows_library.empty()) libraries->push_back({options.windows_library, "win64", "polynya.dll"});
  const auto unit = cosim::pack_unit(is_whole ? *text : scene->resolved_text, *scene, *libraries);
  if (!unit) return fail(kInputOutput, unit.error());
  if (const auto written = write_output(options.out, *unit); !written) return fail(kInputOutput, written.error());
  if (!is_stdout(options.out))
    print_out("{}: {}, {:.1f} MB\n", options.out, counted(cosim::interface_of(*scene).variables.size(), "variable"),
              1e-6 * static_cast<double>(unit->size()));
  return kDone;
}

}  // namespace

Command add_fmu(CommandLine& app) {
  CommandLine command = app.add_command("fmu", "Make a co-simulation unit (FMI 2.0) from a scene", kFmuExamples);
  auto options = std::make_shared<FmuOptions>();
  add_scene(command, options->scene);
  command.option("--out", &options->out, "FILE.fmu", "File for the unit", not_empty(), {.is_required = true});
  command.option("--win64", &options->windows_library, "FILE.dll",
                 "The unit's library for 64-bit Windows, which the unit then has too", not_empty());
  add_set(command, options->set);
  return {command, [options] { return make_unit(*options); }};
}

}  // namespace polynya::app
