#include "io/text/child_process.hpp"

namespace polynya::io {

tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t,
                                                  std::string_view) {
  return tl::unexpected(ChildFailure{true, words[0] + ": a co-simulation unit on Windows starts no programs"});
}

}  // namespace polynya::io
