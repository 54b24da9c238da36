#include "app/options.hpp"

namespace polynya::app {

void add_scene(CommandLine& command, std::string& scene) {
  command.option("scene", scene, "SCENE", "The scene's JSON file; - for stdin").required();
}

void add_run_folder(CommandLine& command, std::string& folder) {
  command.option("run", folder, "RUN", "The run folder").required();
}

void add_set(CommandLine& command, std::vector<io::Assignment>& assignments) {
  const auto problem_of = [](std::string& word) -> std::string {
    const auto assignment = io::parse_assignment(word);
    return assignment ? "" : assignment.error();
  };
  command.repeated(
      "--set", "KEY=VALUE",
      "A scene key's value instead of the scene's, by its path: --set ice.thickness_m=0.7; may be "
      "repeated",
      {problem_of, ""}, [&assignments](const std::string& word) {
        if (auto assignment = io::parse_assignment(word)) assignments.push_back(std::move(*assignment));
      });
}

void add_progress(CommandLine& command, ProgressKind& kind) {
  command
      .option("--progress", kind, "", "auto: a bar on a terminal, else a line every ten seconds; on stderr")
      .one_of<ProgressKind>({{"auto", ProgressKind::kAuto},
                             {"bar", ProgressKind::kBar},
                             {"json", ProgressKind::kJson},
                             {"none", ProgressKind::kNone}});
}

}  // namespace polynya::app
