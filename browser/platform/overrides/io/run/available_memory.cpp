#include "io/run/available_memory.hpp"

namespace polynya::io {

/// WebAssembly can address 4 GiB. A browser tab can use half of them without being stopped.
MemoryAvailable memory_available(const std::filesystem::path&) {
  return {2.0 * 1024 * 1024 * 1024, "what a browser's tab has"};
}

}  // namespace polynya::io
