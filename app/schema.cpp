#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "io/scene/scene_schema.hpp"

namespace polynya::app {

Command add_schema(CommandLine& app) {
  CommandLine command =
      app.add_command("schema", "Print the JSON Schema of scenes",
                      "Examples:\n"
                      "  polynya schema > polynya.schema.json\n"
                      "  polynya schema --markdown            the tables of docs/scene.md\n");
  auto is_markdown = std::make_shared<bool>(false);
  command.flag("--markdown", *is_markdown, "Print the fields as Markdown tables");
  return {command, [is_markdown] {
            write_out(*is_markdown ? io::scene_tables() : io::scene_schema());
            return kDone;
          }};
}

}  // namespace polynya::app
