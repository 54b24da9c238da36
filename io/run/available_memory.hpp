#pragma once

#include <filesystem>
#include <string>

namespace polynya::io {

/// Memory that this process can use in total, including what it uses already.
struct MemoryAvailable {
  double bytes = 0;    ///< infinite if nothing limits it
  std::string source;  ///< the limit in words, for messages
};

/// Returns the smallest of the free memory of the machine including swap (/proc/meminfo), the limits of the control
/// groups (versions 2 and 1), and the limits of the process (ulimit -v and -d). A limit that cannot be read is ignored.
/// `root` is the folder that contains /proc and /sys; tests use another one.
MemoryAvailable memory_available(const std::filesystem::path& root = "/");

}  // namespace polynya::io
