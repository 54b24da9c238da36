// The definitions of parallel.cpp and thread_limit.cpp for programs on one thread, which then need no oneTBB: a
// co-simulation unit (cosim/) brings all that it needs. Results do not depend on the number of threads.
#include "dynamics/parallel.hpp"
#include "dynamics/thread_limit.hpp"

namespace polynya::dynamics {

ThreadLimit::ThreadLimit(int) {}

void ThreadLimit::execute(const std::function<void()>& function) {
  function();
}

void run_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t k = 0; k < count; ++k) work(k);
}

}  // namespace polynya::dynamics
