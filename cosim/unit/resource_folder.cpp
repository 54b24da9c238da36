#include "cosim/unit/resource_folder.hpp"

#include <charconv>

#include <fmt/format.h>

namespace polynya::cosim {

io::Result<std::string> folder_of(std::string_view uri) {
  constexpr std::string_view kScheme = "file:";
  const auto wrong = [&] {
    return io::fail(fmt::format("fmuResourceLocation is \"{}\", allowed: a URI file:///folder", uri));
  };
  if (!uri.starts_with(kScheme)) return wrong();
  std::string_view path = uri.substr(kScheme.size());
  if (path.starts_with("//")) {  // a host stands between two and the third slash: this one, or none
    path.remove_prefix(2);
    if (path.starts_with("localhost/")) path.remove_prefix(9);
  }
  if (!path.starts_with('/')) return wrong();
  std::string folder;
#ifdef _WIN32
  if (path.size() > 2 && path[2] == ':') path.remove_prefix(1);  // file:///C:/folder
#endif
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] != '%') {
      folder += path[i];
      continue;
    }
    unsigned char byte = 0;
    const char* const digits = path.data() + i + 1;
    if (i + 2 >= path.size() || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2) return wrong();
    folder += static_cast<char>(byte);
    i += 2;
  }
  return folder;
}

}  // namespace polynya::cosim
