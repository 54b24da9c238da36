#pragma once

#include <filesystem>
#include <string>

namespace polynya::io {

/// Memory that this process can use in total, including the memory that it uses already. A run compares it with an
/// estimate of its need, and refuses or warns before it starts.
struct MemoryAvailable {
  double bytes = 0;    ///< infinite if nothing limits it
  std::string source;  ///< the limit in words, for messages: "the limit of ulimit -v"
};

/// Returns the smallest of these limits, with the free swap added to the first two: the free memory of the machine
/// (/proc/meminfo), the free memory of the control groups of this process (versions 2 and 1), and the limits of the
/// process (ulimit -v and -d). A limit that cannot be read is ignored. `root` is the folder that contains /proc and
/// /sys; tests use another one.
MemoryAvailable memory_available(const std::filesystem::path& root = "/");

}  // namespace polynya::io
