#include "app/options.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

#include "io/text/problem.hpp"

namespace polynya::app {

void add_scene(CLI::App& command, std::string& scene) {
  option(command, "scene", scene, "SCENE", "The scene's JSON file; - for stdin")->required();
}

void add_run_folder(CLI::App& command, std::string& folder) {
  option(command, "run", folder, "RUN", "The run folder")->required();
}

void add_set(CLI::App& command, std::vector<io::Assignment>& assignments) {
  const auto is_assignment = [](std::string& word) -> std::string {
    const auto assignment = io::parse_assignment(word);
    return assignment ? "" : assignment.error();
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&assignments](const std::vector<std::string>& words) {
            for (const std::string& word : words)
              if (auto assignment = io::parse_assignment(word)) assignments.push_back(std::move(*assignment));
          },
          "A scene key's value instead of the scene's, by its path: --set ice.thickness_m=0.7; may be "
          "repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check(CLI::Validator(is_assignment, ""));
}

void add_progress(CLI::App& command, ProgressKind& kind) {
  set_choices<ProgressKind>(
      *command.add_option("--progress", kind,
                          "auto: a bar on a terminal, else a line every ten seconds; on stderr"),
      {{"auto", ProgressKind::kAuto},
       {"bar", ProgressKind::kBar},
       {"json", ProgressKind::kJson},
       {"none", ProgressKind::kNone}});
}

CLI::Validator between(double least, double most) {
  return {[least, most](std::string& word) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(word, value) && value >= least && value <= most) return "";
            return fmt::format("{} is not a number from {:g} to {:g}", word, least, most);
          },
          fmt::format("{:g} to {:g}", least, most)};
}

CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  return {[least, most](std::string& word) -> std::string {
            std::uint64_t value = 0;
            const char* const end = word.data() + word.size();
            const auto [stop, problem] = std::from_chars(word.data(), end, value);
            if (problem == std::errc() && stop == end && value >= least && value <= most) return "";
            return fmt::format("{} is not a whole number from {} to {}", word, least, most);
          },
          fmt::format("{} to {}", least, most)};
}

CLI::Validator finite() {
  return {[](std::string& word) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(word, value) && std::isfinite(value)) return "";
            return fmt::format("{} is not a finite number", word);
          },
          ""};
}

CLI::Validator not_empty() {
  return {[](std::string& word) -> std::string { return word.empty() ? "the name is empty" : ""; }, ""};
}

std::string no_choice(const std::string& word, const std::vector<std::string_view>& names) {
  const std::string meant = io::nearest(word, names);
  return fmt::format("\"{}\" is not one of: {}{}", word, fmt::join(names, ", "),
                     meant.empty() ? "" : fmt::format("; did you mean {}?", meant));
}

}  // namespace polynya::app
