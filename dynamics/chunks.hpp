#pragma once

#include <algorithm>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "dynamics/fork_join.hpp"

namespace polynya::dynamics {

inline std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

/// Calls work(chunk, begin, end) for every chunk of `chunk` indices of [0, count), on so many threads. How
/// the indices are shared out depends on `chunk` alone, so that what chunks write apart is the same on any
/// number of threads; what they add up must be added per chunk and summed in the chunks' order.
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

}  // namespace polynya::dynamics
