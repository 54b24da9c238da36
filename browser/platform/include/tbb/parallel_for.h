#pragma once

// Takes oneTBB's place in WebAssembly, which has one thread here: chunks are called in their order, which gives the
// bytes of any number of threads (docs/architecture.md, Determinism).

namespace tbb {

struct simple_partitioner {};

template <class Index, class Function>
void parallel_for(Index first, Index last, const Function& function, simple_partitioner) {
  for (Index i = first; i < last; ++i) function(i);
}

}  // namespace tbb
