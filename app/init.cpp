#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/options.hpp"
#include "io/scene/scene_schema.hpp"
#include "io/text/output_file.hpp"

namespace polynya::app {
namespace {

int init(const std::string& file) {
  if (file.empty()) {
    write_out(io::commented_scene());
    return kDone;
  }
  if (std::filesystem::exists(file)) return fail(kInputOutput, file + ": it exists already");
  if (const auto written = io::write_named_file(file, io::commented_scene()); !written)
    return fail(kInputOutput, written.error());
  print_out("{}: a commented scene; run it with\n  polynya run {}\n", file, file);
  return kDone;
}

}  // namespace

Command add_init(CommandLine& app) {
  CommandLine command = app.add_command("init", "Write a commented scene to start from",
                                        "Examples:\n"
                                        "  polynya init my-scene.json && polynya run my-scene.json\n"
                                        "  polynya init                         to stdout\n");
  auto file = std::make_shared<std::string>();
  command.option("file", *file, "FILE", "Where to; stdout if not given");
  return {command, [file] { return init(*file); }};
}

}  // namespace polynya::app
