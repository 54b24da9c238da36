#include "app/guide.hpp"

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"
#include "app/python.hpp"
#include "app/write_output.hpp"
#include "io/text/version.hpp"

namespace polynya::app {
namespace {

/// A footer's examples, and what follows after an empty line.
std::pair<std::string, std::string> examples_and_rest(const std::string& footer) {
  if (!footer.starts_with("Examples:")) return {"", footer};
  const std::size_t end = footer.find("\n\n");
  return end == std::string::npos ? std::pair{footer, std::string()}
                                  : std::pair{footer.substr(0, end + 1), footer.substr(end + 2)};
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
    text += make_usage(app, std::move(name)) + make_positionals(app) + option_groups(app) +
            make_subcommands(app, mode);
    return rest.empty() ? text : text + "\n" + rest;
  }
};

std::string roff(const std::string& words) {
  std::string text;
  for (const char c : words) {
    if ((c == '.' || c == '\'') && (text.empty() || text.back() == '\n')) text += "\\&";
    if (c == '\\')
      text += "\\e";
    else if (c == '-')
      text += "\\-";
    else
      text += c;
  }
  return text;
}

void append_options(std::string& text, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    std::string names = option->get_positional() ? option->get_type_name() : "";
    for (const std::string& name : option->get_snames()) names += (names.empty() ? "-" : ", -") + name;
    for (const std::string& name : option->get_lnames()) names += (names.empty() ? "--" : ", --") + name;
    if (!option->get_positional() && option->get_items_expected_max() > 0)
      names += " " + option->get_type_name();
    text += fmt::format(".TP\n.B {}\n{}\n", roff(names), roff(option->get_description()));
  }
}

void append_command(std::string& text, const CLI::App& command, const std::string& path) {
  text += fmt::format(".SS {}\n{}\n", roff(path), roff(command.get_description()));
  const auto [examples, rest] = examples_and_rest(command.get_footer());
  if (!examples.empty()) text += fmt::format(".PP\n.nf\n{}.fi\n", roff(examples));
  append_options(text, command);
  if (!rest.empty()) text += fmt::format(".PP\n{}", roff(rest));
  for (const CLI::App* sub : commands_of(command)) append_command(text, *sub, path + " " + sub->get_name());
}

/// How bash completes a type of value.
std::string_view completed_by(std::string_view type) {
  type = type.substr(0, type.find(':'));  // a range may follow
  if (type == "FILE" || type == "SCENE" || type == "FLOES") return "-f";
  if (type == "RUN" || type == "DIR") return "-d";
  return "none";
}

/// The lines of the script's tables: after an option its choices or the kind of its value, after a command
/// its subcommands, options and the kind of its positional.
struct Completions {
  std::string values;
  std::string words;

  void add(const CLI::App& command, const std::string& path) {
    std::string known, rest = "none";
    for (const CLI::App* sub : commands_of(command)) known += sub->get_name() + " ";
    for (const CLI::Option* option : command.get_options()) {
      const std::string type = option->get_type_name();
      const bool has_choices = type.find('|') != std::string::npos;
      std::string choices = type;
      std::ranges::replace(choices, '|', ' ');
      if (option->get_positional()) {
        if (has_choices) known += choices + " ";
        rest = completed_by(type);
        continue;
      }
      for (const std::string& name : option->get_lnames()) {
        known += "--" + name + " ";
        if (option->get_items_expected_max() == 0) continue;
        values += has_choices ? fmt::format("    \"{} --{}\") choices=\"{}\" ;;\n", path, name, choices)
                              : fmt::format("    \"{} --{}\") value={} ;;\n", path, name, completed_by(type));
      }
    }
    words += fmt::format("    \"{}\") words=\"{}\"; rest={} ;;\n", path, known, rest);
    for (const CLI::App* sub : commands_of(command)) add(*sub, path + " " + sub->get_name());
  }
};

void append_paths(std::string& paths, const CLI::App& command, const std::string& path) {
  for (const CLI::App* sub : commands_of(command)) {
    const std::string longer = path + " " + sub->get_name();
    paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", longer);
    append_paths(paths, *sub, longer);
  }
}

std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(".TH POLYNYA 1 \"\" \"polynya {}\" \"User Commands\"\n", io::version());
  text += ".SH NAME\npolynya \\- simulate an icebreaker in pack ice\n";
  text += ".SH SYNOPSIS\n.B polynya\n.I command\n[\\fIoption\\fR ...]\n";
  text += fmt::format(".SH DESCRIPTION\n.nf\n{}.fi\n.SH OPTIONS\n", roff(app.get_description()));
  append_options(text, app);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) append_command(text, *command, command->get_name());
  return text + fmt::format(".SH EXIT STATUS\n{}", roff(app.get_footer()));
}

std::string bash_completion(const CLI::App& app) {
  Completions completions;
  completions.add(app, "");
  std::string paths;
  append_paths(paths, app, "");
  return fmt::format(R"(# Completes polynya in bash. Made by `polynya completion`.
_polynya() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}}
  local path="" words="" choices="" value="" rest="" i
  for ((i = 1; i < COMP_CWORD; i++)); do
    case "$path ${{COMP_WORDS[i]}}" in
    {}) path="$path ${{COMP_WORDS[i]}}" ;;
    esac
  done
  case "$path $before" in
{}  esac
  case "$path" in
{}  esac
  if [[ -z $choices && -z $value ]]; then
    if [[ $current == -* ]]; then
      choices=$words
    else
      for i in $words; do [[ $i == -* ]] || choices="$choices $i"; done
      value=$rest
    fi
  fi
  COMPREPLY=()
  [[ -z $choices ]] || mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
  if [[ $value == -f || $value == -d ]]; then
    mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen "$value" -- "$current")
  fi
}}
complete -o filenames -F _polynya polynya
)",
                     paths, completions.values, completions.words);
}

/// A command for the installation, not in the help: writes a page made of the whole command line.
Command add_page(CLI::App& app, const char* name, const char* meaning, std::string (*page)(const CLI::App&)) {
  auto* command = app.add_subcommand(name, meaning);
  command->group("");
  auto file = std::make_shared<std::string>();
  option(*command, "file", *file, "FILE", "Where to; stdout if not given");
  return {command, [file, page, &app] {
            describe_python_commands(app);
            const auto written = write_output(file->empty() ? "-" : *file, page(app));
            return written ? kDone : fail(kInputOutput, written.error());
          }};
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_group().empty()) commands.push_back(command);
  }
  return commands;
}

void lead_with_examples(CLI::App& app) {
  app.formatter(std::make_shared<ExamplesFirst>());
}

Command add_man(CLI::App& app) {
  return add_page(app, "man", "Write the manual page", man_page);
}

Command add_completion(CLI::App& app) {
  return add_page(app, "completion", "Write the completion for bash", bash_completion);
}

}  // namespace polynya::app
