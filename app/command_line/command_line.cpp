#include "app/command_line/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

/// Returns the commands that the help of a command line lists.
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

class ExamplesFirst : public CLI::Formatter {
 public:
  /// Returns the groups of options in the order in which their first options were added; the group with --help comes
  /// last, because the purpose of a command comes first.
  std::string option_groups(const CLI::App* app) const {
    std::vector<std::string> groups;
    const auto options = app->get_options([](const CLI::Option* option) { return option->nonpositional(); });
    for (const CLI::Option* option : options) {
      const std::string& group = option->get_group();
      if (option != app->get_help_ptr() && std::ranges::find(groups, group) == groups.end()) groups.push_back(group);
    }
    if (groups.empty()) groups.emplace_back("Options");
    std::string text;
    for (const std::string& group : groups) {
      text += make_group(group, false, app->get_options([&group](const CLI::Option* option) {
        return option->nonpositional() && option->get_group() == group;
      }));
    }
    return text;
  }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    if (mode == CLI::AppFormatMode::Sub) return make_expanded(app);
    std::string examples, rest = app->get_footer();
    if (rest.starts_with("Examples:")) {
      const std::size_t end = std::min(rest.find("\n\n"), rest.size() - 1) + 1;
      examples = "\n" + rest.substr(0, end) + "\n";
      rest.erase(0, end);
    } else if (!rest.empty()) {
      rest.insert(0, "\n");
    }
    return make_description(app) + examples + make_usage(app, std::move(name)) + make_positionals(app) +
           option_groups(app) + make_subcommands(app, mode) + rest;
  }
};

std::string meant_by(const std::string& word, const std::vector<std::string_view>& names) {
  const std::string meant = io::nearest(word, names);
  return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

std::string wrong_command(const CLI::App& command, const std::vector<std::string>& rest) {
  std::vector<std::string_view> names;
  for (const CLI::App* sub : commands_of(command)) names.push_back(sub->get_name());
  const auto first = std::ranges::find_if(rest, [](const std::string& word) { return !word.starts_with('-'); });
  return fmt::format("{}\ncommands: {}",
                     first == rest.end() ? std::string("a command is missing")
                                         : fmt::format("no such command: {}{}", *first, meant_by(*first, names)),
                     fmt::join(names, ", "));
}

std::string unexpected(const CLI::App& command, const std::vector<std::string>& rest) {
  std::vector<std::string_view> names;
  for (const CLI::Option* option : command.get_options())
    names.insert(names.end(), option->get_lnames().begin(), option->get_lnames().end());
  const auto option = std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with('-'); });
  std::string words = fmt::format("not expected: {}", fmt::join(rest, " "));
  if (option == rest.end()) return words;
  const std::string_view given(*option);
  const std::string_view name = given.substr(std::min(given.find_first_not_of('-'), given.size()));
  const std::string meant = io::nearest(name.substr(0, name.find('=')), names);
  return meant.empty() ? words : fmt::format("{}; did you mean --{}?", words, meant);
}

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
  std::string words = error.what();
  if (!commands_of(*command).empty() && !has_unknown_option)
    words = wrong_command(*command, rest);
  else if (!rest.empty() && is_of_rest)
    words = unexpected(*command, rest);
  return fmt::format("{}: {}\n{} --help explains its options\n", path, words, path);
}

void apply(CLI::App& app, CLI::Option& option, const OptionTraits& traits) {
  option.required(traits.is_required);
  if (traits.shows_default) option.capture_default_str();
  if (!traits.group.empty()) option.group(traits.group);
  for (const std::string& other : traits.excludes) option.excludes(app.get_option(other));
  if (!traits.needs.empty()) option.needs(app.get_option(traits.needs));
  if (traits.delimiter != 0) option.delimiter(traits.delimiter);
  if (traits.most > 1) option.expected(traits.least, traits.most);
  if (traits.one_each_time) option.allow_extra_args(false);
}

}  // namespace

WordCheck between(double least, double most) {
  return {[least, most](std::string& word) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(word, value) && value >= least && value <= most) return "";
            return fmt::format("{} is not a number from {:g} to {:g}", word, least, most);
          },
          fmt::format("{:g} to {:g}", least, most)};
}

WordCheck whole(std::uint64_t least, std::uint64_t most) {
  return {[least, most](std::string& word) -> std::string {
            std::uint64_t value = 0;
            const char* const end = word.data() + word.size();
            const auto [stop, problem] = std::from_chars(word.data(), end, value);
            if (problem == std::errc() && stop == end && value >= least && value <= most) return "";
            return fmt::format("{} is not a whole number from {} to {}", word, least, most);
          },
          fmt::format("{} to {}", least, most)};
}

