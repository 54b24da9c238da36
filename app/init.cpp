#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/tell.hpp"
#include "io/output_file.hpp"
#include "io/scene_schema.hpp"

namespace polynya::app {

int init(const InitOptions& options) {
  if (options.file.empty()) {
    fmt::print("{}", io::commented_scene());
    return kDone;
  }
  std::string problem;
  if (std::filesystem::exists(options.file))
    problem = options.file + ": it exists already";
  else
    problem = io::write_whole_file(options.file, io::commented_scene());
  if (!problem.empty()) {
    tell("polynya: {}\n", problem);
    return kInputOutput;
  }
  fmt::print("{}: a commented scene; run it with\n  polynya run {}\n", options.file, options.file);
  return kDone;
}

}  // namespace polynya::app
