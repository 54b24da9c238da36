#pragma once

#include <filesystem>
#include <string>

namespace polynya::io {

/// Memory that this process can use in total, including the memory that it uses already. Before a run starts, the
/// program refuses the scene if the estimated need at the start is larger, and prints a note if only the need with all
/// floes moving is larger.
struct MemoryAvailable {
  double bytes = 0;    ///< infinite if no limit is known
  std::string source;  ///< the limit in words, for messages: "the limit of ulimit -v"; "nothing" if bytes is infinite
};

/// Returns the smallest of these limits: the free memory of the machine (/proc/meminfo), the free memory of the control
/// groups of this process (versions 2 and 1), and the limits of the process (ulimit -v and -d). The first two include
/// the free swap and the memory that this process uses already; in a group, memory that caches files counts as free. A
/// limit that cannot be read is ignored. `root` is the folder that contains /proc and /sys; tests use another one. The
/// browser and Windows have their own implementations.
MemoryAvailable memory_available(const std::filesystem::path& root = "/");

}  // namespace polynya::io
