#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>
#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace polynya::dynamics {

/// Declares to ThreadSanitizer, which cannot see into TBB's library, the order that TBB keeps: all before a
/// parallel loop comes before its chunks, and they come before all after it. Nothing is declared between two
/// chunks, so that races between them are found. Empty in other builds.
namespace fork_join {

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

}  // namespace fork_join

/// What one thread takes at a time of a step's contacts, with the islands that begin among them: fewer are not worth
/// another thread.
inline constexpr std::size_t kContactsPerChunk = 128;

inline std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

/// Calls work(chunk, begin, end) for every chunk of `chunk` indices of [0, count), on that many threads. The
/// chunks depend on `chunk` alone, so that what each writes is the same on any number of threads; sums must
/// be formed per chunk and added in the chunks' order.
template <typename Work>
void for_chunks(std::size_t count, std::size_t chunk, int threads, Work work) {
  const std::size_t chunks = chunk_count(count, chunk);
  const auto run = [&](std::size_t k) { work(k, k * chunk, std::min(count, (k + 1) * chunk)); };
  if (threads <= 1 || chunks <= 1) {
    for (std::size_t k = 0; k < chunks; ++k) run(k);
  } else {
    const auto run_in_order = [&](std::size_t k) {
      fork_join::begin_chunk();
      run(k);
      fork_join::end_chunk();
    };
    fork_join::fork();
    tbb::parallel_for(std::size_t{0}, chunks, run_in_order, tbb::simple_partitioner());
    fork_join::join();
  }
}

/// Calls work(contact, place) for each of a step's contacts, on that many threads.
template <typename Contacts, typename Work>
void for_contacts(Contacts& contacts, int threads, Work work) {
  for_chunks(contacts.size(), kContactsPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(contacts[i], i);
  });
}

}  // namespace polynya::dynamics
