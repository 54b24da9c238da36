#include "io/run/available_memory.hpp"

#include <limits>

#include <windows.h>

namespace polynya::io {

MemoryAvailable memory_available(const std::filesystem::path&) {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  if (GlobalMemoryStatusEx(&status) == 0) return {std::numeric_limits<double>::infinity(), "nothing"};
  return {static_cast<double>(status.ullAvailPageFile), "what is free on this machine"};
}

}  // namespace polynya::io
