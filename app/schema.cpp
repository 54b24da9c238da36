#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "io/scene_schema.hpp"

namespace polynya::app {

int schema(const SchemaOptions& options) {
  fmt::print("{}", options.markdown ? io::scene_tables() : io::scene_schema());
  return kDone;
}

}  // namespace polynya::app
