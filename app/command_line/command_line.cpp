#include "app/command_line/command_line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "app/command_line/console.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

/// A footer's examples, and what follows after an empty line.
std::pair<std::string, std::string> examples_and_rest(const std::string& footer) {
  if (!footer.starts_with("Examples:")) return {"", footer};
  const std::size_t end = footer.find("\n\n");
  return end == std::string::npos ? std::pair{footer, std::string()}
                                  : std::pair{footer.substr(0, end + 1), footer.substr(end + 2)};
}

/// Those that its help lists.
std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) commands.push_back(command);
  }
  return commands;
}

class ExamplesFirst : public CLI::Formatter {
 public:
  /// In the order in which the groups' first options were added, but --help: what a command is for comes
  /// first.
  std::string option_groups(const CLI::App* app) const {
    std::vector<std::string> groups;
    const auto options = app->get_options([](const CLI::Option* option) { return option->nonpositional(); });
    for (const CLI::Option* option : options) {
      const std::string& group = option->get_group();
      if (option != app->get_help_ptr() && !group.empty() && std::ranges::find(groups, group) == groups.end())
        groups.push_back(group);
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
    const auto [examples, rest] = examples_and_rest(app->get_footer());
    std::string text = make_description(app);
    if (!examples.empty()) text += "\n" + examples + "\n";
    text += make_usage(app, std::move(name)) + make_positionals(app) + option_groups(app) + make_subcommands(app, mode);
    return rest.empty() ? text : text + "\n" + rest;
  }
};

OptionDescription description_of(const CLI::Option& option) {
  OptionDescription described{option.get_positional(),
                              option.get_type_name(),
                              {},
                              option.get_items_expected_max() > 0,
                              option.get_description()};
  for (const std::string& name : option.get_snames()) described.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) described.names.push_back("--" + name);
  return described;
}

CommandDescription description_of(const CLI::App& app) {
  const auto [examples, rest] = examples_and_rest(app.get_footer());
  CommandDescription described{app.get_name(), app.get_description(), examples, rest, {}, {}};
  for (const CLI::Option* option : app.get_options()) described.options.push_back(description_of(*option));
  for (const CLI::App* command : commands_of(app)) described.commands.push_back(description_of(*command));
  return described;
}

CLI::Validator validator_of(WordCheck check) {
  return {std::move(check.problem_of), std::move(check.description)};
}

// What is wrong with a command line, in plain words.

std::string meant_by(const std::string& word, const std::vector<std::string>& names) {
  const std::string meant = io::nearest(word, {names.begin(), names.end()});
  return meant.empty() ? "" : fmt::format("; did you mean {}?", meant);
}

std::string wrong_command(const CLI::App& command, const std::vector<std::string>& rest) {
  std::vector<std::string> names;
  for (const CLI::App* sub : commands_of(command)) names.push_back(sub->get_name());
  const auto first = std::ranges::find_if(rest, [](const std::string& word) { return !word.starts_with('-'); });
  return fmt::format("{}\ncommands: {}",
                     first == rest.end() ? std::string("a command is missing")
                                         : fmt::format("no such command: {}{}", *first, meant_by(*first, names)),
                     fmt::join(names, ", "));
}

std::string unexpected(const CLI::App& command, const std::vector<std::string>& rest) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const auto option = std::ranges::find_if(rest, [](const std::string& word) { return word.starts_with('-'); });
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

std::string no_choice(const std::string& word, const std::vector<std::string_view>& names) {
  const std::string meant = io::nearest(word, names);
  return fmt::format("\"{}\" is not one of: {}{}", word, fmt::join(names, ", "),
                     meant.empty() ? "" : fmt::format("; did you mean {}?", meant));
}

Option Option::required() {
  option_->required();
  return *this;
}
Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}
Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}
Option Option::in_group(const std::string& name) {
  option_->group(name);
  return *this;
}
Option Option::separated_by(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}
Option Option::takes(int least, int most) {
  option_->expected(least, most);
  return *this;
}
Option Option::takes_one_each_time() {
  option_->allow_extra_args(false);
  return *this;
}
Option Option::shows_default() {
  option_->capture_default_str();
  return *this;
}
Option Option::checked_by(WordCheck check) {
  option_->check(validator_of(std::move(check)));
  return *this;
}
Option Option::one_of(std::vector<std::string_view> names) {
  std::vector<std::string> values(names.begin(), names.end());
  return one_of(std::move(names), std::move(values));
}
Option Option::one_of(std::vector<std::string_view> names, std::vector<std::string> values) {
  option_->type_name(fmt::format("{}", fmt::join(names, "|")));
  option_->transform(CLI::Validator(
      [names = std::move(names), values = std::move(values)](std::string& word) -> std::string {
        const auto found = std::ranges::find(names, word);
        if (found == names.end()) return no_choice(word, names);
        word = values[static_cast<std::size_t>(found - names.begin())];
        return "";
      },
      ""));
  return *this;
}

