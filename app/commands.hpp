#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/progress.hpp"

namespace polynya::app {

/// The subcommands, one file each. Each returns an ExitCode. Data goes to stdout, messages to stderr.

struct RunOptions {
  std::string scene;
  std::string out;              ///< empty: runs/<scene name>
  std::optional<double> until;  ///< [s]
  std::optional<std::uint64_t> seed;
  int threads = 1;
  ProgressKind progress = ProgressKind::kAuto;
  bool overwrite = false;
};
int run(const RunOptions& options);

struct ValidateOptions {
  std::string scene;
  bool resolved = false;  ///< print the scene with every default filled in
};
int validate(const ValidateOptions& options);

struct SchemaOptions {
  bool markdown = false;  ///< the tables of docs/scene.md instead
};
int schema(const SchemaOptions& options);

struct InitOptions {
  std::string file;  ///< empty: stdout
};
int init(const InitOptions& options);

}  // namespace polynya::app
