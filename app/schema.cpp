#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/exit_code.hpp"
#include "io/scene/scene_schema.hpp"

namespace polynya::app {

int schema(const SchemaOptions& options) {
  write_out(options.markdown ? io::scene_tables() : io::scene_schema());
  return kDone;
}

}  // namespace polynya::app
