#include "app/usage.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line.hpp"
#include "app/guide.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

std::string meant_by(const std::string& word, const std::vector<std::string>& names) {
  const std::string meant = io::nearest(word, {names.begin(), names.end()});
  return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

std::string wrong_command(const CLI::App& command, const std::vector<std::string>& rest) {
  std::vector<std::string> names;
  for (const CLI::App* sub : commands_of(command)) names.push_back(sub->get_name());
  const auto first =
      std::ranges::find_if(rest, [](const std::string& word) { return !word.starts_with('-'); });
  return fmt::format("{}\ncommands: {}",
                     first == rest.end()
                         ? std::string("a command is missing")
                         : fmt::format("no such command: {}{}", *first, meant_by(*first, names)),
                     fmt::join(names, ", "));
}

std::string unexpected(const CLI::App& command, const std::vector<std::string>& rest) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const auto option =
      std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with('-'); });
  return fmt::format("not expected: {}{}", fmt::join(rest, " "),
                     option == rest.end() ? "" : meant_by(option->substr(0, option->find('=')), names));
}

/// A positional by its type: "SCENE is missing" in place of "scene is required".
std::string missing(const CLI::App& command, const std::string& words) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() && words == option->get_name() + " is required")
      return fmt::format("{} is missing: {}", option->get_type_name(), option->get_description());
  }
  return words;
}

/// The library's words for a value that is missing or no number, in our own.
std::string in_plain_words(const std::string& words) {
  constexpr std::string_view kBegin = "Could not convert: ";
  const std::size_t equals = words.find(" = ");
  const std::size_t colon = words.find(": 1 required ");
  if (colon != std::string::npos && words.ends_with(" missing"))
    return fmt::format("{} needs a value", words.substr(0, colon));
  if (!words.starts_with(kBegin) || equals == std::string::npos) return words;
  return fmt::format("{}: {} is not a number", words.substr(kBegin.size(), equals - kBegin.size()),
                     words.substr(equals + 3));
}

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* command = &app;
  std::string path = app.get_name();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    path += " " + command->get_name();
  }
  const std::vector<std::string> rest = command->remaining();
  const bool has_unknown_option =
      std::ranges::any_of(rest, [](const std::string& word) { return word.starts_with('-'); });
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  const bool is_of_rest = code == CLI::ExitCodes::ExtrasError || code == CLI::ExitCodes::RequiredError;
  std::string words;
  if (!commands_of(*command).empty() && !has_unknown_option)
    words = wrong_command(*command, rest);
  else if (!rest.empty() && is_of_rest)
    words = unexpected(*command, rest);
  else
    words = missing(*command, in_plain_words(error.what()));
  return fmt::format("{}: {}\n{} --help explains its options\n", path, words, path);
}

}  // namespace polynya::app
