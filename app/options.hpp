#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line.hpp"
#include "app/progress.hpp"
#include "io/scene/scene_assign.hpp"

namespace polynya::app {

/// An option, or a positional where the name has no dashes.
template <class Value>
CLI::Option* option(CLI::App& command, const char* name, Value& value, const char* type, const char* meaning,
                    const CLI::Validator& check = {}) {
  return command.add_option(name, value, meaning)->type_name(type)->check(check);
}

/// The positionals SCENE and RUN.
void add_scene(CLI::App& command, std::string& scene);
void add_run_folder(CLI::App& command, std::string& folder);
/// --set, which every command that reads a scene to run or check it has.
void add_set(CLI::App& command, std::vector<io::Assignment>& assignments);
/// --progress, as every long command has it.
void add_progress(CLI::App& command, ProgressKind& kind);

/// As CLI::Range, which accepts "nan".
CLI::Validator between(double least, double most);
/// For counts and seeds: "1.5 is not a whole number from 1 to 1024".
CLI::Validator whole(std::uint64_t least, std::uint64_t most);
/// Every number but infinity and "nan".
CLI::Validator finite();
/// For files and folders: an empty name is a shell variable that is not set, not the default.
CLI::Validator not_empty();

/// '"all" is not one of: outside, inside, both'; with the nearest name where one is near.
std::string no_choice(const std::string& word, const std::vector<std::string_view>& names);

/// An option that takes one of these names. CLI::IsMember and CLI::CheckedTransformer put their maps into
/// messages, in reverse, and accept an enum's numbers.
template <class Enum>
void set_choices(CLI::Option& option, std::vector<std::pair<std::string_view, Enum>> choices) {
  std::vector<std::string_view> names;
  names.reserve(choices.size());
  for (const auto& choice : choices) names.push_back(choice.first);
  option.type_name(fmt::format("{}", fmt::join(names, "|")));
  option.transform(CLI::Validator(
      [choices = std::move(choices), names](std::string& word) -> std::string {
        for (const auto& [name, value] : choices) {
          if (word != name) continue;
          if constexpr (std::is_enum_v<Enum>)
            word = std::to_string(static_cast<std::underlying_type_t<Enum>>(value));
          else
            word = value;
          return "";
        }
        return no_choice(word, names);
      },
      ""));
}

/// Likewise for an option that keeps the name.
inline void set_choices(CLI::Option& option, const std::vector<std::string_view>& names) {
  std::vector<std::pair<std::string_view, std::string>> choices;
  choices.reserve(names.size());
  for (const std::string_view name : names) choices.emplace_back(name, name);
  set_choices(option, std::move(choices));
}

}  // namespace polynya::app
