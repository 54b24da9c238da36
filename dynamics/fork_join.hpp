#pragma once

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

/// Tells ThreadSanitizer what TBB, into whose library it cannot look, sees to: all before a parallel loop
/// comes before its chunks, and they come before all after it. Of two chunks it says nothing, so that what
/// they do to each other is found. Nothing in other builds.
namespace polynya::dynamics::fork_join {

#if defined(__SANITIZE_THREAD__)
inline char forked, joined;  // only their addresses count, known to a chunk before it has read anything
inline void fork() {
  __tsan_release(&forked);
}
inline void begin_chunk() {
  __tsan_acquire(&forked);
}
inline void end_chunk() {
  __tsan_release(&joined);
}
inline void join() {
  __tsan_acquire(&joined);
}
#else
inline void fork() {}         ///< before the loop
inline void begin_chunk() {}  ///< on its thread
inline void end_chunk() {}
inline void join() {}  ///< after the loop
#endif

}  // namespace polynya::dynamics::fork_join
