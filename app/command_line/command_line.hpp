#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/command_line/progress.hpp"
#include "io/scene/scene_assign.hpp"

// CLI11 takes seconds to compile wherever it is included: command_line.cpp alone does.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace polynya::app {

/// What is wrong with a word of the command line; "" where it is right. It may replace the word by another
/// form of it.
struct WordCheck {
  std::function<std::string(std::string&)> problem_of;
  std::string description;  ///< of what is allowed, shown in the help; may be empty
};

WordCheck between(double least, double most);
/// For counts and seeds: "1.5 is not a whole number from 1 to 1024".
WordCheck whole(std::uint64_t least, std::uint64_t most);
/// Every number but infinity and "nan".
WordCheck finite();
/// For files and folders: an empty name is a shell variable that is not set, not the default.
WordCheck not_empty();

/// '"all" is not one of: outside, inside, both'; with the nearest name where one is near.
std::string no_choice(const std::string& word, const std::vector<std::string_view>& names);

/// An option or positional of a command.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required();
  Option excludes(Option other);
  Option needs(Option other);
  Option in_group(const std::string& name);
  Option separated_by(char delimiter);
  Option takes(int count) { return takes(count, count); }
  Option takes(int least, int most);
  /// One value each time it is given, so that a positional may follow.
  Option takes_one_each_time();
  Option shows_default();
  Option checked_by(WordCheck check);
  /// Takes one of these names, which the help lists. CLI::IsMember and CLI::CheckedTransformer put their maps
  /// into messages, in reverse, and accept an enum's numbers.
  Option one_of(std::vector<std::string_view> names);
  template <class Enum>
  Option one_of(const std::vector<std::pair<std::string_view, Enum>>& choices) {
    std::vector<std::string_view> names;
    std::vector<std::string> values;
    for (const auto& [name, value] : choices) {
      names.push_back(name);
      values.push_back(std::to_string(static_cast<std::underlying_type_t<Enum>>(value)));
    }
    return one_of(std::move(names), std::move(values));
  }

 private:
  Option one_of(std::vector<std::string_view> names, std::vector<std::string> values);

  CLI::Option* option_;
};

struct OptionDescription {
  bool is_positional = false;
  std::string type;                ///< "SCENE", "M", "table|csv|json"
  std::vector<std::string> names;  ///< "-h", "--help"; of a positional none
  bool takes_value = false;
  std::string meaning;
};

/// A command line as its manual page and its completion show it: a copy, by values.
struct CommandDescription {
  std::string name;
  std::string meaning;
  std::string examples;  ///< the footer's, or empty
  std::string rest;      ///< of the footer
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;  ///< that its help lists
};

/// The program's command line, or one command on it. What options put their values into must outlive the
/// parse: each command keeps it in a shared_ptr that its `run` holds.
class CommandLine {
 public:
  explicit CommandLine(CLI::App* app) : app_(app) {}

  /// A command; its help begins with the footer's examples.
  CommandLine add_command(const std::string& name, const std::string& meaning, const std::string& footer);
  /// One of the installation's, not in the help.
  CommandLine add_hidden_command(const std::string& name, const std::string& meaning);
  /// It needs one of its own commands.
  void require_command();
  /// All that follows it stays as it is, --help too: another program reads that (`remaining`).
  void hand_on_arguments();
  std::vector<std::string> remaining() const;

  /// An option, or a positional where the name has no dashes. Values: text, numbers, optionals and lists of
  /// them, enums by `one_of` (see command_line.cpp).
  template <class Value>
  Option option(const char* name, Value& value, const char* type, const char* meaning, WordCheck check = {}) {
    if constexpr (std::is_enum_v<Value>) {
      return add_setter(
          name, [&value](int number) { value = static_cast<Value>(number); }, type, meaning);
    } else if constexpr (requires { requires std::is_enum_v<typename Value::value_type>; }) {
      using Enum = typename Value::value_type;
      return add_setter(
          name, [&value](int number) { value = static_cast<Enum>(number); }, type, meaning);
    } else {
      Option added = add_option(name, value, type, meaning);
      return check.problem_of ? added.checked_by(std::move(check)) : added;
    }
  }
  /// One that may be repeated; each word goes to the function once all are right.
  Option repeated(const char* name, const char* type, const char* meaning, WordCheck check,
                  std::function<void(const std::string&)> take);
  Option flag(const char* name, bool& value, const std::string& meaning);
  Option flag(const char* name, std::function<void()> set, const std::string& meaning);

  CommandDescription described() const;
  bool is_chosen() const;

 private:
  template <class Value>
  Option add_option(const char* name, Value& value, const char* type, const char* meaning);
  Option add_setter(const char* name, std::function<void(int)> set, const char* type, const char* meaning);

  CLI::App* app_;
};

// Options that several commands have.

/// The positionals SCENE and RUN.
void add_scene(CommandLine& command, std::string& scene);
void add_run_folder(CommandLine& command, std::string& folder);
/// --set, which every command that reads a scene to run or check it has.
void add_set(CommandLine& command, std::vector<io::Assignment>& assignments);
/// --progress, as every long command has it.
void add_progress(CommandLine& command, ProgressKind& kind);

/// A command, and what it does; it returns an ExitCode. Data goes to stdout, messages to stderr.
struct Command {
  CommandLine line;
  std::function<int()> run;
};

/// Runs the one of a command's own commands that the words chose.
inline int run_chosen(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (command.line.is_chosen()) return command.run();
  }
  return 0;
}

/// What the whole command line has beside its commands.
struct ProgramText {
  std::string examples;
  std::string footer;
  std::string version;
};

/// Parses the words and runs the command that they choose, or prints help, version or what is wrong with
/// them.
int run_command_line(const ProgramText& text, const std::vector<Command (*)(CommandLine&)>& commands, int count,
                     const char* const* words);

}  // namespace polynya::app
