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

// Only command_line.cpp includes CLI11, because it takes seconds to compile.
namespace CLI {
class App;
}  // namespace CLI

namespace polynya::app {

/// Check of a word of the command line. problem_of returns a message, or "" if the word is right.
struct WordCheck {
  std::function<std::string(std::string&)> problem_of;
  std::string description;  ///< allowed words, shown in the help; may be empty
};

/// Accepts numbers from `least` to `most`.
WordCheck between(double least, double most);
/// Accepts whole numbers, for counts and seeds. The message is "1.5 is not a whole number from 1 to 1024".
WordCheck whole(std::uint64_t least, std::uint64_t most);
/// Accepts all numbers except infinity and "nan".
WordCheck finite();
/// Accepts all texts except an empty one, for files and folders. An empty name usually comes from a shell variable that
/// is not set.
WordCheck not_empty();

/// Properties of an option in addition to its name, value and meaning.
struct OptionTraits {
  bool is_required = false;
  bool shows_default = false;
  std::string group = {};  ///< heading in the help; empty: "Options"
  /// Options that may not be given together with it; they must have been added before.
  std::vector<std::string> excludes = {};
  std::string needs = {};      ///< option that must be given with it, added before
  char delimiter = 0;          ///< character between the items of a list; 0: blanks
  int least = 1, most = 1;     ///< allowed number of items of a list; 1, 1: any number
  bool one_each_time = false;  ///< true: each occurrence of the option takes one item, so that a positional may follow
};

using OptionValue =
    std::variant<std::string*, double*, int*, std::int64_t*, std::uint64_t*, std::optional<std::string>*,
                 std::optional<int>*, std::optional<double>*, std::optional<std::int64_t>*,
                 std::optional<std::uint64_t>*, std::vector<std::string>*, std::vector<double>*>;

/// The program's command line, or one command of it. Parsing stores values in variables of the caller, which must exist
/// until then: each command keeps them in a shared_ptr that its `run` holds.
class CommandLine {
 public:
  explicit CommandLine(CLI::App* app) : app_(app) {}

  /// Adds a command. Its help begins with the examples in `footer`. A command without a meaning is not listed in the
  /// help.
  CommandLine add_command(const std::string& name, const std::string& meaning, const std::string& footer);
  /// Makes one of the command's own commands mandatory.
  void require_command();
  /// Leaves all words after the command unparsed, including --help, because another program reads them (`remaining`).
  void hand_on_arguments();
  std::vector<std::string> remaining() const;
  bool is_chosen() const;

  /// Adds an option, or a positional if the name has no dashes.
  void option(const char* name, OptionValue value, const char* type, const char* meaning, WordCheck check = {},
              const OptionTraits& traits = {});
  /// Adds an option that takes one of these names, which the help lists.
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

/// Add the positional SCENE, or RUN.
void add_scene(CommandLine& command, std::string& scene);
void add_run_folder(CommandLine& command, std::string& folder);
/// Adds --set, for every command that reads a scene to run or check it.
void add_set(CommandLine& command, std::vector<std::string>& words);
/// Returns the assignments of the words of --set, which have been checked.
std::vector<io::Assignment> assignments_of(const std::vector<std::string>& words);
/// Adds --progress, for every long command.
void add_progress(CommandLine& command, ProgressKind& kind);

/// A command and the function that carries it out, which returns an ExitCode. Data is written to stdout, messages to
/// stderr.
struct Command {
  CommandLine line;
  std::function<int()> run;
};
using Commands = std::vector<Command>;

/// Runs the command that the words chose.
int run_chosen(const Commands& commands);

// Each function adds a command with its help, options and action, all in one file (docs/architecture.md, "To add").
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
/// Adds the commands that are written in Python (python/polynya/command.py).
void add_python_commands(CommandLine& app, Commands& commands);

/// Replaces this process by Python, which runs a command of the package with its name and its words. Returns, with an
/// ExitCode, only if that fails.
int become_python(const std::vector<std::string>& words);

/// Commit of the source from which the program is built; empty outside of git (cmake/PolynyaCommit.cmake).
extern const std::string_view kCommit;

/// Texts of the help and the version of the whole program.
struct ProgramText {
  std::string examples;
  std::string footer;
  std::string version;
};

/// Parses the words and runs the chosen command, or prints help, version or an error. Returns the exit code.
int run_command_line(const ProgramText& text, const std::function<Commands(CommandLine&)>& add_commands, int count,
                     const char* const* words);

}  // namespace polynya::app
