#include "dynamics/parallel.hpp"

#include <tbb/parallel_for.h>
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace polynya::dynamics {
namespace {

// Declares to ThreadSanitizer, which cannot see into TBB's library, the order that TBB keeps: all before a parallel
// loop comes before its chunks, and they come before all after it. Nothing is declared between two chunks, so that
// races between them are found. Empty in other builds.
#if defined(__SANITIZE_THREAD__)
char forked, joined;  // only their addresses count, known to a chunk before it has read anything
void fork() {
  __tsan_release(&forked);
}
void begin_chunk() {
  __tsan_acquire(&forked);
}
void end_chunk() {
  __tsan_release(&joined);
}
void join() {
  __tsan_acquire(&joined);
}
#else
void fork() {}         ///< before the loop
void begin_chunk() {}  ///< on its thread
void end_chunk() {}
void join() {}  ///< after the loop
#endif

}  // namespace

void run_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  const auto run_in_order = [&](std::size_t k) {
    begin_chunk();
    work(k);
    end_chunk();
  };
  fork();
  tbb::parallel_for(std::size_t{0}, count, run_in_order, tbb::simple_partitioner());
  join();
}

}  // namespace polynya::dynamics
