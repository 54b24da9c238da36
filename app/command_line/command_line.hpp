#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "app/command_line/console.hpp"
#include "io/scene/scene_reader.hpp"

// CLI11 takes seconds to compile wherever it is included: command_line.cpp alone does.
namespace CLI {
class App;
}  // namespace CLI

namespace polynya::app {

/// What is wrong with a word of the command line; "" where it is right.
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

/// What an option is besides its name, its value and its meaning.
struct OptionTraits {
  bool is_required = false;
  bool shows_default = false;
  std::string group = {};                  ///< its heading in the help; empty: "Options"
  std::vector<std::string> excludes = {};  ///< options that were added before
  std::string needs = {};                  ///< likewise
  char delimiter = 0;                      ///< between the items of a list
  int least = 1, most = 1;                 ///< items of a list, where they are not any number
  bool one_each_time = false;              ///< of a list, so that a positional may follow
};

using OptionValue =
    std::variant<std::string*, double*, int*, std::int64_t*, std::uint64_t*, std::optional<std::string>*,
                 std::optional<int>*, std::optional<double>*, std::optional<std::int64_t>*,
                 std::optional<std::uint64_t>*, std::vector<std::string>*, std::vector<double>*>;

/// The program's command line, or one command on it. What options put their values into must outlive the
/// parse: each command keeps it in a shared_ptr that its `run` holds.
class CommandLine {
 public:
  explicit CommandLine(CLI::App* app) : app_(app) {}

  /// A command; its help begins with the footer's examples. One without a meaning is not in the help.
  CommandLine add_command(const std::string& name, const std::string& meaning, const std::string& footer);
  /// It needs one of its own commands.
  void require_command();
  /// All that follows it stays as it is, --help too: another program reads that (`remaining`).
  void hand_on_arguments();
  std::vector<std::string> remaining() const;
  bool is_chosen() const;

  /// An option, or a positional where the name has no dashes.
  void option(const char* name, OptionValue value, const char* type, const char* meaning, WordCheck check = {},
              const OptionTraits& traits = {});
  /// One that takes one of these names, which the help lists.
  template <class Choice, class Value>
  void choice(const char* name, Value& value, const char* meaning,
              std::vector<std::pair<std::string_view, Choice>> choices, const OptionTraits& traits = {}) {
    std::vector<std::string_view> names;
    names.reserve(choices.size());
    for (const auto& each : choices) names.push_back(each.first);
    add_choice(name, std::move(names), meaning, traits,
               [&value, choices = std::move(choices)](std::size_t which) { value = choices[which].second; });
  }
  void flag(const char* name, bool& value, const std::string& meaning, const OptionTraits& traits = {});

 private:
  void add_choice(const char* name, std::vector<std::string_view> names, const char* meaning,
                  const OptionTraits& traits, std::function<void(std::size_t)> set);

  CLI::App* app_;
};

// Options that several commands have.

/// The positionals SCENE and RUN.
void add_scene(CommandLine& command, std::string& scene);
void add_run_folder(CommandLine& command, std::string& folder);
/// --set, which every command that reads a scene to run or check it has.
void add_set(CommandLine& command, std::vector<std::string>& words);
/// What its words, which have been checked, assign.
std::vector<io::Assignment> assignments_of(const std::vector<std::string>& words);
/// --progress, as every long command has it.
void add_progress(CommandLine& command, ProgressKind& kind);

/// A command, and what it does; it returns an ExitCode. Data goes to stdout, messages to stderr.
struct Command {
  CommandLine line;
  std::function<int()> run;
};
using Commands = std::vector<Command>;

/// Runs the one of the commands that the words chose.
int run_chosen(const Commands& commands);

// Each adds a command: its help, its options and what it does, all in one file (docs/architecture.md, "To add").
Command add_channel(CommandLine& app);
Command add_cut(CommandLine& app);
Command add_database(CommandLine& app);
Command add_export(CommandLine& app);
Command add_fmu(CommandLine& app);
Command add_import(CommandLine& app);
Command add_init(CommandLine& app);
Command add_inspect(CommandLine& app);
Command add_read_json(CommandLine& app);
Command add_read_run(CommandLine& app);
Command add_resume(CommandLine& app);
Command add_run(CommandLine& app);
Command add_schema(CommandLine& app);
Command add_ships(CommandLine& app);
Command add_validate(CommandLine& app);
Command add_view(CommandLine& app);
/// Those that are written in Python (python/polynya/command.py).
void add_python_commands(CommandLine& app, Commands& commands);

/// Becomes Python, which runs a command of the package: its name and its words. Returns, with an ExitCode, only where
/// that fails.
int become_python(const std::vector<std::string>& words);

/// Of the source that the program is built of; empty outside of git (cmake/PolynyaCommit.cmake).
extern const std::string_view kCommit;

/// What the whole command line has beside its commands.
struct ProgramText {
  std::string examples;
  std::string footer;
  std::string version;
};

/// Parses the words and runs the command that they choose, or prints help, version or what is wrong with them.
int run_command_line(const ProgramText& text, const std::function<Commands(CommandLine&)>& add_commands, int count,
                     const char* const* words);

}  // namespace polynya::app
