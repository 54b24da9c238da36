#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include <fmt/ranges.h>

#include "app/command_line/commands.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "app/command_line/python.hpp"
#include "io/text/version.hpp"

namespace polynya::app {
namespace {

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

void append_options(std::string& text, const CommandDescription& command) {
  for (const OptionDescription& option : command.options) {
    std::string names = option.is_positional ? option.type : fmt::format("{}", fmt::join(option.names, ", "));
    if (!option.is_positional && option.takes_value) names += " " + option.type;
    text += fmt::format(".TP\n.B {}\n{}\n", roff(names), roff(option.meaning));
  }
}

void append_command(std::string& text, const CommandDescription& command, const std::string& path) {
  text += fmt::format(".SS {}\n{}\n", roff(path), roff(command.meaning));
  if (!command.examples.empty()) text += fmt::format(".PP\n.nf\n{}.fi\n", roff(command.examples));
  append_options(text, command);
  if (!command.rest.empty()) text += fmt::format(".PP\n{}", roff(command.rest));
  for (const CommandDescription& sub : command.commands) append_command(text, sub, path + " " + sub.name);
}

/// How bash completes a type of value.
std::string_view completed_by(std::string_view type) {
  type = type.substr(0, type.find(':'));  // a range may follow
  if (type == "FILE" || type == "SCENE" || type == "FLOES" || type == "STUDY") return "-f";
  if (type == "RUN" || type == "DIR") return "-d";
  return "none";
}

/// The lines of the script's tables: after an option its choices or the kind of its value, after a command
/// its subcommands, options and the kind of its positional.
struct Completions {
  std::string values;
  std::string words;

  void add(const CommandDescription& command, const std::string& path) {
    std::string known, rest = "none";
    for (const CommandDescription& sub : command.commands) known += sub.name + " ";
    for (const OptionDescription& option : command.options) {
      const bool has_choices = option.type.find('|') != std::string::npos;
      std::string choices = option.type;
      std::ranges::replace(choices, '|', ' ');
      if (option.is_positional) {
        if (has_choices) known += choices + " ";
        rest = completed_by(option.type);
        continue;
      }
      for (const std::string& name : option.names) {
        if (!name.starts_with("--")) continue;
        known += name + " ";
        if (!option.takes_value) continue;
        values += has_choices ? fmt::format("    \"{} {}\") choices=\"{}\" ;;\n", path, name, choices)
                              : fmt::format("    \"{} {}\") value={} ;;\n", path, name, completed_by(option.type));
      }
    }
    words += fmt::format("    \"{}\") words=\"{}\"; rest={} ;;\n", path, known, rest);
    for (const CommandDescription& sub : command.commands) add(sub, path + " " + sub.name);
  }
};

void append_paths(std::string& paths, const CommandDescription& command, const std::string& path) {
  for (const CommandDescription& sub : command.commands) {
    const std::string longer = path + " " + sub.name;
    paths += fmt::format("{}\"{}\"", paths.empty() ? "" : "|", longer);
    append_paths(paths, sub, longer);
  }
}

std::string man_page(const CommandDescription& program) {
  std::string text = fmt::format(".TH POLYNYA 1 \"\" \"polynya {}\" \"User Commands\"\n", io::version());
  text += ".SH NAME\npolynya \\- simulate an icebreaker in pack ice\n";
  text += ".SH SYNOPSIS\n.B polynya\n.I command\n[\\fIoption\\fR ...]\n";
  text += fmt::format(".SH DESCRIPTION\n.nf\n{}.fi\n.SH OPTIONS\n", roff(program.meaning));
  append_options(text, program);
  text += ".SH COMMANDS\n";
  for (const CommandDescription& command : program.commands) append_command(text, command, command.name);
  return text + fmt::format(".SH EXIT STATUS\n{}", roff(program.rest));
}

std::string bash_completion(const CommandDescription& program) {
  Completions completions;
  completions.add(program, "");
  std::string paths;
  append_paths(paths, program, "");
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
Command add_page(CommandLine& program, const char* name, const char* meaning,
                 std::string (*page)(const CommandDescription&)) {
  CommandLine command = program.add_hidden_command(name, meaning);
  auto file = std::make_shared<std::string>();
  command.option("file", *file, "FILE", "Where to; stdout if not given");
  return {command, [file, page, program] {
            CommandDescription described = program.described();
            describe_python_commands(described.commands);
            const auto written = write_output(file->empty() ? "-" : *file, page(described));
            return written ? kDone : fail(kInputOutput, written.error());
          }};
}

}  // namespace

Command add_man(CommandLine& program) {
  return add_page(program, "man", "Write the manual page", man_page);
}

Command add_completion(CommandLine& program) {
  return add_page(program, "completion", "Write the completion for bash", bash_completion);
}

}  // namespace polynya::app
