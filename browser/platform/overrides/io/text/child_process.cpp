#include "io/text/child_process.hpp"

namespace polynya::io {

tl::expected<ChildOutput, ChildFailure> run_child(const std::vector<std::string>& words, std::size_t,
                                                  std::string_view) {
  return tl::unexpected(ChildFailure{true, words[0] + ": a browser starts no programs; import this file with the "
                                                      "native polynya, which writes floes in metres"});
}

}  // namespace polynya::io