CommandLine CommandLine::add_command(const std::string& name, const std::string& meaning, const std::string& footer) {
  CLI::App* const command = app_->add_subcommand(name, meaning);
  command->footer(footer);
  return CommandLine(command);
}
CommandLine CommandLine::add_hidden_command(const std::string& name, const std::string& meaning) {
  CLI::App* const command = app_->add_subcommand(name, meaning);
  command->group("");
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
CommandDescription CommandLine::described() const {
  return description_of(*app_);
}

template <class Value>
Option CommandLine::add_option(const char* name, Value& value, const char* type, const char* meaning) {
  return Option(app_->add_option(name, value, meaning)->type_name(type));
}
template Option CommandLine::add_option(const char*, std::string&, const char*, const char*);
template Option CommandLine::add_option(const char*, double&, const char*, const char*);
template Option CommandLine::add_option(const char*, int&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::int64_t&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::uint64_t&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::optional<std::string>&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::optional<int>&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::optional<double>&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::optional<std::int64_t>&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::optional<std::uint64_t>&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::vector<std::string>&, const char*, const char*);
template Option CommandLine::add_option(const char*, std::vector<double>&, const char*, const char*);

Option CommandLine::add_setter(const char* name, std::function<void(int)> set, const char* type, const char* meaning) {
  return Option(app_->add_option_function<int>(name, std::move(set), meaning)->type_name(type));
}

Option CommandLine::repeated(const char* name, const char* type, const char* meaning, WordCheck check,
                             std::function<void(const std::string&)> take) {
  const auto take_all = [take = std::move(take)](const std::vector<std::string>& words) {
    std::ranges::for_each(words, take);
  };
  return Option(app_->add_option_function<std::vector<std::string>>(name, take_all, meaning)
                    ->type_name(type)
                    ->allow_extra_args(false)
                    ->check(validator_of(std::move(check))));
}
Option CommandLine::flag(const char* name, bool& value, const std::string& meaning) {
  return Option(app_->add_flag(name, value, meaning));
}
Option CommandLine::flag(const char* name, std::function<void()> set, const std::string& meaning) {
  return Option(app_->add_flag_callback(name, std::move(set), meaning));
}

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
  command.repeated("--set", "KEY=VALUE",
                   "A scene key's value instead of the scene's, by its path: --set ice.thickness_m=0.7; may be "
                   "repeated",
                   {problem_of, ""}, [&assignments](const std::string& word) {
                     if (auto assignment = io::parse_assignment(word)) assignments.push_back(std::move(*assignment));
                   });
}

void add_progress(CommandLine& command, ProgressKind& kind) {
  command.option("--progress", kind, "", "auto: a bar on a terminal, else a line every ten seconds; on stderr")
      .one_of<ProgressKind>({{"auto", ProgressKind::kAuto},
                             {"bar", ProgressKind::kBar},
                             {"json", ProgressKind::kJson},
                             {"none", ProgressKind::kNone}});
}

int run_command_line(const ProgramText& text, const std::vector<Command (*)(CommandLine&)>& commands, int count,
                     const char* const* words) {
  CLI::App app(text.examples, "polynya");
  app.formatter(std::make_shared<ExamplesFirst>());  // subcommands inherit it
  app.footer(text.footer);
  app.set_version_flag("--version", text.version);
  app.require_subcommand(1);
  CommandLine line(&app);
  std::vector<Command> added;
  for (const auto& add : commands) added.push_back(add(line));
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, unused;
    if (app.exit(error, out, unused) != 0) {
      write_err(usage_message(app, error));
      return kUsage;
    }
    write_out(out.str());  // help or version
    return kDone;
  }
  return run_chosen(added);
}

}  // namespace polynya::app
