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

/// Check of a word of the command line, before it is converted to the type of its variable. A word that violates it
/// ends the program with kUsage and the message.
struct WordCheck {
  /// Returns the message that the user gets, or "" if the word is right. It may also change the word. No function:
  /// every word is accepted.
  std::function<std::string(std::string&)> problem_of;
  std::string description;  ///< allowed words, shown in the help; may be empty
};

/// Accepts numbers from `least` to `most`, both included, in the unit of the option; not "nan".
WordCheck between(double least, double most);
/// Accepts whole numbers from `least` to `most`, both included, for counts and seeds. The message is like "1.5 is not a
/// whole number from 1 to 1024".
WordCheck whole(std::uint64_t least, std::uint64_t most);
/// Accepts all numbers except infinity and "nan".
WordCheck finite();
/// Accepts all texts except an empty one, for files and folders. An empty name usually comes from a shell variable that
/// is not set.
WordCheck not_empty();

/// Properties of an option in addition to its name, value and meaning. A command line that violates one of them is
/// rejected with kUsage.
struct OptionTraits {
  bool is_required = false;  ///< true: the command needs the option
  /// True: the help shows the value that the variable had when the option was added.
  bool shows_default = false;
  std::string group = {};  ///< heading in the help; empty: "Options"
  /// Options that may not be given together with it, such as "--json"; they must have been added before, otherwise the
  /// program ends by an exception at its start.
  std::vector<std::string> excludes = {};
  std::string needs = {};   ///< option that must be given with it, added before (see `excludes`); empty: none
  char delimiter = 0;       ///< character between the items of a list in one word; 0: each item is a word
  int least = 1, most = 1;  ///< allowed number of items of a list; with most = 1 `least` is ignored: any number
  /// For a list. True: each occurrence of the option takes one item, so that a positional may follow. False: it takes
  /// all words up to the next option.
  bool one_each_time = false;
};

/// Variable of the caller in which an option's value is stored. Its type decides which words are accepted. An optional
/// stays empty without the option, and any other variable keeps its value; a vector collects the items of a list.
using OptionValue =
    std::variant<std::string*, double*, int*, std::int64_t*, std::uint64_t*, std::optional<std::string>*,
                 std::optional<int>*, std::optional<double>*, std::optional<std::int64_t>*,
                 std::optional<std::uint64_t>*, std::vector<std::string>*, std::vector<double>*>;

/// The program's command line, or one command of it. Parsing stores values in variables of the caller, which must exist
/// until then: each command keeps them in a shared_ptr that its `run` holds.
class CommandLine {
 public:
  explicit CommandLine(CLI::App* app) : app_(app) {}

  /// Adds a command. `meaning` is its line in the help; a command with an empty one works but is not listed. `footer`
  /// is text at the end of the command's help; if its first paragraph begins with "Examples:", that paragraph is shown
  /// before the usage.
  CommandLine add_command(const std::string& name, const std::string& meaning, const std::string& footer);
  /// Makes one of the command's own commands mandatory, such as `build` after `polynya database`.
  void require_command();
  /// Leaves all words after the command unparsed, including --help, because another program reads them.
  void hand_on_arguments();
  std::vector<std::string> remaining() const;  ///< the words that hand_on_arguments() left, after parsing
  bool is_chosen() const;                      ///< true if the parsed command line contains this command

  /// Adds an option, such as "-o,--out", or a positional if the name has no dashes. `type` stands for the value in the
  /// help ("DIR"), and `meaning` explains the option there. `check` is applied to each word of the option.
  void option(const char* name, OptionValue value, const char* type, const char* meaning, WordCheck check = {},
              const OptionTraits& traits = {});
  /// Adds an option that takes one of these names, which the help lists. The value that belongs to the name is stored
  /// in `value`, which keeps its initial value without the option.
  template <class Choice, class Value>
  void choice(const char* name, Value& value, const char* meaning,
              std::vector<std::pair<std::string_view, Choice>> choices, const OptionTraits& traits = {}) {
    std::vector<std::string_view> names;
    names.reserve(choices.size());
    for (const auto& each : choices) names.push_back(each.first);
    add_choice(name, std::move(names), meaning, traits,
               [&value, choices = std::move(choices)](std::size_t which) { value = choices[which].second; });
  }
  /// Adds an option without a value, which sets the variable to true; without it the variable keeps its value.
  void flag(const char* name, bool& value, const std::string& meaning, const OptionTraits& traits = {});

 private:
  void add_choice(const char* name, std::vector<std::string_view> names, const char* meaning,
                  const OptionTraits& traits, std::function<void(std::size_t)> set);

  CLI::App* app_;
};

// Options that several commands have.

/// Add the mandatory positional SCENE (a file, or "-" for stdin), or RUN (a run folder).
void add_scene(CommandLine& command, std::string& scene);
void add_run_folder(CommandLine& command, std::string& folder);
/// Adds --set KEY=VALUE, which replaces values of a scene, for every command that reads a scene to run or check it. It
/// may be repeated. A word that is no assignment is refused; whether the key exists is checked with the scene.
void add_set(CommandLine& command, std::vector<std::string>& words);
/// Returns the assignments of the words of --set, in their order. Parsing has checked them; wrong words would be left
/// out.
std::vector<io::Assignment> assignments_of(const std::vector<std::string>& words);
/// Adds --progress, for every long command: auto, bar, json or none. It does not offer kLines, which auto uses without
/// a terminal. Without the option `kind` keeps its value.
void add_progress(CommandLine& command, ProgressKind& kind);

/// A command and the function that carries it out, which returns an ExitCode. Data is written to stdout, messages to
/// stderr.
struct Command {
  CommandLine line;
  std::function<int()> run;
};
using Commands = std::vector<Command>;

/// Runs the command that the parsed words chose and returns its exit code; 0 if none was chosen. `commands` are
/// all commands of one level; a command that has its own calls this function again with them.
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

/// Replaces this process by Python, which runs a command of the package polynya; the first word is the command's name.
/// POLYNYA_PYTHON chooses the interpreter; otherwise /usr/bin/python3 is preferred to the first python3 on the search
/// path, because it finds Debian's modules. Returns only if it fails (the package or Python is missing), with a message
/// on stderr and kInputOutput. Otherwise Python gives the exit code.
int become_python(const std::vector<std::string>& words);

/// Commit of the source from which the program is built; empty outside of git (cmake/PolynyaCommit.cmake).
extern const std::string_view kCommit;

/// Texts of `polynya --help` and `polynya --version`.
struct ProgramText {
  std::string examples;  ///< beginning of the help
  std::string footer;    ///< end of the help
  std::string version;   ///< output of --version
};

/// Parses the words and runs the chosen command, or prints help or version on stdout, or an error on stderr. Returns
/// the exit code: the command's own, 0 after help or version, or kUsage if the words are wrong or name no command.
/// `add_commands` adds the commands and returns them. `count` and `words` are the arguments of main().
int run_command_line(const ProgramText& text, const std::function<Commands(CommandLine&)>& add_commands, int count,
                     const char* const* words);

}  // namespace polynya::app
