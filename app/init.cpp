#include <filesystem>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "io/scene/scene_schema.hpp"
#include "io/text/output_file.hpp"

namespace polynya::app {

int init(const InitOptions& options) {
  if (options.file.empty()) {
    write_out(io::commented_scene());
    return kDone;
  }
  std::string problem;
  if (std::filesystem::exists(options.file))
    problem = options.file + ": it exists already";
  else
    problem = io::write_named_file(options.file, io::commented_scene());
  if (!problem.empty()) {
    print_err("polynya: {}\n", problem);
    return kInputOutput;
  }
  print_out("{}: a commented scene; run it with\n  polynya run {}\n", options.file, options.file);
  return kDone;
}

}  // namespace polynya::app
