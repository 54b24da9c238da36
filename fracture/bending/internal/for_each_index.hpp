#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace polynya::fracture {

/// Calls work(i) once for every i < count, on that many threads.
template <typename Work>
void for_each_index(std::size_t count, int threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(run);
  run();
}

}  // namespace polynya::fracture