WordCheck finite() {
  return {[](std::string& word) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(word, value) && std::isfinite(value)) return "";
            return fmt::format("{} is not a finite number", word);
          },
          ""};
}

WordCheck not_empty() {
  return {[](std::string& word) -> std::string { return word.empty() ? "the name is empty" : ""; }, ""};
}

CommandLine CommandLine::add_command(const std::string& name, const std::string& meaning, const std::string& footer) {
  CLI::App* const command = app_->add_subcommand(name, meaning);
  command->footer(footer);
  if (meaning.empty()) command->group("");
  return CommandLine(command);
}
void CommandLine::require_command() {
  app_->require_subcommand(1);
}
void CommandLine::hand_on_arguments() {
  app_->set_help_flag();
  app_->prefix_command();
}
std::vector<std::string> CommandLine::remaining() const {
  return app_->remaining();
}
bool CommandLine::is_chosen() const {
  return app_->parsed();
}

void CommandLine::option(const char* name, OptionValue value, const char* type, const char* meaning, WordCheck check,
                         const OptionTraits& traits) {
  CLI::Option& added = *std::visit([&](auto* place) { return app_->add_option(name, *place, meaning); }, value);
  added.type_name(type);
  if (check.problem_of) added.check(CLI::Validator(std::move(check.problem_of), std::move(check.description)));
  apply(*app_, added, traits);
}

void CommandLine::add_choice(const char* name, std::vector<std::string_view> names, const char* meaning,
                             const OptionTraits& traits, std::function<void(std::size_t)> set) {
  const auto place_of = [names](const std::string& word) {
    return static_cast<std::size_t>(std::ranges::find(names, word) - names.begin());
  };
  CLI::Option& added = *app_->add_option_function<std::string>(
      name, [place_of, set = std::move(set)](const std::string& word) { set(place_of(word)); }, meaning);
  added.type_name(fmt::format("{}", fmt::join(names, "|")));
  const auto problem_of = [names, place_of](const std::string& word) {
    if (place_of(word) < names.size()) return std::string();
    return fmt::format("\"{}\" is not one of: {}{}", word, fmt::join(names, ", "), meant_by(word, names));
  };
  added.check(problem_of);
  apply(*app_, added, traits);
}

void CommandLine::flag(const char* name, bool& value, const std::string& meaning, const OptionTraits& traits) {
  apply(*app_, *app_->add_flag(name, value, meaning), traits);
}

void add_scene(CommandLine& command, std::string& scene) {
  command.option("scene", &scene, "SCENE", "JSON file of the scene; - for stdin", {}, {.is_required = true});
}

void add_run_folder(CommandLine& command, std::string& folder) {
  command.option("run", &folder, "RUN", "The run folder", {}, {.is_required = true});
}

void add_set(CommandLine& command, std::vector<std::string>& words) {
  const auto problem_of = [](std::string& word) -> std::string {
    const auto assignment = io::parse_assignment(word);
    return assignment ? "" : assignment.error();
  };
  command.option("--set", &words, "KEY=VALUE",
                 "Replace the value of a scene key, given by its path: --set ice.thickness_m=0.7; may be repeated",
                 {problem_of, ""}, {.one_each_time = true});
}

std::vector<io::Assignment> assignments_of(const std::vector<std::string>& words) {
  std::vector<io::Assignment> assignments;
  for (const std::string& word : words)
    if (auto assignment = io::parse_assignment(word)) assignments.push_back(*std::move(assignment));
  return assignments;
}

void add_progress(CommandLine& command, ProgressKind& kind) {
  command.choice<ProgressKind>("--progress", kind,
                               "Progress on stderr; auto: a bar on a terminal, otherwise a line every ten seconds",
                               {{"auto", ProgressKind::kAuto},
                                {"bar", ProgressKind::kBar},
                                {"json", ProgressKind::kJson},
                                {"none", ProgressKind::kNone}});
}

int run_chosen(const Commands& commands) {
  const auto chosen = std::ranges::find_if(commands, [](const Command& command) { return command.line.is_chosen(); });
  return chosen == commands.end() ? 0 : chosen->run();
}

int run_command_line(const ProgramText& text, const std::function<Commands(CommandLine&)>& add_commands, int count,
                     const char* const* words) {
  CLI::App app(text.examples, "polynya");
  app.formatter(std::make_shared<ExamplesFirst>());  // commands inherit it
  app.footer(text.footer);
  app.set_version_flag("--version", text.version);
  app.require_subcommand(1);
  CommandLine line(&app);
  const Commands commands = add_commands(line);
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, unused;
    if (app.exit(error, out, unused) != 0) {
      write_err(usage_message(app, error));
      return kUsage;
    }
    write_out(out.str());  // text of the help or the version
    return kDone;
  }
  return run_chosen(commands);
}

}  // namespace polynya::app
