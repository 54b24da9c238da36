#pragma once

#include <filesystem>
#include <string>

namespace polynya::io {

/// How much memory this process can have in all, what it has already included.
struct MemoryAvailable {
  double bytes = 0;    ///< infinite where nothing limits it
  std::string source;  ///< what sets the limit, in words
};

/// The least of what is free on the machine, swap included (/proc/meminfo), of the control groups' limits
/// (version 2 and 1), and of the limits of the process (ulimit -v and -d). What cannot be read limits
/// nothing. `root` is where /proc and /sys are.
MemoryAvailable memory_available(const std::filesystem::path& root = "/");

}  // namespace polynya::io
