#include "app/python.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include <unistd.h>

#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "app/options.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;

/// The folder that holds the Python package: beside the build's app/, or the installed one.
std::optional<fs::path> package_folder(const fs::path& program) {
  const fs::path above = program.parent_path().parent_path();
  for (const char* place : {"python", "lib/polynya/python"})
    if (fs::exists(above / place / "polynya" / "__init__.py")) return above / place;
  return {};
}

/// Debian's Python sees Debian's modules; another one first in the path may not.
std::string python() {
  if (const char* chosen = std::getenv("POLYNYA_PYTHON"); chosen && *chosen) return chosen;
  const char* const debians = "/usr/bin/python3";
  return access(debians, X_OK) == 0 ? debians : "python3";
}

}  // namespace

void PythonOptions::add_to(CommandLine& command) {
  for (std::size_t i = 0; i < options_.size(); ++i)
    command.option(options_[i].name, values_[i], options_[i].value, options_[i].meaning);
}

void PythonOptions::append_to(std::vector<std::string>& words) const {
  for (std::size_t i = 0; i < options_.size(); ++i)
    if (!values_[i].empty()) words.push_back(fmt::format("{}={}", options_[i].name, values_[i]));
}

int become_python(const std::string& module, const std::vector<std::string>& words) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const auto package = package_folder(program);
  if (!package)
    return fail(
        kInputOutput,
        fmt::format("the Python package is neither in {0}/python nor in {0}/lib/polynya/python; build "
                    "or install polynya again",
                    program.parent_path().parent_path().string()));
  const char* const more = std::getenv("PYTHONPATH");
  setenv("PYTHONPATH", (package->string() + (more && *more ? ":" + std::string(more) : "")).c_str(), 1);
  setenv("PYTHONSAFEPATH", "1", 1);  // no module of the working folder
  setenv("POLYNYA_PROGRAM", program.c_str(), 1);
  std::vector<std::string> line{python(), "-m", module};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(line.size() + 1);
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  flush_out();
  execvp(arguments[0], arguments.data());
  return fail(kInputOutput,
              fmt::format("{}: {}; this command needs Python: ./setup.sh python, or apt-get install python3",
                          line[0], std::strerror(errno)));
}

}  // namespace polynya::app
