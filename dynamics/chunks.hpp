#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "dynamics/thread_limit.hpp"

namespace polynya::dynamics {

// What one thread takes at a time of a step's contacts and islands: fewer are not worth another thread.
inline constexpr std::size_t kContactsPerChunk = 128;
inline constexpr std::size_t kIslandsPerChunk = 16;  ///< most have one or two contacts

inline std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

/// Calls work(chunk, begin, end) for every chunk of `chunk` indices of [0, count), on the threads of the ThreadLimit
/// that executes, or in order where threads is 1. The chunks depend on `chunk` alone, so that what each writes is the
/// same on any number of threads; sums must be formed per chunk and added in the chunks' order.
template <typename Work>
void for_chunks(std::size_t count, std::size_t chunk, int threads, Work work) {
  const std::size_t chunks = chunk_count(count, chunk);
  const auto run = [&](std::size_t k) { work(k, k * chunk, std::min(count, (k + 1) * chunk)); };
  ThreadLimit* const limit = threads > 1 && chunks > 1 ? ThreadLimit::current() : nullptr;
  if (limit != nullptr) return limit->run(chunks, std::ref(run));
  for (std::size_t k = 0; k < chunks; ++k) run(k);
}

}  // namespace polynya::dynamics
