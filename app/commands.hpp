#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/progress.hpp"

namespace polynya::app {

/// The subcommands, one file each. Each returns an ExitCode. Data goes to stdout, messages to stderr.

/// How a run is carried out, whether it starts or goes on.
struct CarryOptions {
  int threads = 1;
  double checkpoint_every = 0;        ///< simulated time between checkpoints [s]; 0: by the clock alone
  double checkpoint_every_wall = 60;  ///< and by the clock [s]; 0: never by it
  bool check = false;  ///< every cross-index and sum of the world is derived anew after every step
  ProgressKind progress = ProgressKind::kAuto;
};

struct RunOptions {
  std::string scene;
  std::string out;              ///< empty: runs/<scene name>
  std::optional<double> until;  ///< [s]
  std::optional<std::uint64_t> seed;
  bool overwrite = false;
  CarryOptions carry;
};
int run(const RunOptions& options);

struct ResumeOptions {
  std::string folder;
  std::string checkpoint;     ///< empty: the newest
  bool from_failure = false;  ///< only repeats the step that a failure was dumped for
  CarryOptions carry;
};
int resume(const ResumeOptions& options);

struct ValidateOptions {
  std::string scene;
  bool resolved = false;  ///< print the scene with every default filled in
  bool json = false;      ///< print its problems as a JSON array
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
