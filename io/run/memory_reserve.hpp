#pragma once

namespace polynya::io {

/// Keeps some memory back from now on. Where there is no other, it is freed and used, so that a step which
/// runs out of memory can as a rule be finished. Once; exact numbers use it too
/// (geometry/exact/exact_memory.hpp).
void keep_memory_reserve();

/// Whether the reserve had to be used.
bool is_memory_reserve_used();

/// Frees the reserve, if there is still one.
void release_memory_reserve();

}  // namespace polynya::io
