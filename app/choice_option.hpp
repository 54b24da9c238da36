#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {

/// '"all" is not one of: outside, inside, both'; with the one that was meant where one is near.
inline std::string no_choice(const std::string& word, const std::vector<std::string_view>& names) {
  const std::string meant = io::nearest(word, names);
  return fmt::format("\"{}\" is not one of: {}{}", word, fmt::join(names, ", "),
                     meant.empty() ? "" : fmt::format("; did you mean {}?", meant));
}

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
