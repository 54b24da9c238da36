#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "app/command_line.hpp"

namespace polynya::app {

/// An option whose value Python reads and checks.
struct PythonOption {
  const char* name;
  const char* value;
  const char* meaning;
};

/// Some of them on a command line.
class PythonOptions {
 public:
  /// The options outlive it.
  explicit PythonOptions(std::span<const PythonOption> options)
      : options_(options), values_(options.size()) {}

  /// The command refers to this from then on.
  void add_to(CommandLine& command);

  /// Appends those that were given, each as NAME=VALUE.
  void append_to(std::vector<std::string>& words) const;

 private:
  std::span<const PythonOption> options_;
  std::vector<std::string> values_;
};

/// Becomes Python, which runs a module of the package (python/polynya) with these words. Returns, with an
/// ExitCode, only where that fails.
int become_python(const std::string& module, const std::vector<std::string>& words);

}  // namespace polynya::app
