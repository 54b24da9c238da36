#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include "dynamics/parallel.hpp"

namespace polynya::dynamics {

/// Number of contacts of a step that one thread takes at a time, with the islands that begin among them; fewer are not
/// worth another thread. Results do not change.
inline constexpr std::size_t kContactsPerChunk = 128;

inline std::size_t chunk_count(std::size_t count, std::size_t chunk) {
  return (count + chunk - 1) / chunk;
}

/// Calls work(chunk, begin, end) for every chunk of `chunk` indices of [0, count), on the given number of threads. The
/// chunks depend only on `chunk`, so the values that each chunk writes are the same for any number of threads. Sums
/// must be formed per chunk and added in the order of the chunks.
template <typename Work>
void for_chunks(std::size_t count, std::size_t chunk, int threads, Work work) {
  const std::size_t chunks = chunk_count(count, chunk);
  const auto run = [&](std::size_t k) { work(k, k * chunk, std::min(count, (k + 1) * chunk)); };
  if (threads <= 1 || chunks <= 1) {
    for (std::size_t k = 0; k < chunks; ++k) run(k);
  } else {
    run_parallel(chunks, std::ref(run));
  }
}

/// Calls work(contact, place) for each contact of a step, on the given number of threads.
template <typename Contacts, typename Work>
void for_contacts(Contacts& contacts, int threads, Work work) {
  for_chunks(contacts.size(), kContactsPerChunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(contacts[i], i);
  });
}

}  // namespace polynya::dynamics
